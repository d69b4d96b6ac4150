/// Members that follow a log, against members that are run from its beginning.

#include "geocontainer_mpm/forecast/live_ensemble.h"

#include <gtest/gtest.h>

#include "geocontainer_mpm/error.h"
#include "release_fixture.h"

namespace geocontainer_mpm::forecast {
namespace {

const auto never = [] { return false; };

std::string distributions()
{
  return std::string(GEOCONTAINER_MPM_SOURCE_DIR) + "/config/ensembles/release.yaml";
}

EnsemblePlan plan(std::size_t members)
{
  return draw_members(release_path(), coarse_overrides(), distributions(), members, 7);
}

TEST(LiveEnsemble, FollowsTheLogInPiecesAsOneRunFromItsBeginningWould)
{
  LiveEnsemble pieces(plan(3), 2), whole(plan(3), 1);
  const scene::SceneDescription scene = coarse_release();
  const AssumedOpening& opening = planned();
  barge::OpeningSignal so_far(scene.hull->signal);
  std::vector<ensemble::Member> members;
  for (int i = 0; i <= 40; ++i) {
    so_far.add(sample_at(i));
    if (i == 15 || i == 30 || i == 40)
      members = pieces.run_ahead(so_far, opening.continue_from(so_far, 1.0), { 8.0, 20.0 }, 0.25, never);
  }
  EXPECT_GT(pieces.cost_s(), 0.0);
  const std::vector<ensemble::Member> at_once =
      whole.run_ahead(so_far, opening.continue_from(so_far, 1.0), { 8.0, 20.0 }, 0.25, never);
  ASSERT_EQ(members.size(), 3u);
  for (std::size_t i = 0; i < members.size(); ++i) {
    EXPECT_EQ(members[i].ending, ensemble::Ending::completed) << members[i].why;
    EXPECT_EQ(members[i].digest, at_once[i].digest);
    EXPECT_EQ(members[i].outcome, scene::Outcome::released);
  }
  EXPECT_NE(members[0].digest, members[1].digest);

  pieces.reset();  // another log begins
  const std::vector<ensemble::Member> again =
      pieces.run_ahead(so_far, opening.continue_from(so_far, 1.0), { 8.0, 20.0 }, 0.25, never);
  for (std::size_t i = 0; i < members.size(); ++i)
    EXPECT_EQ(again[i].digest, at_once[i].digest);
}

TEST(LiveEnsemble, SaysWhyAMemberIsMissing)
{
  EnsemblePlan two = plan(2);
  two.scenes[0].numerics.speed_jump = 1e-6;  // any motion is too fast
  LiveEnsemble ensemble(std::move(two), 1);
  const scene::SceneDescription scene = coarse_release();
  const AssumedOpening& opening = planned();
  barge::OpeningSignal so_far(scene.hull->signal);
  for (int i = 0; i <= 40; ++i)
    so_far.add(sample_at(i));
  const std::vector<ensemble::Member> members =
      ensemble.run_ahead(so_far, opening.continue_from(so_far, 1.0), { 4.0, 20.0 }, 0.25, never);
  EXPECT_EQ(members[0].ending, ensemble::Ending::failed);
  EXPECT_NE(members[0].why.find("solver stopped"), std::string::npos) << members[0].why;
  EXPECT_EQ(members[1].ending, ensemble::Ending::completed);
}

TEST(LiveEnsemble, SaysHowHardTheSheetIsPulledAtEachInstantAhead)
{
  LiveEnsemble ensemble(plan(4), 1);
  const scene::SceneDescription scene = coarse_release();
  const AssumedOpening& opening = planned();
  barge::OpeningSignal so_far(scene.hull->signal);
  for (int i = 0; i <= 15; ++i)
    so_far.add(sample_at(i));
  const std::vector<ensemble::Member> members =
      ensemble.run_ahead(so_far, opening.continue_from(so_far, 1.0), { 10.0, 20.0 }, 0.25, never);
  const TensionBand band = ensemble.tension();
  ASSERT_EQ(band.time_s.size(), 41u);
  ASSERT_EQ(band.p90.size(), band.time_s.size());
  double largest = 0.0;
  for (std::size_t k = 0; k < band.time_s.size(); ++k) {
    EXPECT_NEAR(band.time_s[k], so_far.known_until_s() + 0.25 * static_cast<double>(k), 1e-9);
    EXPECT_LE(band.p10[k], band.p50[k]);
    EXPECT_LE(band.p50[k], band.p90[k]);
    largest = std::max(largest, band.p90[k]);
  }
  // P90 of four members is the largest of them: at its own highest instant that member's own peak, as frames show it.
  double peak = 0.0;
  for (const ensemble::Member& member : members)
    peak = std::max(peak, *member.figures[ensemble::peak_tension_figure()]);
  EXPECT_LE(largest, peak);
  EXPECT_GE(largest, 0.5 * peak);
}

TEST(LiveEnsemble, DoesNotTakeAnOverrideOfWhatIsDrawn)
{
  std::vector<std::string> overrides = coarse_overrides();
  overrides.push_back("hull.friction=0.3");
  EXPECT_THROW(draw_members(release_path(), overrides, distributions(), 2, 1), InputError);
}

}  // namespace
}  // namespace geocontainer_mpm::forecast
