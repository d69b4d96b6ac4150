#include "geocontainer_mpm/ros/forecast_messages.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geocontainer_mpm/ensemble/members.h"
#include "geocontainer_mpm/ros/conversions.h"
#include "message_parts.h"

namespace geocontainer_mpm::ros_bridge {
namespace {

using forecast::EnsembleForecast;
using forecast::Forecast;
using forecast::Instant;
using forecast::Verdict;

ros::Time stamp_of(std::int64_t origin_ns, double time_s)
{
  return to_time(origin_ns + std::llround(time_s * 1e9), ros::Time());
}

double largest_utilisation(const scene::StatusFrame& status)
{
  return std::max(status.peak_utilisation_sheet, status.peak_utilisation_seam);
}

/// First instant from which the utilisation is at `limit`; none: 0.
ros::Time exceeded(const Forecast& forecast, double limit)
{
  for (const Instant& instant : forecast.instants)
    if (instant.utilisation >= limit)
      return stamp_of(forecast.origin_ns, instant.time_s);
  return {};
}

double tension_at_release(const Forecast& forecast)
{
  const double release_s = forecast.status.release_time_s;
  if (release_s < 0.0)
    return 0.0;
  const auto after = std::find_if(forecast.instants.begin(), forecast.instants.end(),
                                  [&](const Instant& instant) { return instant.time_s >= release_s; });
  return after == forecast.instants.end() ? forecast.instants.back().peak_tension_n_per_m : after->peak_tension_n_per_m;
}

std::string outcome_ahead(const Forecast& forecast)
{
  const scene::StatusFrame& status = forecast.status;
  switch (status.outcome) {
    case scene::Outcome::released:
      if (status.release_time_s <= forecast.from_s)
        return "The container has left the hull";
      return fmt::format("The container will leave the hull {:.0f} s from now",
                         std::max(0.0, status.release_time_s - forecast.newest_s));
    case scene::Outcome::hung_up:
      return "The container will hang in the slot";
    case scene::Outcome::releasing:
      return fmt::format("The container will not have left the hull within {:.0f} s",
                         forecast.until_s - forecast.from_s);
    case scene::Outcome::waiting:
      return "The container will stay in the hull";
    case scene::Outcome::none:
      break;
  }
  return "Nothing to release in this scene";
}

std::string sentence(const Forecast& forecast, bool stale)
{
  std::string text = outcome_ahead(forecast);
  const scene::StatusFrame& status = forecast.status;
  text += fmt::format("; largest tension {:.0f} kN/m, {:.0f} % of what the geotextile bears",
                      status.peak_tension_n_per_m / 1e3, 100.0 * largest_utilisation(status));
  if (status.ruptures > 0)
    text += "; it will tear";
  if (!forecast.stopped.empty())
    text += fmt::format("; computed to {:.1f} s only: {}", forecast.until_s, forecast.stopped);
  if (stale)
    text += "; the hull has departed from the opening that was assumed";
  return text;
}

Quantiles quantiles_of(const ensemble::FigureSummary& summary, double from = 0.0)
{
  Quantiles quantiles;
  quantiles.p10 = summary.p10 - from;
  quantiles.p50 = summary.p50 - from;
  quantiles.p90 = summary.p90 - from;
  return quantiles;
}

std::vector<double> correlations_of(const ensemble::FigureSummary& summary)
{
  std::vector<double> values;
  for (const std::optional<double>& correlation : summary.rank_correlation)
    values.push_back(correlation.value_or(0.0));
  return values;
}

std::string rates(const forecast::Advice& advice)
{
  const double fastest = advice.rate_rad_per_s * degrees_per_radian;
  const double slowest = advice.slowest_rad_per_s * degrees_per_radian;
  if (slowest == 0.0)
    return fmt::format("open with at most {:.2f} deg/s for each half", fastest);
  const std::string span =
      slowest == fastest ? fmt::format("{:.2f}", fastest) : fmt::format("{:.2f} to {:.2f}", slowest, fastest);
  return advice.complete ? fmt::format("open with {} deg/s for each half, not slower", span)
                         : fmt::format("{} deg/s for each half will do, other rates are being tried", span);
}

void add_advice(const forecast::Advice& advice, ReleaseEnsemble& message)
{
  message.advised_rate = advice.rate_rad_per_s;
  message.slowest_rate = advice.slowest_rad_per_s;
  message.advice_complete = advice.complete;
  message.advised_utilisation = advice.utilisation;
  message.utilisation_limit = advice.utilisation_limit;
  const double rate = advice.rate_rad_per_s * degrees_per_radian;
  switch (advice.verdict) {
    case Verdict::none:
      message.advice = ReleaseEnsemble::NONE_ASKED;
      return;
    case Verdict::any_rate:
      message.advice = ReleaseEnsemble::ANY_RATE;
      message.message += fmt::format("; open as fast as you like, up to {:.2f} deg/s for each half", rate);
      return;
    case Verdict::rate:
      message.advice = ReleaseEnsemble::RATE;
      message.message += "; " + rates(advice);
      return;
    case Verdict::no_rate:
      message.advice = ReleaseEnsemble::NO_RATE;
      message.message += "; no opening rate that was tried keeps the geotextile below its limit";
      return;
  }
}

}  // namespace

std::string first_non_finite(const Forecast& forecast)
{
  const scene::StatusFrame& status = forecast.status;
  for (const double value : { status.release_time_s, status.peak_tension_n_per_m, status.peak_tension_time_s,
                              status.peak_utilisation_sheet, status.peak_utilisation_seam, forecast.from_s })
    if (!std::isfinite(value))
      return "status of the forecast";
  if (!status.peak_tension_position_m.allFinite())
    return "place of the forecast's peak";
  for (const Instant& instant : forecast.instants)
    for (const double value :
         { instant.time_s, instant.opening.port_rad, instant.opening.starboard_rad, instant.tension_n_per_m,
           instant.peak_tension_n_per_m, instant.utilisation, instant.width_m, instant.centroid_m.sum() })
      if (!std::isfinite(value))
        return fmt::format("forecast of {} s", instant.time_s);
  return "";
}

ReleaseForecast to_release_forecast(const Forecast& forecast, bool stale, const alarm::Limits& limits,
                                    const std::string& barge_frame)
{
  const scene::StatusFrame& status = forecast.status;
  ReleaseForecast message;
  message.header.stamp = stamp_of(forecast.origin_ns, forecast.from_s);
  message.header.frame_id = barge_frame;
  message.stale = stale;
  message.assumption =
      forecast.assumption == forecast::Assumption::plan ? ReleaseForecast::PLAN : ReleaseForecast::MEASURED;
  for (const Instant& instant : forecast.instants) {
    message.stamps.push_back(stamp_of(forecast.origin_ns, instant.time_s));
    message.port.push_back(instant.opening.port_rad);
    message.starboard.push_back(instant.opening.starboard_rad);
    message.tension.push_back(instant.tension_n_per_m);
    message.peak_tension.push_back(instant.peak_tension_n_per_m);
    message.utilisation.push_back(instant.utilisation);
    message.centroid.push_back(to_point(instant.centroid_m));
    message.width.push_back(instant.width_m);
  }
  message.outcome = to_message(status.outcome);
  message.ruptured = status.ruptures > 0;
  message.message = sentence(forecast, stale);
  if (status.release_time_s >= 0.0)
    message.release_time = stamp_of(forecast.origin_ns, status.release_time_s);
  message.release_tension = tension_at_release(forecast);
  message.peak_tension_time = stamp_of(forecast.origin_ns, status.peak_tension_time_s);
  message.peak_tension_position = to_point(status.peak_tension_position_m);
  message.exceeds_warn_time = exceeded(forecast, limits.warn);
  message.exceeds_alarm_time = exceeded(forecast, limits.alarm);
  message.age = std::max(0.0, forecast.newest_s - forecast.from_s);
  message.cost = forecast.cost_s;
  return message;
}

ReleaseEnsemble to_release_ensemble(const EnsembleForecast& ensemble)
{
  const ensemble::Summary& summary = ensemble.summary;
  ReleaseEnsemble message;
  message.header.stamp = stamp_of(ensemble.origin_ns, ensemble.from_s);
  message.seed = ensemble.seed;
  message.members = static_cast<std::uint32_t>(summary.members);
  message.completed = static_cast<std::uint32_t>(summary.completed);
  message.inputs = ensemble.inputs;
  message.chance = summary.chance;
  message.cost = ensemble.cost_s;
  if (summary.figures.empty()) {
    message.message = "No member of the ensemble reached its end";
    return message;
  }
  const ensemble::FigureSummary& tension = summary.figures[ensemble::peak_tension_figure()];
  const ensemble::FigureSummary& release = summary.figures[ensemble::release_time_figure()];
  message.peak_tension = quantiles_of(tension);
  message.peak_utilisation = quantiles_of(summary.figures[ensemble::peak_utilisation_figure()]);
  message.release_delay = quantiles_of(release, ensemble.from_s);
  message.final_width = quantiles_of(summary.figures[ensemble::width_figure()]);
  message.hung_up = summary.hung_up ? summary.hung_up->value : 0.0;
  message.ruptured = summary.ruptured ? summary.ruptured->value : 0.0;
  for (const double time_s : ensemble.tension.time_s)
    message.stamps.push_back(stamp_of(ensemble.origin_ns, time_s));
  message.tension_p10 = ensemble.tension.p10;
  message.tension_p50 = ensemble.tension.p50;
  message.tension_p90 = ensemble.tension.p90;
  message.tension_correlation = correlations_of(tension);
  message.release_correlation = correlations_of(release);
  message.message =
      fmt::format("Largest tension {:.0f} to {:.0f} kN/m in eight of ten cases", tension.p10 / 1e3, tension.p90 / 1e3);
  add_advice(ensemble.advice, message);
  return message;
}

}  // namespace geocontainer_mpm::ros_bridge
