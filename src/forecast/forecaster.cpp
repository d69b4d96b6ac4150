#include "geocontainer_mpm/forecast/forecaster.h"

#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

#include "geocontainer_mpm/ensemble/members.h"

namespace geocontainer_mpm::forecast {
namespace {

using barge::OpeningAngles;

/// So many tolerances away from what it assumes a run ahead is not worth its end.
constexpr double hopeless = 4.0;
/// Of the threads; the live run's is 0, and the scheduler gives it ten times as much.
constexpr int niceness = 10;

/// Linux has a niceness for each thread; the members' threads inherit it.
void lower_priority()
{
  setpriority(PRIO_PROCESS, static_cast<id_t>(syscall(SYS_gettid)), niceness);
}

bool same(const OpeningAngles& a, const OpeningAngles& b)
{
  return a.port_rad == b.port_rad && a.starboard_rad == b.starboard_rad;
}

/// By the filtered opening, in which a hull that stands still stands exactly still.
bool stands_still(const barge::OpeningSignal& opening, double for_s)
{
  const double known = opening.known_until_s();
  return known < 0.0 || same(opening.angles(known), opening.angles(std::max(0.0, known - for_s)));
}

std::chrono::steady_clock::duration duration(double seconds)
{
  return std::chrono::duration_cast<std::chrono::steady_clock::duration>(std::chrono::duration<double>(seconds));
}

}  // namespace

Forecaster::Forecaster(scene::SceneDescription scene, ForecasterSettings settings,
                       std::unique_ptr<LiveEnsemble> ensemble, ForecasterHooks hooks)
    : scene_(std::move(scene))
    , settings_(settings)
    , hooks_(std::move(hooks))
    , ensemble_(std::move(ensemble))
    , recent_(settings_.rate_window_s)
{
  forecast_thread_ = std::thread([this] { run_forecasts(); });
  if (ensemble_)
    ensemble_thread_ = std::thread([this] { run_ensembles(); });
}

Forecaster::~Forecaster()
{
  {
    const Lock lock(mutex_);
    quit_ = forecasting_.give_up = ensembling_.give_up = true;
  }
  changed_.notify_all();
  forecast_thread_.join();
  if (ensemble_thread_.joinable())
    ensemble_thread_.join();
}

void Forecaster::restart(std::uint64_t run)
{
  {
    const Lock lock(mutex_);
    run_ = run;
    recent_.clear();
    state_.reset();
    last_forecast_.reset();
    for (Task* task : { &forecasting_, &ensembling_ }) {
      task->give_up = true;
      task->computing.reset();
      task->published.reset();
      task->from_s.reset();
      task->stale = false;
      task->due = {};
    }
  }
  changed_.notify_all();
}

/// Stale is what was published. A forecast that is being computed is given up where the hull is far from it; an
/// ensemble takes longer and is never.
void Forecaster::notice_departure(double time_s, const OpeningAngles& angles)
{
  for (Task* task : { &forecasting_, &ensembling_ })
    if (task->published && task->published->departure(time_s, angles) > settings_.tolerance_rad)
      task->stale = true;
  if (forecasting_.computing && forecasting_.computing->departure(time_s, angles) > hopeless * settings_.tolerance_rad)
    forecasting_.give_up = true;
}

void Forecaster::measured(double time_s, const OpeningAngles& angles)
{
  bool wake;
  {
    const Lock lock(mutex_);
    wake = recent_.empty();
    recent_.add(time_s, angles);
    const bool was_stale = forecasting_.stale || ensembling_.stale;
    notice_departure(time_s, recent_.trend().angles);  // a sample alone is as far off as its noise
    wake = wake || (!was_stale && (forecasting_.stale || ensembling_.stale));
  }
  if (wake)
    changed_.notify_all();
}

void Forecaster::give_state(scene::Snapshot state)
{
  {
    const Lock lock(mutex_);
    state_ = std::move(state);
    ++states_given_;
    state_wanted_ = false;
  }
  changed_.notify_all();
}

void Forecaster::plan(const std::vector<barge::OpeningSample>& samples)
{
  if (!samples.empty()) {  // only to check it: the log's origin may not be known yet
    std::vector<barge::OpeningPoint> points;
    points.reserve(samples.size());
    for (const barge::OpeningSample& sample : samples)
      points.push_back({ static_cast<double>(sample.stamp_ns - samples.front().stamp_ns) / 1e9, sample.angles });
    AssumedOpening::planned(std::move(points), scene_.hull ? scene_.hull->signal : barge::OpeningSignalParameters{},
                            "points");
  }
  {
    const Lock lock(mutex_);
    plan_ = samples;
    ++plans_;
    forecasting_.stale = ensembling_.stale = true;
  }
  changed_.notify_all();
}

/// The plan, for as long as the hull keeps to it.
AssumedOpening Forecaster::assume(const scene::Snapshot& state, const RecentSamples::Trend& trend) const
{
  const double newest_s = recent_.newest().time_s;
  if (!plan_.empty()) {
    std::vector<barge::OpeningPoint> points;
    points.reserve(plan_.size());
    for (const barge::OpeningSample& sample : plan_)
      points.push_back({ static_cast<double>(sample.stamp_ns - state.opening().origin_ns()) / 1e9, sample.angles });
    AssumedOpening plan = AssumedOpening::planned(
        std::move(points), scene_.hull ? scene_.hull->signal : barge::OpeningSignalParameters{}, "points");
    if (plan.departure(newest_s, trend.angles) <= settings_.tolerance_rad)
      return plan;
  }
  const double full = scene_.hull ? scene_.hull->full_opening() : 0.0;
  const OpeningAngles rate = stands_still(state.opening(), settings_.rate_window_s) ? OpeningAngles{} : trend.rate;
  return AssumedOpening::at_rate(newest_s, trend.angles, rate, full);
}

/// False: quit. `also` is another reason to wake up.
bool Forecaster::wait_until_due(Lock& lock, const Task& task, const std::function<bool()>& also)
{
  const auto due = [&] {
    if (quit_)
      return true;
    if (recent_.empty())
      return false;
    return !task.published || task.stale || Clock::now() >= task.due || also();
  };
  while (!due())
    changed_.wait_until(lock, recent_.empty() ? Clock::now() + duration(1.0) : task.due);
  return !quit_;
}

/// The live run's state, asked for now. None: quit or restarted meanwhile, or the run has not begun.
std::optional<scene::Snapshot> Forecaster::fetch_state(Lock& lock)
{
  const std::uint64_t run = run_, before = states_given_;
  state_wanted_ = true;
  changed_.wait_for(lock, duration(1.0), [&] { return quit_ || run_ != run || states_given_ != before; });
  if (quit_ || run_ != run || states_given_ == before)
    return std::nullopt;
  return state_;
}

/// None where there is nothing to begin with: no state yet, or the same again.
std::optional<Forecaster::Job> Forecaster::begin(Lock& lock, Task& task)
{
  const std::optional<scene::Snapshot> state = fetch_state(lock);
  if (!state || recent_.empty() || state->opening().empty())
    return std::nullopt;
  if (!task.stale && task.from_s == state->time_s()) {  // finished, stopped or held
    task.due = Clock::now() + duration(settings_.period_s);
    return std::nullopt;
  }
  const RecentSamples::Trend trend = recent_.trend();
  task.computing = assume(*state, trend);
  task.give_up = quit_.load();
  task.due = Clock::now() + duration(&task == &forecasting_ ? settings_.period_s : settings_.ensemble_period_s);
  return Job{ run_, plans_, *state, *task.computing, recent_.newest().time_s };
}

/// What was computed is published from now on, unless it was given up. Returns the time of the newest measurement.
double Forecaster::finish(Task& task, const Job& job, bool done)
{
  const Lock lock(mutex_);
  if (!done || run_ != job.run) {
    task.computing.reset();
    return job.newest_s;
  }
  task.published = std::exchange(task.computing, std::nullopt);
  task.from_s = job.state.time_s();
  const double newest_s = recent_.newest().time_s;
  task.stale =
      job.plans != plans_ || task.published->departure(newest_s, recent_.trend().angles) > settings_.tolerance_rad;
  return newest_s;
}

barge::OpeningSignal Forecaster::ahead(const AssumedOpening& assumed, const scene::Snapshot& state) const
{
  return assumed.continue_from(state.opening(), scene_.hull ? scene_.hull->signal.smoothing_time_s : 0.0);
}

void Forecaster::run_forecasts()
{
  lower_priority();
  Lock lock(mutex_);
  while (wait_until_due(lock, forecasting_, [] { return false; })) {
    if (forecasting_.stale && last_forecast_) {
      Forecast stale = *std::exchange(last_forecast_, std::nullopt);
      stale.newest_s = recent_.newest().time_s;
      lock.unlock();
      hooks_.forecast(stale, true);
      lock.lock();
    }
    const std::optional<Job> job = begin(lock, forecasting_);
    if (!job)
      continue;
    lock.unlock();
    std::optional<Forecast> forecast =
        forecast::run_ahead(scene_, job->state, ahead(job->assumed, job->state), settings_.reach, settings_.interval_s,
                            [this] { return forecasting_.give_up.load(); });
    const double newest_s = finish(forecasting_, *job, forecast.has_value());
    if (forecast) {
      forecast->run = job->run;
      forecast->origin_ns = job->state.opening().origin_ns();
      forecast->newest_s = newest_s;
      forecast->assumption = job->assumed.assumption();
      hooks_.forecast(*forecast, false);
    }
    lock.lock();
    if (forecast && run_ == job->run)
      last_forecast_ = std::move(forecast);
  }
}

void Forecaster::run_ensembles()
{
  lower_priority();
  Lock lock(mutex_);
  while (wait_until_due(lock, ensembling_, [this] { return search_.has_value(); })) {
    if (ensemble_run_ != run_) {
      ensemble_run_ = run_;
      lock.unlock();
      ensemble_->reset();
      lock.lock();
      search_.reset();
      searched_at_.reset();
      growing_ = false;
      last_ensemble_ = {};
    }
    // In turns: members that take longer than their period, or a hull that accelerates, would leave no time for advice.
    const bool due = !ensembling_.published || ensembling_.stale || Clock::now() >= ensembling_.due;
    if (search_ && (rate_is_next_ || !due))
      try_rate(lock);
    else
      pass_ensemble(lock);
    rate_is_next_ = !rate_is_next_;
  }
}

/// All members once, under the opening that is assumed.
void Forecaster::pass_ensemble(Lock& lock)
{
  const std::optional<Job> job = begin(lock, ensembling_);
  if (!job)
    return;
  lock.unlock();
  const std::vector<ensemble::Member> members = members_ahead(job->state, job->assumed);
  const bool done = !ensembling_.give_up;
  finish(ensembling_, *job, done);
  if (done) {
    last_ensemble_.run = job->run;
    last_ensemble_.origin_ns = job->state.opening().origin_ns();
    last_ensemble_.from_s = job->state.opening().known_until_s();
    last_ensemble_.seed = ensemble_->plan().seed;
    last_ensemble_.inputs.clear();
    for (const ensemble::Input& input : ensemble_->plan().inputs)
      last_ensemble_.inputs.push_back(input.key);
    last_ensemble_.summary = ensemble::summarise(members, ensemble_->plan().values);
    last_ensemble_.tension = ensemble_->tension();
    last_ensemble_.cost_s = ensemble_->cost_s();
    consider_advice(*job);
    hooks_.ensemble(last_ensemble_);
  }
  lock.lock();
}

std::vector<ensemble::Member> Forecaster::members_ahead(const scene::Snapshot& state, const AssumedOpening& assumed)
{
  return ensemble_->run_ahead(state.opening(), ahead(assumed, state), settings_.reach, settings_.interval_s,
                              [this] { return ensembling_.give_up.load(); });
}

/// A search begins when the hull has moved since the last one, can still open and some member is still in it.
void Forecaster::consider_advice(const Job& job)
{
  const ensemble::Summary& summary = last_ensemble_.summary;
  if (!settings_.advice || !scene_.hull || summary.figures.empty())
    return;
  const OpeningAngles now = job.state.opening().angles(std::max(0.0, job.state.opening().known_until_s()));
  const double most = std::max(now.port_rad, now.starboard_rad);
  if (most >= scene_.hull->full_opening() - settings_.tolerance_rad ||
      summary.figures[ensemble::release_time_figure()].p90 <= last_ensemble_.from_s) {
    search_.reset();
    growing_ = false;
    last_ensemble_.advice = {};  // nothing is left to be advised
    return;
  }
  if (search_ || (searched_at_ && same(*searched_at_, now)))
    return;
  searched_at_ = now;
  search_.emplace(*settings_.advice);
}

/// All members once, under the next rate of the search.
void Forecaster::try_rate(Lock& lock)
{
  const std::optional<scene::Snapshot> state = fetch_state(lock);
  if (!state || recent_.empty() || state->opening().empty())
    return;
  const double rate = *search_->next();
  const AssumedOpening assumed = AssumedOpening::at_rate(recent_.newest().time_s, recent_.trend().angles,
                                                         { rate, rate }, scene_.hull->full_opening());
  ensembling_.give_up = quit_.load();
  lock.unlock();
  const ensemble::Summary summary = ensemble::summarise(members_ahead(*state, assumed), ensemble_->plan().values);
  const bool done = !ensembling_.give_up;
  if (done) {
    search_->add(summary.figures.empty() ? std::numeric_limits<double>::infinity()
                                         : summary.figures[ensemble::peak_utilisation_figure()].p90);
    // Advice of an earlier search stands until the new one is done; the first one is told as it grows.
    const Advice advice = search_->advice();
    const bool over = !search_->next();
    const bool is_first = growing_ || last_ensemble_.advice.verdict == Verdict::none;
    if (over || (is_first && advice.verdict != Verdict::none)) {
      last_ensemble_.advice = advice;
      growing_ = !over;
      hooks_.ensemble(last_ensemble_);
    }
    if (over)
      search_.reset();
  }
  lock.lock();
}

}  // namespace geocontainer_mpm::forecast
