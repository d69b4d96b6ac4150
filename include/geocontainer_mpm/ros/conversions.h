#pragma once
/// From frames to messages: pure functions, no node, no master. Geometry is given in the barge frame and comes out in
/// `View::frame_id`.

#include <geocontainer_mpm/GeotextileForces.h>
#include <geocontainer_mpm/ReleaseStatus.h>
#include <geometry_msgs/PolygonStamped.h>
#include <ros/time.h>
#include <sensor_msgs/JointState.h>
#include <sensor_msgs/PointCloud2.h>
#include <visualization_msgs/MarkerArray.h>

#include <Eigen/Geometry>
#include <string>

#include "geocontainer_mpm/ros/opening_conversion.h"
#include "geocontainer_mpm/ros/progress.h"
#include "geocontainer_mpm/ros/release_alarms.h"
#include "geocontainer_mpm/scene/frame.h"

namespace geocontainer_mpm::ros_bridge {

/// How a frame is put into the world.
struct View {
  std::string frame_id = "base_link";
  ros::Time stamp;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();  ///< of the barge in frame_id
  /// A plane-strain section is drawn from x = -width_m to 0, so that its face is what the viewer sees.
  double width_m = 3.0;
};

/// Stamp of a frame; `before_first_sample` is for a run whose epoch is not known yet.
ros::Time to_time(std::int64_t stamp_ns, const ros::Time& before_first_sample);

/// Names the first quantity that is not finite, or nothing: such a frame reaches no topic.
std::string first_non_finite(const scene::Frame& frame);
std::string first_non_finite(const Progress& progress);
std::string first_non_finite(const AlarmReport& alarms);

/// The outline of a closed sheet; an open one goes there and back, since a polygon joins its ends. In 3-D the section
/// nearest midships.
geometry_msgs::PolygonStamped to_container_shape(const scene::GeotextileFrame& sheet, const View& view);
GeotextileForces to_geotextile_forces(const scene::GeotextileFrame& sheet, const View& view);

/// Fields x, y, z, speed (m/s), mean_stress (Pa, compression negative); every `stride`-th particle of each body.
sensor_msgs::PointCloud2 to_soil_cloud(const scene::Frame& frame, const View& view, int stride);

std::uint8_t to_message(scene::Outcome outcome);  ///< as in ReleaseStatus
ReleaseStatus to_release_status(const Progress& progress, const AlarmReport& alarms, const View& view);

/// The filtered opening in use, for robot_state_publisher: joints `hull_port_joint` and `hull_starboard_joint`.
sensor_msgs::JointState to_hull_joint_states(const barge::OpeningAngles& opening, const ros::Time& stamp);

/// Each geotextile coloured by utilisation, a ribbon in plane strain, its triangles in 3-D; outlines of hull and
/// surfaces, in 3-D their faces as well; legend. Ids and vertex counts depend on the scene alone, so that rviz updates
/// in place.
visualization_msgs::MarkerArray to_markers(const scene::Frame& frame, const Progress& progress, const View& view);

/// One sentence for the superintendent.
std::string status_sentence(const Progress& progress);

/// Colour of a utilisation: green at 0 over yellow at 0.5 to red at 1, magenta beyond; red, green, blue in [0, 1].
Eigen::Vector3f utilisation_colour(double utilisation);

}  // namespace geocontainer_mpm::ros_bridge
