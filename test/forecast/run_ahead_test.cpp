/// A run ahead finds what the live run finds later.

#include "geocontainer_mpm/forecast/run_ahead.h"

#include <gtest/gtest.h>

#include "release_fixture.h"

namespace geocontainer_mpm::forecast {
namespace {

const auto never = [] { return false; };

TEST(RunAhead, UnderTheOpeningThatComesFindsTheSameToTheLastBit)
{
  const scene::SceneDescription scene = coarse_release();
  LiveRun live(scene);
  live.follow_until(1.5);
  const std::optional<scene::Snapshot> now = live.simulation().snapshot();
  ASSERT_TRUE(now);
  const AssumedOpening& plan = planned();
  const std::optional<Forecast> forecast =
      run_ahead(scene, *now, plan.continue_from(now->opening(), 1.0), { 20.0, 20.0 }, 0.25, never);
  ASSERT_TRUE(forecast);
  EXPECT_EQ(forecast->stopped, "");
  EXPECT_LT(forecast->from_s, 1.5);
  EXPECT_EQ(forecast->status.outcome, scene::Outcome::released);
  EXPECT_GT(forecast->cost_s, 0.0);

  // The live run has not noticed, and comes to the same.
  live.follow_until(log_end_s);
  live.simulation().opening().finish();
  live.catch_up();
  const scene::StatusFrame status = live.simulation().status();
  EXPECT_EQ(forecast->status.release_time_s, status.release_time_s);
  EXPECT_EQ(forecast->status.peak_tension_n_per_m, status.peak_tension_n_per_m);
  EXPECT_EQ(forecast->status.peak_tension_time_s, status.peak_tension_time_s);

  double before_s = -1.0, before_peak = 0.0;
  for (const Instant& instant : forecast->instants) {
    EXPECT_GT(instant.time_s, before_s);
    EXPECT_GE(instant.peak_tension_n_per_m, before_peak);
    before_s = instant.time_s;
    before_peak = instant.peak_tension_n_per_m;
  }
  EXPECT_EQ(before_peak, forecast->status.peak_tension_n_per_m);
}

TEST(RunAhead, AtTheRateMeasuredHalfWayNamesTheRelease)
{
  const scene::SceneDescription scene = coarse_release();
  LiveRun live(scene);
  RecentSamples recent(0.5);
  for (int i = 0; i <= 30; ++i)
    recent.add(i * sample_interval_s, sample_at(i).angles);
  live.follow_until(1.5);
  const RecentSamples::Trend trend = recent.trend();
  const AssumedOpening assumed =
      AssumedOpening::at_rate(recent.newest().time_s, trend.angles, trend.rate, scene.hull->full_opening());
  const std::optional<scene::Snapshot> now = live.simulation().snapshot();
  const std::optional<Forecast> forecast =
      run_ahead(scene, *now, assumed.continue_from(now->opening(), 1.0), { 20.0, 20.0 }, 0.25, never);
  live.follow_until(log_end_s);
  live.simulation().opening().finish();
  live.catch_up();
  // The log is a straight line but for its end, which the filter rounds: what the issue asks of a real one.
  EXPECT_NEAR(forecast->status.release_time_s, live.simulation().status().release_time_s, 0.1);
}

TEST(RunAhead, OfAClosedHullIsOverAtOnceAndOfNoneIsNothing)
{
  const scene::SceneDescription scene = coarse_release();
  LiveRun live(scene);
  EXPECT_FALSE(live.simulation().snapshot());  // has not begun
  live.follow_until(0.4);
  const std::optional<scene::Snapshot> now = live.simulation().snapshot();
  const AssumedOpening closed = AssumedOpening::at_rate(0.4, {}, {}, full_rad);
  const std::optional<Forecast> forecast =
      run_ahead(scene, *now, closed.continue_from(now->opening(), 1.0), { 60.0, 20.0 }, 0.25, never);
  EXPECT_EQ(forecast->status.outcome, scene::Outcome::waiting);
  EXPECT_LT(forecast->until_s, 10.0);  // at rest for good
  EXPECT_FALSE(
      run_ahead(scene, *now, closed.continue_from(now->opening(), 1.0), { 60.0, 20.0 }, 0.25, [] { return true; }));
}

}  // namespace
}  // namespace geocontainer_mpm::forecast
