#pragma once
/// What the vessel's monitoring system is told: tables of one line a figure, for each message they come from.

#include <array>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "geocontainer_mpm/vessel/stamp.h"

namespace geocontainer_mpm::vessel {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

enum class ReleaseState { waiting, releasing, released, hung_up, none };
const char* to_string(ReleaseState state);

/// The state of a release as the node publishes it.
struct ReleaseFigures {
  Stamp stamp;  ///< the simulated instant in the log's time
  ReleaseState state = ReleaseState::none;
  bool resting = false;
  bool stopped = false;  ///< the solver had to stop
  std::string message;   ///< one sentence for the superintendent
  double port_rad = unknown;
  double starboard_rad = unknown;
  double current_tension_n_per_m = unknown;
  double peak_tension_n_per_m = unknown;
  double peak_utilisation = unknown;  ///< peak tension over the seam's strength
  std::array<double, 3> centroid_m = { unknown, unknown, unknown };
  double width_m = unknown;
  double height_m = unknown;
  double release_time_s = -1.0;  ///< since the start of the log; negative while not released
  double lag_s = unknown;
};

/// Lists of numbers by name, one beside the other: a curve, an outline. An object of lists on the wire.
using Columns = std::map<std::string, std::vector<double>>;

/// The newest forecast.
struct ForecastFigures {
  Stamp stamp;         ///< the simulated instant it started from
  bool stale = false;  ///< the hull has departed from the opening that was assumed
  ReleaseState outcome = ReleaseState::none;
  bool ruptured = false;
  std::string message;
  std::optional<Stamp> release;           ///< nothing: not within the horizon
  double until_release_s = unknown;       ///< from the newest measurement that the forecast knew of
  double peak_tension_n_per_m = unknown;  ///< up to the horizon's end, what has been included
  double peak_utilisation = unknown;      ///< of sheet or seam, whichever is more
  Columns curve;                          ///< `time` (s since 1970, UTC) and `tension` (N/m)
};

/// Below which a tenth, half and nine tenths of the members lie; infinite: not within their run.
struct Band {
  double p10 = unknown, p50 = unknown, p90 = unknown;
};

enum class AdviceState { none, any_rate, rate, rate_so_far, no_rate };
const char* to_string(AdviceState advice);

/// The newest ensemble, and the advice drawn from it.
struct EnsembleFigures {
  Stamp stamp;
  double members = unknown;  ///< that have come to their end
  Band peak_tension_n_per_m, peak_utilisation, release_delay_s, final_width_m;
  Columns tension;  ///< `time` (s since 1970, UTC), `p10`, `p50`, `p90` (N/m) over the time ahead
  double hung_up = unknown, ruptured = unknown;  ///< probabilities
  AdviceState advice = AdviceState::none;
  double advised_rate_rad_per_s = unknown;
  double slowest_rate_rad_per_s = unknown;  ///< 0: none is too slow
  double advised_utilisation = unknown;     ///< p90 at that rate
  std::string advice_message;
};

/// The section as it is drawn: the geotextile's outline in the barge's frame.
struct SectionFigures {
  Stamp stamp;
  Columns outline;  ///< `y`, `z` (m) of points, `utilisation` of the piece from each to the next; as many when closed
};

/// Curves and outlines have no more points than this: they are drawn on a screen, some hundred pixels wide.
constexpr std::size_t most_points = 64;

/// Every so manyth point of an outline; a piece that stands for several has the largest utilisation of theirs.
Columns thin_outline(const std::vector<double>& y, const std::vector<double>& z,
                     const std::vector<double>& utilisation);
/// As many stretches of a curve as may be, of each the point of largest tension: a peak stays. First and last are kept.
Columns thin_curve(const std::vector<double>& time, const std::vector<double>& tension);
/// As many stretches of curves that share their instants as may be; each has the time of its last one, and of each
/// curve the largest value: a peak stays. `curves` must be as long as `time`.
Columns thin_band(const std::vector<double>& time, const Columns& curves);

/// A Signal K notification.
struct Notice {
  std::string state;  ///< normal, alert, warn, alarm or emergency
  std::string message;
  bool sound = false;  ///< beside being shown
  bool acknowledged = false;

  bool operator==(const Notice& other) const { return state == other.state && message == other.message; }
};

/// A value on a path: nothing (sent as null), a number in SI units, text, a notification, or lists of numbers.
using Value = std::variant<std::monostate, double, std::string, Notice, Columns>;

template <typename Source>
struct Figure {
  const char* path;   ///< below the prefix
  const char* units;  ///< SI; empty for text
  const char* description;
  bool limited;  ///< the limits of utilisation apply: the server raises its alarm from them
  Value (*value)(const Source& source);
};

/// The tables. A figure more is a line more in src/vessel/figures.cpp.
const std::vector<Figure<ReleaseFigures>>& release_figures();
const std::vector<Figure<ForecastFigures>>& forecast_figures();
const std::vector<Figure<EnsembleFigures>>& ensemble_figures();
const std::vector<Figure<SectionFigures>>& section_figures();

/// What the release itself is an alarm for: standing still in the slot, or a prediction that has stopped.
Notice release_notice(const ReleaseFigures& release);

}  // namespace geocontainer_mpm::vessel
