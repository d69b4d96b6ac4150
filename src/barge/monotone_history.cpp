#include "geocontainer_mpm/barge/monotone_history.h"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace geocontainer_mpm::barge {
namespace {

double seconds(std::int64_t ns)
{
  return static_cast<double>(ns) / 1e9;
}

// Slope at the knot between two chords of lengths h0, h1 in time and slopes d0, d1.
double harmonic_slope(double h0, double d0, double h1, double d1)
{
  if (!(d0 * d1 > 0.0))
    return 0.0;
  const double w0 = 2.0 * h1 + h0;
  const double w1 = h1 + 2.0 * h0;
  return (w0 + w1) / (w0 / d0 + w1 / d1);
}

}  // namespace

void MonotoneHistory::append(std::int64_t time_ns, const Pair& value)
{
  const Knot added{ time_ns, seconds(time_ns), value, { 0.0, 0.0 } };
  const std::size_t n = knots_.size();
  if (n < 2) {
    knots_.push_back(added);
    return;
  }
  const Knot& before = knots_[n - 2];
  Knot& middle = knots_[n - 1];
  if (before.value == middle.value && middle.value == value) {
    middle = added;
    return;
  }
  const double h0 = seconds(middle.time_ns - before.time_ns);
  const double h1 = seconds(time_ns - middle.time_ns);
  for (std::size_t i = 0; i < 2; ++i)
    middle.rate[i] =
        harmonic_slope(h0, (middle.value[i] - before.value[i]) / h0, h1, (value[i] - middle.value[i]) / h1);
  knots_.push_back(added);
}

double MonotoneHistory::settled_until_s() const
{
  if (knots_.empty())
    return -1.0;
  // The slope at the last knot is still open, unless what leads to it is flat: then it is zero whatever follows.
  const std::size_t n = knots_.size();
  const bool slope_known = n == 1 || knots_[n - 2].value == knots_[n - 1].value;
  return knots_[slope_known ? n - 1 : n - 2].time_s;
}

std::size_t MonotoneHistory::interval(double time_s) const
{
  const auto later = std::upper_bound(knots_.begin(), knots_.end(), time_s,
                                      [](double time, const Knot& knot) { return time < knot.time_s; });
  return later == knots_.begin() ? knots_.size() : static_cast<std::size_t>(later - knots_.begin()) - 1;
}

MonotoneHistory::Pair MonotoneHistory::value(double time_s) const
{
  if (knots_.empty())
    return { 0.0, 0.0 };
  const std::size_t k = interval(time_s);
  if (k == knots_.size())
    return knots_.front().value;
  if (k + 1 == knots_.size())
    return knots_.back().value;
  const Knot& a = knots_[k];
  const Knot& b = knots_[k + 1];
  const double h = seconds(b.time_ns - a.time_ns);
  const double s = std::min((time_s - a.time_s) / h, 1.0);
  const double r = 1.0 - s;
  Pair result;
  for (std::size_t i = 0; i < 2; ++i) {
    const double rise = s * s * (3.0 - 2.0 * s) * (b.value[i] - a.value[i]);
    const double bend = h * s * r * (r * a.rate[i] - s * b.rate[i]);
    // Rounding must not leave the range of the knots.
    const auto [low, high] = std::minmax(a.value[i], b.value[i]);
    result[i] = std::clamp(a.value[i] + rise + bend, low, high);
  }
  return result;
}

MonotoneHistory::Pair MonotoneHistory::rate(double time_s) const
{
  const std::size_t k = interval(time_s);
  if (k >= knots_.size() || k + 1 == knots_.size())
    return { 0.0, 0.0 };
  const Knot& a = knots_[k];
  const Knot& b = knots_[k + 1];
  const double h = seconds(b.time_ns - a.time_ns);
  const double s = std::min((time_s - a.time_s) / h, 1.0);
  const double r = 1.0 - s;
  Pair result;
  for (std::size_t i = 0; i < 2; ++i)
    result[i] =
        6.0 * s * r * (b.value[i] - a.value[i]) / h + r * (1.0 - 3.0 * s) * a.rate[i] + s * (3.0 * s - 2.0) * b.rate[i];
  return result;
}

double MonotoneHistory::next_motion_s(double time_s) const
{
  std::size_t k = interval(time_s);
  if (k == knots_.size())
    k = 0;
  // Flat runs are two knots long, so this ends after one or two rounds.
  for (; k + 1 < knots_.size(); ++k) {
    if (knots_[k].value != knots_[k + 1].value)
      return std::max(time_s, knots_[k].time_s);
  }
  return std::numeric_limits<double>::infinity();
}

}  // namespace geocontainer_mpm::barge
