#include "geocontainer_mpm/ros/outputs.h"

#include <tf2/exceptions.h>

namespace geocontainer_mpm::ros_bridge {
namespace {

constexpr std::uint32_t publisher_queue = 10;

Eigen::Isometry3d to_pose(const geometry_msgs::Transform& transform)
{
  const geometry_msgs::Quaternion& rotation = transform.rotation;
  const geometry_msgs::Vector3& translation = transform.translation;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = Eigen::Quaterniond(rotation.w, rotation.x, rotation.y, rotation.z).normalized().toRotationMatrix();
  pose.translation() = Eigen::Vector3d(translation.x, translation.y, translation.z);
  return pose;
}

bool subscribed(const ros::Publisher& publisher)
{
  return publisher.getNumSubscribers() > 0;
}

}  // namespace

Outputs::Outputs(ros::NodeHandle& node, const NodeParameters& parameters)
    : fixed_frame_(parameters.fixed_frame)
    , barge_frame_(parameters.barge_frame)
    , display_width_m_(parameters.display_width_m)
    , soil_stride_(parameters.soil_stride)
    , listener_(transforms_, node, false)  // no thread of its own: the node spins anyway
    , shape_(node.advertise<geometry_msgs::PolygonStamped>("container_shape", publisher_queue))
    , forces_(node.advertise<GeotextileForces>("geotextile_forces", publisher_queue))
    , markers_(node.advertise<visualization_msgs::MarkerArray>("geotextile_markers", publisher_queue))
    , soil_(node.advertise<sensor_msgs::PointCloud2>("soil_particles", publisher_queue))
    , status_(node.advertise<ReleaseStatus>("release_status", publisher_queue))
    , joints_(node.advertise<sensor_msgs::JointState>("hull_joint_states", publisher_queue))
{
  transforms_.setUsingDedicatedThread(true);
}

bool Outputs::wanted() const
{
  return subscribed(shape_) || subscribed(forces_) || subscribed(markers_) || subscribed(soil_);
}

View Outputs::view_of(const Progress& progress)
{
  View view;
  view.frame_id = barge_frame_;
  view.stamp = to_time(progress.stamp_ns, ros::Time::now());
  view.width_m = display_width_m_;
  if (fixed_frame_ == barge_frame_)
    return view;
  // A container at rest keeps its stamp while the transforms of that instant are forgotten.
  if (has_last_view_ && last_view_.stamp == view.stamp)
    return last_view_;
  const ros::Time instant = progress.stamp_ns > 0 ? view.stamp : ros::Time();  // the latest, before the log has begun
  std::string error;
  try {
    view.pose = to_pose(transforms_.lookupTransform(fixed_frame_, barge_frame_, instant).transform);
    view.frame_id = fixed_frame_;
    last_view_ = view;
    has_last_view_ = true;
  } catch (const tf2::TransformException& exception) {
    error = exception.what();
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  health_.transform_error = error;
  health_.without_transform += error.empty() ? 0 : 1;
  return view;
}

bool Outputs::refuse(const std::string& not_finite)
{
  if (not_finite.empty())
    return false;
  const std::lock_guard<std::mutex> lock(mutex_);
  ++health_.dropped;
  health_.last_dropped = not_finite;
  return true;
}

void Outputs::publish_joints(const Progress& progress)
{
  const ros::Time stamp = to_time(progress.stamp_ns, ros::Time::now());
  if (subscribed(joints_) && !stamp.isZero())
    joints_.publish(to_hull_joint_states(progress.opening, stamp));
}

void Outputs::publish_status(const Progress& progress, const AlarmReport& alarms, const View& view)
{
  if (subscribed(status_))
    status_.publish(to_release_status(progress, alarms, view));
}

void Outputs::publish(const Progress& progress, const AlarmReport& alarms)
{
  if (refuse(first_non_finite(progress)) || refuse(first_non_finite(alarms)))
    return;
  publish_joints(progress);
  if (subscribed(status_))
    publish_status(progress, alarms, view_of(progress));
}

void Outputs::publish(const scene::Frame& frame, const Progress& progress, const AlarmReport& alarms)
{
  if (refuse(first_non_finite(progress)) || refuse(first_non_finite(alarms)))
    return;
  const View view = view_of(progress);
  publish_joints(progress);
  publish_status(progress, alarms, view);
  if (refuse(first_non_finite(frame)))
    return;
  for (const scene::GeotextileFrame& sheet : frame.geotextile) {
    if (subscribed(shape_))
      shape_.publish(to_container_shape(sheet, view));
    if (subscribed(forces_))
      forces_.publish(to_geotextile_forces(sheet, view));
  }
  if (subscribed(markers_))
    markers_.publish(to_markers(frame, progress, view));
  if (subscribed(soil_))
    soil_.publish(to_soil_cloud(frame, view, soil_stride_));
  const std::lock_guard<std::mutex> lock(mutex_);
  ++health_.frames;
}

OutputHealth Outputs::health() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return health_;
}

}  // namespace geocontainer_mpm::ros_bridge
