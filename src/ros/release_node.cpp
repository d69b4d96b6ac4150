#include "geocontainer_mpm/ros/release_node.h"

#include <fmt/format.h>
#include <ros/console.h>

#include <algorithm>
#include <chrono>
#include <utility>

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
  settings.checkpoint = parameters.checkpoint;
  settings.checkpoint_period_s = parameters.checkpoint_period_s;
  settings.resume_within_s = parameters.resume_within_s;
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
    , alarms_(parameters_.alarms, ros::Time::isSimTime())
{
  Beginning beginning = begin();
  RunRecord record(parameters_.record, scene_.name, scene_text(parameters_.scene, parameters_.scene_overrides));
  SolverSettings settings = solver_settings(parameters_);
  settings.resumed = beginning.resumed;
  settings.resume = beginning.what;
  if (beginning.found)  // what the node before has recorded is kept
    settings.first_run = std::max<std::uint64_t>(2, record.free_run());

  input_ = std::make_unique<OpeningInput>(node, parameters_.joints, queue_);
  if (parameters_.forecast.enabled)
    forecasts_ = std::make_unique<ForecastTopics>(
        node, parameters_, scene_,
        [this](std::shared_ptr<const forecast::Forecast> forecast) { alarms_.expect(std::move(forecast)); });
  if (forecasts_)
    forecasts_->restart(settings.first_run);
  solver_ = std::make_unique<SolverThread>(std::move(beginning.simulation), queue_, std::move(record),
                                           std::move(settings), hooks());

  DiagnosticSources sources;
  sources.progress = [this] { return solver_->progress(); };
  sources.outputs = [this] { return outputs_.health(); };
  sources.senders = [this] { return input_->senders(); };
  sources.alarms = [this] { return alarms_.report(); };
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
  const Callback acknowledge = [this](Trigger::Request&, Trigger::Response& response) {
    response.success = true;
    response.message = alarms_.acknowledge();
    solver_->announce();  // shown as soon as the solver has a moment; nobody waits for it
    return true;
  };
  acknowledge_ = private_node.advertiseService("acknowledge", acknowledge);
}

Beginning ReleaseNode::begin() const
{
  Beginning beginning = begin_or_resume(scene_, parameters_.threads, parameters_.checkpoint);
  ROS_INFO("scene '%s' from %s is ready: %lu particles, %d threads", scene_.name.c_str(), parameters_.scene.c_str(),
           static_cast<unsigned long>(beginning.simulation.counters().particles), parameters_.threads);
  if (beginning.found)
    ROS_WARN("%s", beginning.what.c_str());
  return beginning;
}

SolverHooks ReleaseNode::hooks()
{
  SolverHooks hooks;
  hooks.now_ns = [] { return static_cast<std::int64_t>(ros::Time::now().toNSec()); };
  hooks.senders = [this] { return input_->senders(); };
  hooks.frame_wanted = [this] { return outputs_.wanted(); };
  hooks.frame = [this](const scene::Frame& frame, const Progress& progress) {
    outputs_.publish(frame, progress, look(progress));
  };
  hooks.progress = [this](const Progress& progress) { outputs_.publish(progress, look(progress)); };
  if (forecasts_) {
    hooks.forecaster = &forecasts_->forecaster();
    hooks.restarted = [this](std::uint64_t run) { forecasts_->restart(run); };
  }
  hooks.notice = [](const std::string& sentence) { ROS_WARN("%s", sentence.c_str()); };
  return hooks;
}

AlarmReport ReleaseNode::look(const Progress& progress)
{
  return alarms_.look(progress, static_cast<std::int64_t>(ros::Time::now().toNSec()), input_->senders());
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
