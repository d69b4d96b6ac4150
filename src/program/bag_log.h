#pragma once
/// Opening angles from a recorded bag (only built with ROS).

#include <string>
#include <vector>

#include "geocontainer_mpm/barge/opening_signal.h"

namespace geocontainer_mpm::program {

struct BagSource {
  std::string path;
  std::string topic;  ///< empty: `hull_opening`, or `joint_states` of a bag without it, whatever their namespace
  std::string port_joint, starboard_joint;
};

/// Samples in the order in which the bag recorded them, stamped by their headers: what a node at the other end of
/// `rosbag play` gets. Throws an InputError for a file that is no complete bag or has no opening in it.
std::vector<barge::OpeningSample> read_bag(const BagSource& source);

}  // namespace geocontainer_mpm::program
