#include "geocontainer_mpm/ros/opening_input.h"

#include <boost/function.hpp>
#include <chrono>

namespace geocontainer_mpm::ros_bridge {
namespace {

/// roscpp's own queue only has to bridge the time between two spins.
constexpr std::uint32_t subscriber_queue = 10'000;

}  // namespace

std::int64_t steady_now_ns()
{
  const auto since_start = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::nanoseconds>(since_start).count();
}

void OpeningQueue::push(const ArrivedSample& sample)
{
  std::function<void()> notify;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (samples_.size() >= capacity_)
      ++dropped_;
    else
      samples_.push_back(sample);
    notify = on_push_;
  }
  if (notify)
    notify();
}

std::optional<ArrivedSample> OpeningQueue::front() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return samples_.empty() ? std::nullopt : std::optional<ArrivedSample>(samples_.front());
}

void OpeningQueue::pop()
{
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!samples_.empty())
    samples_.pop_front();
}

void OpeningQueue::clear()
{
  const std::lock_guard<std::mutex> lock(mutex_);
  samples_.clear();
}

bool OpeningQueue::empty() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return samples_.empty();
}

std::uint64_t OpeningQueue::dropped() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return dropped_;
}

void OpeningQueue::on_push(std::function<void()> callback)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  on_push_ = std::move(callback);
}

OpeningInput::OpeningInput(ros::NodeHandle& node, const OpeningJoints& joints, OpeningQueue& queue)
    : joints_(joints), queue_(queue)
{
  const boost::function<void(const HullOpening&)> on_opening = [this](const HullOpening& message) { receive(message); };
  const boost::function<void(const sensor_msgs::JointState&)> on_joints =
      [this](const sensor_msgs::JointState& message) { receive(message); };
  const ros::TransportHints hints = ros::TransportHints().tcpNoDelay();
  hull_opening_ = node.subscribe<HullOpening, const HullOpening&>("hull_opening", subscriber_queue, on_opening,
                                                                  ros::VoidConstPtr(), hints);
  joint_states_ = node.subscribe<sensor_msgs::JointState, const sensor_msgs::JointState&>(
      "joint_states", subscriber_queue, on_joints, ros::VoidConstPtr(), hints);
}

unsigned OpeningInput::senders() const
{
  return hull_opening_.getNumPublishers() + joint_states_.getNumPublishers();
}

void OpeningInput::receive(const HullOpening& message)
{
  queue_.push({ to_sample(message), steady_now_ns() });
}

void OpeningInput::receive(const sensor_msgs::JointState& message)
{
  if (const auto sample = to_sample(message, joints_))
    queue_.push({ *sample, steady_now_ns() });
}

}  // namespace geocontainer_mpm::ros_bridge
