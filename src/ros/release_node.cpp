#include "geocontainer_mpm/ros/release_node.h"

#include <fmt/format.h>
#include <ros/console.h>

#include <chrono>

#include "geocontainer_mpm/error.h"
#include "geocontainer_mpm/ros/run_record.h"

namespace geocontainer_mpm::ros_bridge {
namespace {

std::int64_t nanoseconds(double seconds)
{
  return static_cast<std::int64_t>(seconds * 1e9);
}

SolverSettings solver_settings(const NodeParameters& parameters)
{
  SolverSettings settings;
  settings.gate = { nanoseconds(parameters.max_future_s), nanoseconds(parameters.time_jump_back_s),
                    nanoseconds(parameters.transport_patience_s) };
  settings.autostart = parameters.autostart;
  settings.finish_when_source_leaves = parameters.finish_when_source_leaves;
  settings.publish_rate_hz = parameters.publish_rate_hz;
  settings.threads = parameters.threads;
  settings.save_directory = parameters.save_directory;
  return settings;
}

scene::SceneDescription load(const NodeParameters& parameters)
{
  scene::SceneDescription scene = scene::load_scene(parameters.scene, parameters.scene_overrides);
  if (!scene.hull)
    throw InputError(parameters.scene, "hull", "", "missing, but this node follows the opening of a hull");
  return scene;
}

}  // namespace

ReleaseNode::ReleaseNode(ros::NodeHandle node, ros::NodeHandle private_node)
    : parameters_(load_parameters(private_node))
    , scene_(load(parameters_))
    , queue_(static_cast<std::size_t>(parameters_.queue_size))
    , outputs_(node, parameters_)
{
  scene::Simulation simulation(scene_, parameters_.threads);
  ROS_INFO("scene '%s' from %s is ready: %lu particles, %d threads", scene_.name.c_str(), parameters_.scene.c_str(),
           static_cast<unsigned long>(simulation.counters().particles), parameters_.threads);

  input_ = std::make_unique<OpeningInput>(node, parameters_.joints, queue_);
  if (parameters_.forecast.enabled)
    forecasts_ = std::make_unique<ForecastTopics>(node, parameters_, scene_);
  SolverHooks hooks;
  if (forecasts_) {
    hooks.forecaster = &forecasts_->forecaster();
    hooks.restarted = [this](std::uint64_t run) { forecasts_->restart(run); };
  }
  hooks.now_ns = [] { return static_cast<std::int64_t>(ros::Time::now().toNSec()); };
  hooks.senders = [this] { return input_->senders(); };
  hooks.frame_wanted = [this] { return outputs_.wanted(); };
  hooks.frame = [this](const scene::Frame& frame, const Progress& progress) { outputs_.publish(frame, progress); };
  hooks.progress = [this](const Progress& progress) { outputs_.publish(progress); };
  solver_ = std::make_unique<SolverThread>(
      std::move(simulation), queue_,
      RunRecord(parameters_.record, scene_.name, scene_text(parameters_.scene, parameters_.scene_overrides)),
      solver_settings(parameters_), hooks);

  DiagnosticSources sources;
  sources.progress = [this] { return solver_->progress(); };
  sources.outputs = [this] { return outputs_.health(); };
  sources.senders = [this] { return input_->senders(); };
  diagnostics_ = std::make_unique<Diagnostics>(node, private_node, parameters_.diagnostic_period, scene_.name,
                                               parameters_.threads, sources);

  using Trigger = std_srvs::Trigger;
  using Callback = boost::function<bool(Trigger::Request&, Trigger::Response&)>;
  const auto advertise = [&](const char* name, std::future<Reply> (SolverThread::*action)()) {
    const Callback callback = [this, action](Trigger::Request&, Trigger::Response& response) {
      return answer((*solver_.*action)(), response);
    };
    return private_node.advertiseService(name, callback);
  };
  reset_ = advertise("reset", &SolverThread::reset);
  start_ = advertise("start", &SolverThread::start);
  stop_ = advertise("stop", &SolverThread::stop);
  save_ = advertise("save", &SolverThread::save);
}

bool ReleaseNode::answer(std::future<Reply> reply, std_srvs::Trigger::Response& response) const
{
  if (reply.wait_for(std::chrono::duration<double>(parameters_.service_timeout_s)) != std::future_status::ready) {
    response.success = false;
    response.message = fmt::format("the solver is in a long step; not done within {} s, will be done after it",
                                   parameters_.service_timeout_s);
    return true;
  }
  const Reply done = reply.get();
  response.success = done.success;
  response.message = done.message;
  return true;
}

}  // namespace geocontainer_mpm::ros_bridge
