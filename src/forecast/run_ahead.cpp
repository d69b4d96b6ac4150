#include "geocontainer_mpm/forecast/run_ahead.h"

#include <algorithm>
#include <cmath>
#include <ctime>

namespace geocontainer_mpm::forecast {
namespace {

using scene::Advance;

Instant instant_of(const scene::Simulation& simulation)
{
  const scene::StatusFrame status = simulation.status();
  Instant instant;
  instant.time_s = simulation.time_s();
  instant.opening = simulation.opening().angles(instant.time_s);
  instant.tension_n_per_m = status.current_tension_n_per_m;
  instant.peak_tension_n_per_m = status.peak_tension_n_per_m;
  instant.utilisation = std::max(status.peak_utilisation_sheet, status.peak_utilisation_seam);
  instant.centroid_m = status.centroid_m;
  instant.width_m = status.width_m;
  return instant;
}

}  // namespace

bool nothing_more_to_see(const scene::Simulation& simulation, const Reach& reach)
{
  const scene::StatusFrame status = simulation.status();
  if (status.release_time_s >= 0.0 && simulation.time_s() > status.release_time_s + reach.after_release_s)
    return true;
  return status.resting && std::isinf(simulation.opening().next_motion_s(simulation.time_s()));
}

double thread_cpu_time_s()
{
  std::timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

std::optional<Forecast> run_ahead(const scene::SceneDescription& scene, const scene::Snapshot& from,
                                  const barge::OpeningSignal& opening, const Reach& reach, double interval_s,
                                  const std::function<bool()>& stop)
{
  const double began_s = thread_cpu_time_s();
  scene::SceneDescription longer = scene;
  longer.time.end_s = from.time_s() + reach.horizon_s;
  scene::Simulation simulation(longer, 1, from);
  simulation.opening() = opening;

  Forecast forecast;
  forecast.from_s = from.time_s();
  forecast.instants.push_back(instant_of(simulation));
  for (bool done = false; !done;) {
    if (stop())
      return std::nullopt;
    const Advance result = simulation.advance();
    done = result == Advance::finished || result == Advance::stopped || result == Advance::waiting ||
           nothing_more_to_see(simulation, reach);
    if (result == Advance::stopped)
      forecast.stopped = simulation.failure().reason;
    const double since_last = simulation.time_s() - forecast.instants.back().time_s;
    if ((done && since_last > 0.0) || (result == Advance::frame_due && since_last > interval_s - 1e-9))
      forecast.instants.push_back(instant_of(simulation));
  }
  forecast.until_s = simulation.time_s();
  forecast.status = simulation.status();
  forecast.cost_s = thread_cpu_time_s() - began_s;
  return forecast;
}

}  // namespace geocontainer_mpm::forecast
