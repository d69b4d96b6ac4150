#include "geocontainer_mpm/ros/vessel_link.h"

#include <fmt/format.h>
#include <geocontainer_mpm/HullOpening.h>
#include <ros/console.h>

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
  add(status, "state", to_string(health.state));
  add(status, "confirmation", to_string(health.confirmation));
  add(status, "connections", health.connections);
  add(status, "failures", health.failures);
  add(status, "last error", health.last_error);
  add(status, "messages sent", health.messages_sent);
  add(status, "values sent", health.values_sent);
  add(status, "values confirmed", health.values_confirmed);
  add(status, "values replaced before they were sent", health.values_replaced);
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
    , updater_(node, private_node)
{
  if (parameters_.hull_angles != AngleSource::none)
    opening_ = node.advertise<HullOpening>("hull_opening", 100);
  updater_.setHardwareID("none");
  updater_.add("vessel link", this, &VesselLink::describe);
  if (parameters_.signalk.enabled)
    open_signalk();
  for (const VesselNmeaPort& port : parameters_.nmea)
    open_port(port);
  // The newest status is enough: what is sent is a state.
  const boost::function<void(const ReleaseStatus&)> take = [this](const ReleaseStatus& message) { on_status(message); };
  status_ = node.subscribe<ReleaseStatus, const ReleaseStatus&>("release_status", 1, take);
  timer_ = node.createWallTimer(ros::WallDuration(parameters_.diagnostic_period),
                                [this](const ros::WallTimerEvent&) { updater_.force_update(); });
}

void VesselLink::open_signalk()
{
  VesselSignalK& signalk = parameters_.signalk;
  if (replay_)
    signalk.server.source += ".replay";
  auto announced = vessel::describe_figures(signalk.path_prefix, replay_ ? 0.0 : signalk.utilisation_warn,
                                            replay_ ? 0.0 : signalk.utilisation_alarm);
  if (!replay_)
    announced.push_back({ "notifications." + signalk.path_prefix + release_notice_path, "", "", {} });
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
  if (replay_ && !parameters_.send_replays) {
    ++withheld_;
    return;
  }
  const vessel::ReleaseFigures figures = to_figures(message);
  if (signalk_) {
    auto values = vessel::to_values(figures, parameters_.signalk.path_prefix);
    if (!replay_)
      values.push_back({ "notifications." + parameters_.signalk.path_prefix + release_notice_path,
                         vessel::release_notice(figures), figures.stamp });
    signalk_->send(values);
  }
  const std::string release = vessel::write_release(figures);
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
  add(status, "Signal K angles not believed (age, type)", unbelieved_.load());
}

}  // namespace geocontainer_mpm::ros_bridge
