#pragma once
/// One run ahead of the live one.

#include <functional>
#include <optional>

#include "geocontainer_mpm/forecast/forecast.h"
#include "geocontainer_mpm/scene/simulation.h"

namespace geocontainer_mpm::forecast {

/// Goes on from `from` under `opening`, which must continue the snapshot's own and be finished, for `horizon_s` of
/// simulated time or until all lies still in a hull that does not move any more. An instant is kept every `interval_s`,
/// rounded to the scene's output interval. One thread. None when `stop()` said so before it was done.
std::optional<Forecast> run_ahead(const scene::SceneDescription& scene, const scene::Snapshot& from,
                                  const barge::OpeningSignal& opening, double horizon_s, double interval_s,
                                  const std::function<bool()>& stop);

/// Processor time of the calling thread, s.
double thread_cpu_time_s();

}  // namespace geocontainer_mpm::forecast
