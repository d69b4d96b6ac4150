/// Going on from a checkpoint: bit for bit with the whole log or the rest of it, and what makes it begin anew.

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <thread>

#include "geocontainer_mpm/ros/solver_thread.h"

namespace geocontainer_mpm::ros_bridge {
namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;

constexpr std::int64_t second = 1'000'000'000;
constexpr std::int64_t epoch = 1'700'000'000 * second;

scene::SceneDescription coarse_scene(const std::vector<std::string>& overrides = {})
{
  std::vector<std::string> all = { "time.end_s=2" };
  all.insert(all.end(), overrides.begin(), overrides.end());
  return scene::load_scene(GEOCONTAINER_MPM_SOURCE_DIR "/test/ros/coarse_release.yaml", all);
}

/// 20 Hz, opening at 0.05 rad/s from 0.3 s on.
std::vector<barge::OpeningSample> make_log()
{
  std::vector<barge::OpeningSample> log;
  for (int i = 0; i <= 70; ++i) {
    const double angle = 0.05 * std::max(0.0, 0.05 * i - 0.3);
    log.push_back({ epoch + i * second / 20, { angle, angle } });
  }
  return log;
}

std::uint64_t undisturbed_digest()
{
  static const std::uint64_t digest = [] {
    scene::Simulation simulation(coarse_scene(), 1);
    for (const barge::OpeningSample& sample : make_log())
      simulation.opening().add(sample);
    simulation.opening().finish();
    scene::Advance result = scene::Advance::stepped;
    while (result == scene::Advance::stepped || result == scene::Advance::frame_due)
      result = simulation.advance();
    return simulation.digest();
  }();
  return digest;
}

class RunCheckpointTest : public testing::Test {
protected:
  RunCheckpointTest()
  {
    fs::remove_all(folder);
    fs::create_directories(folder);
  }
  ~RunCheckpointTest() override
  {
    solver.reset();
    fs::remove_all(folder);
  }

  /// A node that begins with this checkpoint; `record`: a file name in the folder, or none.
  struct Told {
    bool found, resumed;
    std::string what;
  };
  Told start(const fs::path& checkpoint, const std::string& record = "",
             const scene::SceneDescription& scene = coarse_scene())
  {
    Beginning beginning = begin_or_resume(scene, 1, checkpoint.string());
    const Told told{ beginning.found, beginning.resumed, beginning.what };
    SolverSettings settings;
    settings.gate.patience_ns = second / 10;
    settings.checkpoint = checkpoint.string();
    settings.checkpoint_period_s = 1e-3;
    settings.resumed = beginning.resumed;
    settings.resume = beginning.what;
    RunRecord run_record(record.empty() ? "" : (folder / record).string(), "coarse", "text");
    if (beginning.found)
      settings.first_run = std::max<std::uint64_t>(2, run_record.free_run());
    SolverHooks hooks;
    hooks.now_ns = [this] { return now_ns.load(); };
    hooks.senders = [] { return 1u; };
    hooks.frame_wanted = [] { return false; };
    hooks.progress = [](const Progress&) {};
    now_ns = 0;
    queue.clear();
    solver =
        std::make_unique<SolverThread>(std::move(beginning.simulation), queue, std::move(run_record), settings, hooks);
    return told;
  }

  void play(std::size_t from, std::size_t to, std::int64_t later_ns = 0)
  {
    const std::vector<barge::OpeningSample> log = make_log();
    for (std::size_t i = from; i < std::min(to, log.size()); ++i) {
      now_ns = log[i].stamp_ns + later_ns;
      queue.push({ { log[i].stamp_ns + later_ns, log[i].angles }, steady_now_ns() });
    }
  }

  template <typename Condition>
  bool wait_until(Condition condition)
  {
    const auto end = std::chrono::steady_clock::now() + 60s;
    while (!condition(solver->progress())) {
      if (std::chrono::steady_clock::now() > end)
        return false;
      std::this_thread::sleep_for(2ms);
    }
    return true;
  }
  bool wait_for(RunState state)
  {
    return wait_until([state](const Progress& progress) { return progress.state == state; });
  }

  /// What a kill in the middle of the release leaves behind: the file as it was while steps were taken.
  fs::path left_by_a_kill()
  {
    static std::string bytes;
    if (bytes.empty()) {
      start(folder / "first.h5");
      play(0, 45);
      EXPECT_TRUE(wait_until([](const Progress& progress) { return progress.checkpoint_time_s > 1.0; }));
      std::ifstream file(folder / "first.h5", std::ios::binary);
      bytes.assign(std::istreambuf_iterator<char>(file), {});
      solver.reset();
    }
    const fs::path state = folder / "state.h5";
    std::ofstream(state, std::ios::binary) << bytes;
    return state;
  }

  const fs::path folder = fs::temp_directory_path() / "geocontainer_mpm_run_checkpoint_test";
  std::atomic<std::int64_t> now_ns{ 0 };
  OpeningQueue queue{ 10000 };
  std::unique_ptr<SolverThread> solver;
};

TEST_F(RunCheckpointTest, TheWholeLogAgainEndsAsTheUndisturbedRun)
{
  const fs::path state = left_by_a_kill();
  std::ofstream(folder / "run.h5") << "the record of the run that was killed";
  const Told beginning = start(state, "run.h5");
  ASSERT_TRUE(beginning.resumed) << beginning.what;
  EXPECT_NE(beginning.what.find("goes on at 1."), std::string::npos) << beginning.what;
  play(0, 1000);
  ASSERT_TRUE(wait_for(RunState::finished));
  const Progress progress = solver->progress();
  EXPECT_EQ(progress.digest, undisturbed_digest());
  EXPECT_EQ(progress.run, 2u);
  EXPECT_GT(progress.known_again, 20u);
  EXPECT_EQ(progress.rejected, RejectedCounts{}) << "what was known is no fault of the sensor";
  EXPECT_EQ(progress.gaps, 0u);
  EXPECT_EQ(progress.record_path, (folder / "run_run2.h5").string()) << "the first part stays";
  // The run is over: there is nothing to go on with.
  solver.reset();
  EXPECT_FALSE(start(state).resumed);
}

TEST_F(RunCheckpointTest, TheRestOfTheLogEndsAsTheUndisturbedRun)
{
  const fs::path state = left_by_a_kill();
  ASSERT_TRUE(start(state).resumed);
  play(20, 1000);
  ASSERT_TRUE(wait_for(RunState::finished));
  EXPECT_EQ(solver->progress().digest, undisturbed_digest());
}

TEST_F(RunCheckpointTest, ATerminatedNodeGoesOnWhereItWas)
{
  start(folder / "state.h5");
  play(0, 30);
  ASSERT_TRUE(wait_until([](const Progress& p) { return p.state == RunState::following && p.accepted == 30; }));
  const double reached_s = solver->progress().time_s;
  solver.reset();
  ASSERT_TRUE(start(folder / "state.h5").resumed);
  EXPECT_NEAR(solver->progress().time_s, reached_s, 0.1);  // a few dozen steps back at most
  play(0, 1000);
  ASSERT_TRUE(wait_for(RunState::finished));
  EXPECT_EQ(solver->progress().digest, undisturbed_digest());
}

TEST_F(RunCheckpointTest, AnotherLogBeginsAnew)
{
  const fs::path state = left_by_a_kill();
  for (const std::int64_t later_ns : { -100 * second, 3600 * second }) {
    fs::copy_file(state, folder / "copy.h5", fs::copy_options::overwrite_existing);
    ASSERT_TRUE(start(folder / "copy.h5").resumed);
    play(0, 1000, later_ns);
    ASSERT_TRUE(wait_for(RunState::finished));
    const Progress progress = solver->progress();
    EXPECT_EQ(progress.digest, undisturbed_digest());
    EXPECT_EQ(progress.run, 3u);
    EXPECT_NE(progress.resume.find("another one is heard"), std::string::npos) << progress.resume;
    EXPECT_TRUE(fs::exists(folder / "copy.h5.unused"));
    solver.reset();
  }
}

TEST_F(RunCheckpointTest, ALoopOfTheLogBeginsAnewAndAResetLeavesNoCheckpoint)
{
  const fs::path state = left_by_a_kill();
  ASSERT_TRUE(start(state).resumed);
  play(20, 50);
  ASSERT_TRUE(wait_until([](const Progress& progress) { return progress.accepted == 50; }));
  now_ns = epoch;
  ASSERT_TRUE(wait_until([](const Progress& p) { return p.state == RunState::waiting_for_opening && p.run == 3; }));
  play(0, 1000);
  ASSERT_TRUE(wait_until([](const Progress& p) { return p.state == RunState::finished && p.run == 3; }));
  EXPECT_EQ(solver->progress().digest, undisturbed_digest());
  ASSERT_TRUE(wait_until([&](const Progress&) { return fs::exists(state); }));  // another thread writes it
  EXPECT_TRUE(solver->reset().get().success);
  EXPECT_FALSE(fs::exists(state)) << "a run that was given up is not gone on with";
}

TEST_F(RunCheckpointTest, WhatCannotBeUsedIsKeptAndSaidWhy)
{
  const fs::path state = left_by_a_kill();
  const Told other = start(state, "", coarse_scene({ "hull.friction=0.3" }));
  EXPECT_TRUE(other.found);
  EXPECT_FALSE(other.resumed);
  EXPECT_NE(other.what.find("another scene: 'friction: 0.2' there, 'friction: 0.3' now"), std::string::npos)
      << other.what;
  EXPECT_TRUE(fs::exists(state.string() + ".unused"));
  solver.reset();
  std::ofstream(folder / "text.h5") << "no checkpoint";
  const Told damaged = start(folder / "text.h5");
  EXPECT_FALSE(damaged.resumed);
  EXPECT_NE(damaged.what.find("not an HDF5 file"), std::string::npos) << damaged.what;
  EXPECT_FALSE(start(folder / "none.h5").found);
}

TEST_F(RunCheckpointTest, SaveWritesTheCheckpointToo)
{
  const std::string before = fs::current_path().string();
  fs::current_path(folder);
  start(folder / "state.h5");
  play(0, 30);
  ASSERT_TRUE(wait_until([](const Progress& p) { return p.state == RunState::following && p.accepted == 30; }));
  fs::remove(folder / "state.h5");
  const Reply reply = solver->save().get();
  EXPECT_TRUE(reply.success) << reply.message;
  EXPECT_NE(reply.message.find("checkpoint in"), std::string::npos) << reply.message;
  EXPECT_TRUE(fs::exists(folder / "state.h5"));
  fs::current_path(before);
}

TEST_F(RunCheckpointTest, WhatCannotBeWrittenIsReportedAndTheRunGoesOn)
{
  start(folder / "no_such_folder" / "state.h5");
  play(0, 1000);
  ASSERT_TRUE(wait_for(RunState::finished));
  EXPECT_EQ(solver->progress().digest, undisturbed_digest());
  ASSERT_TRUE(wait_until([](const Progress& progress) { return !progress.checkpoint_error.empty(); }));
}

TEST(ResumedLog, JudgesByStampAndOnlyUntilTheLogHasGoneOn)
{
  barge::OpeningSignal saved{ barge::OpeningSignalParameters() };
  for (const barge::OpeningSample& sample : make_log())
    saved.add(sample);
  ResumedLog log(saved, barge::OpeningSignalParameters(), 10.0);
  const std::int64_t last_ns = saved.last_accepted().stamp_ns;
  using Verdict = ResumedLog::Verdict;
  const auto judge = [&log](std::int64_t stamp_ns, double angle = 0.1) {
    return log.judge({ stamp_ns, { angle, angle } });
  };
  EXPECT_EQ(judge(epoch), Verdict::known);
  EXPECT_EQ(judge(last_ns), Verdict::known);
  EXPECT_EQ(judge(last_ns + 1), Verdict::goes_on);
  EXPECT_EQ(judge(last_ns + 10 * second), Verdict::goes_on);
  EXPECT_EQ(judge(last_ns + 10 * second + 1), Verdict::another);
  EXPECT_EQ(judge(epoch - 1), Verdict::another);
  EXPECT_EQ(judge(epoch - 1, 99.0), Verdict::goes_on) << "nobody believes it: no evidence";
  EXPECT_TRUE(log.too_late(last_ns + 11 * second));
  EXPECT_FALSE(log.too_late(epoch - 100 * second)) << "a player may begin before the first sample";
  log.has_gone_on();
  EXPECT_EQ(judge(last_ns + 100 * second), Verdict::goes_on) << "a silence of the run's own";
  EXPECT_EQ(judge(epoch - 1), Verdict::goes_on) << "the opening signal's business";
  EXPECT_EQ(judge(epoch + second), Verdict::known);
  EXPECT_FALSE(log.too_late(last_ns + 11 * second));
  EXPECT_EQ(ResumedLog().judge({ epoch, {} }), Verdict::goes_on) << "nothing was resumed";
}

}  // namespace
}  // namespace geocontainer_mpm::ros_bridge
