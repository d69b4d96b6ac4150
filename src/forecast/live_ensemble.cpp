#include "geocontainer_mpm/forecast/live_ensemble.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <utility>

#include "geocontainer_mpm/ensemble/sampling.h"
#include "geocontainer_mpm/ensemble/statistics.h"

namespace geocontainer_mpm::forecast {
namespace {

/// The members follow a log for as long as it goes on: eleven days.
constexpr double no_end_s = 1e6;

/// The first instant that is not before `time_s`.
std::size_t instant_at(double time_s, double from_s, double interval_s)
{
  return static_cast<std::size_t>(std::max(0.0, std::ceil((time_s - from_s) / interval_s - 1e-9)));
}

void keep_largest(std::vector<double>& tension, std::size_t instant, double now)
{
  if (instant < tension.size())
    tension[instant] = std::max(tension[instant], now);
  else
    tension.resize(instant + 1, now);
}

}  // namespace

EnsemblePlan draw_members(const std::string& scene, const std::vector<std::string>& overrides,
                          const std::string& distributions, std::size_t members, std::uint64_t seed)
{
  EnsemblePlan plan;
  plan.seed = seed;
  plan.inputs = ensemble::load_inputs(distributions);
  plan.values = ensemble::draw(plan.inputs, members, seed);
  for (const std::vector<std::string>& member :
       ensemble::assignments(plan.inputs, plan.values, overrides, "", "scene_overrides", distributions)) {
    plan.scenes.push_back(scene::load_scene(scene, member));
    plan.scenes.back().time.end_s = no_end_s;
  }
  return plan;
}

LiveEnsemble::LiveEnsemble(EnsemblePlan plan, int threads)
    : plan_(std::move(plan)), threads_(threads), followers_(plan_.scenes.size())
{
}

void LiveEnsemble::reset()
{
  for (Follower& follower : followers_) {
    if (follower.run)
      follower.run->reset();
    follower.failed.clear();
  }
}

/// As far as the log is known. The first time the member is built, which settles it.
void LiveEnsemble::follow(std::size_t i, const barge::OpeningSignal& so_far, const std::function<bool()>& stop)
{
  using scene::Advance;
  Follower& follower = followers_[i];
  if (!follower.run)
    follower.run.emplace(plan_.scenes[i], 1);
  follower.run->opening() = so_far;
  Advance result = Advance::stepped;
  while ((result == Advance::stepped || result == Advance::frame_due) && !stop())
    result = follower.run->advance();
  if (result == Advance::stopped)
    follower.failed = fmt::format("the solver stopped at {:.4f} s: {}", follower.run->failure().time_s,
                                  follower.run->failure().reason);
}

ensemble::Member LiveEnsemble::member_ahead(std::size_t i, const barge::OpeningSignal& so_far,
                                            const barge::OpeningSignal& ahead, const Reach& reach, double interval_s,
                                            const std::function<bool()>& stop)
{
  Follower& follower = followers_[i];
  follower.tension.clear();
  try {
    if (follower.failed.empty())
      follow(i, so_far, stop);
    if (!follower.failed.empty())
      return ensemble::failed_member(follower.failed);
    const std::optional<scene::Snapshot> now = follower.run->snapshot();
    if (!now)
      return ensemble::failed_member("there is no log yet");
    scene::SceneDescription scene = plan_.scenes[i];
    scene.time.end_s = now->time_s() + reach.horizon_s;
    scene::Simulation run(scene, 1, *now);
    run.opening() = ahead;
    const auto look = [&, from_s = so_far.known_until_s()](const scene::Simulation& at) {
      keep_largest(follower.tension, instant_at(at.time_s(), from_s, interval_s), at.status().current_tension_n_per_m);
      return nothing_more_to_see(at, reach);
    };
    look(run);
    return ensemble::advance_member(run, look, stop);
  } catch (const std::exception& error) {  // a scene that cannot be built, or no memory
    follower.failed = error.what();
    return ensemble::failed_member(error.what());
  }
}

std::vector<ensemble::Member> LiveEnsemble::run_ahead(const barge::OpeningSignal& so_far,
                                                      const barge::OpeningSignal& ahead, const Reach& reach,
                                                      double interval_s, const std::function<bool()>& stop)
{
  std::mutex adding;
  double cost = 0.0;
  std::vector<ensemble::Member> members = ensemble::run_members(
      followers_.size(), threads_,
      [&](std::size_t i) {
        const double began = thread_cpu_time_s();
        ensemble::Member member = member_ahead(i, so_far, ahead, reach, interval_s, stop);
        const std::lock_guard<std::mutex> lock(adding);
        cost += thread_cpu_time_s() - began;
        return member;
      },
      [] {});
  cost_s_ = cost;
  find_tension(members, so_far.known_until_s(), interval_s);
  return members;
}

void LiveEnsemble::find_tension(const std::vector<ensemble::Member>& members, double from_s, double interval_s)
{
  tension_ = {};
  std::vector<const std::vector<double>*> histories;
  std::size_t instants = 0;
  for (std::size_t i = 0; i < members.size(); ++i)
    if (members[i].ending == ensemble::Ending::completed) {
      histories.push_back(&followers_[i].tension);
      instants = std::max(instants, followers_[i].tension.size());
    }
  std::vector<double> now(histories.size());
  for (std::size_t k = 0; k < instants; ++k) {
    for (std::size_t m = 0; m < histories.size(); ++m)
      now[m] = (*histories[m])[std::min(k, histories[m]->size() - 1)];
    tension_.time_s.push_back(from_s + static_cast<double>(k) * interval_s);
    tension_.p10.push_back(ensemble::quantile(now, 0.1));
    tension_.p50.push_back(ensemble::quantile(now, 0.5));
    tension_.p90.push_back(ensemble::quantile(now, 0.9));
  }
}

}  // namespace geocontainer_mpm::forecast
