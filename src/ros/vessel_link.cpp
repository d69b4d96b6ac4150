#include "geocontainer_mpm/ros/vessel_link.h"

#include <fmt/format.h>
#include <geocontainer_mpm/HullOpening.h>
#include <geometry_msgs/TransformStamped.h>
#include <ros/console.h>
#include <tf2/exceptions.h>

#include <Eigen/Geometry>
#include <boost/function.hpp>
#include <string>
#include <utility>

namespace geocontainer_mpm::ros_bridge {
namespace {

using diagnostic_msgs::DiagnosticStatus;
using diagnostic_updater::DiagnosticStatusWrapper;
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
