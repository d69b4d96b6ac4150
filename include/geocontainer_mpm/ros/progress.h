#pragma once
/// Where a run stands: what the solver thread tells topics, diagnostics and services.

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "geocontainer_mpm/scene/frame.h"
#include "geocontainer_mpm/scene/simulation.h"

namespace geocontainer_mpm::ros_bridge {

enum class RunState {
  waiting_for_clock,    ///< use_sim_time is set and no /clock was heard
  waiting_for_opening,  ///< no sample was accepted yet
  running,              ///< steps are taken
  following,            ///< up to date: waits for the next sample or for time to pass
  paused,               ///< by ~stop, or not started yet
  finished,             ///< the end of the scene is reached, or everything rests for good
  stopped               ///< the solver had to stop
};
const char* to_string(RunState state);

/// Samples that never reached the prediction, by reason: the verdicts of the opening signal and what is judged before.
enum class RejectReason {
  duplicate,
  out_of_order,
  non_finite,
  out_of_range,
  too_fast,
  unstamped,
  from_future,
  queue_full
};
inline constexpr std::size_t reject_reason_count = 8;
const char* to_string(RejectReason reason);
using RejectedCounts = std::array<std::uint64_t, reject_reason_count>;

struct Progress {
  RunState state = RunState::waiting_for_opening;
  std::uint64_t run = 1;               ///< counts restarts: loops, seeks back, ~reset
  std::int64_t stamp_ns = 0;           ///< simulated instant in the log's epoch; 0 before the first sample
  double time_s = 0.0;                 ///< simulated time since the first sample
  double end_s = 0.0;                  ///< simulated time at which the run is complete
  double dt_s = 0.0;                   ///< last time step
  double lag_s = 0.0;                  ///< newest accepted stamp minus simulated instant
  double real_time_factor = 0.0;       ///< simulated over wall-clock time while stepping; 0 before the first step
  std::uint64_t digest = 0;            ///< of the mechanical state at `digest_time_s`
  double digest_time_s = -1.0;         ///< < 0: none yet
  double seam_strength_n_per_m = 0.0;  ///< of the weakest geotextile; 0: none
  scene::StatusFrame status;
  scene::RunCounters counters;
  barge::OpeningAngles opening;
  std::uint64_t accepted = 0;  ///< samples in this run
  RejectedCounts rejected{};   ///< in this run
  std::size_t gaps = 0;        ///< silences over which the angle was held, in this run
  bool holding = false;        ///< such a silence lasts
  bool log_over = false;       ///< the last sender has gone
  scene::Failure failure;      ///< meaningful when stopped
  std::string record_path;     ///< empty: none
  std::string record_error;    ///< empty: none
  std::uint64_t recorded_frames = 0;
  std::int64_t newest_stamp_ns = 0;     ///< of the newest accepted sample, in the log's epoch; 0 before the first
  barge::OpeningAngles newest_opening;  ///< the newest that is certain, whatever the simulation's lag
  std::string checkpoint_path;          ///< empty: none
  std::string checkpoint_error;         ///< empty: none
  double checkpoint_time_s = -1.0;      ///< simulated instant of the newest one; < 0: none
  double checkpoint_cost_s = 0.0;       ///< most that one has cost the run, processor time, s
  std::string resume;                   ///< what became of the checkpoint that was found; empty: none was
  std::uint64_t known_again = 0;        ///< samples of the log that are from before the checkpoint
};

}  // namespace geocontainer_mpm::ros_bridge
