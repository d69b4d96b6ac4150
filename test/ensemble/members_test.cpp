/// Members run whichever way they are shared out, and what is made of their results.

#include "geocontainer_mpm/ensemble/members.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <thread>

namespace geocontainer_mpm::ensemble {
namespace {

using scene::Outcome;

constexpr double infinity = std::numeric_limits<double>::infinity();

Member completed(Outcome outcome, double peak, double utilisation, std::optional<double> release_s)
{
  Member member;
  member.ending = Ending::completed;
  member.outcome = outcome;
  member.figures = { peak, utilisation, release_s, 1.0, 5.0, 1.0 };
  return member;
}

Member failed(const std::string& why)
{
  Member member;
  member.ending = Ending::failed;
  member.why = why;
  member.figures.resize(figures().size());
  return member;
}

TEST(Summarise, CountsHungUpMembersAsReleasedLaterThanAllOthers)
{
  // Release is later the rougher the hull; the roughest hang. The second input has nothing to do with it.
  std::vector<Member> members;
  std::vector<std::vector<std::string>> values;
  const std::vector<const char*> other = { "3", "1", "5", "2", "4", "6", "10", "7", "9", "8" };
  for (int i = 0; i < 10; ++i) {
    members.push_back(i < 8 ? completed(Outcome::released, 100.0 - i, 0.5, 20.0 + i)
                            : completed(Outcome::hung_up, 100.0 - i, i == 9 ? 1.2 : 0.9, std::nullopt));
    values.push_back({ std::to_string(0.1 * i), other[static_cast<std::size_t>(i)] });
  }
  members[9].ruptures = 3;
  const Summary summary = summarise(members, values);
  EXPECT_EQ(summary.completed, 10u);
  EXPECT_EQ(summary.outcomes.at(Outcome::hung_up), 2u);
  EXPECT_DOUBLE_EQ(summary.hung_up->value, 0.2);
  EXPECT_DOUBLE_EQ(summary.ruptured->value, 0.1);
  EXPECT_DOUBLE_EQ(summary.overloaded->value, 0.1);
  const FigureSummary& release = summary.figures[release_time_figure()];
  EXPECT_DOUBLE_EQ(release.p10, 20.1);
  EXPECT_DOUBLE_EQ(release.p50, 24.5);
  EXPECT_EQ(release.p90, infinity);
  EXPECT_EQ(release.most_important, std::size_t{ 0 });
  // Places 9 and 10 are shared: correlation of 1 ... 10 with 1 ... 8, 9.5, 9.5.
  EXPECT_NEAR(release.rank_correlation[0].value(), 82.0 / std::sqrt(82.5 * 82.0), 1e-12);
  EXPECT_NEAR(summary.figures[0].rank_correlation[0].value(), -1.0, 1e-12);
  EXPECT_FALSE(summary.figures[4].rank_correlation[0].has_value()) << "all are as wide";
  EXPECT_FALSE(summary.figures[4].most_important.has_value());
}

TEST(Summarise, LeavesOutWhatFailedAndCountsIt)
{
  const std::vector<std::vector<std::string>> values = { { "1" }, { "2" }, { "3" } };
  const Summary summary = summarise(
      { completed(Outcome::released, 1.0, 0.1, 2.0), failed("why"), completed(Outcome::released, 3.0, 0.1, 4.0) },
      values);
  EXPECT_EQ(summary.members, 3u);
  EXPECT_EQ(summary.completed, 2u);
  EXPECT_DOUBLE_EQ(summary.figures[0].p50, 2.0);
  const Summary none = summarise({ failed("why"), failed("why"), failed("why") }, values);
  EXPECT_EQ(none.completed, 0u);
  EXPECT_TRUE(none.figures.empty());
  EXPECT_FALSE(none.hung_up.has_value());
}

TEST(RunMembers, RunsEachOnceOnAnyNumberOfThreads)
{
  for (const int threads : { 1, 2, 5, 40 }) {
    std::size_t done = 0;
    const std::vector<Member> members = run_members(
        23, threads,
        [](std::size_t i) {
          std::this_thread::sleep_for(std::chrono::microseconds(i % 3 == 0 ? 300 : 10));
          return completed(Outcome::released, static_cast<double>(i), 0.0, std::nullopt);
        },
        [&] { ++done; });
    EXPECT_EQ(done, 23u);
    for (std::size_t i = 0; i < 23; ++i)
      EXPECT_EQ(members.at(i).figures[0], static_cast<double>(i));
  }
}

TEST(Text, KeepsTheBits)
{
  std::vector<Member> members = { completed(Outcome::hung_up, 0.1 + 0.2, 1.0 / 3.0, std::nullopt),
                                  failed("a \"b\"\n") };
  members[0].digest = 0xfedcba9876543210ULL;
  members[0].ruptures = 4;
  const std::vector<Member> back = from_text(to_text(members));
  ASSERT_EQ(back.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(back[i].ending, members[i].ending);
    EXPECT_EQ(back[i].why, members[i].why);
    EXPECT_EQ(back[i].outcome, members[i].outcome);
    EXPECT_EQ(back[i].figures, members[i].figures);
    EXPECT_EQ(back[i].ruptures, members[i].ruptures);
    EXPECT_EQ(back[i].digest, members[i].digest);
  }
}

scene::SceneDescription thrown_block(double speed)
{
  return scene::parse_scene(R"(
name: thrown_block
gravity_m_per_s2: [0, 0]
time: { end_s: 0.5, output_interval_s: 0.1 }
grid: { cell_size_m: 0.1, lower_m: [0, 0], upper_m: [1, 1], faces: { y_min: free, y_max: free, z_min: free, z_max: free } }
materials:
  block: { law: linear_elastic, density_kg_per_m3: 1000, young_modulus_pa: 1.0e5, poisson_ratio: 0.3 }
bodies:
  block: { material: block, shape: { box: { lower_m: [0.1, 0.4], upper_m: [0.3, 0.6] } } }
)",
                            "thrown_block",
                            { "bodies.block.initial_velocity_m_per_s=[" + std::to_string(speed) + ", 0]" });
}

TEST(RunMember, NamesWhatEndedIt)
{
  const auto open = [](scene::Simulation& simulation) { simulation.use_scene_opening(); };
  const auto go = [] { return false; };
  const Member slow = run_member(thrown_block(0.5), open, go);
  EXPECT_EQ(slow.ending, Ending::completed) << slow.why;
  EXPECT_EQ(slow.outcome, Outcome::none);
  EXPECT_NE(slow.digest, 0u);
  const Member fast = run_member(thrown_block(5.0), open, go);
  EXPECT_EQ(fast.ending, Ending::failed);
  EXPECT_NE(fast.why.find("left the grid"), std::string::npos) << fast.why;
  const Member unopened = run_member(
      thrown_block(0.5), [](scene::Simulation&) { throw std::runtime_error("no log"); }, go);
  EXPECT_EQ(unopened.ending, Ending::failed);
  EXPECT_EQ(unopened.why, "no log");
  EXPECT_EQ(run_member(thrown_block(0.5), open, [] { return true; }).ending, Ending::interrupted);
}

}  // namespace
}  // namespace geocontainer_mpm::ensemble
