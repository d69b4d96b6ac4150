#include "geocontainer_mpm/ros/forecast_topics.h"

#include <fmt/format.h>
#include <ros/console.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "geocontainer_mpm/error.h"

namespace geocontainer_mpm::ros_bridge {
namespace {

constexpr std::uint32_t queue_size = 10;

forecast::ForecasterSettings settings_of(const ForecastParameters& parameters)
{
  forecast::ForecasterSettings settings = parameters.settings;
  if (parameters.advice_enabled)
    settings.advice = parameters.advice;
  return settings;
}

std::unique_ptr<forecast::LiveEnsemble> ensemble_of(const NodeParameters& parameters)
{
  const ForecastParameters& forecast = parameters.forecast;
  if (forecast.members == 0)
    return nullptr;
  std::vector<std::string> overrides = parameters.scene_overrides;
  overrides.insert(overrides.end(), forecast.ensemble_overrides.begin(), forecast.ensemble_overrides.end());
  return std::make_unique<forecast::LiveEnsemble>(
      forecast::draw_members(parameters.scene, overrides, forecast.distributions,
                             static_cast<std::size_t>(forecast.members), static_cast<std::uint64_t>(forecast.seed)),
      forecast.ensemble_threads);
}

std::size_t index_of(const std::vector<std::string>& names, const std::string& joint)
{
  const auto found = std::find(names.begin(), names.end(), joint);
  if (found == names.end())
    throw InputError("opening_plan", "joint_names", "", fmt::format("must have '{}'", joint));
  return static_cast<std::size_t>(found - names.begin());
}

}  // namespace

std::vector<barge::OpeningSample> to_plan(const trajectory_msgs::JointTrajectory& trajectory,
                                          const OpeningJoints& joints, const ros::Time& now)
{
  if (trajectory.points.empty())
    return {};
  const std::size_t port = index_of(trajectory.joint_names, joints.port);
  const std::size_t starboard = index_of(trajectory.joint_names, joints.starboard);
  const ros::Time begin = trajectory.header.stamp.isZero() ? now : trajectory.header.stamp;
  const auto begin_ns = static_cast<std::int64_t>(begin.toNSec());
  std::vector<barge::OpeningSample> plan;
  for (std::size_t i = 0; i < trajectory.points.size(); ++i) {
    const trajectory_msgs::JointTrajectoryPoint& point = trajectory.points[i];
    if (point.positions.size() != trajectory.joint_names.size())
      throw InputError("opening_plan", fmt::format("points[{}].positions", i),
                       fmt::format("{} values", point.positions.size()), "must have one for each joint");
    plan.push_back(
        { begin_ns + point.time_from_start.toNSec(), { point.positions[port], point.positions[starboard] } });
  }
  return plan;
}

ForecastTopics::ForecastTopics(ros::NodeHandle& node, const NodeParameters& parameters,
                               const scene::SceneDescription& scene, Expect expect)
    : joints_(parameters.joints)
    , barge_frame_(parameters.barge_frame)
    , limits_(parameters.alarms.utilisation)
    , forecasts_(node.advertise<ReleaseForecast>("release_forecast", queue_size, true))
    , ensembles_(node.advertise<ReleaseEnsemble>("release_ensemble", queue_size, true))
    , expect_(std::move(expect))
{
  forecast::ForecasterHooks hooks;
  hooks.forecast = [this](const forecast::Forecast& forecast, bool stale) { publish(forecast, stale); };
  hooks.ensemble = [this](const forecast::EnsembleForecast& ensemble) {
    ensembles_.publish(to_release_ensemble(ensemble));
  };
  forecaster_ = std::make_unique<forecast::Forecaster>(scene, settings_of(parameters.forecast), ensemble_of(parameters),
                                                       std::move(hooks));
  plans_ = node.subscribe("opening_plan", queue_size, &ForecastTopics::take_plan, this);
}

void ForecastTopics::restart(std::uint64_t run)
{
  forecaster_->restart(run);
  expect_(nullptr);
}

void ForecastTopics::take_plan(const trajectory_msgs::JointTrajectory& trajectory)
{
  try {
    forecaster_->plan(to_plan(trajectory, joints_, ros::Time::now()));
  } catch (const InputError& error) {
    ROS_WARN_THROTTLE(5.0, "opening_plan not taken, the one before stays: %s", error.what());
  }
}

void ForecastTopics::publish(const forecast::Forecast& forecast, bool stale)
{
  const std::string bad = first_non_finite(forecast);
  if (!bad.empty()) {
    ROS_WARN_THROTTLE(5.0, "forecast not published: %s is not finite", bad.c_str());
    return;
  }
  forecasts_.publish(to_release_forecast(forecast, stale, limits_, barge_frame_));
  expect_(stale ? nullptr : std::make_shared<const forecast::Forecast>(forecast));
}

}  // namespace geocontainer_mpm::ros_bridge
