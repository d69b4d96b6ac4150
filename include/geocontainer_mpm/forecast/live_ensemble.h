#pragma once
/// An ensemble whose members follow the log as the live run does.

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "geocontainer_mpm/ensemble/distribution.h"
#include "geocontainer_mpm/ensemble/members.h"
#include "geocontainer_mpm/forecast/advice.h"
#include "geocontainer_mpm/forecast/run_ahead.h"
#include "geocontainer_mpm/scene/simulation.h"

namespace geocontainer_mpm::forecast {

/// The members that are drawn.
struct EnsemblePlan {
  std::uint64_t seed = 0;
  std::vector<ensemble::Input> inputs;
  std::vector<std::vector<std::string>> values;  ///< a row a member
  std::vector<scene::SceneDescription> scenes;   ///< a member each
};

/// Draws `members` from the distributions of a file and reads the scene for each, `overrides` first. Throws InputError,
/// also for an override of what is drawn.
EnsemblePlan draw_members(const std::string& scene, const std::vector<std::string>& overrides,
                          const std::string& distributions, std::size_t members, std::uint64_t seed);

/// Tension over the time ahead: at each instant of what is the largest in a member since the instant before. A member
/// that has come to its end stays as it was there.
struct TensionBand {
  std::vector<double> time_s;         ///< since the start of the log
  std::vector<double> p10, p50, p90;  ///< N/m, below which a tenth, half and nine tenths of the members lie
};

/// What an ensemble says.
struct EnsembleForecast {
  std::uint64_t run = 0;       ///< of the live run it belongs to
  std::int64_t origin_ns = 0;  ///< stamp of the log's time 0
  double from_s = 0.0;         ///< simulated time of the newest opening that the members know
  std::uint64_t seed = 0;
  std::vector<std::string> inputs;  ///< scene keys
  ensemble::Summary summary;
  TensionBand tension;
  double cost_s = 0.0;  ///< processor time of all members
  Advice advice;
};

/// A member has another fill and another geotextile than the live run: that one's state is not a state of it. So every
/// member has a run of its own that follows the log, and goes ahead from there.
class LiveEnsemble {
public:
  LiveEnsemble(EnsemblePlan plan, int threads);

  const EnsemblePlan& plan() const { return plan_; }
  void reset();  ///< another log begins

  /// Every member follows `so_far` as far as it is known, and from there goes on under `ahead`, which continues it and
  /// is finished, as far as `reach`. A member that could not be built or had to stop says so in its place. Instants of
  /// tension() are `interval_s` apart.
  std::vector<ensemble::Member> run_ahead(const barge::OpeningSignal& so_far, const barge::OpeningSignal& ahead,
                                          const Reach& reach, double interval_s, const std::function<bool()>& stop);
  TensionBand tension() const { return tension_; }  ///< of the last run_ahead(), of the members that completed
  double cost_s() const { return cost_s_; }         ///< processor time of the last run_ahead(), all threads

private:
  struct Follower {
    std::optional<scene::Simulation> run;
    std::string failed;           ///< why it could not be built or had to stop
    std::vector<double> tension;  ///< of its last run ahead, by instant, N/m
  };

  ensemble::Member member_ahead(std::size_t i, const barge::OpeningSignal& so_far, const barge::OpeningSignal& ahead,
                                const Reach& reach, double interval_s, const std::function<bool()>& stop);
  void find_tension(const std::vector<ensemble::Member>& members, double from_s, double interval_s);
  void follow(std::size_t i, const barge::OpeningSignal& so_far, const std::function<bool()>& stop);

  EnsemblePlan plan_;
  int threads_;
  std::vector<Follower> followers_;
  TensionBand tension_;
  double cost_s_ = 0.0;
};

}  // namespace geocontainer_mpm::forecast
