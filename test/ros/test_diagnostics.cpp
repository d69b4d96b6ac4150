#include <gtest/gtest.h>

#include "geocontainer_mpm/ros/diagnostics.h"

namespace geocontainer_mpm::ros_bridge {
namespace {

using diagnostic_msgs::DiagnosticStatus;
using diagnostic_updater::DiagnosticStatusWrapper;

std::uint64_t& count(Progress& progress, RejectReason reason)
{
  return progress.rejected[static_cast<std::size_t>(reason)];
}

std::string value(const DiagnosticStatusWrapper& status, const std::string& key)
{
  for (const auto& pair : status.values)
    if (pair.key == key)
      return pair.value;
  return "(no such key)";
}

TEST(Diagnostics, StoppedIsAnErrorWithTheReason)
{
  Progress progress;
  progress.state = RunState::stopped;
  progress.failure.reason = "a particle left the grid";
  DiagnosticStatusWrapper status;
  describe_simulation(progress, "release", 2, status);
  EXPECT_EQ(status.level, DiagnosticStatus::ERROR);
  EXPECT_NE(status.message.find("a particle left the grid"), std::string::npos);
  EXPECT_EQ(value(status, "state"), "stopped");
}

TEST(Diagnostics, LateSilentClockAndFailedRecordAreReported)
{
  Progress progress;
  progress.state = RunState::running;
  DiagnosticStatusWrapper status;
  describe_simulation(progress, "release", 2, status);
  EXPECT_EQ(status.level, DiagnosticStatus::OK);
  progress.lag_s = 12.0;
  describe_simulation(progress, "release", 2, status);
  EXPECT_EQ(status.level, DiagnosticStatus::WARN);
  progress.record_error = "disk full";
  describe_simulation(progress, "release", 2, status);
  EXPECT_EQ(status.level, DiagnosticStatus::ERROR);
  EXPECT_NE(status.message.find("disk full"), std::string::npos);
  Progress waiting;
  waiting.state = RunState::waiting_for_clock;
  describe_simulation(waiting, "release", 2, status);
  EXPECT_EQ(status.level, DiagnosticStatus::WARN);
}

TEST(Diagnostics, DigestIsWrittenAsItsSixteenDigits)
{
  Progress progress;
  progress.digest = 0xabcULL;
  progress.digest_time_s = 4.0;
  DiagnosticStatusWrapper status;
  describe_simulation(progress, "release", 2, status);
  EXPECT_EQ(value(status, "state digest"), "0000000000000abc");
}

TEST(Diagnostics, RejectedSamplesWarnOnlyWhileTheyAreNew)
{
  Progress before, now;
  now.accepted = 10;
  count(now, RejectReason::non_finite) = 2;
  count(now, RejectReason::from_future) = 1;
  DiagnosticStatusWrapper status;
  describe_opening(now, before, 1, status);
  EXPECT_EQ(status.level, DiagnosticStatus::WARN);
  EXPECT_NE(status.message.find("2 non finite"), std::string::npos);
  EXPECT_NE(status.message.find("1 from the future"), std::string::npos);
  EXPECT_EQ(value(status, "rejected: non finite"), "2");
  DiagnosticStatusWrapper later;
  describe_opening(now, now, 1, later);
  EXPECT_EQ(later.level, DiagnosticStatus::OK);
  EXPECT_EQ(value(later, "rejected: non finite"), "2");
}

TEST(Diagnostics, CountsOfANewRunStartFromZero)
{
  Progress before, now;
  before.run = 1;
  count(before, RejectReason::too_fast) = 5;
  now.run = 2;
  count(now, RejectReason::too_fast) = 1;
  DiagnosticStatusWrapper status;
  describe_opening(now, before, 1, status);
  EXPECT_NE(status.message.find("1 too fast"), std::string::npos);
}

TEST(Diagnostics, HoldingIsAWarningAsLongAsItLasts)
{
  Progress now;
  now.gaps = 1;
  now.holding = true;
  DiagnosticStatusWrapper status;
  describe_opening(now, now, 1, status);
  EXPECT_EQ(status.level, DiagnosticStatus::WARN);
  EXPECT_EQ(value(status, "holding"), "true");
}

TEST(Diagnostics, OutputsSayWhatDidNotGoOut)
{
  OutputHealth before, now;
  DiagnosticStatusWrapper status;
  describe_outputs(now, before, status);
  EXPECT_EQ(status.level, DiagnosticStatus::OK);
  now.transform_error = "map does not exist";
  describe_outputs(now, before, status);
  EXPECT_EQ(status.level, DiagnosticStatus::WARN);
  EXPECT_NE(status.message.find("map does not exist"), std::string::npos);
  now.dropped = 1;
  now.last_dropped = "sand stress";
  describe_outputs(now, before, status);
  EXPECT_EQ(status.level, DiagnosticStatus::ERROR);
  EXPECT_NE(status.message.find("sand stress"), std::string::npos);
}

TEST(Diagnostics, AlarmsWarnByWhatIsLatchedAndNotInAReplay)
{
  AlarmReport report;
  report.alarms.resize(2);
  report.alarms[0].name = "sensor";
  report.alarms[1].name = "lag";
  DiagnosticStatusWrapper status;
  describe_alarms(report, status);
  EXPECT_EQ(status.level, DiagnosticStatus::OK);
  EXPECT_EQ(status.message, "no alarm");
  report.alarms[1].latched = alarm::Level::warn;
  report.alarms[1].message = "The prediction is 4.0 s behind the measurement";
  DiagnosticStatusWrapper warned;
  describe_alarms(report, warned);
  EXPECT_EQ(warned.level, DiagnosticStatus::WARN);
  EXPECT_EQ(warned.message, "The prediction is 4.0 s behind the measurement (over)");
  EXPECT_NE(value(warned, "lag").find("latched warn, not acknowledged"), std::string::npos);
  report.alarms[0].level = report.alarms[0].latched = alarm::Level::alarm;
  describe_alarms(report, warned);
  EXPECT_EQ(warned.level, DiagnosticStatus::ERROR);
  report.replay = true;
  describe_alarms(report, warned);
  EXPECT_EQ(warned.level, DiagnosticStatus::OK);
  EXPECT_EQ(warned.message.find("[replay] "), 0u) << warned.message;
}

TEST(Diagnostics, TheCheckpointIsToldAndItsFailureWarns)
{
  Progress progress;
  DiagnosticStatusWrapper without;
  describe_simulation(progress, "release", 2, without);
  EXPECT_EQ(value(without, "checkpoint"), "(no such key)");
  progress.checkpoint_path = "state.h5";
  progress.checkpoint_time_s = 2.5;
  progress.checkpoint_error = "No space left on device";
  progress.resume = "goes on at 2.000 s from state.h5";
  DiagnosticStatusWrapper status;
  describe_simulation(progress, "release", 2, status);
  EXPECT_EQ(status.level, DiagnosticStatus::WARN);
  EXPECT_NE(status.message.find("No space left"), std::string::npos);
  EXPECT_EQ(value(status, "checkpoint of time (s)"), "2.5");
  EXPECT_EQ(value(status, "resume"), progress.resume);
}

}  // namespace
}  // namespace geocontainer_mpm::ros_bridge
