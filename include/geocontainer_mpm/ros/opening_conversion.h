#pragma once
/// From opening messages to opening samples. The node and `simulate --bag` both use this and nothing else, so that a
/// replay and an offline run see the same bits: the stamp is the header's, in integer nanoseconds.
/// The namespace is not called `ros`, which would hide ::ros from everything inside geocontainer_mpm.

#include <geocontainer_mpm/HullOpening.h>
#include <sensor_msgs/JointState.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "geocontainer_mpm/barge/opening_signal.h"

namespace geocontainer_mpm::ros_bridge {

/// Joints that carry the opening in a JointState; position is rad from closed, opening positive.
struct OpeningJoints {
  std::string port = "hull_port_joint";
  std::string starboard = "hull_starboard_joint";
};

inline barge::OpeningSample to_sample(const HullOpening& message)
{
  return { static_cast<std::int64_t>(message.header.stamp.toNSec()), { message.port, message.starboard } };
}

/// Nothing for a message that names neither joint (it speaks of other joints). Where only one is named, or a name has
/// no position, the missing angle is NaN, so that the opening signal rejects and counts the sample.
inline std::optional<barge::OpeningSample> to_sample(const sensor_msgs::JointState& message,
                                                     const OpeningJoints& joints)
{
  const auto port = std::find(message.name.begin(), message.name.end(), joints.port);
  const auto starboard = std::find(message.name.begin(), message.name.end(), joints.starboard);
  if (port == message.name.end() && starboard == message.name.end())
    return std::nullopt;
  const auto angle = [&](std::vector<std::string>::const_iterator name) {
    const auto index = static_cast<std::size_t>(name - message.name.begin());
    return index < message.position.size() ? message.position[index] : std::numeric_limits<double>::quiet_NaN();
  };
  return barge::OpeningSample{ static_cast<std::int64_t>(message.header.stamp.toNSec()),
                               { angle(port), angle(starboard) } };
}

}  // namespace geocontainer_mpm::ros_bridge
