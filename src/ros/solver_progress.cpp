/// What the solver thread hands out: progress, frames and files. How it steps is in solver_thread.cpp.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "geocontainer_mpm/ros/solver_thread.h"

namespace geocontainer_mpm::ros_bridge {
namespace {

double seconds(std::int64_t ns)
{
  return static_cast<double>(ns) / 1e9;
}

std::uint64_t& count_of(RejectedCounts& counts, RejectReason reason)
{
  return counts[static_cast<std::size_t>(reason)];
}

/// 0 where there is no geotextile.
double weakest_seam(const scene::SceneDescription& scene)
{
  double weakest = 0.0;
  for (const auto& [name, sheet] : scene.geotextiles) {
    double efficiency = sheet.seams.empty() ? sheet.seam_efficiency : 1.0;
    for (const auto& [seam_name, named] : sheet.seams)
      efficiency = std::min(efficiency, named.efficiency.value_or(sheet.seam_efficiency));
    const double seam = sheet.strength_n_per_m * efficiency;
    weakest = weakest > 0.0 ? std::min(weakest, seam) : seam;
  }
  return weakest;
}

/// The newest angles that are certain.
barge::OpeningAngles newest_known(const barge::OpeningSignal& opening)
{
  return opening.angles(
      std::min(opening.known_until_s(), seconds(opening.last_accepted().stamp_ns - opening.origin_ns())));
}

}  // namespace

void SolverThread::deliver(bool frame_is_due)
{
  const std::int64_t steady_ns = steady_now_ns();
  const bool keep = frame_is_due && !record_.path().empty();
  // Everything that is not the routine of a running prediction goes out at once.
  const bool throttled = frame_is_due && state_ == RunState::running && steady_ns < next_output_ns_;
  const bool show = !throttled && hooks_.frame_wanted();
  if (keep || show) {
    const scene::Frame frame = simulation_.frame();
    if (keep)
      record_.write(frame);
    refresh_progress(&frame);
    if (show)
      hooks_.frame(frame, progress());
  } else {
    refresh_progress(nullptr);
  }
  if (throttled)
    return;
  if (!show)
    hooks_.progress(progress());
  last_delivery_ns_ = steady_ns;
  // Instants on a grid rather than a least distance: frames come in bursts, with the samples.
  const auto period_ns = static_cast<std::int64_t>(1e9 / settings_.publish_rate_hz);
  next_output_ns_ = std::max(next_output_ns_ + period_ns, steady_ns - period_ns);
}

void SolverThread::set_state(RunState state)
{
  if (state == state_)
    return;
  state_ = state;
  // Between samples the state changes 20 times a second: the heartbeat is soon enough for that.
  if (state != RunState::running && state != RunState::following)
    refresh_progress(nullptr);
}

double SolverThread::stepped_s() const
{
  const scene::RunCounters counters = simulation_.counters();
  return counters.simulated_time_s - counters.skipped.resting_time_s;
}

void SolverThread::refresh_progress(const scene::Frame* frame)
{
  Progress next = progress();
  const barge::OpeningSignal& opening = simulation_.opening();
  next.state = state_;
  next.run = run_;
  next.time_s = simulation_.time_s();
  next.end_s = simulation_.scene().time.end_s;
  next.status = simulation_.status();
  next.counters = simulation_.counters();
  next.opening = next.newest_opening = {};
  next.stamp_ns = next.newest_stamp_ns = 0;
  next.lag_s = 0.0;
  if (!opening.empty()) {
    next.stamp_ns = opening.origin_ns() + std::llround(next.time_s * 1e9);
    if (state_ != RunState::finished)  // nothing more is to be caught up with
      next.lag_s = std::max(0.0, seconds(opening.last_accepted().stamp_ns - next.stamp_ns));
    next.opening = opening.angles(next.time_s);
    next.newest_opening = newest_known(opening);
    next.newest_stamp_ns = opening.last_accepted().stamp_ns;
  }
  next.seam_strength_n_per_m = weakest_seam(simulation_.scene());
  if (frame != nullptr)
    next.dt_s = frame->dt_s;
  next.real_time_factor = stepping_ns_ > 0 ? (stepped_s() - stepped_before_s_) / seconds(stepping_ns_) : 0.0;

  using barge::SampleVerdict;
  next.accepted = opening.count(SampleVerdict::accepted);
  next.rejected = rejected_at_gate_;
  count_of(next.rejected, RejectReason::duplicate) = opening.count(SampleVerdict::duplicate);
  count_of(next.rejected, RejectReason::out_of_order) = opening.count(SampleVerdict::out_of_order);
  count_of(next.rejected, RejectReason::non_finite) = opening.count(SampleVerdict::non_finite);
  count_of(next.rejected, RejectReason::out_of_range) = opening.count(SampleVerdict::out_of_range);
  count_of(next.rejected, RejectReason::too_fast) = opening.count(SampleVerdict::too_fast);
  count_of(next.rejected, RejectReason::queue_full) = queue_.dropped() - dropped_before_;
  next.gaps = opening.gaps().size();
  next.holding = !opening.gaps().empty() && std::isinf(opening.gaps().back().to_s);
  next.log_over = log_over_;
  next.failure = failure_;
  next.record_path = record_.path();
  next.record_error = record_.error();
  next.recorded_frames = record_.frames();
  next.checkpoint_path = checkpoint_.path();
  next.checkpoint_error = checkpoint_.error();
  next.checkpoint_time_s = checkpoint_.time_s();
  next.checkpoint_cost_s = checkpoint_.cost_s();
  next.resume = resume_;
  next.known_again = known_again_;

  // While steps are taken the digest would be stale before anybody reads it.
  if (state_ != RunState::running &&
      (digest_time_s_ < 0.0 || digest_time_s_ != next.time_s || digest_steps_ != next.counters.steps)) {
    digest_time_s_ = next.time_s;
    digest_steps_ = next.counters.steps;
    next.digest = simulation_.digest();
  }
  next.digest_time_s = digest_time_s_;
  const std::lock_guard<std::mutex> lock(mutex_);
  progress_ = std::move(next);
}

Reply SolverThread::save_now()
{
  std::string stem;
  do
    stem = (std::filesystem::path(settings_.save_directory) / fmt::format("{}_{}", record_.scene_name(), ++saved_))
               .string();
  while (std::filesystem::exists(stem + ".h5") || std::filesystem::exists(stem + ".json"));
  const std::string error = save_state(simulation_, record_, stem, seconds(stepping_ns_), settings_.threads);
  if (!error.empty())
    return { false, error };
  std::string further = record_.frames() > 0 ? ", frames so far in " + record_.path() : "";
  if (state_ != RunState::stopped && !simulation_.opening().empty() && !checkpoint_.path().empty()) {
    checkpoint_.wait();
    checkpoint_.save(simulation_);
    checkpoint_.wait();
    if (!checkpoint_.error().empty())
      return { false, "the checkpoint: " + checkpoint_.error() };
    further += ", checkpoint in " + checkpoint_.path();
  }
  return { true,
           fmt::format("state at {:.3f} s in {}.h5, summary in {}.json{}", simulation_.time_s(), stem, stem, further) };
}

}  // namespace geocontainer_mpm::ros_bridge
