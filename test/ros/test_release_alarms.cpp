/// What each alarm of a release judges. That levels fall late and stay latched is tested with the book (test/alarm).

#include <gtest/gtest.h>

#include <cmath>

#include "geocontainer_mpm/ros/release_alarms.h"

namespace geocontainer_mpm::ros_bridge {
namespace {

using alarm::Level;

constexpr std::int64_t second = 1'000'000'000;
constexpr std::int64_t epoch = 1'700'000'000 * second;

class ReleaseAlarmsTest : public testing::Test {
protected:
  ReleaseAlarmsTest()
  {
    progress.state = RunState::running;
    progress.status.outcome = scene::Outcome::releasing;
    progress.accepted = 100;
  }

  /// After this much more of log and simulation, the opening heard to the end.
  void look(double after_s = 0.1)
  {
    now_s += after_s;
    progress.time_s = now_s;
    if (heard)
      progress.newest_stamp_ns = at(now_s);
    report = alarms.look(progress, at(now_s), senders);
  }

  const alarm::Alarm& of(const std::string& name) const
  {
    for (const alarm::Alarm& alarm : report.alarms)
      if (alarm.name == name)
        return alarm;
    throw std::out_of_range(name);
  }
  Level level(const std::string& name) const { return of(name).level; }

  static std::int64_t at(double time_s) { return epoch + std::llround(time_s * 1e9); }

  AlarmParameters parameters;
  ReleaseAlarms alarms{ parameters, false };
  Progress progress;
  AlarmReport report;
  double now_s = 0.0;
  bool heard = true;
  unsigned senders = 1;
};

TEST_F(ReleaseAlarmsTest, AQuietReleaseRaisesNone)
{
  for (int i = 0; i < 100; ++i) {
    progress.status.centroid_m.z() -= 0.01;
    progress.accepted += 2;
    look();
  }
  ASSERT_EQ(report.alarms.size(), 8u);
  for (const alarm::Alarm& alarm : report.alarms) {
    EXPECT_EQ(alarm.latched, Level::normal) << alarm.name;
    EXPECT_FALSE(alarm.message.empty()) << alarm.name;
    EXPECT_TRUE(std::isfinite(alarm.value)) << alarm.name;
  }
  EXPECT_FALSE(report.replay);
}

TEST_F(ReleaseAlarmsTest, TensionOfSheetAndSeamAreApartAndFall)
{
  progress.status.utilisation_seam = progress.status.peak_utilisation_seam = 0.9;
  progress.status.utilisation_sheet = progress.status.peak_utilisation_sheet = 0.5;
  look();
  EXPECT_EQ(level("seam_utilisation"), Level::warn);
  EXPECT_EQ(of("seam_utilisation").value, 0.9);
  EXPECT_EQ(level("sheet_utilisation"), Level::normal);
  progress.status.utilisation_seam = 0.3;
  look();
  look(3.0);
  EXPECT_EQ(level("seam_utilisation"), Level::normal);
  EXPECT_EQ(of("seam_utilisation").latched, Level::warn);
  EXPECT_NE(alarms.acknowledge().find("seam_utilisation"), std::string::npos);
  look();
  EXPECT_EQ(of("seam_utilisation").latched, Level::normal);
}

TEST_F(ReleaseAlarmsTest, APeakBetweenTwoLooksIsNotMissed)
{
  look();
  progress.status.utilisation_seam = 0.2;
  progress.status.peak_utilisation_seam = 1.3;
  look();
  EXPECT_EQ(level("seam_utilisation"), Level::alarm);
  EXPECT_EQ(of("seam_utilisation").value, 1.3);
  look();
  EXPECT_EQ(of("seam_utilisation").value, 0.2) << "it is over";
}

TEST_F(ReleaseAlarmsTest, ATornSheetStaysAnAlarm)
{
  progress.status.ruptures = 3;
  progress.status.rupture_time_s = 12.0;
  look();
  look(60.0);
  EXPECT_EQ(level("sheet_utilisation"), Level::alarm);
  EXPECT_NE(of("sheet_utilisation").message.find("torn, first after 12.0 s"), std::string::npos)
      << of("sheet_utilisation").message;
}

/// Utilisation grows by 0.1 a second to 1.2 at 12 s, then stays: the largest so far.
std::shared_ptr<forecast::Forecast> a_forecast(std::uint64_t run)
{
  auto ahead = std::make_shared<forecast::Forecast>();
  ahead->run = run;
  for (int i = 0; i <= 20; ++i) {
    forecast::Instant instant;
    instant.time_s = i;
    instant.utilisation = std::min(1.2, 0.1 * i);
    ahead->instants.push_back(instant);
  }
  return ahead;
}

TEST_F(ReleaseAlarmsTest, AForecastWarnsWithLeadTimeUntilTheWorstIsOver)
{
  look(4.0);
  EXPECT_EQ(level("forecast_utilisation"), Level::normal);
  EXPECT_EQ(of("forecast_utilisation").message, "No forecast");
  alarms.expect(a_forecast(progress.run + 1));
  look();
  EXPECT_EQ(level("forecast_utilisation"), Level::normal) << "of another run";
  alarms.expect(a_forecast(progress.run));
  progress.lag_s = 0.5;
  look();
  EXPECT_EQ(level("forecast_utilisation"), Level::alarm);
  EXPECT_EQ(of("forecast_utilisation").value, 1.2);
  EXPECT_NEAR(of("forecast_utilisation").lead_time_s, 10.0 - (4.2 + 0.5), 1e-9);
  now_s = 13.0;
  look();
  EXPECT_EQ(of("forecast_utilisation").value, 0.0);
  look(3.0);
  EXPECT_EQ(level("forecast_utilisation"), Level::normal);
  EXPECT_EQ(of("forecast_utilisation").latched, Level::alarm);
}

TEST_F(ReleaseAlarmsTest, AContainerThatDoesNotSinkIsSuspectedThenSure)
{
  look();
  for (int i = 0; i < 49; ++i) {
    progress.status.centroid_m.z() -= 0.0001;
    look();
  }
  EXPECT_EQ(level("hung_up"), Level::normal);
  look();
  look();
  EXPECT_EQ(level("hung_up"), Level::warn);
  EXPECT_GE(of("hung_up").value, 5.0);
  progress.status.outcome = scene::Outcome::hung_up;
  look();
  EXPECT_EQ(level("hung_up"), Level::alarm);
  progress.status.outcome = scene::Outcome::releasing;
  progress.status.centroid_m.z() -= 0.1;
  look();
  look(3.0);
  EXPECT_EQ(level("hung_up"), Level::normal) << "the hull moved again";
  progress.status.outcome = scene::Outcome::released;
  look(100.0);
  EXPECT_EQ(level("hung_up"), Level::normal) << "it lies on the bed";
}

TEST_F(ReleaseAlarmsTest, LopsidedNamesTheSideAndKnowsTheNewestOpening)
{
  progress.opening = { 0.1, 0.1 };
  progress.newest_opening = { 0.1, 0.16 };
  look();
  EXPECT_EQ(level("lopsided_opening"), Level::warn);
  EXPECT_NE(of("lopsided_opening").message.find("Starboard is 3.4 deg further open than port"), std::string::npos)
      << of("lopsided_opening").message;
  progress.newest_opening = { 0.26, 0.16 };
  look();
  EXPECT_EQ(level("lopsided_opening"), Level::alarm);
}

TEST_F(ReleaseAlarmsTest, ASilentSensorWarnsThenAlarmsThenIsHeardAgain)
{
  look();
  heard = false;
  look(0.95);
  EXPECT_EQ(level("sensor"), Level::normal);
  look();
  EXPECT_EQ(level("sensor"), Level::warn);
  look(4.0);
  EXPECT_EQ(level("sensor"), Level::alarm);
  heard = true;
  look();
  look(2.1);
  EXPECT_EQ(level("sensor"), Level::normal);
  heard = false;
  progress.state = RunState::finished;
  look(100.0);
  EXPECT_EQ(level("sensor"), Level::normal) << "nobody needs the sensor any more";
}

TEST_F(ReleaseAlarmsTest, NobodySendsTheOpening)
{
  heard = false;
  senders = 0;
  progress.state = RunState::waiting_for_clock;
  report = alarms.look(progress, 0, senders);
  progress.state = RunState::waiting_for_opening;
  look();
  look(4.9);
  EXPECT_EQ(level("sensor"), Level::normal);
  look(0.2);
  EXPECT_EQ(level("sensor"), Level::warn);
  EXPECT_NE(of("sensor").message.find("Nobody"), std::string::npos);
}

TEST_F(ReleaseAlarmsTest, ManyRejectedSamplesWarnFewDoNot)
{
  const auto ten_seconds = [this](int bad_of_ten) {
    for (int i = 0; i < 100; ++i) {
      progress.accepted += static_cast<std::uint64_t>(10 - bad_of_ten);
      progress.rejected[static_cast<std::size_t>(RejectReason::too_fast)] += static_cast<std::uint64_t>(bad_of_ten);
      progress.rejected[static_cast<std::size_t>(RejectReason::duplicate)] += 10;
      look();
    }
  };
  ten_seconds(1);
  EXPECT_EQ(level("sensor"), Level::normal);
  ten_seconds(3);
  EXPECT_EQ(level("sensor"), Level::warn);
  EXPECT_NE(of("sensor").message.find("30 %"), std::string::npos) << of("sensor").message;
}

TEST_F(ReleaseAlarmsTest, ALagOfABurstIsNone)
{
  progress.lag_s = 12.0;
  look();
  progress.lag_s = 0.5;
  look(0.5);
  EXPECT_EQ(level("lag"), Level::normal);
  progress.lag_s = 12.0;
  look();
  look(1.0);
  EXPECT_EQ(level("lag"), Level::alarm);
}

TEST_F(ReleaseAlarmsTest, AStoppedSolverIsAnAlarmAndAnotherRunKeepsItUntilItIsSeen)
{
  progress.state = RunState::stopped;
  progress.failure.reason = "a particle left the grid";
  look();
  EXPECT_EQ(level("solver"), Level::alarm);
  progress.state = RunState::waiting_for_opening;
  ++progress.run;
  look();
  EXPECT_EQ(level("solver"), Level::normal);
  EXPECT_EQ(of("solver").latched, Level::alarm);
  EXPECT_NE(of("solver").message.find("a particle left the grid"), std::string::npos);
  alarms.acknowledge();
  EXPECT_EQ(alarms.report().alarms.back().latched, Level::normal);
  EXPECT_NE(alarms.acknowledge().find("no alarm"), std::string::npos);
}

}  // namespace
}  // namespace geocontainer_mpm::ros_bridge
