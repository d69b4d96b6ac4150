#include "geocontainer_mpm/ros/conversions.h"

#include <fmt/format.h>
#include <sensor_msgs/point_cloud2_iterator.h>

#include <algorithm>
#include <cmath>

#include "message_parts.h"
#include "outline.h"

namespace geocontainer_mpm::ros_bridge {
namespace {

geometry_msgs::Point to_placed_point(const Vec3& in_barge, const View& view)
{
  return to_point(Vec3(view.pose * in_barge));
}

bool finite(const Vec3& vector)
{
  return vector.allFinite();
}

bool finite(double value)
{
  return std::isfinite(value);
}

bool finite(const scene::SymmetricTensor& stress)
{
  return std::all_of(stress.begin(), stress.end(), [](double value) { return std::isfinite(value); });
}

template <typename Values>
bool all_finite(const Values& values)
{
  return std::all_of(values.begin(), values.end(), [](const auto& value) { return finite(value); });
}

bool finite(const scene::StatusFrame& status)
{
  return all_finite(std::array<double, 11>{ status.release_time_s, status.peak_tension_n_per_m,
                                            status.peak_tension_time_s, status.current_tension_n_per_m,
                                            status.utilisation_sheet, status.utilisation_seam, status.elongation_max,
                                            status.length_m, status.width_m, status.height_m, status.soil_volume }) &&
         finite(status.centroid_m) && finite(status.peak_tension_position_m);
}

std_msgs::Header header_of(const View& view)
{
  std_msgs::Header header;
  header.stamp = view.stamp;
  header.frame_id = view.frame_id;
  return header;
}

/// `ros::Duration` holds no more than 68 years and throws beyond.
ros::Duration to_duration(double seconds)
{
  return ros::Duration(std::clamp(seconds, -2e9, 2e9));
}

ReleaseAlarm to_message(const alarm::Alarm& alarm)
{
  static_assert(ReleaseAlarm::WARN == static_cast<int>(alarm::Level::warn) &&
                ReleaseAlarm::ALARM == static_cast<int>(alarm::Level::alarm));
  ReleaseAlarm message;
  message.name = alarm.name;
  message.level = static_cast<std::uint8_t>(alarm.level);
  message.latched = static_cast<std::uint8_t>(alarm.latched);
  message.acknowledged = alarm.acknowledged;
  message.since = to_time(alarm.since_ns, ros::Time());
  message.value = alarm.value;
  message.unit = alarm.unit;
  message.lead_time = alarm.lead_time_s;
  message.message = alarm.message;
  return message;
}

std::string outcome_sentence(const Progress& progress)
{
  const scene::StatusFrame& status = progress.status;
  switch (status.outcome) {
    case scene::Outcome::waiting:
      return "The container rests in the hull";
    case scene::Outcome::releasing:
      return fmt::format("The container is leaving the hull (open {:.1f} / {:.1f} deg)",
                         progress.opening.port_rad * degrees_per_radian,
                         progress.opening.starboard_rad * degrees_per_radian);
    case scene::Outcome::released:
      return fmt::format("The container left the hull after {:.1f} s", status.release_time_s) +
             (status.resting ? " and rests" : "");
    case scene::Outcome::hung_up:
      return "The container hangs in the slot";
    case scene::Outcome::none:
      break;
  }
  return "Nothing to release in this scene";
}

}  // namespace

std::uint8_t to_message(scene::Outcome outcome)
{
  switch (outcome) {
    case scene::Outcome::waiting:
      return ReleaseStatus::WAITING;
    case scene::Outcome::releasing:
      return ReleaseStatus::RELEASING;
    case scene::Outcome::released:
      return ReleaseStatus::RELEASED;
    case scene::Outcome::hung_up:
      return ReleaseStatus::HUNG_UP;
    case scene::Outcome::none:
      break;
  }
  return ReleaseStatus::NONE;
}

ros::Time to_time(std::int64_t stamp_ns, const ros::Time& before_first_sample)
{
  if (stamp_ns <= 0)
    return before_first_sample;
  ros::Time time;
  return time.fromNSec(static_cast<std::uint64_t>(stamp_ns));
}

std::string first_non_finite(const scene::Frame& frame)
{
  for (const scene::SoilFrame& soil : frame.soil) {
    if (!all_finite(soil.position))
      return soil.name + " position";
    if (!all_finite(soil.velocity))
      return soil.name + " velocity";
    if (!all_finite(soil.stress))
      return soil.name + " stress";
  }
  for (const scene::GeotextileFrame& sheet : frame.geotextile) {
    if (!all_finite(sheet.node))
      return sheet.name + " node";
    if (!all_finite(sheet.gauge_tension))
      return sheet.name + " tension";
  }
  for (const scene::BoundaryFrame& boundary : frame.boundary)
    if (!all_finite(boundary.position))
      return boundary.name + " position";
  return "";
}

std::string first_non_finite(const Progress& progress)
{
  if (!finite(progress.opening.port_rad) || !finite(progress.opening.starboard_rad))
    return "opening";
  return finite(progress.status) ? "" : "status";
}

std::string first_non_finite(const AlarmReport& alarms)
{
  for (const alarm::Alarm& alarm : alarms.alarms)
    if (!finite(alarm.value) || !finite(alarm.lead_time_s))
      return "alarm " + alarm.name;
  return "";
}

geometry_msgs::PolygonStamped to_container_shape(const scene::GeotextileFrame& sheet, const View& view)
{
  geometry_msgs::PolygonStamped shape;
  shape.header = header_of(view);
  shape.polygon.points.reserve(sheet.node.size());
  for (const Vec3& node : container_outline(sheet)) {
    const Eigen::Vector3f position = (view.pose * node).cast<float>();
    geometry_msgs::Point32 point;
    point.x = position.x();
    point.y = position.y();
    point.z = position.z();
    shape.polygon.points.push_back(point);
  }
  return shape;
}

GeotextileForces to_geotextile_forces(const scene::GeotextileFrame& sheet, const View& view)
{
  GeotextileForces forces;
  forces.header = header_of(view);
  forces.name = sheet.name;
  forces.nodes.reserve(sheet.node.size());
  for (const Vec3& node : sheet.node)
    forces.nodes.push_back(to_placed_point(node, view));
  for (const scene::Triangle& triangle : sheet.triangles)
    forces.triangles.insert(forces.triangles.end(), triangle.begin(), triangle.end());
  forces.tension = sheet.gauge_tension;
  forces.utilisation.reserve(sheet.gauge_tension.size());
  for (const double tension : sheet.gauge_tension)
    forces.utilisation.push_back(tension / sheet.seam_strength_n_per_m);
  forces.gauge_length = sheet.gauge_length_m;
  forces.strength = sheet.strength_n_per_m;
  forces.seam_strength = sheet.seam_strength_n_per_m;
  return forces;
}

sensor_msgs::PointCloud2 to_soil_cloud(const scene::Frame& frame, const View& view, int stride)
{
  const auto step = static_cast<std::size_t>(stride);
  std::size_t count = 0;
  for (const scene::SoilFrame& soil : frame.soil)
    count += (soil.position.size() + step - 1) / step;

  sensor_msgs::PointCloud2 cloud;
  cloud.header = header_of(view);
  cloud.is_dense = true;
  using sensor_msgs::PointField;
  sensor_msgs::PointCloud2Modifier modifier(cloud);
  modifier.setPointCloud2Fields(5, "x", 1, PointField::FLOAT32, "y", 1, PointField::FLOAT32, "z", 1,
                                PointField::FLOAT32, "speed", 1, PointField::FLOAT32, "mean_stress", 1,
                                PointField::FLOAT32);
  modifier.resize(count);
  sensor_msgs::PointCloud2Iterator<float> field(cloud, "x");
  for (const scene::SoilFrame& soil : frame.soil)
    for (std::size_t p = 0; p < soil.position.size(); p += step, ++field) {
      const Eigen::Vector3f position = (view.pose * soil.position[p]).cast<float>();
      const scene::SymmetricTensor& stress = soil.stress[p];
      field[0] = position.x();
      field[1] = position.y();
      field[2] = position.z();
      field[3] = static_cast<float>(soil.velocity[p].norm());
      field[4] = static_cast<float>((stress[0] + stress[1] + stress[2]) / 3.0);
    }
  return cloud;
}

std::string status_sentence(const Progress& progress)
{
  if (progress.state == RunState::stopped)
    return fmt::format("The prediction stopped at {:.2f} s at {}: {}", progress.failure.time_s,
                       scene::place(progress.failure.position_m, progress.status.dimensions), progress.failure.reason);
  if (progress.state == RunState::waiting_for_clock)
    return "Waiting for /clock (use_sim_time is set)";
  if (progress.state == RunState::waiting_for_opening)
    return "Waiting for the first believable opening angle";
  std::string sentence = outcome_sentence(progress);
  if (progress.seam_strength_n_per_m > 0.0) {
    const double utilisation = progress.status.peak_tension_n_per_m / progress.seam_strength_n_per_m;
    sentence += fmt::format("; peak tension {:.1f} kN/m, {:.0f} % of the seam's strength",
                            progress.status.peak_tension_n_per_m / 1e3, utilisation * 100.0);
    if (utilisation >= 1.0)
      sentence += ": the seam fails";
  }
  if (progress.state == RunState::paused)
    sentence += " (paused)";
  return sentence + ".";
}

ReleaseStatus to_release_status(const Progress& progress, const AlarmReport& alarms, const View& view)
{
  const scene::StatusFrame& status = progress.status;
  ReleaseStatus message;
  message.header = header_of(view);
  message.outcome = to_message(status.outcome);
  message.resting = status.resting;
  message.stopped = progress.state == RunState::stopped;
  message.message = status_sentence(progress);
  message.port = progress.opening.port_rad;
  message.starboard = progress.opening.starboard_rad;
  message.release_time = to_duration(status.release_time_s);
  message.current_tension = status.current_tension_n_per_m;
  message.peak_tension = status.peak_tension_n_per_m;
  message.peak_tension_time = to_duration(status.peak_tension_time_s);
  message.peak_tension_position = to_placed_point(status.peak_tension_position_m, view);
  message.peak_utilisation =
      progress.seam_strength_n_per_m > 0.0 ? status.peak_tension_n_per_m / progress.seam_strength_n_per_m : 0.0;
  message.centroid = to_placed_point(status.centroid_m, view);
  message.width = status.width_m;
  message.height = status.height_m;
  message.real_time_factor = progress.real_time_factor;
  message.lag = progress.lag_s;
  message.replay = alarms.replay;
  message.alarms.reserve(alarms.alarms.size());
  for (const alarm::Alarm& alarm : alarms.alarms)
    message.alarms.push_back(to_message(alarm));
  return message;
}

sensor_msgs::JointState to_hull_joint_states(const barge::OpeningAngles& opening, const ros::Time& stamp)
{
  const OpeningJoints joints;  // the names of the URDF, whatever the input calls them
  sensor_msgs::JointState state;
  state.header.stamp = stamp;
  state.name = { joints.port, joints.starboard };
  state.position = { opening.port_rad, opening.starboard_rad };
  return state;
}

const char* to_string(RunState state)
{
  switch (state) {
    case RunState::waiting_for_clock:
      return "waiting for clock";
    case RunState::waiting_for_opening:
      return "waiting for opening";
    case RunState::running:
      return "running";
    case RunState::following:
      return "following";
    case RunState::paused:
      return "paused";
    case RunState::finished:
      return "finished";
    case RunState::stopped:
      break;
  }
  return "stopped";
}

const char* to_string(RejectReason reason)
{
  switch (reason) {
    case RejectReason::duplicate:
      return "duplicate";
    case RejectReason::out_of_order:
      return "out of order";
    case RejectReason::non_finite:
      return "non finite";
    case RejectReason::out_of_range:
      return "out of range";
    case RejectReason::too_fast:
      return "too fast";
    case RejectReason::unstamped:
      return "unstamped";
    case RejectReason::from_future:
      return "from the future";
    case RejectReason::queue_full:
      break;
  }
  return "queue full";
}

}  // namespace geocontainer_mpm::ros_bridge
