#include <ros/init.h>
#include <ros/node_handle.h>

#include <csignal>
#include <cstdio>
#include <exception>

#include "geocontainer_mpm/error.h"
#include "geocontainer_mpm/ros/vessel_link.h"

namespace {

constexpr int exit_bad_input = 2;

/// roscpp itself only answers SIGINT; a supervisor sends SIGTERM.
void on_terminate(int)
{
  ros::requestShutdown();
}

}  // namespace

int main(int argc, char** argv)
{
  ros::init(argc, argv, "vessel_link");
  try {
    const ros::NodeHandle node;
    std::signal(SIGTERM, on_terminate);
    const geocontainer_mpm::ros_bridge::VesselLink link(node, ros::NodeHandle("~"));
    ros::spin();
  } catch (const geocontainer_mpm::InputError& error) {
    std::fprintf(stderr, "vessel_link_node: %s\n", error.what());
    return exit_bad_input;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "vessel_link_node: %s\n", error.what());
    return 1;
  }
  return 0;
}
