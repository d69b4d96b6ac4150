#pragma once
/// One run ahead of the live one.

#include <functional>
#include <optional>

#include "geocontainer_mpm/forecast/forecast.h"
#include "geocontainer_mpm/scene/simulation.h"

namespace geocontainer_mpm::forecast {

/// How far a run ahead goes.
struct Reach {
  double horizon_s = 60.0;       ///< simulated time from the state that it starts from, s, > 0
  double after_release_s = 6.0;  ///< of it after the release: until the container lies on the bed, s, > 0
};

/// Released so long ago, or at rest for good.
bool nothing_more_to_see(const scene::Simulation& simulation, const Reach& reach);

/// Goes on from `from` under `opening`, which must continue the snapshot's own and be finished, as far as it reaches.
/// An instant is kept every `interval_s`, rounded to the scene's output interval. One thread. None when `stop()` said
/// so before it was done.
std::optional<Forecast> run_ahead(const scene::SceneDescription& scene, const scene::Snapshot& from,
                                  const barge::OpeningSignal& opening, const Reach& reach, double interval_s,
                                  const std::function<bool()>& stop);

/// Processor time of the calling thread, s.
double thread_cpu_time_s();

}  // namespace geocontainer_mpm::forecast
