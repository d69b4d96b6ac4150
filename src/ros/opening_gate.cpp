#include "geocontainer_mpm/ros/opening_gate.h"

#include <algorithm>

namespace geocontainer_mpm::ros_bridge {
namespace {

/// Clock readings closer together than this are not kept: enough resolution for a patience of tenths of a second.
constexpr std::int64_t reading_spacing_ns = 20'000'000;

}  // namespace

GateDecision OpeningGate::judge(const ArrivedSample& arrived, std::int64_t now_ns, std::int64_t steady_ns) const
{
  const std::int64_t stamp = arrived.sample.stamp_ns;
  if (stamp <= 0)
    return GateDecision::reject_unstamped;
  if (now_ns == 0)
    return GateDecision::wait;
  const bool patient = steady_ns - arrived.arrived_ns < parameters_.patience_ns;
  if (stamp > now_ns + parameters_.max_future_ns)
    return patient ? GateDecision::wait : GateDecision::reject_future;
  if (stamp < newest_taken_ns_ - parameters_.time_jump_back_ns && patient)
    return GateDecision::wait;
  return GateDecision::take;
}

void OpeningGate::taken(const barge::OpeningSample& sample)
{
  newest_taken_ns_ = std::max(newest_taken_ns_, sample.stamp_ns);
}

bool OpeningGate::jumped_back(std::int64_t now_ns)
{
  if (now_ns < newest_now_ns_ - parameters_.time_jump_back_ns)
    return true;
  newest_now_ns_ = std::max(newest_now_ns_, now_ns);
  return false;
}

std::optional<std::int64_t> OpeningGate::settled_clock(std::int64_t now_ns, std::int64_t steady_ns)
{
  if (now_ns != 0 && (readings_.empty() || steady_ns - readings_.back().steady_ns >= reading_spacing_ns))
    readings_.push_back({ now_ns, steady_ns });
  while (!readings_.empty() && readings_.front().steady_ns <= steady_ns - parameters_.patience_ns) {
    settled_ns_ = readings_.front().now_ns;
    readings_.pop_front();
  }
  return settled_ns_;
}

void OpeningGate::reset()
{
  *this = OpeningGate(parameters_);
}

}  // namespace geocontainer_mpm::ros_bridge
