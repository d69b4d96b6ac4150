/// The solver thread against a run that is stepped by hand: same samples, same bits, whatever the timing.

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "geocontainer_mpm/ros/solver_thread.h"

namespace geocontainer_mpm::ros_bridge {
namespace {

using namespace std::chrono_literals;

constexpr std::int64_t second = 1'000'000'000;
constexpr std::int64_t epoch = 1'700'000'000 * second;
constexpr double log_s = 4.5;

scene::SceneDescription coarse_scene(const std::vector<std::string>& overrides = {})
{
  std::vector<std::string> all = { "time.end_s=3" };
  all.insert(all.end(), overrides.begin(), overrides.end());
  return scene::load_scene(GEOCONTAINER_MPM_SOURCE_DIR "/test/ros/coarse_release.yaml", all);
}

scene::Simulation coarse_simulation()
{
  return scene::Simulation(coarse_scene(), 1);
}

/// 20 Hz, closed for 0.5 s, then opening at 0.05 rad/s.
std::vector<barge::OpeningSample> make_log()
{
  std::vector<barge::OpeningSample> log;
  for (int i = 0; i <= static_cast<int>(log_s * 20.0); ++i) {
    const double angle = 0.05 * std::max(0.0, 0.05 * i - 0.5);
    log.push_back({ epoch + i * second / 20, { angle, angle } });
  }
  return log;
}

/// The digest at the end of the scene, stepped without thread, clock or queue.
std::uint64_t offline_digest()
{
  static const std::uint64_t digest = [] {
    scene::Simulation simulation = coarse_simulation();
    for (const barge::OpeningSample& sample : make_log())
      simulation.opening().add(sample);
    simulation.opening().finish();
    scene::Advance result = scene::Advance::stepped;
    while (result == scene::Advance::stepped || result == scene::Advance::frame_due)
      result = simulation.advance();
    EXPECT_EQ(result, scene::Advance::finished);
    return simulation.digest();
  }();
  return digest;
}

class SolverThreadTest : public testing::Test {
protected:
  void start(SolverSettings settings = {}, scene::Simulation simulation = coarse_simulation(),
             const std::string& record = "")
  {
    settings.gate.patience_ns = second / 10;
    settings.publish_rate_hz = 1000.0;
    SolverHooks hooks;
    hooks.now_ns = [this] { return now_ns.load(); };
    hooks.senders = [this] { return senders.load(); };
    hooks.frame_wanted = [] { return true; };
    hooks.frame = [this](const scene::Frame&, const Progress&) { ++frames; };
    hooks.progress = [](const Progress&) {};
    solver = std::make_unique<SolverThread>(std::move(simulation), queue, RunRecord(record, "coarse", "text"), settings,
                                            hooks);
  }

  void push(const barge::OpeningSample& sample) { queue.push({ sample, steady_now_ns() }); }

  /// Clock and samples as a player sends them, `pause` apart.
  void play(std::chrono::microseconds pause)
  {
    for (const barge::OpeningSample& sample : make_log()) {
      now_ns = sample.stamp_ns;
      push(sample);
      if (pause.count() > 0)
        std::this_thread::sleep_for(pause);
    }
  }

  template <typename Condition>
  bool wait_until(Condition condition, std::chrono::seconds limit = 30s)
  {
    const auto end = std::chrono::steady_clock::now() + limit;
    while (!condition(solver->progress())) {
      if (std::chrono::steady_clock::now() > end)
        return false;
      std::this_thread::sleep_for(2ms);
    }
    return true;
  }

  bool wait_for(RunState state, std::uint64_t run = 1)
  {
    return wait_until([&](const Progress& progress) { return progress.state == state && progress.run == run; });
  }

  std::atomic<std::int64_t> now_ns{ 0 };
  std::atomic<unsigned> senders{ 1 };
  std::atomic<int> frames{ 0 };
  OpeningQueue queue{ 10000 };
  std::unique_ptr<SolverThread> solver;
};

class SolverThreadTimingTest : public SolverThreadTest, public testing::WithParamInterface<int> {};

TEST_P(SolverThreadTimingTest, EndsAsARunByHand)
{
  start();
  play(std::chrono::microseconds(GetParam()));
  ASSERT_TRUE(wait_for(RunState::finished));
  ASSERT_TRUE(wait_until([](const Progress& progress) { return progress.accepted == make_log().size(); }));
  const Progress progress = solver->progress();
  EXPECT_EQ(progress.time_s, 3.0);
  EXPECT_EQ(progress.digest_time_s, 3.0);
  EXPECT_EQ(progress.digest, offline_digest());
  EXPECT_EQ(progress.stamp_ns, epoch + 3 * second);
  EXPECT_GT(progress.counters.steps, 100u);
  EXPECT_GT(frames, 3);
}

INSTANTIATE_TEST_SUITE_P(MicrosecondsBetweenSamples, SolverThreadTimingTest, testing::Values(0, 3000, 20000));

TEST_F(SolverThreadTest, WaitsForClockThenForSamples)
{
  start();
  ASSERT_TRUE(wait_for(RunState::waiting_for_clock));
  now_ns = epoch;
  ASSERT_TRUE(wait_for(RunState::waiting_for_opening));
}

TEST_F(SolverThreadTest, ClockGoingBackRepeatsTheRunBitForBit)
{
  start();
  play(0us);
  ASSERT_TRUE(wait_for(RunState::finished));
  // The player's two connections: first of the next loop before the clock, last of the loop before after it.
  const std::vector<barge::OpeningSample> log = make_log();
  push(log.front());
  std::this_thread::sleep_for(20ms);
  now_ns = epoch;
  push({ epoch + 60 * second, { 0.2, 0.2 } });
  std::this_thread::sleep_for(200ms);  // the left-over is given up
  for (std::size_t i = 1; i < log.size(); ++i) {
    now_ns = log[i].stamp_ns;
    push(log[i]);
  }
  ASSERT_TRUE(wait_for(RunState::finished, 2));
  const Progress progress = solver->progress();
  EXPECT_EQ(progress.digest, offline_digest());
  EXPECT_EQ(progress.rejected[static_cast<std::size_t>(RejectReason::from_future)], 1u);
}

TEST_F(SolverThreadTest, ResetWhileSteppingAnswersAndTheRunCanBeRepeated)
{
  start();
  play(0us);
  ASSERT_TRUE(wait_until([](const Progress& progress) { return progress.counters.steps > 10; }));
  std::future<Reply> reply = solver->reset();
  ASSERT_EQ(reply.wait_for(5s), std::future_status::ready);
  EXPECT_TRUE(reply.get().success);
  ASSERT_TRUE(wait_for(RunState::waiting_for_opening, 2));
  EXPECT_EQ(solver->progress().counters.steps, 0u);
  play(0us);
  ASSERT_TRUE(wait_for(RunState::finished, 2));
  EXPECT_EQ(solver->progress().digest, offline_digest());
}

TEST_F(SolverThreadTest, StopHoldsAndStartGoesOn)
{
  SolverSettings settings;
  settings.autostart = false;
  start(settings);
  play(0us);
  ASSERT_TRUE(wait_for(RunState::paused));
  std::this_thread::sleep_for(200ms);
  EXPECT_EQ(solver->progress().counters.steps, 0u);
  EXPECT_TRUE(solver->start().get().success);
  ASSERT_TRUE(wait_for(RunState::finished));
  EXPECT_EQ(solver->progress().digest, offline_digest());
}

TEST_F(SolverThreadTest, SilenceIsHeldOnceTheClockHasGoneOn)
{
  start();
  const std::vector<barge::OpeningSample> log = make_log();
  for (int i = 0; i < 20; ++i)
    push(log[static_cast<std::size_t>(i)]);
  now_ns = log[20].stamp_ns;
  ASSERT_TRUE(wait_until([](const Progress& progress) { return progress.accepted == 20; }));
  std::this_thread::sleep_for(300ms);
  EXPECT_FALSE(solver->progress().holding);  // the clock stands: a pause is no silence
  now_ns = epoch + 10 * second;
  ASSERT_TRUE(wait_for(RunState::finished));  // on the held angle
  EXPECT_TRUE(solver->progress().holding);
  EXPECT_EQ(solver->progress().gaps, 1u);
}

TEST_F(SolverThreadTest, TheLogIsOverWhenItsSenderHasGone)
{
  SolverSettings settings;
  settings.finish_when_source_leaves = true;
  start(settings);
  const std::vector<barge::OpeningSample> log = make_log();
  for (int i = 0; i < 20; ++i)
    push(log[static_cast<std::size_t>(i)]);
  now_ns = log[19].stamp_ns;
  ASSERT_TRUE(wait_until([](const Progress& progress) { return progress.accepted == 20; }));
  std::this_thread::sleep_for(300ms);
  EXPECT_FALSE(solver->progress().log_over);
  senders = 0;
  ASSERT_TRUE(wait_for(RunState::finished));
  EXPECT_TRUE(solver->progress().log_over);
}

TEST_F(SolverThreadTest, SolverFailureIsReportedAndResetRecovers)
{
  // No bed and no room below the lips: the container leaves the grid.
  start({}, scene::Simulation(coarse_scene({ "grid.lower_m=[-6,-4.6]", "surfaces.bed.line_m=[[-6,-4.55],[-5.5,-4.55]]",
                                             "hull.friction=0", "time.end_s=200" }),
                              1));
  for (int i = 0; i < 4000; ++i) {
    const double angle = std::min(0.6, 0.1 * 0.05 * i);
    push({ epoch + i * second / 20, { angle, angle } });
  }
  now_ns = epoch + 200 * second;
  ASSERT_TRUE(wait_for(RunState::stopped));
  EXPECT_FALSE(solver->progress().failure.reason.empty());
  EXPECT_TRUE(solver->reset().get().success);
  ASSERT_TRUE(wait_for(RunState::waiting_for_opening, 2));
  EXPECT_TRUE(solver->progress().failure.reason.empty());
}

TEST_F(SolverThreadTest, RecordsAndSaves)
{
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "geocontainer_mpm_solver_thread_test";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  SolverSettings settings;
  settings.save_directory = folder.string();
  start(settings, coarse_simulation(), (folder / "run.h5").string());
  play(0us);
  ASSERT_TRUE(wait_for(RunState::finished));
  EXPECT_EQ(solver->progress().recorded_frames, 31u);  // 0 to 3 s, both ends, each once
  const Reply reply = solver->save().get();
  ASSERT_TRUE(reply.success) << reply.message;
  EXPECT_TRUE(std::filesystem::exists(folder / "coarse_1.h5"));
  const nlohmann::json summary = nlohmann::json::parse(std::ifstream(folder / "coarse_1.json"));
  EXPECT_EQ(summary.at("digest"), digest_text(offline_digest()));
  EXPECT_EQ(summary.at("simulated_time_s"), 3.0);

  now_ns = epoch;  // a second run does not overwrite the first
  ASSERT_TRUE(wait_for(RunState::waiting_for_opening, 2));
  play(0us);
  ASSERT_TRUE(wait_for(RunState::finished, 2));
  EXPECT_TRUE(std::filesystem::exists(folder / "run_run2.h5"));
  EXPECT_TRUE(std::filesystem::exists(folder / "run.h5"));
  solver.reset();
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace geocontainer_mpm::ros_bridge
