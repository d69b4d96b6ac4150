#pragma once
/// Owns the simulation and the one thread that touches it. Knows no ROS: clock, senders and outputs are hooks, so that
/// it is tested without a master.

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <future>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "geocontainer_mpm/forecast/forecaster.h"
#include "geocontainer_mpm/ros/opening_gate.h"
#include "geocontainer_mpm/ros/opening_input.h"
#include "geocontainer_mpm/ros/progress.h"
#include "geocontainer_mpm/ros/run_checkpoint.h"
#include "geocontainer_mpm/ros/run_record.h"
#include "geocontainer_mpm/scene/simulation.h"

namespace geocontainer_mpm::ros_bridge {

struct SolverSettings {
  GateParameters gate;
  bool autostart = true;
  bool finish_when_source_leaves = false;
  double publish_rate_hz = 10.0;
  int threads = 1;                   ///< for the summary only
  std::string save_directory = ".";  ///< of ~save
  std::string checkpoint;            ///< file of the state to go on from; empty: none
  double checkpoint_period_s = 10.0;
  bool resumed = false;            ///< the simulation is one that goes on (begin_or_resume())
  std::string resume;              ///< what became of the checkpoint that was found, for the progress
  double resume_within_s = 600.0;  ///< a log that goes on later than this after the checkpoint's is another one
  std::uint64_t first_run = 1;     ///< number of the run
};

/// Called on the solver thread, `now_ns` and `senders` at every turn of its loop.
struct SolverHooks {
  std::function<std::int64_t()> now_ns;  ///< clock of the samples, ns; 0: not heard yet
  std::function<unsigned()> senders;     ///< senders of the opening that are connected
  std::function<bool()> frame_wanted;    ///< does anybody read frames
  std::function<void(const scene::Frame&, const Progress&)> frame;
  std::function<void(const Progress&)> progress;     ///< where a frame is not wanted
  std::function<void(const std::string&)> notice;    ///< one sentence for the log; may be empty
  std::function<void(std::uint64_t run)> restarted;  ///< may be empty
  forecast::Forecaster* forecaster = nullptr;        ///< is told what it needs; none: no forecasts
};

struct Reply {
  bool success = false;
  std::string message;
};

class SolverThread {
public:
  SolverThread(scene::Simulation simulation, OpeningQueue& queue, RunRecord record, SolverSettings settings,
               SolverHooks hooks);
  ~SolverThread();  ///< ends the thread between two steps and closes the record
  SolverThread(const SolverThread&) = delete;
  SolverThread& operator=(const SolverThread&) = delete;

  /// Carried out between two steps; the future is ready then, or broken when the thread ends before.
  std::future<Reply> reset();
  std::future<Reply> start();
  std::future<Reply> stop();
  std::future<Reply> save();
  std::future<Reply> announce();  ///< nothing but that the progress is handed out again

  Progress progress() const;

private:
  using Request = std::packaged_task<Reply()>;

  std::future<Reply> post(std::function<Reply()> action);
  void wake();
  void wait(std::int64_t longest_ns);
  void serve_requests();

  void run();
  void turn();
  void follow_clock(std::int64_t now_ns);
  void drain_queue(std::int64_t now_ns);
  void give_state_ahead();
  void notice_silence(std::int64_t now_ns);
  void notice_end_of_log();
  void take(const barge::OpeningSample& sample);
  void advance();
  int steps_per_call() const;
  void give_up_resumed();
  void restart();

  void deliver(bool frame_is_due);
  void refresh_progress(const scene::Frame* frame);
  void set_state(RunState state);
  double stepped_s() const;
  Reply save_now();

  scene::Simulation simulation_;
  OpeningQueue& queue_;
  RunRecord record_;
  SolverSettings settings_;
  SolverHooks hooks_;
  OpeningGate gate_;
  RunCheckpoint checkpoint_;
  std::string resume_;  ///< what became of the checkpoint that was found

  // Of the run; cleared by restart().
  RunState state_ = RunState::waiting_for_opening;
  std::uint64_t run_ = 1;
  RejectedCounts rejected_at_gate_{};
  std::uint64_t dropped_before_ = 0;
  ResumedLog resumed_log_;
  std::uint64_t known_again_ = 0;     ///< samples from before the checkpoint
  std::int64_t stepping_ns_ = 0;      ///< wall-clock time spent in advance()
  double stepped_before_s_ = 0.0;     ///< simulated time before the resume, rest not counted
  std::int64_t last_arrival_ns_ = 0;  ///< steady clock
  std::int64_t no_sender_since_ns_ = 0;
  bool had_sender_ = false;
  bool log_over_ = false;
  double digest_time_s_ = -1.0;
  std::uint64_t digest_steps_ = 0;
  scene::Failure failure_;  ///< where an exception, not the solver, ended the run

  bool paused_ = false;
  std::int64_t last_delivery_ns_ = 0;  ///< steady clock, as next_output_ns_
  std::int64_t next_output_ns_ = 0;
  double mean_step_ns_ = 1e6;
  unsigned saved_ = 0;

  mutable std::mutex mutex_;  ///< guards what follows
  std::condition_variable wake_;
  bool woken_ = false;
  std::vector<Request> requests_;
  Progress progress_;

  std::atomic<bool> quit_{ false };
  std::thread thread_;  // last: starts when everything else stands
};

}  // namespace geocontainer_mpm::ros_bridge
