#include "geocontainer_mpm/ros/diagnostics.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "geocontainer_mpm/ros/conversions.h"
#include "geocontainer_mpm/ros/run_record.h"

namespace geocontainer_mpm::ros_bridge {
namespace {

using diagnostic_msgs::DiagnosticStatus;
using diagnostic_updater::DiagnosticStatusWrapper;

constexpr double late_s = 5.0;  ///< a lag beyond this is worth a warning: the prediction is no longer of now

template <typename Value>
void add(DiagnosticStatusWrapper& status, const std::string& key, const Value& value)
{
  status.add(key, fmt::format("{}", value));
}

}  // namespace

void describe_simulation(const Progress& progress, const std::string& scene_name, int threads,
                         DiagnosticStatusWrapper& status)
{
  status.summary(DiagnosticStatus::OK, to_string(progress.state));
  if (progress.state == RunState::waiting_for_clock)
    status.summary(DiagnosticStatus::WARN, "use_sim_time is set, but no /clock was heard");
  else if (progress.lag_s > late_s)
    status.summary(DiagnosticStatus::WARN, fmt::format("{:.1f} s behind the measurement", progress.lag_s));
  if (!progress.record_error.empty())
    status.mergeSummary(DiagnosticStatus::ERROR, "record: " + progress.record_error);
  if (!progress.checkpoint_error.empty())
    status.mergeSummary(DiagnosticStatus::WARN, "checkpoint: " + progress.checkpoint_error);
  if (progress.state == RunState::stopped)
    status.summary(DiagnosticStatus::ERROR, status_sentence(progress));

  add(status, "scene", scene_name);
  add(status, "state", to_string(progress.state));
  add(status, "run", progress.run);
  add(status, "outcome", scene::to_string(progress.status.outcome));
  add(status, "simulated time (s)", progress.time_s);
  add(status, "end of scene (s)", progress.end_s);
  add(status, "simulation lag (s)", progress.lag_s);
  add(status, "real-time factor", progress.real_time_factor);
  add(status, "time step (s)", progress.dt_s);
  add(status, "steps", progress.counters.steps);
  add(status, "time skipped at rest (s)", progress.counters.skipped.resting_time_s);
  add(status, "particles", progress.counters.particles);
  add(status, "threads", threads);
  if (progress.digest_time_s >= 0.0) {
    add(status, "state digest", digest_text(progress.digest));
    add(status, "state digest of time (s)", progress.digest_time_s);
  }
  if (!progress.record_path.empty()) {
    add(status, "record", progress.record_path);
    add(status, "recorded frames", progress.recorded_frames);
  }
  if (!progress.checkpoint_path.empty()) {
    add(status, "checkpoint", progress.checkpoint_path);
    add(status, "checkpoint of time (s)", progress.checkpoint_time_s);
    add(status, "checkpoint cost (s)", progress.checkpoint_cost_s);
  }
  if (!progress.resume.empty())
    add(status, "resume", progress.resume);
}

void describe_opening(const Progress& progress, const Progress& before, unsigned senders,
                      DiagnosticStatusWrapper& status)
{
  const bool same_run = progress.run == before.run;
  status.summary(DiagnosticStatus::OK, progress.accepted > 0 ? "following" : "no sample yet");
  std::string fresh;
  for (std::size_t i = 0; i < reject_reason_count; ++i) {
    const std::uint64_t new_ones = progress.rejected[i] - (same_run ? before.rejected[i] : 0);
    if (new_ones > 0)
      fresh += fmt::format("{}{} {}", fresh.empty() ? "" : ", ", new_ones, to_string(static_cast<RejectReason>(i)));
  }
  if (!fresh.empty())
    status.summary(DiagnosticStatus::WARN, "samples rejected: " + fresh);
  if (progress.gaps > (same_run ? before.gaps : 0))
    status.mergeSummary(DiagnosticStatus::WARN, "gap in the opening, the angle was held");
  if (progress.holding)
    status.mergeSummary(DiagnosticStatus::WARN, "the opening is silent, its last angle is held");

  add(status, "port (rad)", progress.opening.port_rad);
  add(status, "starboard (rad)", progress.opening.starboard_rad);
  add(status, "senders", senders);
  add(status, "accepted", progress.accepted);
  for (std::size_t i = 0; i < reject_reason_count; ++i)
    add(status, std::string("rejected: ") + to_string(static_cast<RejectReason>(i)), progress.rejected[i]);
  add(status, "known from the checkpoint", progress.known_again);
  add(status, "gaps", progress.gaps);
  add(status, "holding", progress.holding);
  add(status, "log over", progress.log_over);
}

void describe_outputs(const OutputHealth& health, const OutputHealth& before, DiagnosticStatusWrapper& status)
{
  status.summary(DiagnosticStatus::OK, "publishing to whom subscribes");
  if (!health.transform_error.empty())
    status.summary(DiagnosticStatus::WARN, "geometry is in the barge frame: " + health.transform_error);
  if (health.dropped > before.dropped)
    status.summary(DiagnosticStatus::ERROR, "not finite, not published: " + health.last_dropped);
  add(status, "frames published", health.frames);
  add(status, "frames without transform", health.without_transform);
  add(status, "frames dropped", health.dropped);
}

void describe_alarms(const AlarmReport& report, DiagnosticStatusWrapper& status)
{
  alarm::Level worst = alarm::Level::normal;
  std::string sentences;
  for (const alarm::Alarm& alarm : report.alarms) {
    std::string text = fmt::format("{}, {:.3g} {}", to_string(alarm.level), alarm.value, alarm.unit);
    if (alarm.latched != alarm::Level::normal) {
      worst = std::max(worst, alarm.latched);
      sentences += fmt::format("{}{}{}", sentences.empty() ? "" : "; ", alarm.message,
                               alarm.level == alarm::Level::normal ? " (over)" : "");
      text += fmt::format(", latched {}, {}", to_string(alarm.latched),
                          alarm.acknowledged ? "acknowledged" : "not acknowledged");
    }
    add(status, alarm.name, text);
  }
  const std::string message = sentences.empty() ? "no alarm" : sentences;
  if (report.replay)
    status.summary(DiagnosticStatus::OK, "[replay] " + message);
  else
    status.summary(worst == alarm::Level::alarm  ? DiagnosticStatus::ERROR
                   : worst == alarm::Level::warn ? DiagnosticStatus::WARN
                                                 : DiagnosticStatus::OK,
                   message);
}

Diagnostics::Diagnostics(ros::NodeHandle& node, const ros::NodeHandle& private_node, double period_s,
                         std::string scene_name, int threads, DiagnosticSources sources)
    : scene_name_(std::move(scene_name)), threads_(threads), sources_(std::move(sources)), updater_(node, private_node)
{
  updater_.setHardwareID("none");
  updater_.add("simulation", this, &Diagnostics::simulation);
  updater_.add("hull opening", this, &Diagnostics::opening);
  updater_.add("outputs", this, &Diagnostics::outputs);
  updater_.add("alarms", this, &Diagnostics::alarms);
  timer_ = node.createWallTimer(ros::WallDuration(period_s),
                                [this](const ros::WallTimerEvent&) { updater_.force_update(); });
}

void Diagnostics::simulation(DiagnosticStatusWrapper& status)
{
  describe_simulation(sources_.progress(), scene_name_, threads_, status);
}

void Diagnostics::opening(DiagnosticStatusWrapper& status)
{
  const Progress progress = sources_.progress();
  describe_opening(progress, progress_before_, sources_.senders(), status);
  progress_before_ = progress;
}

void Diagnostics::outputs(DiagnosticStatusWrapper& status)
{
  const OutputHealth health = sources_.outputs();
  describe_outputs(health, outputs_before_, status);
  outputs_before_ = health;
}

void Diagnostics::alarms(DiagnosticStatusWrapper& status)
{
  describe_alarms(sources_.alarms(), status);
}

}  // namespace geocontainer_mpm::ros_bridge
