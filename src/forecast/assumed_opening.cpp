#include "geocontainer_mpm/forecast/assumed_opening.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "geocontainer_mpm/error.h"

namespace geocontainer_mpm::forecast {
namespace {

using barge::OpeningAngles;
using barge::OpeningPoint;

/// Between the samples that stand for the assumed opening: 20 Hz, as logs have.
constexpr std::int64_t sample_interval_ns = 50'000'000;

OpeningAngles between(const OpeningPoint& a, const OpeningPoint& b, double time_s)
{
  const double part = (time_s - a.time_s) / (b.time_s - a.time_s);
  return { a.angles.port_rad + part * (b.angles.port_rad - a.angles.port_rad),
           a.angles.starboard_rad + part * (b.angles.starboard_rad - a.angles.starboard_rad) };
}

/// How long until a half stops, s.
double time_to_stop(double angle_rad, double rate, double full_rad)
{
  if (rate > 0.0)
    return std::max(0.0, (full_rad - angle_rad) / rate);
  return rate < 0.0 ? std::max(0.0, -angle_rad / rate) : 0.0;
}

void check_point(const std::vector<OpeningPoint>& points, std::size_t i, const barge::OpeningSignalParameters& signal,
                 const std::string& key)
{
  const OpeningPoint& point = points[i];
  const std::string at = fmt::format("{}[{}]", key, i);
  if (!std::isfinite(point.time_s))
    throw InputError("", at, fmt::format("{}", point.time_s), "the time must be a number");
  for (const double angle : { point.angles.port_rad, point.angles.starboard_rad })
    if (!(angle >= signal.min_angle_rad && angle <= signal.max_angle_rad))
      throw InputError("", at, fmt::format("{} rad", angle),
                       fmt::format("angles must lie in hull.signal's range [{}, {}] rad", signal.min_angle_rad,
                                   signal.max_angle_rad));
  if (i == 0)
    return;
  const OpeningPoint& before = points[i - 1];
  const double step = point.time_s - before.time_s;
  if (!(step > 0.0))
    throw InputError("", at, fmt::format("{} s", point.time_s), "times must increase");
  const double turned = std::max(std::abs(point.angles.port_rad - before.angles.port_rad),
                                 std::abs(point.angles.starboard_rad - before.angles.starboard_rad));
  if (turned > signal.max_rate_rad_per_s * step)
    throw InputError(
        "", at, fmt::format("{:.4g} rad/s", turned / step),
        fmt::format("must not be faster than hull.signal.max_rate_rad_per_s = {}", signal.max_rate_rad_per_s));
}

}  // namespace

AssumedOpening::AssumedOpening(Assumption assumption, std::vector<OpeningPoint> points)
    : assumption_(assumption), points_(std::move(points))
{
}

AssumedOpening AssumedOpening::at_rate(double from_s, OpeningAngles from, OpeningAngles rate, double full_rad)
{
  const double port = time_to_stop(from.port_rad, rate.port_rad, full_rad);
  const double starboard = time_to_stop(from.starboard_rad, rate.starboard_rad, full_rad);
  std::vector<OpeningPoint> points{ { from_s, from } };
  for (const double after : { std::min(port, starboard), std::max(port, starboard) })
    if (after > points.back().time_s - from_s)
      points.push_back({ from_s + after,
                         { from.port_rad + rate.port_rad * std::min(after, port),
                           from.starboard_rad + rate.starboard_rad * std::min(after, starboard) } });
  return AssumedOpening(Assumption::measured, std::move(points));
}

AssumedOpening AssumedOpening::planned(std::vector<OpeningPoint> points,
                                       const barge::OpeningSignalParameters& parameters, const std::string& key)
{
  if (points.empty())
    throw InputError("", key, "", "must have at least one point");
  for (std::size_t i = 0; i < points.size(); ++i)
    check_point(points, i, parameters, key);
  return AssumedOpening(Assumption::plan, std::move(points));
}

OpeningAngles AssumedOpening::at(double time_s) const
{
  const auto after = std::upper_bound(points_.begin(), points_.end(), time_s,
                                      [](double time, const OpeningPoint& point) { return time < point.time_s; });
  if (after == points_.begin())
    return points_.front().angles;
  if (after == points_.end())
    return points_.back().angles;
  return between(*(after - 1), *after, time_s);
}

double AssumedOpening::departure(double time_s, const OpeningAngles& measured) const
{
  const OpeningAngles assumed = at(time_s);
  return std::max(std::abs(measured.port_rad - assumed.port_rad),
                  std::abs(measured.starboard_rad - assumed.starboard_rad));
}

barge::OpeningSignal AssumedOpening::continue_from(const barge::OpeningSignal& so_far, double settle_s) const
{
  barge::OpeningSignal opening = so_far;
  const std::int64_t origin_ns = so_far.origin_ns(), last_ns = so_far.last_accepted().stamp_ns - origin_ns;
  const std::int64_t end_ns =
      std::max<std::int64_t>(last_ns, std::llround((end_s() + settle_s) * 1e9)) + sample_interval_ns;
  for (std::int64_t time_ns = last_ns + sample_interval_ns; time_ns <= end_ns; time_ns += sample_interval_ns)
    opening.add({ origin_ns + time_ns, at(static_cast<double>(time_ns) / 1e9) });
  opening.finish();
  return opening;
}

void RecentSamples::add(double time_s, const OpeningAngles& angles)
{
  samples_.push_back({ time_s, angles });
  while (samples_.front().time_s < time_s - window_s_)
    samples_.pop_front();
}

RecentSamples::Trend RecentSamples::trend() const
{
  const double newest_s = samples_.back().time_s, count = static_cast<double>(samples_.size());
  double t = 0.0, port = 0.0, starboard = 0.0;
  for (const OpeningPoint& sample : samples_) {
    t += sample.time_s - newest_s;
    port += sample.angles.port_rad;
    starboard += sample.angles.starboard_rad;
  }
  t /= count;
  port /= count;
  starboard /= count;
  double tt = 0.0, t_port = 0.0, t_starboard = 0.0;
  for (const OpeningPoint& sample : samples_) {
    const double dt = sample.time_s - newest_s - t;
    tt += dt * dt;
    t_port += dt * (sample.angles.port_rad - port);
    t_starboard += dt * (sample.angles.starboard_rad - starboard);
  }
  const OpeningAngles rate = tt > 0.0 ? OpeningAngles{ t_port / tt, t_starboard / tt } : OpeningAngles{};
  return { { port - rate.port_rad * t, starboard - rate.starboard_rad * t }, rate };
}

}  // namespace geocontainer_mpm::forecast
