#pragma once
/// What several conversions need.

#include <geometry_msgs/Point.h>

#include "geocontainer_mpm/scene/frame.h"

namespace geocontainer_mpm::ros_bridge {

inline constexpr double degrees_per_radian = 57.29577951308232;

inline geometry_msgs::Point to_point(const Vec3& position)
{
  geometry_msgs::Point point;
  point.x = position.x();
  point.y = position.y();
  point.z = position.z();
  return point;
}

}  // namespace geocontainer_mpm::ros_bridge
