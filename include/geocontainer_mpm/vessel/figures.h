#pragma once
/// What the vessel's monitoring system is told: one table, one line a figure.

#include <array>
#include <limits>
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

/// A Signal K notification.
struct Notice {
  std::string state;  ///< normal, alert, warn, alarm or emergency
  std::string message;
  bool sound = false;  ///< beside being shown

  bool operator==(const Notice& other) const { return state == other.state && message == other.message; }
};

/// A value on a path: nothing (sent as null), a number in SI units, text, or a notification.
using Value = std::variant<std::monostate, double, std::string, Notice>;

struct Figure {
  const char* path;   ///< below the prefix
  const char* units;  ///< SI; empty for text
  const char* description;
  bool limited;  ///< the limits of utilisation apply: the server raises its alarm from them
  Value (*value)(const ReleaseFigures& release);
};

/// The table. A figure more is a line more in src/vessel/figures.cpp.
const std::vector<Figure>& figures();

/// What the release itself is an alarm for: standing still in the slot, or a prediction that has stopped.
Notice release_notice(const ReleaseFigures& release);

}  // namespace geocontainer_mpm::vessel
