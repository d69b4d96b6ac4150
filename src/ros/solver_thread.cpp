#include "geocontainer_mpm/ros/solver_thread.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
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

}  // namespace

SolverThread::SolverThread(scene::Simulation simulation, OpeningQueue& queue, RunRecord record, SolverSettings settings,
                           SolverHooks hooks)
    : simulation_(std::move(simulation))
    , queue_(queue)
    , record_(std::move(record))
    , settings_(std::move(settings))
    , hooks_(std::move(hooks))
    , gate_(settings_.gate)
    , checkpoint_(settings_.checkpoint, settings_.checkpoint_period_s)
    , resume_(settings_.resume)
    , paused_(!settings_.autostart)
{
  record_.begin_run(run_ = settings_.first_run);
  if (settings_.resumed) {
    resumed_log_ =
        ResumedLog(simulation_.opening(), simulation_.scene().hull.value().signal, settings_.resume_within_s);
    stepped_before_s_ = stepped_s();
  }
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

std::future<Reply> SolverThread::announce()
{
  return post([] { return Reply{ true, {} }; });
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
  if (state_ != RunState::stopped && !simulation_.opening().empty())
    checkpoint_.save(simulation_);
  checkpoint_.wait();
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
  else if (resumed_log_.too_late(now_ns))
    give_up_resumed();
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
        take(arrived->sample);
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

void SolverThread::take(const barge::OpeningSample& sample)
{
  switch (resumed_log_.judge(sample)) {
    case ResumedLog::Verdict::known:
      ++known_again_;
      return;
    case ResumedLog::Verdict::another:
      give_up_resumed();
      break;
    case ResumedLog::Verdict::goes_on:
      break;
  }
  if (simulation_.opening().add(sample) != barge::SampleVerdict::accepted)
    return;
  gate_.taken(sample);
  resumed_log_.has_gone_on();
  if (hooks_.forecaster)
    hooks_.forecaster->measured(seconds(sample.stamp_ns - simulation_.opening().origin_ns()), sample.angles);
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
      if (checkpoint_.due(steady_now_ns()))
        checkpoint_.save(simulation_);
      return;
    case scene::Advance::waiting:
      set_state(RunState::following);
      if (simulation_.time_s() > checkpoint_.time_s() && checkpoint_.due(steady_now_ns()))
        checkpoint_.save(simulation_);
      return;
    case scene::Advance::finished:
      set_state(RunState::finished);
      checkpoint_.wait();
      checkpoint_.save(simulation_);
      deliver(true);
      return;
    case scene::Advance::stopped:
      failure_ = simulation_.failure();
      set_state(RunState::stopped);
      deliver(false);
      return;
  }
}

void SolverThread::give_up_resumed()
{
  resume_ = resumed_log_.contradiction();
  if (hooks_.notice)
    hooks_.notice(resume_);
  checkpoint_.set_aside();
  restart();
}

void SolverThread::restart()
{
  const bool fresh = simulation_.opening().empty() && simulation_.counters().steps == 0;
  if (!fresh) {
    simulation_.reset();
    record_.begin_run(++run_);
    checkpoint_.discard();
  }
  resumed_log_ = {};
  known_again_ = 0;
  stepped_before_s_ = 0.0;
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

}  // namespace geocontainer_mpm::ros_bridge
