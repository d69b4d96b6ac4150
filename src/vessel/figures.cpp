#include "geocontainer_mpm/vessel/figures.h"

#include <cmath>

namespace geocontainer_mpm::vessel {
namespace {

Value known(double value)
{
  return std::isfinite(value) ? Value(value) : Value();
}

using Release = const ReleaseFigures&;

}  // namespace

const char* to_string(ReleaseState state)
{
  switch (state) {
    case ReleaseState::waiting:
      return "waiting";
    case ReleaseState::releasing:
      return "releasing";
    case ReleaseState::released:
      return "released";
    case ReleaseState::hung_up:
      return "hung_up";
    case ReleaseState::none:
      break;
  }
  return "none";
}

const std::vector<Figure>& figures()
{
  static const std::vector<Figure> table = {
    { "hull.port.opening", "rad", "Rotation of the port half from closed, opening positive", false,
      [](Release r) { return known(r.port_rad); } },
    { "hull.starboard.opening", "rad", "Rotation of the starboard half from closed, opening positive", false,
      [](Release r) { return known(r.starboard_rad); } },
    { "release.state", "", "waiting, releasing, released, hung_up or none", false,
      [](Release r) { return Value(to_string(r.state)); } },
    { "release.message", "", "One sentence for the superintendent", false, [](Release r) { return Value(r.message); } },
    { "release.time", "s", "From the start of the log until all of the container was below the lips", false,
      [](Release r) { return r.release_time_s >= 0.0 ? known(r.release_time_s) : Value(); } },
    { "tension.current", "N/m", "Largest tension of the geotextile now, per metre of width", false,
      [](Release r) { return known(r.current_tension_n_per_m); } },
    { "tension.peak", "N/m", "Largest tension so far", false, [](Release r) { return known(r.peak_tension_n_per_m); } },
    { "tension.residual", "N/m", "Tension that stays once the released container rests", false,
      [](Release r) {
        return r.state == ReleaseState::released && r.resting ? known(r.current_tension_n_per_m) : Value();
      } },
    { "utilisation.peak", "ratio", "Largest tension so far over the strength of the seam", true,
      [](Release r) { return known(r.peak_utilisation); } },
    { "centroid.x", "m", "Centroid of the fill, forward", false, [](Release r) { return known(r.centroid_m[0]); } },
    { "centroid.y", "m", "Centroid of the fill, to port", false, [](Release r) { return known(r.centroid_m[1]); } },
    { "centroid.z", "m", "Centroid of the fill, up", false, [](Release r) { return known(r.centroid_m[2]); } },
    { "width", "m", "Extent of the container across the barge", false, [](Release r) { return known(r.width_m); } },
    { "height", "m", "Extent of the container upwards", false, [](Release r) { return known(r.height_m); } },
    { "lag", "s", "How far the prediction is behind the newest measurement", false,
      [](Release r) { return known(r.lag_s); } },
  };
  return table;
}

Notice release_notice(const ReleaseFigures& release)
{
  const std::string state = release.state == ReleaseState::hung_up ? "alarm" : release.stopped ? "warn" : "normal";
  return { state, release.message, state == "alarm" };
}

}  // namespace geocontainer_mpm::vessel
