/// What is taken for the opening from now on.

#include "geocontainer_mpm/forecast/assumed_opening.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "geocontainer_mpm/error.h"

namespace geocontainer_mpm::forecast {
namespace {

using barge::OpeningAngles;
using barge::OpeningSample;
using barge::OpeningSignal;
using barge::OpeningSignalParameters;

constexpr std::int64_t interval_ns = 50'000'000;

TEST(AssumedOpening, GoesOnAtItsRateUntilEachHalfStops)
{
  const AssumedOpening opening = AssumedOpening::at_rate(10.0, { 0.1, 0.2 }, { 0.02, 0.02 }, 0.3);
  EXPECT_DOUBLE_EQ(opening.at(9.0).port_rad, 0.1);
  EXPECT_DOUBLE_EQ(opening.at(12.0).port_rad, 0.14);
  EXPECT_NEAR(opening.at(16.0).starboard_rad, 0.3, 1e-15);  // stopped at 15 s
  EXPECT_NEAR(opening.at(16.0).port_rad, 0.22, 1e-15);
  EXPECT_NEAR(opening.at(30.0).port_rad, 0.3, 1e-15);
  EXPECT_DOUBLE_EQ(opening.end_s(), 20.0);
  EXPECT_EQ(opening.assumption(), Assumption::measured);
}

TEST(AssumedOpening, ClosesNoFurtherThanClosedAndStandsWithoutARate)
{
  const AssumedOpening closing = AssumedOpening::at_rate(0.0, { 0.1, 0.1 }, { -0.02, 0.0 }, 0.3);
  EXPECT_NEAR(closing.at(100.0).port_rad, 0.0, 1e-15);
  EXPECT_DOUBLE_EQ(closing.at(100.0).starboard_rad, 0.1);
  // Beyond the end of its travel a half stays: sensors are off by a little.
  const AssumedOpening beyond = AssumedOpening::at_rate(0.0, { 0.31, 0.31 }, { 0.02, 0.02 }, 0.3);
  EXPECT_DOUBLE_EQ(beyond.at(5.0).port_rad, 0.31);
}

RC_GTEST_PROP(AssumedOpening, NeverLeavesWhatTheHullCanDo, ())
{
  const auto part = [] { return *rc::gen::inRange(0, 1001) / 1000.0; };
  const double full = 0.1 + 0.5 * part();
  const OpeningAngles from{ full * part(), full * part() };
  const OpeningAngles rate{ 0.1 * (part() - 0.5), 0.1 * (part() - 0.5) };
  const AssumedOpening opening = AssumedOpening::at_rate(3.0, from, rate, full);
  double before_port = from.port_rad;
  for (double time = 3.0; time < 40.0; time += 0.25) {
    const OpeningAngles angles = opening.at(time);
    for (const double angle : { angles.port_rad, angles.starboard_rad }) {
      RC_ASSERT(angle >= -1e-12);
      RC_ASSERT(angle <= full + 1e-12);
    }
    RC_ASSERT(std::abs(angles.port_rad - before_port) <= std::abs(rate.port_rad) * 0.25 + 1e-12);
    before_port = angles.port_rad;
  }
}

TEST(AssumedOpening, IsFilteredAsIfItHadBeenMeasured)
{
  const auto angle_at = [](double time_s) { return 0.02 * time_s; };
  OpeningSignal all{ OpeningSignalParameters{} };
  OpeningSignal so_far = all;
  const std::int64_t origin_ns = 7'000'000'000;
  for (int i = 0; i <= 200; ++i) {
    const double angle = angle_at(i * 0.05);
    const OpeningSample sample{ origin_ns + i * interval_ns, { angle, angle } };
    all.add(sample);
    if (i <= 80)
      so_far.add(sample);
  }
  const AssumedOpening plan = AssumedOpening::planned(
      { { 0.0, { 0.0, 0.0 } }, { 10.0, { angle_at(10.0), angle_at(10.0) } } }, OpeningSignalParameters{}, "plan");
  EXPECT_EQ(plan.assumption(), Assumption::plan);
  const OpeningSignal continued = plan.continue_from(so_far, 1.0);
  EXPECT_TRUE(std::isinf(continued.known_until_s()));
  for (double time = 0.0; time < 9.0; time += 0.1)
    EXPECT_NEAR(continued.angles(time).port_rad, all.angles(time).port_rad, 1e-12) << time;
  for (double time = 0.0; time < so_far.known_until_s(); time += 0.1)  // what is known stays to the last bit
    EXPECT_EQ(continued.angles(time).port_rad, so_far.angles(time).port_rad) << time;
  EXPECT_NEAR(continued.angles(30.0).port_rad, angle_at(10.0), 0.0016);  // half of the backlash behind
}

TEST(AssumedOpening, RefusesAPlanThatNoLogCouldFollow)
{
  const OpeningSignalParameters signal;
  const auto refused = [&](std::vector<barge::OpeningPoint> points, const std::string& why) {
    try {
      AssumedOpening::planned(std::move(points), signal, "points");
      ADD_FAILURE() << "taken: " << why;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(why), std::string::npos) << error.what();
    }
  };
  refused({}, "at least one");
  refused({ { 0.0, { 0.0, 0.0 } }, { 0.0, { 0.1, 0.1 } } }, "points[1]");
  refused({ { 0.0, { 0.0, 0.8 } } }, "0.7");
  refused({ { 0.0, { 0.0, 0.0 } }, { 1.0, { 0.3, 0.3 } } }, "max_rate_rad_per_s");
  refused({ { 0.0, { std::nan(""), 0.0 } } }, "points[0]");
  refused({ { std::nan(""), { 0.0, 0.0 } } }, "time");
}

TEST(RecentSamples, TellTheRateOfAStraightLineExactly)
{
  RecentSamples recent(2.0);
  for (int i = 0; i < 200; ++i)
    recent.add(0.05 * i, { 0.1 + 0.02 * 0.05 * i, i < 150 ? 0.5 : 0.2 - 0.01 * 0.05 * i });
  const RecentSamples::Trend trend = recent.trend();
  EXPECT_NEAR(trend.rate.port_rad, 0.02, 1e-12);
  EXPECT_NEAR(trend.angles.port_rad, 0.1 + 0.02 * 9.95, 1e-12);
  EXPECT_NEAR(trend.rate.starboard_rad, -0.01, 1e-12);  // the window has forgotten what was before
  EXPECT_DOUBLE_EQ(recent.newest().time_s, 0.05 * 199);
}

TEST(RecentSamples, AreAtRestAfterOneSample)
{
  RecentSamples recent(2.0);
  recent.add(3.0, { 0.1, 0.2 });
  EXPECT_EQ(recent.trend().rate.port_rad, 0.0);
  EXPECT_EQ(recent.trend().angles.starboard_rad, 0.2);
}

}  // namespace
}  // namespace geocontainer_mpm::forecast
