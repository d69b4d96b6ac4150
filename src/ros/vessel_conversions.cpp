/// From messages to what the vessel is told, and from health to diagnostics: pure functions.
#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "geocontainer_mpm/ros/vessel_link.h"

namespace geocontainer_mpm::ros_bridge {
namespace {

using diagnostic_msgs::DiagnosticStatus;
using diagnostic_updater::DiagnosticStatusWrapper;
using vessel::NmeaFault;
using vessel::Stamp;

Stamp to_stamp(const ros::Time& time)
{
  return Stamp(std::chrono::seconds(time.sec) + std::chrono::nanoseconds(time.nsec));
}

vessel::ReleaseState to_state(std::uint8_t outcome)
{
  switch (outcome) {
    case ReleaseStatus::WAITING:
      return vessel::ReleaseState::waiting;
    case ReleaseStatus::RELEASING:
      return vessel::ReleaseState::releasing;
    case ReleaseStatus::RELEASED:
      return vessel::ReleaseState::released;
    case ReleaseStatus::HUNG_UP:
      return vessel::ReleaseState::hung_up;
    default:
      return vessel::ReleaseState::none;
  }
}

vessel::AlarmLevel to_level(std::uint8_t level)
{
  return level == ReleaseAlarm::ALARM  ? vessel::AlarmLevel::alarm
         : level == ReleaseAlarm::WARN ? vessel::AlarmLevel::warn
                                       : vessel::AlarmLevel::normal;
}

vessel::Band to_band(const Quantiles& quantiles)
{
  return { quantiles.p10, quantiles.p50, quantiles.p90 };
}

vessel::AdviceState to_advice_state(const ReleaseEnsemble& ensemble)
{
  switch (ensemble.advice) {
    case ReleaseEnsemble::ANY_RATE:
      return vessel::AdviceState::any_rate;
    case ReleaseEnsemble::RATE:
      return ensemble.advice_complete != 0 ? vessel::AdviceState::rate : vessel::AdviceState::rate_so_far;
    case ReleaseEnsemble::NO_RATE:
      return vessel::AdviceState::no_rate;
    default:
      return vessel::AdviceState::none;
  }
}

std::vector<double> seconds(const std::vector<ros::Time>& stamps)
{
  std::vector<double> times;
  for (const ros::Time& stamp : stamps)
    times.push_back(stamp.toSec());
  return times;
}

double largest(const std::vector<double>& values)
{
  return values.empty() ? vessel::unknown : *std::max_element(values.begin(), values.end());
}

template <typename Value>
void add(DiagnosticStatusWrapper& status, const std::string& key, const Value& value)
{
  status.add(key, fmt::format("{}", value));
}

}  // namespace

vessel::ReleaseFigures to_figures(const ReleaseStatus& status)
{
  vessel::ReleaseFigures figures;
  figures.stamp = to_stamp(status.header.stamp);
  figures.state = to_state(status.outcome);
  figures.resting = status.resting;
  figures.stopped = status.stopped;
  figures.message = status.message;
  figures.port_rad = status.port;
  figures.starboard_rad = status.starboard;
  figures.current_tension_n_per_m = status.current_tension;
  figures.peak_tension_n_per_m = status.peak_tension;
  figures.peak_utilisation = status.peak_utilisation;
  figures.centroid_m = { status.centroid.x, status.centroid.y, status.centroid.z };
  figures.width_m = status.width;
  figures.height_m = status.height;
  figures.release_time_s = status.release_time.toSec();
  figures.lag_s = status.lag;
  return figures;
}

std::vector<vessel::Alarm> to_alarms(const ReleaseStatus& status)
{
  std::vector<vessel::Alarm> alarms;
  for (const ReleaseAlarm& alarm : status.alarms)
    alarms.push_back({ alarm.name, to_level(alarm.level), to_level(alarm.latched), alarm.acknowledged != 0,
                       to_stamp(alarm.since), alarm.message });
  return alarms;
}

vessel::ForecastFigures to_figures(const ReleaseForecast& forecast)
{
  vessel::ForecastFigures figures;
  figures.stamp = to_stamp(forecast.header.stamp);
  figures.stale = forecast.stale != 0;
  figures.outcome = to_state(forecast.outcome);
  figures.ruptured = forecast.ruptured != 0;
  figures.message = forecast.message;
  if (!forecast.release_time.isZero()) {
    figures.release = to_stamp(forecast.release_time);
    figures.until_release_s = (forecast.release_time - forecast.header.stamp).toSec() - forecast.age;
  }
  figures.peak_tension_n_per_m = largest(forecast.peak_tension);
  figures.peak_utilisation = largest(forecast.utilisation);
  if (forecast.stamps.size() == forecast.tension.size() && !forecast.stamps.empty())
    figures.curve = vessel::thin_curve(seconds(forecast.stamps), forecast.tension);
  return figures;
}

vessel::EnsembleFigures to_figures(const ReleaseEnsemble& ensemble)
{
  vessel::EnsembleFigures figures;
  figures.stamp = to_stamp(ensemble.header.stamp);
  figures.members = ensemble.completed;
  figures.peak_tension_n_per_m = to_band(ensemble.peak_tension);
  figures.peak_utilisation = to_band(ensemble.peak_utilisation);
  figures.release_delay_s = to_band(ensemble.release_delay);
  figures.final_width_m = to_band(ensemble.final_width);
  const std::size_t instants = ensemble.stamps.size();
  if (instants > 0 && ensemble.tension_p10.size() == instants && ensemble.tension_p50.size() == instants &&
      ensemble.tension_p90.size() == instants)
    figures.tension = vessel::thin_band(
        seconds(ensemble.stamps),
        { { "p10", ensemble.tension_p10 }, { "p50", ensemble.tension_p50 }, { "p90", ensemble.tension_p90 } });
  figures.hung_up = ensemble.hung_up;
  figures.ruptured = ensemble.ruptured;
  figures.advice = to_advice_state(ensemble);
  figures.advised_rate_rad_per_s = ensemble.advised_rate;
  figures.slowest_rate_rad_per_s = ensemble.slowest_rate;
  figures.advised_utilisation = ensemble.advised_utilisation;
  figures.advice_message = ensemble.message;
  return figures;
}

vessel::SectionFigures to_section(const GeotextileForces& forces, const Eigen::Isometry3d& to_barge)
{
  std::vector<double> y, z;
  for (const geometry_msgs::Point& node : forces.nodes) {
    const Eigen::Vector3d point = to_barge * Eigen::Vector3d(node.x, node.y, node.z);
    y.push_back(point.y());
    z.push_back(point.z());
  }
  return { to_stamp(forces.header.stamp), vessel::thin_outline(y, z, forces.utilisation) };
}

void describe_signalk(const vessel::SignalKHealth& health, const vessel::SignalKHealth& before,
                      DiagnosticStatusWrapper& status)
{
  status.summary(DiagnosticStatus::OK, to_string(health.state));
  if (health.state != vessel::LinkState::open)
    status.summary(DiagnosticStatus::WARN, fmt::format("{}: {}", to_string(health.state), health.last_error));
  else if (health.confirmation == vessel::Confirmation::unconfirmed)
    status.summary(DiagnosticStatus::WARN,
                   fmt::format("unconfirmed: the server does not show {}; a server with security on drops what comes "
                               "without a token that may write",
                               health.oldest_unconfirmed));
  if (health.bad_messages > before.bad_messages)
    status.mergeSummary(DiagnosticStatus::WARN,
                        fmt::format("{} messages were not Signal K", health.bad_messages - before.bad_messages));
  if (health.values_refused > before.values_refused)
    status.mergeSummary(DiagnosticStatus::WARN, fmt::format("{} values have no path on the server (an alarm that the "
                                                            "link does not know)",
                                                            health.values_refused - before.values_refused));
  add(status, "state", to_string(health.state));
  add(status, "confirmation", to_string(health.confirmation));
  add(status, "connections", health.connections);
  add(status, "failures", health.failures);
  add(status, "last error", health.last_error);
  add(status, "messages sent", health.messages_sent);
  add(status, "values sent", health.values_sent);
  add(status, "values confirmed", health.values_confirmed);
  add(status, "values replaced before they were sent", health.values_replaced);
  add(status, "values refused", health.values_refused);
  add(status, "values received", health.values_received);
  add(status, "bad messages", health.bad_messages);
}

void describe_nmea_port(const vessel::NmeaPortHealth& health, const vessel::NmeaPortHealth& before,
                        vessel::NmeaTransport transport, int bound_port, DiagnosticStatusWrapper& status)
{
  status.summary(DiagnosticStatus::OK, to_string(transport));
  if (transport == vessel::NmeaTransport::tcp_client && health.peers == 0)
    status.summary(DiagnosticStatus::WARN, "not connected: " + health.last_error);
  std::string fresh;
  for (std::size_t i = 0; i < vessel::nmea_fault_count; ++i)
    if (const std::uint64_t count = health.counts.faults[i] - before.counts.faults[i]; count > 0)
      fresh += fmt::format("{}{} {}", fresh.empty() ? "" : ", ", count, to_string(static_cast<NmeaFault>(i)));
  if (!fresh.empty())
    status.mergeSummary(DiagnosticStatus::WARN, "ignored: " + fresh);
  add(status, "bound port", bound_port);
  add(status, "peers", health.peers);
  add(status, "connections", health.connections);
  add(status, "failures", health.failures);
  add(status, "last error", health.last_error);
  add(status, "bytes in", health.bytes_in);
  add(status, "sentences in", health.counts.sentences);
  add(status, "hull angles in", health.counts.angles);
  for (std::size_t i = 0; i < vessel::nmea_fault_count; ++i)
    add(status, std::string("ignored: ") + to_string(static_cast<NmeaFault>(i)), health.counts.faults[i]);
  add(status, "texts sent", health.sent);
  add(status, "texts dropped", health.dropped);
}

}  // namespace geocontainer_mpm::ros_bridge
