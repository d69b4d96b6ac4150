#include "geocontainer_mpm/ros/vessel_link.h"

#include <fmt/format.h>
#include <geocontainer_mpm/HullOpening.h>
#include <geometry_msgs/TransformStamped.h>
#include <ros/console.h>
#include <tf2/exceptions.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <boost/function.hpp>
#include <string>
#include <utility>

namespace geocontainer_mpm::ros_bridge {
namespace {

using diagnostic_msgs::DiagnosticStatus;
using diagnostic_updater::DiagnosticStatusWrapper;
using vessel::NmeaFault;
using vessel::Stamp;

constexpr const char* release_notice_path = ".release";
constexpr const char* hull_path = ".hull.section";
/// The outline is the longest value by far, and is looked at by eyes.
constexpr std::chrono::milliseconds outline_period{ 500 };

Stamp to_stamp(const ros::Time& time)
{
  return Stamp(std::chrono::seconds(time.sec) + std::chrono::nanoseconds(time.nsec));
}

ros::Time to_time(Stamp stamp)
{
  ros::Time time;
  time.fromNSec(static_cast<std::uint64_t>(stamp.time_since_epoch().count()));
  return time;
}

std::chrono::nanoseconds to_duration(double seconds)
{
  return std::chrono::nanoseconds(static_cast<std::chrono::nanoseconds::rep>(1e9 * seconds));
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

double largest(const std::vector<double>& values)
{
  return values.empty() ? vessel::unknown : *std::max_element(values.begin(), values.end());
}

Eigen::Isometry3d to_pose(const geometry_msgs::Transform& transform)
{
  const geometry_msgs::Quaternion& rotation = transform.rotation;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = Eigen::Quaterniond(rotation.w, rotation.x, rotation.y, rotation.z).normalized().toRotationMatrix();
  pose.translation() << transform.translation.x, transform.translation.y, transform.translation.z;
  return pose;
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
  if (forecast.stamps.size() == forecast.tension.size() && !forecast.stamps.empty()) {
    std::vector<double> time;
    for (const ros::Time& stamp : forecast.stamps)
      time.push_back(stamp.toSec());
    figures.curve = vessel::thin_curve(time, forecast.tension);
  }
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
  figures.hung_up = ensemble.hung_up;
  figures.ruptured = ensemble.ruptured;
  figures.advice = ensemble.advice == ReleaseEnsemble::ANY_RATE  ? vessel::AdviceState::any_rate
                   : ensemble.advice == ReleaseEnsemble::RATE    ? vessel::AdviceState::rate
                   : ensemble.advice == ReleaseEnsemble::NO_RATE ? vessel::AdviceState::no_rate
                                                                 : vessel::AdviceState::none;
  figures.advised_rate_rad_per_s = ensemble.advised_rate;
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

VesselLink::VesselLink(ros::NodeHandle node, const ros::NodeHandle& private_node)
    : parameters_(load_vessel_parameters(private_node))
    , replay_(ros::Time::isSimTime())
    , signalk_pair_(to_duration(parameters_.pair_within_s))
    , listener_(transforms_, node, false)  // no thread of its own: the node spins anyway
    , updater_(node, private_node)
{
  if (parameters_.hull_angles != AngleSource::none)
    opening_ = node.advertise<HullOpening>("hull_opening", 100);
  transforms_.setUsingDedicatedThread(true);
  updater_.setHardwareID("none");
  updater_.add("vessel link", this, &VesselLink::describe);
  if (parameters_.signalk.enabled)
    open_signalk(node);
  for (const VesselNmeaPort& port : parameters_.nmea)
    open_port(port);
  // The newest status is enough: what is sent is a state.
  const boost::function<void(const ReleaseStatus&)> take = [this](const ReleaseStatus& message) { on_status(message); };
  status_ = node.subscribe<ReleaseStatus, const ReleaseStatus&>("release_status", 1, take);
  timer_ = node.createWallTimer(ros::WallDuration(parameters_.diagnostic_period),
                                [this](const ros::WallTimerEvent&) { updater_.force_update(); });
}

void VesselLink::open_signalk(ros::NodeHandle& node)
{
  VesselSignalK& signalk = parameters_.signalk;
  if (replay_)
    signalk.server.source += ".replay";
  auto announced = vessel::describe_figures(signalk.path_prefix, replay_ ? 0.0 : signalk.utilisation_warn,
                                            replay_ ? 0.0 : signalk.utilisation_alarm);
  if (!replay_) {
    announced.push_back({ notice_path(release_notice_path), "", "", {} });
    for (const vessel::AlarmKind& kind : vessel::alarm_kinds())
      announced.push_back({ notice_path(std::string(".") + kind.name), "", "", {} });
  }
  announced.push_back(
      { signalk.path_prefix + hull_path, "", "Port half of the hull, closed, and its hinge, for pictures", {} });
  std::vector<std::string> inputs;
  if (parameters_.hull_angles == AngleSource::signalk)
    inputs = { signalk.port_path, signalk.starboard_path };
  signalk_ = std::make_unique<vessel::SignalKClient>(signalk.server, std::move(announced), std::move(inputs),
                                                     [this](const vessel::IncomingValue& value) { on_input(value); });
  updater_.add("signal k", [this](Status& status) {
    const vessel::SignalKHealth health = signalk_->health();
    describe_signalk(health, signalk_before_, status);
    signalk_before_ = health;
  });
  if (!replay_ || parameters_.send_replays)
    signalk_->send({ { signalk.path_prefix + hull_path, vessel::Value(signalk.section.columns()),
                       std::chrono::system_clock::now() } });

  const boost::function<void(const ReleaseForecast&)> take_forecast = [this](const ReleaseForecast& message) {
    send(vessel::forecast_figures(), to_figures(message));
  };
  const boost::function<void(const ReleaseEnsemble&)> take_ensemble = [this](const ReleaseEnsemble& message) {
    send(vessel::ensemble_figures(), to_figures(message));
  };
  const boost::function<void(const GeotextileForces&)> take_forces = [this](const GeotextileForces& message) {
    on_forces(message);
  };
  forecast_ = node.subscribe<ReleaseForecast, const ReleaseForecast&>("release_forecast", 1, take_forecast);
  ensemble_ = node.subscribe<ReleaseEnsemble, const ReleaseEnsemble&>("release_ensemble", 1, take_ensemble);
  forces_ = node.subscribe<GeotextileForces, const GeotextileForces&>("geotextile_forces", 10, take_forces);
}

std::string VesselLink::notice_path(const std::string& name) const
{
  return "notifications." + parameters_.signalk.path_prefix + name;
}

template <typename Source>
void VesselLink::send(const std::vector<vessel::Figure<Source>>& table, const Source& figures)
{
  if (!withholds(replay_heard_))
    signalk_->send(vessel::to_values(table, figures, parameters_.signalk.path_prefix));
}

/// A replay that is heard by a link which does not know that it is in one could not be marked: it is never sent.
bool VesselLink::withholds(bool replay) const
{
  return replay_ ? !parameters_.send_replays : replay;
}

void VesselLink::on_forces(const GeotextileForces& message)
{
  const auto now = std::chrono::steady_clock::now();
  const std::string& wanted = parameters_.signalk.section.geotextile;
  // In three dimensions there is no one outline.
  if (now < next_outline_ || !message.triangles.empty() || (!wanted.empty() && message.name != wanted))
    return;
  Eigen::Isometry3d to_barge = Eigen::Isometry3d::Identity();
  if (message.header.frame_id != parameters_.barge_frame) {
    try {
      const auto transform =
          transforms_.lookupTransform(parameters_.barge_frame, message.header.frame_id, message.header.stamp);
      to_barge = to_pose(transform.transform);
    } catch (const tf2::TransformException& error) {
      ++without_transform_;
      return;
    }
  }
  next_outline_ = now + outline_period;
  send(vessel::section_figures(), to_section(message, to_barge));
}

void VesselLink::open_port(const VesselNmeaPort& parameters)
{
  ports_.push_back(std::unique_ptr<Port>(
      new Port{ parameters, vessel::OpeningPair(to_duration(parameters_.pair_within_s)), {}, {} }));
  Port& port = *ports_.back();
  port.port = std::make_unique<vessel::NmeaPort>(
      parameters.port, [this, &port](const vessel::Sentence& sentence, vessel::NmeaCounts& counts) {
        on_sentence(port, sentence, counts);
      });
  updater_.add(fmt::format("nmea {}", ports_.size()), [&port](Status& status) {
    const vessel::NmeaPortHealth health = port.port->health();
    describe_nmea_port(health, port.before, port.parameters.port.transport, port.port->bound_port(), status);
    port.before = health;
  });
}

void VesselLink::on_status(const ReleaseStatus& message)
{
  ++heard_;
  replay_heard_ = message.replay != 0;
  if (withholds(replay_heard_)) {
    ++withheld_;
    return;
  }
  const vessel::ReleaseFigures figures = to_figures(message);
  const std::vector<vessel::Alarm> alarms = replay_ ? std::vector<vessel::Alarm>() : to_alarms(message);
  if (signalk_) {
    auto values = vessel::to_values(vessel::release_figures(), figures, parameters_.signalk.path_prefix);
    for (const vessel::Alarm& alarm : alarms)
      values.push_back({ notice_path("." + alarm.name), vessel::to_notice(alarm), figures.stamp });
    // A status without alarms is not left without any.
    if (!replay_ && alarms.empty())
      values.push_back({ notice_path(release_notice_path), vessel::release_notice(figures), figures.stamp });
    signalk_->send(values);
  }
  const std::string release = vessel::write_release(figures) +
                              alarm_sentences_.due(alarms, std::chrono::steady_clock::now(), parameters_.names);
  std::string angles;
  for (const std::string& sentence :
       vessel::write_hull_angles(figures.port_rad, figures.starboard_rad, parameters_.names))
    angles += sentence;
  for (const auto& port : ports_) {
    const std::string text = (port->parameters.send_angles ? angles : "") + (port->parameters.send ? release : "");
    if (!text.empty())
      port->port->send(text);
  }
}

void VesselLink::on_sentence(Port& port, const vessel::Sentence& sentence, vessel::NmeaCounts& counts)
{
  if (parameters_.hull_angles != AngleSource::nmea || !port.parameters.receive)
    return;
  // A sentence has no time of its own: it is measured when it is heard.
  const Stamp now = to_stamp(ros::Time::now());
  for (const vessel::HullAngle& angle : vessel::read_hull_angles(sentence, parameters_.names, counts))
    if (const auto sample = port.pair.add(angle.half, now, angle.angle_rad))
      publish(*sample);
}

void VesselLink::on_input(const vessel::IncomingValue& value)
{
  const auto* const angle = std::get_if<double>(&value.value);
  const auto age = std::chrono::abs(std::chrono::system_clock::now() - value.stamp.value_or(Stamp()));
  // The server hands out what it last heard, however long ago that was.
  if (angle == nullptr || age > to_duration(parameters_.signalk.max_age_s)) {
    ++unbelieved_;
    return;
  }
  const vessel::HullHalf half =
      value.path == parameters_.signalk.port_path ? vessel::HullHalf::port : vessel::HullHalf::starboard;
  if (const auto sample = signalk_pair_.add(half, *value.stamp, *angle))
    publish(*sample);
}

void VesselLink::publish(const vessel::OpeningSample& sample)
{
  HullOpening message;
  message.header.stamp = to_time(sample.stamp);
  message.header.frame_id = parameters_.barge_frame;
  message.port = sample.port_rad;
  message.starboard = sample.starboard_rad;
  opening_.publish(message);
  ++published_;
}

void VesselLink::describe(Status& status)
{
  status.summary(DiagnosticStatus::OK,
                 signalk_ || !ports_.empty() ? "linked" : "nothing is configured: neither Signal K nor NMEA");
  if (withheld_ > 0)
    status.summary(DiagnosticStatus::OK, "a replay (use_sim_time) is not sent; see send_replays");
  add(status, "statuses heard", heard_.load());
  add(status, "statuses of a replay, not sent", withheld_.load());
  add(status, "hull openings published", published_.load());
  add(status, "outlines without a transform", without_transform_.load());
  add(status, "Signal K angles not believed (age, type)", unbelieved_.load());
}

}  // namespace geocontainer_mpm::ros_bridge
