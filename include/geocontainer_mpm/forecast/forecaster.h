#pragma once
/// Keeps a forecast of the live run, and an ensemble's, as fresh as the processors allow: two threads of low priority
/// beside the solver's. Knows no ROS.
///
/// A forecast is stale when the hull has departed from the opening it assumed. The next one begins when the one that is
/// being computed is done, or at once where the hull is far from what that one assumes: giving up at every departure
/// would leave a slow model without any forecast while the hull accelerates.

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "geocontainer_mpm/forecast/assumed_opening.h"
#include "geocontainer_mpm/forecast/forecast.h"
#include "geocontainer_mpm/forecast/live_ensemble.h"
#include "geocontainer_mpm/forecast/run_ahead.h"
#include "geocontainer_mpm/scene/simulation.h"

namespace geocontainer_mpm::forecast {

struct ForecasterSettings {
  Reach reach;                           ///< of every run ahead
  double interval_s = 0.25;              ///< between instants of a forecast or an ensemble, s, > 0
  double period_s = 5.0;                 ///< wall-clock s after which a forecast is made anew, > 0
  double tolerance_rad = 0.005;          ///< departure that makes a forecast stale, rad, > 0
  double rate_window_s = 2.0;            ///< samples of so long tell the rate, s, > 0
  double ensemble_period_s = 15.0;       ///< the same as period_s for the ensemble
  std::optional<AdviceSettings> advice;  ///< none: not searched; needs an ensemble
};

/// Called on the forecaster's own threads.
struct ForecasterHooks {
  std::function<void(const Forecast&, bool stale)> forecast;  ///< a new one, or the last one that became stale
  std::function<void(const EnsembleForecast&)> ensemble;
};

class Forecaster {
public:
  /// `scene` is the live run's.
  Forecaster(scene::SceneDescription scene, ForecasterSettings settings, std::unique_ptr<LiveEnsemble> ensemble,
             ForecasterHooks hooks);
  ~Forecaster();  ///< gives up what is being computed
  Forecaster(const Forecaster&) = delete;
  Forecaster& operator=(const Forecaster&) = delete;

  // By the thread of the live run.
  void restart(std::uint64_t run);  ///< all that was known is of another log; what is being computed is given up
  void measured(double time_s, const barge::OpeningAngles& angles);  ///< a sample was accepted; since the log's start
  bool state_wanted() const { return state_wanted_; }
  void give_state(scene::Snapshot state);

  /// By any thread: samples of the planned opening with their absolute stamps; none: the measured rate again. Throws
  /// InputError for a plan that the hull's signal would not believe.
  void plan(const std::vector<barge::OpeningSample>& samples);

private:
  using Lock = std::unique_lock<std::mutex>;
  using Clock = std::chrono::steady_clock;

  /// One thing that is computed over and over.
  struct Task {
    std::optional<AssumedOpening> computing, published;  ///< what each assumes
    bool stale = false;                                  ///< the published one
    std::atomic<bool> give_up{ false };
    Clock::time_point due{};
    std::optional<double> from_s;  ///< of the published one
  };
  struct Job {
    std::uint64_t run, plans;
    scene::Snapshot state;
    AssumedOpening assumed;
    double newest_s;  ///< time of the newest measurement
  };

  void run_forecasts();
  void run_ensembles();
  void pass_ensemble(Lock& lock);
  std::vector<ensemble::Member> members_ahead(const scene::Snapshot& state, const AssumedOpening& assumed);
  void consider_advice(const Job& job);
  void try_rate(Lock& lock);
  bool wait_until_due(Lock& lock, const Task& task, const std::function<bool()>& also);
  std::optional<scene::Snapshot> fetch_state(Lock& lock);
  std::optional<Job> begin(Lock& lock, Task& task);
  double finish(Task& task, const Job& job, bool done);
  AssumedOpening assume(const scene::Snapshot& state, const RecentSamples::Trend& trend) const;
  barge::OpeningSignal ahead(const AssumedOpening& assumed, const scene::Snapshot& state) const;
  void notice_departure(double time_s, const barge::OpeningAngles& angles);

  scene::SceneDescription scene_;
  ForecasterSettings settings_;
  ForecasterHooks hooks_;
  std::unique_ptr<LiveEnsemble> ensemble_;

  // Of the ensemble's thread alone.
  std::uint64_t ensemble_run_ = 1;
  EnsembleForecast last_ensemble_;
  std::optional<RateSearch> search_;
  bool growing_ = false;                             ///< the advice is that of a search which is not done
  bool rate_is_next_ = false;                        ///< of a search, before the next pass
  std::optional<barge::OpeningAngles> searched_at_;  ///< opening of the last search

  std::atomic<bool> quit_{ false };
  std::atomic<bool> state_wanted_{ false };
  std::mutex mutex_;  ///< guards what follows
  std::condition_variable changed_;
  std::uint64_t run_ = 1;
  RecentSamples recent_;
  std::optional<scene::Snapshot> state_;
  std::uint64_t states_given_ = 0;
  std::vector<barge::OpeningSample> plan_;
  std::uint64_t plans_ = 0;  ///< that came
  std::optional<Forecast> last_forecast_;
  Task forecasting_, ensembling_;

  std::thread forecast_thread_, ensemble_thread_;  // last: start when everything else stands
};

}  // namespace geocontainer_mpm::forecast
