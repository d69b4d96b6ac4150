#pragma once
/// What a run ahead of the live one has found.

#include <cstdint>
#include <string>
#include <vector>

#include "geocontainer_mpm/barge/opening_signal.h"
#include "geocontainer_mpm/scene/frame.h"

namespace geocontainer_mpm::forecast {

/// Where the assumed opening comes from.
enum class Assumption {
  plan,     ///< the planned opening
  measured  ///< the rate measured last, continued up to the hull's limit
};

/// Of the forecast at one instant. Of several geotextiles the largest.
struct Instant {
  double time_s = 0.0;  ///< since the start of the log
  barge::OpeningAngles opening;
  double tension_n_per_m = 0.0;       ///< largest at this instant (gauge length)
  double peak_tension_n_per_m = 0.0;  ///< largest up to it
  double utilisation = 0.0;           ///< peak over strength, of sheet or seam, whichever is more
  Vec3 centroid_m = Vec3::Zero();     ///< barge frame
  double width_m = 0.0;
};

struct Forecast {
  std::uint64_t run = 0;       ///< of the live run it belongs to
  std::int64_t origin_ns = 0;  ///< stamp of the log's time 0
  double from_s = 0.0;         ///< simulated time of the state it started from
  double newest_s = 0.0;       ///< time of the newest measurement when it was ready
  double until_s = 0.0;        ///< as far as it got
  Assumption assumption = Assumption::measured;
  std::vector<Instant> instants;
  /// At the end; its peak, release and rupture are those of the whole run, what lies behind included.
  scene::StatusFrame status;
  std::string stopped;  ///< why the solver had to stop; empty: it did not
  double cost_s = 0.0;  ///< processor time it took
};

}  // namespace geocontainer_mpm::forecast
