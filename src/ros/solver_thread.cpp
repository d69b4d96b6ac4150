#include "geocontainer_mpm/ros/solver_thread.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <filesystem>
#include <utility>

namespace geocontainer_mpm::ros_bridge {
namespace {

constexpr std::int64_t idle_wait_ns = 50'000'000;     ///< between looks at the clock while there is nothing to do
constexpr std::int64_t heartbeat_ns = 1'000'000'000;  ///< outputs are repeated so often while nothing changes
constexpr double call_ns = 20e6;                      ///< wanted duration of one advance(): latency of requests
constexpr int most_steps_per_call = 256;

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

}  // namespace

SolverThread::SolverThread(scene::Simulation simulation, OpeningQueue& queue, RunRecord record, SolverSettings settings,
                           SolverHooks hooks)
    : simulation_(std::move(simulation))
    , queue_(queue)
    , record_(std::move(record))
    , settings_(std::move(settings))
    , hooks_(std::move(hooks))
    , gate_(settings_.gate)
    , paused_(!settings_.autostart)
{
  refresh_progress(nullptr);
  queue_.on_push([this] { wake(); });
  thread_ = std::thread([this] { run(); });
}

SolverThread::~SolverThread()
{
  queue_.on_push(nullptr);
  quit_ = true;
  wake();
  thread_.join();
}

std::future<Reply> SolverThread::post(std::function<Reply()> action)
{
  Request request(std::move(action));
  std::future<Reply> reply = request.get_future();
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    requests_.push_back(std::move(request));
    woken_ = true;
  }
  wake_.notify_one();
  return reply;
}

std::future<Reply> SolverThread::reset()
{
  return post([this] {
    queue_.clear();  // what is still queued belongs to what is being given up
    restart();
    return Reply{ true, fmt::format("back to the initial state, run {} begins", run_) };
  });
}

std::future<Reply> SolverThread::start()
{
  return post([this] {
    const bool was_paused = std::exchange(paused_, false);
    return Reply{ true, was_paused ? "following the opening" : "already following the opening" };
  });
}

std::future<Reply> SolverThread::stop()
{
  return post([this] {
    paused_ = true;
    return Reply{ true, fmt::format("held at {:.3f} s; samples are still taken", simulation_.time_s()) };
  });
}

std::future<Reply> SolverThread::save()
{
  return post([this] { return save_now(); });
}

Progress SolverThread::progress() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return progress_;
}

void SolverThread::wake()
{
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    woken_ = true;
  }
  wake_.notify_one();
}

void SolverThread::wait(std::int64_t longest_ns)
{
  std::unique_lock<std::mutex> lock(mutex_);
  wake_.wait_for(lock, std::chrono::nanoseconds(longest_ns), [this] { return woken_; });
  woken_ = false;
}

void SolverThread::serve_requests()
{
  std::vector<Request> requests;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    requests.swap(requests_);
  }
  for (Request& request : requests)
    request();
  if (!requests.empty())
    deliver(false);
}

void SolverThread::run()
{
  while (!quit_) {
    try {
      turn();
    } catch (const std::exception& error) {
      // The solver reports its own failures; this is what nobody foresaw, such as memory running out.
      failure_ = { std::string("unexpected: ") + error.what(), Vec3::Zero(), simulation_.time_s() };
      state_ = RunState::stopped;
      wait(idle_wait_ns);
    }
  }
}

void SolverThread::turn()
{
  serve_requests();
  const std::int64_t now_ns = hooks_.now_ns();
  follow_clock(now_ns);
  drain_queue(now_ns);
  if (state_ != RunState::finished && state_ != RunState::stopped) {
    notice_silence(now_ns);
    notice_end_of_log();
  }

  if (state_ == RunState::finished || state_ == RunState::stopped) {
    // Only a restart leads on from here.
  } else if (paused_) {
    set_state(RunState::paused);
  } else if (simulation_.opening().empty()) {
    set_state(now_ns == 0 ? RunState::waiting_for_clock : RunState::waiting_for_opening);
  } else {
    advance();
  }
  give_state_ahead();
  if (steady_now_ns() - last_delivery_ns_ >= heartbeat_ns)
    deliver(false);
  if (state_ != RunState::running)
    wait(idle_wait_ns);
}

void SolverThread::follow_clock(std::int64_t now_ns)
{
  if (gate_.jumped_back(now_ns))
    restart();
}

void SolverThread::drain_queue(std::int64_t now_ns)
{
  while (const std::optional<ArrivedSample> arrived = queue_.front()) {
    switch (gate_.judge(*arrived, now_ns, steady_now_ns())) {
      case GateDecision::wait:
        return;
      case GateDecision::reject_future:
        ++count_of(rejected_at_gate_, RejectReason::from_future);
        break;
      case GateDecision::reject_unstamped:
        ++count_of(rejected_at_gate_, RejectReason::unstamped);
        break;
      case GateDecision::take:
        if (simulation_.opening().add(arrived->sample) == barge::SampleVerdict::accepted) {
          gate_.taken(arrived->sample);
          if (hooks_.forecaster)
            hooks_.forecaster->measured(seconds(arrived->sample.stamp_ns - simulation_.opening().origin_ns()),
                                        arrived->sample.angles);
        }
        break;
    }
    last_arrival_ns_ = std::max(last_arrival_ns_, arrived->arrived_ns);
    queue_.pop();
  }
}

/// What a run ahead starts from, when one is about to.
void SolverThread::give_state_ahead()
{
  if (!hooks_.forecaster || !hooks_.forecaster->state_wanted())
    return;
  if (std::optional<scene::Snapshot> state = simulation_.snapshot())
    hooks_.forecaster->give_state(std::move(*state));
}

void SolverThread::notice_silence(std::int64_t now_ns)
{
  const std::int64_t steady_ns = steady_now_ns();
  const std::optional<std::int64_t> settled_ns = gate_.settled_clock(now_ns, steady_ns);
  if (!settled_ns || simulation_.opening().empty() || !queue_.empty())
    return;
  if (steady_ns - last_arrival_ns_ < settings_.gate.patience_ns)
    return;
  simulation_.opening().clock(seconds(*settled_ns - simulation_.opening().origin_ns()));
}

void SolverThread::notice_end_of_log()
{
  if (!settings_.finish_when_source_leaves || log_over_ || simulation_.opening().empty())
    return;
  const std::int64_t steady_ns = steady_now_ns();
  if (hooks_.senders() > 0) {
    had_sender_ = true;
    no_sender_since_ns_ = steady_ns;
    return;
  }
  const std::int64_t quiet_since_ns = std::max(no_sender_since_ns_, last_arrival_ns_);
  if (!had_sender_ || !queue_.empty() || steady_ns - quiet_since_ns < settings_.gate.patience_ns)
    return;
  log_over_ = true;
  simulation_.opening().finish();
}

int SolverThread::steps_per_call() const
{
  return std::clamp(static_cast<int>(call_ns / mean_step_ns_), 1, most_steps_per_call);
}

void SolverThread::advance()
{
  const std::uint64_t steps_before = simulation_.counters().steps;
  const std::int64_t begin_ns = steady_now_ns();
  const scene::Advance result = simulation_.advance(steps_per_call());
  const std::int64_t spent_ns = steady_now_ns() - begin_ns;
  if (const std::uint64_t steps = simulation_.counters().steps - steps_before; steps > 0) {
    stepping_ns_ += spent_ns;
    mean_step_ns_ = 0.7 * mean_step_ns_ + 0.3 * static_cast<double>(spent_ns) / static_cast<double>(steps);
  }

  switch (result) {
    case scene::Advance::stepped:
      set_state(RunState::running);
      return;
    case scene::Advance::frame_due:
      set_state(RunState::running);
      deliver(true);
      return;
    case scene::Advance::waiting:
      set_state(RunState::following);
      return;
    case scene::Advance::finished:
      set_state(RunState::finished);
      deliver(true);
      return;
    case scene::Advance::stopped:
      failure_ = simulation_.failure();
      set_state(RunState::stopped);
      deliver(false);
      return;
  }
}

void SolverThread::restart()
{
  const bool fresh = simulation_.opening().empty() && simulation_.counters().steps == 0;
  if (!fresh) {
    simulation_.reset();
    record_.begin_run(++run_);
  }
  gate_.reset();
  rejected_at_gate_ = {};
  dropped_before_ = queue_.dropped();
  stepping_ns_ = last_arrival_ns_ = no_sender_since_ns_ = 0;
  had_sender_ = log_over_ = false;
  digest_time_s_ = -1.0;
  failure_ = {};
  state_ = RunState::waiting_for_opening;
  if (hooks_.restarted)
    hooks_.restarted(run_);
  deliver(false);
}

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
  next.opening = {};
  next.stamp_ns = 0;
  next.lag_s = 0.0;
  if (!opening.empty()) {
    next.stamp_ns = opening.origin_ns() + std::llround(next.time_s * 1e9);
    if (state_ != RunState::finished)  // nothing more is to be caught up with
      next.lag_s = std::max(0.0, seconds(opening.last_accepted().stamp_ns - next.stamp_ns));
    next.opening = opening.angles(next.time_s);
  }
  next.seam_strength_n_per_m = weakest_seam(simulation_.scene());
  if (frame != nullptr)
    next.dt_s = frame->dt_s;
  const double stepped_s = next.counters.simulated_time_s - next.counters.skipped.resting_time_s;
  next.real_time_factor = stepping_ns_ > 0 ? stepped_s / seconds(stepping_ns_) : 0.0;

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
  const std::string streamed = record_.frames() > 0 ? ", frames so far in " + record_.path() : "";
  return { true, fmt::format("state at {:.3f} s in {}.h5, summary in {}.json{}", simulation_.time_s(), stem, stem,
                             streamed) };
}

}  // namespace geocontainer_mpm::ros_bridge
