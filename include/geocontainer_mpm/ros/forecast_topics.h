#pragma once
/// The forecaster in the node: plan in, forecasts and ensembles out.

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/subscriber.h>
#include <trajectory_msgs/JointTrajectory.h>

#include <functional>
#include <memory>
#include <string>

#include "geocontainer_mpm/forecast/forecaster.h"
#include "geocontainer_mpm/ros/forecast_messages.h"
#include "geocontainer_mpm/ros/parameters.h"

namespace geocontainer_mpm::ros_bridge {

/// The plan of a trajectory with both joints of the hull. A stamp of zero means `now`. Throws InputError naming what is
/// missing or not finite.
std::vector<barge::OpeningSample> to_plan(const trajectory_msgs::JointTrajectory& trajectory,
                                          const OpeningJoints& joints, const ros::Time& now);

class ForecastTopics {
public:
  /// What is expected now: none while it is not known. Called on any thread.
  using Expect = std::function<void(std::shared_ptr<const forecast::Forecast>)>;

  /// Draws the ensemble's members. Throws InputError for distributions or overrides that do not fit the scene.
  ForecastTopics(ros::NodeHandle& node, const NodeParameters& parameters, const scene::SceneDescription& scene,
                 Expect expect);

  forecast::Forecaster& forecaster() { return *forecaster_; }
  void restart(std::uint64_t run);

private:
  void take_plan(const trajectory_msgs::JointTrajectory& trajectory);
  void publish(const forecast::Forecast& forecast, bool stale);

  OpeningJoints joints_;
  std::string barge_frame_;
  alarm::Limits limits_;
  ros::Publisher forecasts_, ensembles_;
  Expect expect_;
  std::unique_ptr<forecast::Forecaster> forecaster_;
  ros::Subscriber plans_;  // last: comes when everything else stands
};

}  // namespace geocontainer_mpm::ros_bridge
