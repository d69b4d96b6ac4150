#pragma once
/// Topics out. Called on the solver thread; a message is built only when somebody subscribes to it.

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>

#include <cstdint>
#include <mutex>
#include <string>

#include "geocontainer_mpm/ros/conversions.h"
#include "geocontainer_mpm/ros/parameters.h"

namespace geocontainer_mpm::ros_bridge {

/// What went wrong on the way out, for the diagnostics.
struct OutputHealth {
  std::uint64_t frames = 0;             ///< published
  std::uint64_t without_transform = 0;  ///< published in the barge frame, for want of its pose
  std::uint64_t dropped = 0;            ///< not published: something in them was not finite
  std::string transform_error;          ///< of the last frame; empty: none
  std::string last_dropped;             ///< what was not finite
};

class Outputs {
public:
  Outputs(ros::NodeHandle& node, const NodeParameters& parameters);

  bool wanted() const;
  void publish(const scene::Frame& frame, const Progress& progress, const AlarmReport& alarms);
  void publish(const Progress& progress, const AlarmReport& alarms);  ///< status only
  OutputHealth health() const;

private:
  View view_of(const Progress& progress);
  bool refuse(const std::string& not_finite);
  void publish_status(const Progress& progress, const AlarmReport& alarms, const View& view);
  void publish_joints(const Progress& progress);

  std::string fixed_frame_, barge_frame_;
  double display_width_m_;
  int soil_stride_;
  tf2_ros::Buffer transforms_;
  tf2_ros::TransformListener listener_;
  View last_view_;
  bool has_last_view_ = false;
  ros::Publisher shape_, forces_, markers_, soil_, status_, joints_;
  mutable std::mutex mutex_;  ///< guards health_
  OutputHealth health_;
};

}  // namespace geocontainer_mpm::ros_bridge
