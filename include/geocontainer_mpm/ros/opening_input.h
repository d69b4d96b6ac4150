#pragma once
/// From the topics `hull_opening` and `joint_states` into a deep, ordered queue. Nothing is stepped in a callback.

#include <geocontainer_mpm/HullOpening.h>
#include <ros/node_handle.h>
#include <ros/subscriber.h>
#include <sensor_msgs/JointState.h>

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>

#include "geocontainer_mpm/ros/opening_conversion.h"
#include "geocontainer_mpm/ros/opening_gate.h"

namespace geocontainer_mpm::ros_bridge {

/// This machine's steady clock, ns.
std::int64_t steady_now_ns();

/// Samples in order of arrival, from the callbacks to the solver.
class OpeningQueue {
public:
  explicit OpeningQueue(std::size_t capacity) : capacity_(capacity) {}

  void push(const ArrivedSample& sample);  ///< drops and counts the sample when the queue is full
  std::optional<ArrivedSample> front() const;
  void pop();
  void clear();
  bool empty() const;
  std::uint64_t dropped() const;

  /// Called after every push, on the pushing thread.
  void on_push(std::function<void()> callback);

private:
  mutable std::mutex mutex_;
  std::size_t capacity_;
  std::deque<ArrivedSample> samples_;
  std::uint64_t dropped_ = 0;
  std::function<void()> on_push_;
};

class OpeningInput {
public:
  OpeningInput(ros::NodeHandle& node, const OpeningJoints& joints, OpeningQueue& queue);

  /// Number of publishers connected to either topic.
  unsigned senders() const;

private:
  void receive(const HullOpening& message);
  void receive(const sensor_msgs::JointState& message);

  OpeningJoints joints_;
  OpeningQueue& queue_;
  ros::Subscriber hull_opening_;
  ros::Subscriber joint_states_;
};

}  // namespace geocontainer_mpm::ros_bridge
