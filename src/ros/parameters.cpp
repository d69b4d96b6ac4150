#include "geocontainer_mpm/ros/parameters.h"

#include <unistd.h>

#include <filesystem>
#include <limits>
#include <utility>

#include "parameter_reader.h"

namespace geocontainer_mpm::ros_bridge {
namespace {

using XmlRpc::XmlRpcValue;
using Reader = ParameterReader;

void require_text(const Reader& reader, const char* key, const std::string& value)
{
  if (value.empty())
    reader.fail(key, XmlRpcValue(), "must be given and not be empty");
}

void require_writable_directory(const Reader& reader, const char* key, const std::filesystem::path& directory)
{
  std::error_code error;
  if (!std::filesystem::is_directory(directory, error) || ::access(directory.c_str(), W_OK | X_OK) != 0)
    reader.fail(key, XmlRpcValue(directory.string()), "must be (in) an existing directory that this node may write to");
}

void read_ensemble(Reader reader, ForecastParameters& parameters)
{
  reader.read("members", parameters.members, 0, 10'000);
  reader.read("distributions", parameters.distributions);
  reader.read("scene_overrides", parameters.ensemble_overrides);
  reader.read("seed", parameters.seed, 0, std::numeric_limits<int>::max());
  reader.read("threads", parameters.ensemble_threads, 1, 256);
  reader.read("period_s", parameters.settings.ensemble_period_s, 0.0, 86'400.0);
  reader.refuse_unknown();
  if (parameters.members > 0)
    require_text(reader, "distributions", parameters.distributions);
}

void read_advice(Reader reader, ForecastParameters& parameters)
{
  forecast::AdviceSettings& advice = parameters.advice;
  const double unlimited = std::numeric_limits<double>::infinity();
  reader.read("enabled", parameters.advice_enabled);
  reader.read("utilisation_limit", advice.utilisation_limit, 0.0, unlimited);
  reader.read("slowest_rad_per_s", advice.slowest_rad_per_s, 0.0, unlimited);
  reader.read("fastest_rad_per_s", advice.fastest_rad_per_s, 0.0, unlimited);
  reader.read("ladder", advice.ladder, 2, 100);
  reader.read("halvings", advice.halvings, 0, 100);
  reader.refuse_unknown();
  if (advice.slowest_rad_per_s >= advice.fastest_rad_per_s)
    reader.fail("slowest_rad_per_s", XmlRpcValue(advice.slowest_rad_per_s),
                "must be below ~forecast/advice/fastest_rad_per_s");
  if (parameters.advice_enabled && parameters.members == 0)
    reader.fail("enabled", XmlRpcValue(true), "needs an ensemble: ~forecast/ensemble/members above 0");
}

void read_forecast(Reader reader, ForecastParameters& parameters)
{
  forecast::ForecasterSettings& settings = parameters.settings;
  reader.read("enabled", parameters.enabled);
  reader.read("horizon_s", settings.reach.horizon_s, 0.0, 86'400.0);
  reader.read("after_release_s", settings.reach.after_release_s, 0.0, 86'400.0);
  reader.read("interval_s", settings.interval_s, 0.0, 3600.0);
  reader.read("period_s", settings.period_s, 0.0, 86'400.0);
  reader.read("tolerance_rad", settings.tolerance_rad, 0.0, 1.57);
  reader.read("rate_window_s", settings.rate_window_s, 0.0, 3600.0);
  read_ensemble(reader.dictionary("ensemble"), parameters);
  read_advice(reader.dictionary("advice"), parameters);
  reader.refuse_unknown();
}

/// `<name>_warn<unit>` and `<name>_alarm<unit>`.
void read_limits(Reader& reader, const std::string& name, const std::string& unit, alarm::Limits& limits)
{
  const std::string warn = name + "_warn" + unit, highest = name + "_alarm" + unit;
  reader.read(warn.c_str(), limits.warn, 0.0, std::numeric_limits<double>::infinity());
  reader.read(highest.c_str(), limits.alarm, 0.0, std::numeric_limits<double>::infinity());
  if (limits.alarm <= limits.warn)
    reader.fail(highest, XmlRpcValue(limits.alarm), "must be greater than " + warn);
}

void read_alarms(Reader reader, AlarmParameters& alarms)
{
  const double unlimited = std::numeric_limits<double>::infinity();
  read_limits(reader, "utilisation", "", alarms.utilisation);
  read_limits(reader, "lopsided", "_rad", alarms.lopsided_rad);
  read_limits(reader, "silence", "_s", alarms.silence_s);
  reader.read("rejected_warn", alarms.rejected_warn, 0.0, 1.0);
  read_limits(reader, "lag", "_s", alarms.lag_s);
  reader.read("not_sinking_s", alarms.not_sinking_s, 0.0, unlimited);
  reader.read("not_sinking_m", alarms.not_sinking_m, 0.0, unlimited);
  reader.read("band", alarms.band, 0.0, 0.9, true);
  reader.read("fall_after_s", alarms.fall_after_s, 0.0, 3600.0, true);
  reader.refuse_unknown();
}

}  // namespace

NodeParameters parse_parameters(const XmlRpcValue& tree, const std::string& source)
{
  NodeParameters parameters;
  const double unlimited = std::numeric_limits<double>::infinity();
  Reader reader(tree, source);
  reader.read("scene", parameters.scene);
  reader.read("scene_overrides", parameters.scene_overrides);
  reader.read("threads", parameters.threads, 1, 256);
  reader.read("autostart", parameters.autostart);
  reader.read("port_joint", parameters.joints.port);
  reader.read("starboard_joint", parameters.joints.starboard);
  reader.read("queue_size", parameters.queue_size, 1, 10'000'000);
  reader.read("max_future_s", parameters.max_future_s, 0.0, unlimited);
  reader.read("time_jump_back_s", parameters.time_jump_back_s, 0.0, unlimited);
  reader.read("transport_patience_s", parameters.transport_patience_s, 0.0, 60.0, true);
  reader.read("finish_when_source_leaves", parameters.finish_when_source_leaves);
  reader.read("fixed_frame", parameters.fixed_frame);
  reader.read("barge_frame", parameters.barge_frame);
  reader.read("display_width_m", parameters.display_width_m, 0.0, unlimited);
  reader.read("publish_rate_hz", parameters.publish_rate_hz, 0.0, 1000.0);
  reader.read("soil_stride", parameters.soil_stride, 1, 1'000'000);
  reader.read("record", parameters.record);
  reader.read("save_directory", parameters.save_directory);
  reader.read("checkpoint", parameters.checkpoint);
  reader.read("checkpoint_period_s", parameters.checkpoint_period_s, 0.0, 86'400.0);
  reader.read("resume_within_s", parameters.resume_within_s, 0.0, 86'400.0);
  reader.read("service_timeout_s", parameters.service_timeout_s, 0.0, 3600.0);
  reader.read("diagnostic_period", parameters.diagnostic_period, 0.0, 3600.0);
  read_forecast(reader.dictionary("forecast"), parameters.forecast);
  read_alarms(reader.dictionary("alarms"), parameters.alarms);
  reader.refuse_unknown();

  require_text(reader, "scene", parameters.scene);
  require_text(reader, "port_joint", parameters.joints.port);
  require_text(reader, "starboard_joint", parameters.joints.starboard);
  require_text(reader, "fixed_frame", parameters.fixed_frame);
  require_text(reader, "barge_frame", parameters.barge_frame);
  if (parameters.joints.port == parameters.joints.starboard)
    reader.fail("starboard_joint", XmlRpcValue(parameters.joints.starboard), "must differ from ~port_joint");
  require_writable_directory(reader, "save_directory", parameters.save_directory);
  for (const auto& [key, path] :
       { std::pair("record", parameters.record), std::pair("checkpoint", parameters.checkpoint) }) {
    const std::filesystem::path directory = std::filesystem::path(path).parent_path();
    if (!path.empty())
      require_writable_directory(reader, key, directory.empty() ? "." : directory);
  }
  return parameters;
}

NodeParameters load_parameters(const ros::NodeHandle& private_handle)
{
  XmlRpcValue tree;
  private_handle.getParam(private_handle.getNamespace(), tree);  // stays invalid when there is none at all
  return parse_parameters(tree, private_handle.getNamespace());
}

}  // namespace geocontainer_mpm::ros_bridge
