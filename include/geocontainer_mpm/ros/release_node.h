#pragma once
/// The node: parameters, input, solver, outputs, diagnostics and services put together. Nothing is decided here.

#include <ros/node_handle.h>
#include <ros/service_server.h>
#include <std_srvs/Trigger.h>

#include <future>
#include <memory>

#include "geocontainer_mpm/ros/diagnostics.h"
#include "geocontainer_mpm/ros/forecast_topics.h"
#include "geocontainer_mpm/ros/opening_input.h"
#include "geocontainer_mpm/ros/outputs.h"
#include "geocontainer_mpm/ros/parameters.h"
#include "geocontainer_mpm/ros/release_alarms.h"
#include "geocontainer_mpm/ros/run_checkpoint.h"
#include "geocontainer_mpm/ros/solver_thread.h"

namespace geocontainer_mpm::ros_bridge {

class ReleaseNode {
public:
  /// Builds the scene before it subscribes: a player that waits for subscribers waits for the solver as well. Throws
  /// InputError for bad parameters or a bad scene.
  ReleaseNode(ros::NodeHandle node, ros::NodeHandle private_node);

private:
  Beginning begin() const;
  SolverHooks hooks();
  AlarmReport look(const Progress& progress);
  bool answer(std::future<Reply> reply, std_srvs::Trigger::Response& response) const;

  NodeParameters parameters_;
  scene::SceneDescription scene_;
  OpeningQueue queue_;
  Outputs outputs_;
  ReleaseAlarms alarms_;
  // Destroyed in reverse order: the thread of solver_ uses everything above it.
  std::unique_ptr<OpeningInput> input_;
  std::unique_ptr<ForecastTopics> forecasts_;  ///< none: no forecasts
  std::unique_ptr<SolverThread> solver_;
  std::unique_ptr<Diagnostics> diagnostics_;
  ros::ServiceServer reset_, start_, stop_, save_, acknowledge_;
};

}  // namespace geocontainer_mpm::ros_bridge
