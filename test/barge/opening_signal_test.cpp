// Verdicts, filter, gaps and ends of the opening signal, one by one.

#include "geocontainer_mpm/barge/opening_signal.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "geocontainer_mpm/error.h"

namespace geocontainer_mpm::barge {
namespace {

constexpr std::int64_t epoch_ns = 1'750'150'800'000'000'000;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

OpeningSample sample(double time_s, double port_rad, double starboard_rad)
{
  return { epoch_ns + std::llround(time_s * 1e9), { port_rad, starboard_rad } };
}

OpeningSample sample(double time_s, double angle_rad)
{
  return sample(time_s, angle_rad, angle_rad);
}

// 20 Hz samples of `angle(t)` on [from, to].
template <typename Angle>
void feed(OpeningSignal& signal, double from_s, double to_s, Angle angle)
{
  for (int i = 0; from_s + i / 20.0 <= to_s + 1e-9; ++i)
    ASSERT_EQ(signal.add(sample(from_s + i / 20.0, angle(from_s + i / 20.0))), SampleVerdict::accepted);
}

double largest_rate(const OpeningSignal& signal, double from_s, double to_s)
{
  double largest = 0.0;
  for (double t = from_s; t < to_s; t += 1e-3)
    largest = std::max({ largest, std::abs(signal.rates(t).port_rad), std::abs(signal.rates(t).starboard_rad) });
  return largest;
}

class OpeningSignalTest : public testing::Test {
protected:
  OpeningSignalParameters parameters_;
  OpeningSignal signal_{ parameters_ };
};

TEST_F(OpeningSignalTest, EmptyKnowsNothing)
{
  EXPECT_TRUE(signal_.empty());
  EXPECT_EQ(signal_.origin_ns(), 0);
  EXPECT_LT(signal_.known_until_s(), 0.0);
  signal_.clock(100.0);
  EXPECT_LT(signal_.known_until_s(), 0.0);
  signal_.finish();
  EXPECT_EQ(signal_.known_until_s(), INFINITY);
  EXPECT_EQ(signal_.angles(3.0).port_rad, 0.0);
  EXPECT_EQ(signal_.next_motion_s(0.0), INFINITY);
}

TEST_F(OpeningSignalTest, TimeStartsAtTheFirstAcceptedSample)
{
  EXPECT_EQ(signal_.add(sample(0.0, nan)), SampleVerdict::non_finite);
  EXPECT_TRUE(signal_.empty());
  EXPECT_EQ(signal_.add(sample(1.0, 0.0)), SampleVerdict::accepted);
  EXPECT_FALSE(signal_.empty());
  EXPECT_EQ(signal_.origin_ns(), epoch_ns + 1'000'000'000);
}

TEST_F(OpeningSignalTest, JudgesNonFinite)
{
  EXPECT_EQ(signal_.add(sample(0.0, nan, 0.0)), SampleVerdict::non_finite);
  EXPECT_EQ(signal_.add(sample(0.0, 0.0, INFINITY)), SampleVerdict::non_finite);
  EXPECT_EQ(signal_.count(SampleVerdict::non_finite), 2U);
  EXPECT_EQ(signal_.rejected(), 2U);
}

TEST_F(OpeningSignalTest, JudgesOutOfRange)
{
  EXPECT_EQ(signal_.add(sample(0.0, 0.0, 0.71)), SampleVerdict::out_of_range);
  EXPECT_EQ(signal_.add(sample(0.0, -0.021, 0.0)), SampleVerdict::out_of_range);
  EXPECT_EQ(signal_.add({ std::numeric_limits<std::int64_t>::max(), {} }), SampleVerdict::out_of_range);
  EXPECT_EQ(signal_.add({ std::numeric_limits<std::int64_t>::min(), {} }), SampleVerdict::out_of_range);
  EXPECT_EQ(signal_.add(sample(0.0, -0.02, 0.7)), SampleVerdict::accepted);
  EXPECT_EQ(signal_.count(SampleVerdict::out_of_range), 4U);
}

TEST_F(OpeningSignalTest, JudgesDuplicateAndOutOfOrder)
{
  feed(signal_, 0.0, 2.0, [](double) { return 0.0; });
  EXPECT_EQ(signal_.add(sample(2.0, 0.0)), SampleVerdict::duplicate);
  EXPECT_EQ(signal_.add(sample(2.0, 0.001)), SampleVerdict::duplicate);
  EXPECT_EQ(signal_.add(sample(1.95, 0.0)), SampleVerdict::duplicate);
  EXPECT_EQ(signal_.add(sample(1.96, 0.0)), SampleVerdict::out_of_order);
  EXPECT_EQ(signal_.add(sample(-5.0, 0.0)), SampleVerdict::out_of_order);
  EXPECT_EQ(signal_.count(SampleVerdict::duplicate), 3U);
  EXPECT_EQ(signal_.count(SampleVerdict::out_of_order), 2U);
  EXPECT_EQ(signal_.last_accepted().stamp_ns, sample(2.0, 0.0).stamp_ns);
}

TEST_F(OpeningSignalTest, JudgesTooFastAtItsExactBound)
{
  feed(signal_, 0.0, 1.0, [](double) { return 0.0; });
  const double bound = parameters_.max_rate_rad_per_s * 0.05 + parameters_.noise_rad;
  EXPECT_EQ(signal_.add(sample(1.05, bound + 1e-9, 0.0)), SampleVerdict::too_fast);
  EXPECT_EQ(signal_.add(sample(1.05, 0.0, bound + 1e-9)), SampleVerdict::too_fast);
  EXPECT_EQ(signal_.add(sample(1.05, bound - 1e-9, 0.0)), SampleVerdict::accepted);
  EXPECT_EQ(signal_.count(SampleVerdict::too_fast), 2U);
}

TEST_F(OpeningSignalTest, RejectedSamplesLeaveNoTrace)
{
  OpeningSignal clean(parameters_);
  const auto angle = [](double t) { return 0.02 * t; };
  feed(clean, 0.0, 5.0, angle);
  for (int i = 0; i <= 100; ++i) {
    signal_.add(sample(i / 20.0, angle(i / 20.0)));
    signal_.add(sample(i / 20.0, 0.3));
    signal_.add(sample(i / 20.0 + 0.01, nan));
    signal_.add(sample(i / 20.0 - 1.0, 0.0));
    if (i % 20 == 5)
      signal_.add(sample(i / 20.0 + 0.02, angle(i / 20.0) + 0.25));
  }
  EXPECT_EQ(signal_.count(SampleVerdict::accepted), 101U);
  EXPECT_EQ(signal_.count(SampleVerdict::too_fast), 5U);
  ASSERT_EQ(signal_.known_until_s(), clean.known_until_s());
  for (double t = 0.0; t < clean.known_until_s(); t += 0.003)
    ASSERT_EQ(signal_.angles(t).port_rad, clean.angles(t).port_rad) << t;
}

TEST_F(OpeningSignalTest, PersistentChangeIsAcceptedAfterMaxGap)
{
  feed(signal_, 0.0, 2.0, [](double) { return 0.01; });
  int rejected = 0;
  double t = 2.05;
  while (signal_.add(sample(t, 0.2)) != SampleVerdict::accepted && rejected < 100) {
    EXPECT_TRUE(signal_.gaps().empty());
    ++rejected;
    t += 0.05;
  }
  // From 2.05 s on: the first one that is more than 0.5 s later is at 2.6 s.
  EXPECT_EQ(rejected, 11);
  EXPECT_EQ(signal_.count(SampleVerdict::too_fast), 11U);
  ASSERT_EQ(signal_.gaps().size(), 1U);
  EXPECT_DOUBLE_EQ(signal_.gaps()[0].from_s, 2.0);
  EXPECT_NEAR(signal_.gaps()[0].to_s, 2.6, 1e-9);
  feed(signal_, t + 0.05, t + 6.0, [](double) { return 0.2; });
  signal_.finish();
  EXPECT_NEAR(signal_.angles(t + 6.0).port_rad, 0.2, parameters_.backlash_rad + 1e-12);
  EXPECT_LE(largest_rate(signal_, 0.0, t + 6.0), parameters_.max_rate_rad_per_s);
}

TEST_F(OpeningSignalTest, SpikesThatDisagreeNeverGetIn)
{
  feed(signal_, 0.0, 1.0, [](double) { return 0.0; });
  for (int i = 1; i < 40; ++i)
    EXPECT_EQ(signal_.add(sample(1.0 + i / 20.0, i % 2 == 0 ? 0.3 : 0.6)), SampleVerdict::too_fast);
}

TEST_F(OpeningSignalTest, StillHullIsExactlyStill)
{
  std::mt19937 engine(7);
  std::normal_distribution<double> noise(0.0, 0.1 * M_PI / 180.0);
  // Closed for 60 s, opened by a ramp of 10 s, then held for 300 s.
  const auto truth = [](double t) { return 0.02 * std::clamp(t - 60.0, 0.0, 10.0); };
  feed(signal_, 0.0, 370.0, [&](double t) { return truth(t) + noise(engine); });
  signal_.finish();
  EXPECT_EQ(signal_.angles(0.0).port_rad, 0.0);
  const double starts = signal_.next_motion_s(0.0);
  EXPECT_GT(starts, 59.5);
  EXPECT_LT(starts, 61.0);
  EXPECT_EQ(signal_.angles(starts).port_rad, 0.0);
  // Open and held: at rest within 3 s and never moving again.
  EXPECT_EQ(signal_.next_motion_s(73.0), INFINITY);
  EXPECT_NEAR(signal_.angles(80.0).port_rad, 0.2, parameters_.backlash_rad);
}

TEST_F(OpeningSignalTest, ClosedHullWithNegativeOffsetIsClosed)
{
  feed(signal_, 0.0, 5.0, [](double) { return -0.015; });
  signal_.finish();
  EXPECT_EQ(signal_.angles(2.0).port_rad, 0.0);
  EXPECT_EQ(signal_.next_motion_s(0.0), INFINITY);
}

TEST_F(OpeningSignalTest, ConstantRateComesOutHalfABacklashBehind)
{
  feed(signal_, 0.0, 12.0, [](double t) { return 0.03 * t; });
  for (double t = 3.0; t < 11.0; t += 0.01) {
    EXPECT_NEAR(signal_.angles(t).port_rad, 0.03 * t - 0.5 * parameters_.backlash_rad, 1e-9);
    EXPECT_NEAR(signal_.rates(t).port_rad, 0.03, 1e-8);
  }
}

TEST_F(OpeningSignalTest, WithoutFilterItPassesThroughTheSamples)
{
  parameters_.smoothing_time_s = 0.0;
  parameters_.backlash_rad = 0.0;
  OpeningSignal signal(parameters_);
  const auto angle = [](double t) { return 0.1 - 0.1 * std::cos(0.3 * t); };
  feed(signal, 0.0, 10.0, angle);
  for (int i = 0; i < 199; ++i)
    EXPECT_NEAR(signal.angles(i / 20.0).port_rad, angle(i / 20.0), 1e-12);
}

TEST_F(OpeningSignalTest, KnownPartLagsByHalfTheWindowAndTwoSamples)
{
  feed(signal_, 0.0, 10.0, [](double t) { return 0.02 * t; });
  EXPECT_NEAR(signal_.known_until_s(), 10.0 - 0.5 - 0.05, 1e-9);
}

TEST_F(OpeningSignalTest, GapHoldsTheAngleAndCatchesUpGently)
{
  const auto angle = [](double t) { return 0.02 * t; };
  feed(signal_, 0.0, 5.0, angle);
  feed(signal_, 7.0, 15.0, angle);
  signal_.finish();
  ASSERT_EQ(signal_.gaps().size(), 1U);
  EXPECT_DOUBLE_EQ(signal_.gaps()[0].from_s, 5.0);
  EXPECT_DOUBLE_EQ(signal_.gaps()[0].to_s, 7.0);
  const double held = signal_.angles(5.0).port_rad;
  EXPECT_NEAR(held, 0.1, 0.02 * 0.5 + parameters_.backlash_rad);
  for (double t = 5.0; t <= 7.0; t += 0.01)
    EXPECT_EQ(signal_.angles(t).port_rad, held);
  EXPECT_DOUBLE_EQ(signal_.next_motion_s(5.5), 7.0);
  for (double t = 0.0; t < 15.0; t += 1e-3)
    EXPECT_LT(std::abs(signal_.angles(t + 1e-3).port_rad - signal_.angles(t).port_rad),
              1e-3 * parameters_.max_rate_rad_per_s + 1e-12);
  EXPECT_LE(largest_rate(signal_, 0.0, 15.0), parameters_.max_rate_rad_per_s);
  EXPECT_NEAR(signal_.angles(8.5).port_rad, angle(8.5), 0.5 * parameters_.backlash_rad + 1e-9);
}

TEST_F(OpeningSignalTest, LongGapCatchesUpAtTheRateLimit)
{
  feed(signal_, 0.0, 5.0, [](double) { return 0.0; });
  feed(signal_, 25.0, 40.0, [](double) { return 0.4; });
  signal_.finish();
  EXPECT_EQ(signal_.angles(25.0).port_rad, 0.0);
  EXPECT_LE(largest_rate(signal_, 0.0, 40.0), parameters_.max_rate_rad_per_s);
  // 0.4 rad at two thirds of 0.1 rad/s: six seconds.
  EXPECT_NEAR(signal_.angles(32.0).port_rad, 0.4, parameters_.backlash_rad + 1e-12);
}

TEST_F(OpeningSignalTest, SilenceJustWithinMaxGapIsNoGap)
{
  for (int i = 0; i <= 20; ++i)
    signal_.add({ epoch_ns + i * 500'000'000LL, {} });
  EXPECT_TRUE(signal_.gaps().empty());
  signal_.add({ epoch_ns + 20 * 500'000'000LL + 500'000'001LL, {} });
  EXPECT_EQ(signal_.gaps().size(), 1U);
}

TEST_F(OpeningSignalTest, ClockMakesAGapCertain)
{
  feed(signal_, 0.0, 5.0, [](double t) { return 0.02 * t; });
  signal_.clock(6.0);  // a sample stamped 5.5 s may still come
  EXPECT_TRUE(signal_.gaps().empty());
  EXPECT_LT(signal_.known_until_s(), 5.0);
  signal_.clock(6.2);
  ASSERT_EQ(signal_.gaps().size(), 1U);
  EXPECT_EQ(signal_.gaps()[0].to_s, INFINITY);
  EXPECT_NEAR(signal_.known_until_s(), 5.7, 1e-8);
  signal_.clock(3.0);
  signal_.clock(nan);
  signal_.clock(INFINITY);
  EXPECT_NEAR(signal_.known_until_s(), 5.7, 1e-8);
  const double held = signal_.angles(5.0).port_rad;
  EXPECT_EQ(signal_.angles(5.65).port_rad, held);

  EXPECT_EQ(signal_.add(sample(5.4, 0.108)), SampleVerdict::out_of_order);
  EXPECT_EQ(signal_.add(sample(5.8, 0.116)), SampleVerdict::accepted);
  EXPECT_NEAR(signal_.gaps()[0].to_s, 5.8, 1e-9);
  EXPECT_NEAR(signal_.known_until_s(), 5.8, 1e-9);
  EXPECT_EQ(signal_.angles(5.8).port_rad, held);
}

TEST_F(OpeningSignalTest, EndOfTheLogIsNoGap)
{
  feed(signal_, 0.0, 5.0, [](double t) { return 0.02 * t; });
  signal_.clock(50.0);
  EXPECT_EQ(signal_.gaps().size(), 1U);
  signal_.finish();
  EXPECT_TRUE(signal_.gaps().empty());
  EXPECT_EQ(signal_.known_until_s(), INFINITY);
  EXPECT_EQ(signal_.next_motion_s(5.0), INFINITY);
  EXPECT_EQ(signal_.add(sample(60.0, 0.1)), SampleVerdict::out_of_order);
}

TEST_F(OpeningSignalTest, NextMotionIsBoundedByWhatIsKnown)
{
  feed(signal_, 0.0, 5.0, [](double) { return 0.0; });
  EXPECT_EQ(signal_.next_motion_s(0.0), signal_.known_until_s());
  EXPECT_NEAR(signal_.known_until_s(), 4.5, 1e-9);
}

TEST(OpeningTable, PassesThroughItsPointsWithoutOvershoot)
{
  const OpeningSignal signal = OpeningSignal::through(
      { { 2.0, { 0.0, 0.0 } }, { 30.0, { 0.365, 0.36 } }, { 60.0, { 0.365, 0.36 } } }, "hull.opening_table");
  EXPECT_EQ(signal.known_until_s(), INFINITY);
  EXPECT_EQ(signal.angles(0.0).port_rad, 0.0);
  EXPECT_DOUBLE_EQ(signal.next_motion_s(0.0), 2.0);
  EXPECT_EQ(signal.angles(30.0).port_rad, 0.365);
  EXPECT_EQ(signal.angles(45.0).starboard_rad, 0.36);
  EXPECT_EQ(signal.next_motion_s(30.0), INFINITY);
  EXPECT_NEAR(signal.angles(16.0).port_rad, 0.5 * 0.365, 1e-12);
  EXPECT_FALSE(signal.empty());
  EXPECT_EQ(OpeningSignal::through({}, "t").known_until_s(), INFINITY);
}

TEST(OpeningTable, NamesTheBadRow)
{
  const auto message = [](const std::vector<OpeningPoint>& points) -> std::string {
    try {
      OpeningSignal::through(points, "hull.opening_table");
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_NE(message({ { 0.0, {} }, { 0.0, {} } }).find("hull.opening_table[1].time_s"), std::string::npos);
  EXPECT_NE(message({ { -1.0, {} } }).find("hull.opening_table[0].time_s"), std::string::npos);
  EXPECT_NE(message({ { 0.0, { 0.0, nan } } }).find("hull.opening_table[0].starboard_rad"), std::string::npos);
  EXPECT_NE(message({ { 0.0, { -0.1, 0.0 } } }).find("hull.opening_table[0].port_rad"), std::string::npos);
}

}  // namespace
}  // namespace geocontainer_mpm::barge
