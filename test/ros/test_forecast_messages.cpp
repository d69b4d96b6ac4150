/// Forecasts and plans as messages.

#include "geocontainer_mpm/ros/forecast_messages.h"

#include <geocontainer_mpm/ReleaseStatus.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "geocontainer_mpm/error.h"
#include "geocontainer_mpm/ros/forecast_topics.h"

namespace geocontainer_mpm::ros_bridge {
namespace {

constexpr std::int64_t origin_ns = 1'800'000'000'000'000'000;

forecast::Forecast released()
{
  forecast::Forecast forecast;
  forecast.origin_ns = origin_ns;
  forecast.from_s = 10.0;
  forecast.newest_s = 11.5;
  forecast.until_s = 26.0;
  for (int i = 0; i <= 16; ++i) {
    forecast::Instant instant;
    instant.time_s = 10.0 + i;
    instant.opening = { 0.02 * i, 0.02 * i };
    instant.tension_n_per_m = 1e3 * i;
    instant.peak_tension_n_per_m = 1e4 * i;
    instant.utilisation = 0.1 * i;
    instant.width_m = 5.0;
    forecast.instants.push_back(instant);
  }
  forecast.status.outcome = scene::Outcome::released;
  forecast.status.release_time_s = 20.4;
  forecast.status.peak_tension_n_per_m = 1.6e5;
  forecast.status.peak_tension_time_s = 26.0;
  forecast.status.peak_utilisation_seam = 1.6;
  return forecast;
}

double after_origin(const ros::Time& time)
{
  return static_cast<double>(static_cast<std::int64_t>(time.toNSec()) - origin_ns) / 1e9;
}

TEST(ForecastMessage, SaysWhenAndHowMuchInTheLogsTime)
{
  const ReleaseForecast message = to_release_forecast(released(), false, { 0.8, 1.0 }, "base_link");
  EXPECT_EQ(message.header.frame_id, "base_link");
  EXPECT_NEAR(after_origin(message.header.stamp), 10.0, 1e-9);
  ASSERT_EQ(message.stamps.size(), 17u);
  EXPECT_NEAR(after_origin(message.stamps[3]), 13.0, 1e-9);
  EXPECT_EQ(message.outcome, ReleaseStatus::RELEASED);
  EXPECT_NEAR(after_origin(message.release_time), 20.4, 1e-9);
  EXPECT_DOUBLE_EQ(message.release_tension, 1.1e5);  // the instant that follows the release
  EXPECT_NEAR(after_origin(message.exceeds_warn_time), 18.0, 1e-9);
  EXPECT_NEAR(after_origin(message.exceeds_alarm_time), 20.0, 1e-9);
  EXPECT_DOUBLE_EQ(message.age, 1.5);
  EXPECT_EQ(message.message,
            "The container will leave the hull 9 s from now; largest tension 160 kN/m, 160 % of what the "
            "geotextile bears");
  EXPECT_NE(to_release_forecast(released(), true, {}, "base_link").message.find("departed"), std::string::npos);
}

TEST(ForecastMessage, HasNoTimesForWhatDoesNotHappen)
{
  forecast::Forecast forecast = released();
  forecast.status.outcome = scene::Outcome::hung_up;
  forecast.status.release_time_s = -1.0;
  const ReleaseForecast message = to_release_forecast(forecast, false, { 2.0, 3.0 }, "base_link");
  EXPECT_TRUE(message.release_time.isZero());
  EXPECT_TRUE(message.exceeds_warn_time.isZero());
  EXPECT_EQ(message.release_tension, 0.0);
  EXPECT_NE(message.message.find("will hang in the slot"), std::string::npos);
}

TEST(ForecastMessage, IsRefusedWhereSomethingIsNotFinite)
{
  EXPECT_EQ(first_non_finite(released()), "");
  forecast::Forecast forecast = released();
  forecast.instants[4].tension_n_per_m = std::nan("");
  EXPECT_EQ(first_non_finite(forecast), "forecast of 14 s");
  forecast = released();
  forecast.status.peak_tension_n_per_m = std::numeric_limits<double>::infinity();
  EXPECT_NE(first_non_finite(forecast), "");
}

forecast::EnsembleForecast some_ensemble()
{
  forecast::EnsembleForecast ensemble;
  ensemble.origin_ns = origin_ns;
  ensemble.from_s = 12.0;
  ensemble.seed = 5;
  ensemble.inputs = { "hull.friction" };
  std::vector<ensemble::Member> members;
  for (int i = 0; i < 11; ++i) {
    ensemble::Member member;
    member.ending = ensemble::Ending::completed;
    member.outcome = scene::Outcome::released;
    member.figures = { 1e4 * i, 0.1 * i, 20.0 + i, 1.0, 8.0 + 0.1 * i, 1.0 };
    members.push_back(member);
  }
  std::vector<std::vector<std::string>> values;
  for (int i = 0; i < 11; ++i)
    values.push_back({ std::to_string(i) });
  ensemble.summary = ensemble::summarise(members, values);
  return ensemble;
}

TEST(EnsembleMessage, CarriesQuantilesFromNowOnAndWhatMatters)
{
  forecast::EnsembleForecast ensemble = some_ensemble();
  ReleaseEnsemble message = to_release_ensemble(ensemble);
  EXPECT_EQ(message.completed, 11u);
  EXPECT_NEAR(message.peak_tension.p10, 2e3, 1e-6);
  EXPECT_NEAR(message.peak_tension.p90, 9.8e4, 1e-6);
  EXPECT_DOUBLE_EQ(message.release_delay.p50, 13.0);
  EXPECT_DOUBLE_EQ(message.final_width.p50, 8.5);
  EXPECT_DOUBLE_EQ(message.tension_correlation[0], 1.0);
  EXPECT_EQ(message.advice, ReleaseEnsemble::NONE_ASKED);

  ensemble.tension = { { 7.0, 7.25 }, { 1e3, 2e3 }, { 3e3, 4e3 }, { 5e3, 6e3 } };
  ensemble.advice = { forecast::Verdict::rate, 0.01, 0.0, true, 0.85, 0.9 };
  message = to_release_ensemble(ensemble);
  EXPECT_EQ(message.advice, ReleaseEnsemble::RATE);
  EXPECT_NE(message.message.find("at most 0.57 deg/s"), std::string::npos) << message.message;
  EXPECT_EQ(message.slowest_rate, 0.0);
  ASSERT_EQ(message.stamps.size(), 2u);
  EXPECT_NEAR((message.stamps[1] - message.header.stamp).toSec(), 7.25 - ensemble.from_s, 1e-6);
  EXPECT_EQ(message.tension_p90[1], 6e3);
  ensemble.advice.slowest_rad_per_s = 0.005;
  message = to_release_ensemble(ensemble);
  EXPECT_EQ(message.slowest_rate, 0.005);
  EXPECT_NE(message.message.find("0.29 to 0.57 deg/s for each half, not slower"), std::string::npos) << message.message;
  ensemble.advice.complete = false;
  message = to_release_ensemble(ensemble);
  EXPECT_FALSE(message.advice_complete);
  EXPECT_NE(message.message.find("0.29 to 0.57 deg/s for each half will do"), std::string::npos) << message.message;
  ensemble.advice.verdict = forecast::Verdict::no_rate;
  EXPECT_NE(to_release_ensemble(ensemble).message.find("no opening rate"), std::string::npos);
}

TEST(EnsembleMessage, OfNoMembersSaysSo)
{
  forecast::EnsembleForecast ensemble;
  ensemble.summary = ensemble::summarise({}, {});
  const ReleaseEnsemble message = to_release_ensemble(ensemble);
  EXPECT_NE(message.message.find("No member"), std::string::npos);
}

trajectory_msgs::JointTrajectory trajectory()
{
  trajectory_msgs::JointTrajectory plan;
  plan.joint_names = { "starboard", "other", "port" };
  plan.header.stamp = ros::Time(100.0);
  for (int i = 0; i < 3; ++i) {
    trajectory_msgs::JointTrajectoryPoint point;
    point.positions = { 0.1 * i, 9.0, 0.2 * i };
    point.time_from_start = ros::Duration(5.0 * i);
    plan.points.push_back(point);
  }
  return plan;
}

TEST(Plan, TakesItsJointsByNameAndItsTimeFromTheStamp)
{
  const OpeningJoints joints{ "port", "starboard" };
  const auto plan = to_plan(trajectory(), joints, ros::Time(7.0));
  ASSERT_EQ(plan.size(), 3u);
  EXPECT_EQ(plan[2].stamp_ns, 110'000'000'000);
  EXPECT_DOUBLE_EQ(plan[2].angles.port_rad, 0.4);
  EXPECT_DOUBLE_EQ(plan[2].angles.starboard_rad, 0.2);
  trajectory_msgs::JointTrajectory now = trajectory();
  now.header.stamp = ros::Time();
  EXPECT_EQ(to_plan(now, joints, ros::Time(7.0))[0].stamp_ns, 7'000'000'000);
  EXPECT_TRUE(to_plan({}, joints, ros::Time(7.0)).empty());  // the measured rate again
}

TEST(Plan, NamesWhatIsMissing)
{
  const auto refused = [](const trajectory_msgs::JointTrajectory& plan, const OpeningJoints& joints,
                          const std::string& why) {
    try {
      to_plan(plan, joints, ros::Time(7.0));
      ADD_FAILURE() << why;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(why), std::string::npos) << error.what();
    }
  };
  refused(trajectory(), { "bow", "starboard" }, "'bow'");
  trajectory_msgs::JointTrajectory plan = trajectory();
  plan.points[1].positions.pop_back();
  refused(plan, { "port", "starboard" }, "points[1].positions");
}

}  // namespace
}  // namespace geocontainer_mpm::ros_bridge
