#include "geocontainer_mpm/vessel/figures.h"

#include <algorithm>
#include <cmath>

namespace geocontainer_mpm::vessel {
namespace {

Value known(double value)
{
  return std::isfinite(value) ? Value(value) : Value();
}

/// To a thousandth: what is drawn need not be exact, and is shorter on the wire.
double short_number(double value)
{
  return std::round(1e3 * value) / 1e3;
}

using Release = const ReleaseFigures&;
using Forecast = const ForecastFigures&;
using Ensemble = const EnsembleFigures&;
using Section = const SectionFigures&;

Value advised(Ensemble e, double figure)
{
  return e.advice == AdviceState::rate || e.advice == AdviceState::rate_so_far ? known(figure) : Value();
}

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

const char* to_string(AdviceState advice)
{
  switch (advice) {
    case AdviceState::any_rate:
      return "any_rate";
    case AdviceState::rate:
      return "rate";
    case AdviceState::rate_so_far:
      return "rate_so_far";
    case AdviceState::no_rate:
      return "no_rate";
    case AdviceState::none:
      break;
  }
  return "none";
}

const std::vector<Figure<ReleaseFigures>>& release_figures()
{
  static const std::vector<Figure<ReleaseFigures>> table = {
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

const std::vector<Figure<ForecastFigures>>& forecast_figures()
{
  static const std::vector<Figure<ForecastFigures>> table = {
    { "forecast.state", "", "fresh, or stale: the hull has left the opening that was assumed", false,
      [](Forecast f) { return Value(f.stale ? "stale" : "fresh"); } },
    { "forecast.message", "", "One sentence for the superintendent", false,
      [](Forecast f) { return Value(f.message); } },
    { "forecast.outcome", "", "At the end of the horizon: waiting, releasing, released, hung_up or none; ruptured",
      false, [](Forecast f) { return Value(f.ruptured ? "ruptured" : to_string(f.outcome)); } },
    { "forecast.release.instant", "", "When all of the container will be below the lips; null: not within the horizon",
      false, [](Forecast f) { return f.release ? Value(format_utc(*f.release)) : Value(); } },
    { "forecast.release.delay", "s", "The same from the newest measurement that the forecast knew of", false,
      [](Forecast f) { return f.release ? known(f.until_release_s) : Value(); } },
    { "forecast.tension.peak", "N/m", "Largest tension up to the end of the horizon, so far included", false,
      [](Forecast f) { return known(f.peak_tension_n_per_m); } },
    { "forecast.utilisation.peak", "ratio", "The same over the strength of sheet or seam, whichever is more", false,
      [](Forecast f) { return known(f.peak_utilisation); } },
    { "forecast.curve", "", "time (s since 1970, UTC) and tension (N/m), largest at each instant", false,
      [](Forecast f) { return f.curve.empty() ? Value() : Value(f.curve); } },
  };
  return table;
}

const std::vector<Figure<EnsembleFigures>>& ensemble_figures()
{
  static const std::vector<Figure<EnsembleFigures>> table = {
    { "ensemble.members", "", "Runs that have come to their end", false, [](Ensemble e) { return known(e.members); } },
    { "ensemble.tension.p10", "N/m", "Peak tension, below it a tenth of the runs", false,
      [](Ensemble e) { return known(e.peak_tension_n_per_m.p10); } },
    { "ensemble.tension.p50", "N/m", "Peak tension, below it half of the runs", false,
      [](Ensemble e) { return known(e.peak_tension_n_per_m.p50); } },
    { "ensemble.tension.p90", "N/m", "Peak tension, below it nine tenths of the runs", false,
      [](Ensemble e) { return known(e.peak_tension_n_per_m.p90); } },
    { "ensemble.tension.curve", "", "time (s since 1970, UTC) and p10, p50, p90 (N/m) of the tension over time", false,
      [](Ensemble e) { return e.tension.empty() ? Value() : Value(e.tension); } },
    { "ensemble.utilisation.p10", "ratio", "Peak utilisation of sheet or seam, below it a tenth of the runs", false,
      [](Ensemble e) { return known(e.peak_utilisation.p10); } },
    { "ensemble.utilisation.p50", "ratio", "Peak utilisation of sheet or seam, below it half of the runs", false,
      [](Ensemble e) { return known(e.peak_utilisation.p50); } },
    { "ensemble.utilisation.p90", "ratio", "Peak utilisation of sheet or seam, below it nine tenths of the runs", false,
      [](Ensemble e) { return known(e.peak_utilisation.p90); } },
    { "ensemble.release.p10", "s", "Until it is out, from the stamp, below it a tenth of the runs; null: never", false,
      [](Ensemble e) { return known(e.release_delay_s.p10); } },
    { "ensemble.release.p50", "s", "Until it is out, from the stamp, below it half of the runs; null: never", false,
      [](Ensemble e) { return known(e.release_delay_s.p50); } },
    { "ensemble.release.p90", "s", "Until it is out, from the stamp, below it nine tenths of the runs; null: never",
      false, [](Ensemble e) { return known(e.release_delay_s.p90); } },
    { "ensemble.width.p10", "m", "Width at rest, below it a tenth of the runs", false,
      [](Ensemble e) { return known(e.final_width_m.p10); } },
    { "ensemble.width.p50", "m", "Width at rest, below it half of the runs", false,
      [](Ensemble e) { return known(e.final_width_m.p50); } },
    { "ensemble.width.p90", "m", "Width at rest, below it nine tenths of the runs", false,
      [](Ensemble e) { return known(e.final_width_m.p90); } },
    { "ensemble.probability.hung_up", "ratio", "Part of the runs that stand still in the slot", false,
      [](Ensemble e) { return known(e.hung_up); } },
    { "ensemble.probability.ruptured", "ratio", "Part of the runs in which sheet or seam tears", false,
      [](Ensemble e) { return known(e.ruptured); } },
    { "advice.state", "", "none, any_rate, rate, rate_so_far (others are being tried) or no_rate", false,
      [](Ensemble e) { return Value(to_string(e.advice)); } },
    { "advice.rate", "rad/s", "Fastest constant opening rate of each half that keeps the limit; null without", false,
      [](Ensemble e) { return advised(e, e.advised_rate_rad_per_s); } },
    { "advice.slowest", "rad/s", "Rates of each half below it do not keep the limit, or are not tried; 0: they do",
      false, [](Ensemble e) { return advised(e, e.slowest_rate_rad_per_s); } },
    { "advice.utilisation", "ratio", "Utilisation at that rate, below it nine tenths of the runs", false,
      [](Ensemble e) { return advised(e, e.advised_utilisation); } },
    { "advice.message", "", "One sentence for the superintendent", false,
      [](Ensemble e) { return Value(e.advice_message); } },
  };
  return table;
}

const std::vector<Figure<SectionFigures>>& section_figures()
{
  static const std::vector<Figure<SectionFigures>> table = {
    { "shape", "", "Outline of the geotextile: y (to port) and z (up) in m from the hinge, utilisation of its pieces",
      false, [](Section s) { return s.outline.empty() ? Value() : Value(s.outline); } },
  };
  return table;
}

Columns thin_outline(const std::vector<double>& y, const std::vector<double>& z, const std::vector<double>& utilisation)
{
  const std::size_t points = y.size();
  const std::size_t pieces = utilisation.size();
  const std::size_t stride = (points + most_points - 1) / most_points;
  Columns outline{ { "y", {} }, { "z", {} }, { "utilisation", {} } };
  for (std::size_t first = 0; first < points; first += stride) {
    outline["y"].push_back(short_number(y[first]));
    outline["z"].push_back(short_number(z[first]));
    const auto begin = utilisation.begin() + static_cast<std::ptrdiff_t>(std::min(first, pieces));
    const auto end = utilisation.begin() + static_cast<std::ptrdiff_t>(std::min(first + stride, pieces));
    if (begin != end)
      outline["utilisation"].push_back(short_number(*std::max_element(begin, end)));
  }
  // An open sheet ends where it ends.
  if (pieces < points && points > 0 && (points - 1) % stride != 0) {
    outline["y"].push_back(short_number(y.back()));
    outline["z"].push_back(short_number(z.back()));
  }
  return outline;
}

Columns thin_curve(const std::vector<double>& time, const std::vector<double>& tension)
{
  Columns curve{ { "time", {} }, { "tension", {} } };
  const std::size_t count = time.size();
  const auto keep = [&](std::size_t i) {
    curve["time"].push_back(short_number(time[i]));
    curve["tension"].push_back(std::round(tension[i]));
  };
  if (count == 0)
    return curve;
  keep(0);
  const std::size_t inner = count > 2 ? count - 2 : 0;
  const std::size_t stretches = std::min(inner, most_points - 2);
  for (std::size_t s = 0; s < stretches; ++s) {
    const auto begin = tension.begin() + static_cast<std::ptrdiff_t>(1 + s * inner / stretches);
    const auto end = tension.begin() + static_cast<std::ptrdiff_t>(1 + (s + 1) * inner / stretches);
    keep(static_cast<std::size_t>(std::max_element(begin, end) - tension.begin()));
  }
  if (count > 1)
    keep(count - 1);
  return curve;
}

Columns thin_band(const std::vector<double>& time, const Columns& curves)
{
  Columns band{ { "time", {} } };
  const std::size_t count = time.size(), stretches = std::min(count, most_points);
  for (std::size_t s = 0; s < stretches; ++s) {
    const auto begin = static_cast<std::ptrdiff_t>(s * count / stretches);
    const auto end = static_cast<std::ptrdiff_t>((s + 1) * count / stretches);
    band["time"].push_back(short_number(time[static_cast<std::size_t>(end - 1)]));
    for (const auto& [name, values] : curves)
      band[name].push_back(std::round(*std::max_element(values.begin() + begin, values.begin() + end)));
  }
  return band;
}

Notice release_notice(const ReleaseFigures& release)
{
  const std::string state = release.state == ReleaseState::hung_up ? "alarm" : release.stopped ? "warn" : "normal";
  return { state, release.message, state == "alarm", false };
}

}  // namespace geocontainer_mpm::vessel
