// The cubic through the knots: no overshoot, continuous rate, nothing changes once it is settled.

#include "geocontainer_mpm/barge/monotone_history.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

namespace geocontainer_mpm::barge {
namespace {

using Pair = MonotoneHistory::Pair;
constexpr std::int64_t second_ns = 1'000'000'000;

struct Knot {
  std::int64_t time_ns;
  Pair value;
};

// Knots 1 ms to 2 s apart; small integers as values make flat runs frequent.
std::vector<Knot> any_knots()
{
  const int count = *rc::gen::inRange(2, 30);
  std::vector<Knot> knots;
  std::int64_t time_ns = 0;
  for (int i = 0; i < count; ++i) {
    knots.push_back({ time_ns, { *rc::gen::inRange(-3, 4) * 0.1, *rc::gen::inRange(-3, 4) * 0.1 } });
    time_ns += *rc::gen::inRange<std::int64_t>(1, 2000) * 1'000'000;
  }
  return knots;
}

MonotoneHistory through(const std::vector<Knot>& knots)
{
  MonotoneHistory history;
  for (const Knot& knot : knots)
    history.append(knot.time_ns, knot.value);
  return history;
}

double seconds(std::int64_t ns)
{
  return static_cast<double>(ns) / 1e9;
}

RC_GTEST_PROP(MonotoneHistory, PassesThroughItsKnotsAndNeverOvershoots, ())
{
  const std::vector<Knot> knots = any_knots();
  const MonotoneHistory history = through(knots);
  for (std::size_t k = 0; k + 1 < knots.size(); ++k) {
    const double t0 = seconds(knots[k].time_ns);
    const double t1 = seconds(knots[k + 1].time_ns);
    for (std::size_t i = 0; i < 2; ++i) {
      const double a = knots[k].value[i];
      const double b = knots[k + 1].value[i];
      RC_ASSERT(history.value(t0)[i] == a);
      const double sign = b >= a ? 1.0 : -1.0;
      double before = a;
      for (int n = 1; n <= 40; ++n) {
        const double now = history.value(t0 + (t1 - t0) * n / 40.0)[i];
        RC_ASSERT(sign * (now - before) >= -1e-15);
        before = now;
      }
      RC_ASSERT(std::abs(before - b) < 1e-12);
    }
  }
}

RC_GTEST_PROP(MonotoneHistory, RateIsTheDerivativeAndAtMostOneAndAHalfTimesTheSteepestChordNearby, ())
{
  const std::vector<Knot> knots = any_knots();
  const MonotoneHistory history = through(knots);
  const auto chord = [&knots](std::size_t k, std::size_t i) {
    return k + 1 < knots.size()
               ? std::abs(knots[k + 1].value[i] - knots[k].value[i]) / seconds(knots[k + 1].time_ns - knots[k].time_ns)
               : 0.0;
  };
  for (std::size_t k = 0; k + 1 < knots.size(); ++k) {
    const double t0 = seconds(knots[k].time_ns);
    const double h = seconds(knots[k + 1].time_ns) - t0;
    for (std::size_t i = 0; i < 2; ++i) {
      const double steepest = std::max({ k > 0 ? chord(k - 1, i) : 0.0, chord(k, i), chord(k + 1, i) });
      for (int n = 1; n < 20; ++n) {
        const double t = t0 + h * n / 20.0;
        const double rate = history.rate(t)[i];
        RC_ASSERT(std::abs(rate) <= 1.5 * steepest + 1e-12);
        const double d = 1e-3 * h;
        const double difference = (history.value(t + d)[i] - history.value(t - d)[i]) / (2.0 * d);
        RC_ASSERT(std::abs(rate - difference) <= 1e-4 * (1.0 + steepest));
      }
    }
  }
}

RC_GTEST_PROP(MonotoneHistory, SettledPartKeepsItsBits, ())
{
  const std::vector<Knot> knots = any_knots();
  const MonotoneHistory whole = through(knots);
  MonotoneHistory growing;
  double settled_before = -1.0;
  for (const Knot& knot : knots) {
    growing.append(knot.time_ns, knot.value);
    const double settled = growing.settled_until_s();
    RC_ASSERT(settled >= settled_before);
    settled_before = settled;
    for (int n = 0; n <= 30; ++n) {
      const double t = std::min(settled * n / 30.0, settled);
      RC_ASSERT(growing.value(t) == whole.value(t));
    }
    RC_ASSERT(growing.value(settled) == whole.value(settled));
  }
}

RC_GTEST_PROP(MonotoneHistory, NextMotionIsTheEndOfTheFlatRun, ())
{
  const std::vector<Knot> knots = any_knots();
  const MonotoneHistory history = through(knots);
  const double t = seconds(knots.back().time_ns) * *rc::gen::inRange(0, 1001) / 1000.0;
  // By hand from the knots: the first one at or after the interval of t whose successor differs.
  double expected = INFINITY;
  for (std::size_t k = 0; k + 1 < knots.size() && !std::isfinite(expected); ++k) {
    if (seconds(knots[k + 1].time_ns) > t && knots[k].value != knots[k + 1].value)
      expected = std::max(t, seconds(knots[k].time_ns));
  }
  RC_ASSERT(history.next_motion_s(t) == expected);
}

TEST(MonotoneHistory, FlatRunTakesNoMemory)
{
  MonotoneHistory history;
  for (std::int64_t i = 0; i < 100000; ++i)
    history.append(i * second_ns / 20, { 0.1, 0.2 });
  EXPECT_EQ(history.knot_count(), 2U);
  EXPECT_DOUBLE_EQ(history.settled_until_s(), 99999 / 20.0);
}

TEST(MonotoneHistory, IsFlatOutsideItsKnots)
{
  MonotoneHistory history;
  EXPECT_LT(history.settled_until_s(), 0.0);
  history.append(second_ns, { 0.1, 0.2 });
  history.append(2 * second_ns, { 0.3, 0.1 });
  EXPECT_EQ(history.value(0.0), (Pair{ 0.1, 0.2 }));
  EXPECT_EQ(history.value(9.0), (Pair{ 0.3, 0.1 }));
  EXPECT_EQ(history.rate(0.5), (Pair{ 0.0, 0.0 }));
  EXPECT_EQ(history.rate(9.0), (Pair{ 0.0, 0.0 }));
  EXPECT_DOUBLE_EQ(history.next_motion_s(0.2), 1.0);
}

}  // namespace
}  // namespace geocontainer_mpm::barge
