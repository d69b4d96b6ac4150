/// Forecaster and live run side by side, as in the node. What is asked of it does not depend on how fast the threads
/// are.

#include "geocontainer_mpm/forecast/forecaster.h"

#include <gtest/gtest.h>

#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>

#include "geocontainer_mpm/error.h"
#include "release_fixture.h"

namespace geocontainer_mpm::forecast {
namespace {

using namespace std::chrono_literals;

constexpr auto long_enough = 300s;  ///< a loaded machine; nothing waits so long on an idle one

class Received {
public:
  ForecasterHooks hooks()
  {
    ForecasterHooks hooks;
    hooks.forecast = [this](const Forecast& forecast, bool stale) {
      const std::lock_guard<std::mutex> lock(mutex_);
      forecasts_.push_back({ forecast, stale });
    };
    hooks.ensemble = [this](const EnsembleForecast& ensemble) {
      const std::lock_guard<std::mutex> lock(mutex_);
      ensembles_.push_back(ensemble);
    };
    return hooks;
  }
  struct Told {
    Forecast forecast;
    bool stale;
  };
  std::vector<Told> forecasts() const
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    return forecasts_;
  }
  std::vector<EnsembleForecast> ensembles() const
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    return ensembles_;
  }

private:
  mutable std::mutex mutex_;
  std::vector<Told> forecasts_;
  std::vector<EnsembleForecast> ensembles_;
};

/// The solver's thread: hands out its state when asked. Until `done()`.
template <class Done>
bool serve(LiveRun& live, Forecaster& forecaster, Done&& done)
{
  const auto until = std::chrono::steady_clock::now() + long_enough;
  while (!done()) {
    if (std::chrono::steady_clock::now() > until)
      return false;
    if (forecaster.state_wanted())
      if (std::optional<scene::Snapshot> state = live.simulation().snapshot())
        forecaster.give_state(std::move(*state));
    std::this_thread::sleep_for(2ms);
  }
  return true;
}

void follow(LiveRun& live, Forecaster& forecaster, double until_s)
{
  while (live.measured_s() < until_s - 1e-9) {
    live.follow();
    forecaster.measured(live.measured_s(), planned().at(live.measured_s()));
  }
}

ForecasterSettings quick()
{
  ForecasterSettings settings;
  settings.reach = { 15.0, 2.0 };
  settings.rate_window_s = 0.5;
  settings.period_s = settings.ensemble_period_s = 3600.0;  // only what is asked for here
  return settings;
}

TEST(Forecaster, ForecastsGoesStaleAndForecastsAgain)
{
  const scene::SceneDescription scene = coarse_release();
  LiveRun live(scene);
  Received received;
  Forecaster forecaster(scene, quick(), nullptr, received.hooks());
  follow(live, forecaster, 0.4);
  ASSERT_TRUE(serve(live, forecaster, [&] { return received.forecasts().size() == 1; }));
  EXPECT_FALSE(received.forecasts()[0].stale);
  EXPECT_EQ(received.forecasts()[0].forecast.status.outcome, scene::Outcome::waiting);  // the hull stands still

  follow(live, forecaster, 1.5);  // it does not any more
  ASSERT_TRUE(serve(live, forecaster, [&] { return received.forecasts().size() == 3; }));
  EXPECT_TRUE(received.forecasts()[1].stale);
  EXPECT_EQ(received.forecasts()[1].forecast.from_s, received.forecasts()[0].forecast.from_s);
  const Forecast forecast = received.forecasts()[2].forecast;
  EXPECT_FALSE(received.forecasts()[2].stale);
  EXPECT_EQ(forecast.status.outcome, scene::Outcome::released);
  EXPECT_EQ(forecast.assumption, Assumption::measured);
  follow(live, forecaster, log_end_s);
  live.simulation().opening().finish();
  live.catch_up();
  EXPECT_NEAR(forecast.status.release_time_s, live.simulation().status().release_time_s, 0.1);
}

TEST(Forecaster, PrefersThePlan)
{
  const scene::SceneDescription scene = coarse_release();
  LiveRun live(scene);
  Received received;
  Forecaster forecaster(scene, quick(), nullptr, received.hooks());
  std::vector<barge::OpeningSample> plan;
  for (const int index : { 0, 10, 50 })
    plan.push_back(sample_at(index));
  EXPECT_THROW(forecaster.plan({ plan[2], plan[1] }), InputError);
  forecaster.plan(plan);
  follow(live, forecaster, 0.3);
  ASSERT_TRUE(serve(live, forecaster, [&] { return !received.forecasts().empty(); }));
  const Forecast forecast = received.forecasts().back().forecast;
  EXPECT_EQ(forecast.assumption, Assumption::plan);
  EXPECT_EQ(forecast.status.outcome, scene::Outcome::released);  // before the hull has moved
  follow(live, forecaster, log_end_s);
  live.simulation().opening().finish();
  live.catch_up();
  EXPECT_NEAR(forecast.status.release_time_s, live.simulation().status().release_time_s, 1e-9);
}

TEST(Forecaster, GivesUpAPlanThatTheHullDoesNotKeepTo)
{
  const scene::SceneDescription scene = coarse_release();
  LiveRun live(scene);
  Received received;
  Forecaster forecaster(scene, quick(), nullptr, received.hooks());
  barge::OpeningSample closed = sample_at(0);
  barge::OpeningSample late = sample_at(50);
  late.stamp_ns += 60'000'000'000;
  forecaster.plan({ closed, late });
  follow(live, forecaster, 1.5);
  ASSERT_TRUE(serve(live, forecaster, [&] { return !received.forecasts().empty(); }));
  EXPECT_EQ(received.forecasts().back().forecast.assumption, Assumption::measured);
}

TEST(Forecaster, IsSilentAboutALogThatIsOver)
{
  const scene::SceneDescription scene = coarse_release();
  Received received;
  LiveRun live(scene);
  Forecaster forecaster(scene, quick(), nullptr, received.hooks());
  follow(live, forecaster, 1.5);
  while (!forecaster.state_wanted())
    std::this_thread::sleep_for(1ms);
  forecaster.give_state(*live.simulation().snapshot());
  forecaster.restart(2);  // while it is computed, or before it has begun
  std::this_thread::sleep_for(50ms);
  const auto told = received.forecasts();
  EXPECT_TRUE(told.empty() || told.front().forecast.run == 1);
  LiveRun again(scene);
  follow(again, forecaster, 0.4);
  const std::size_t before = told.size();
  ASSERT_TRUE(serve(again, forecaster, [&] { return received.forecasts().size() > before; }));
  EXPECT_EQ(received.forecasts().back().forecast.run, 2u);
}

TEST(Forecaster, KeepsAnEnsembleAndAdvisesARate)
{
  const scene::SceneDescription scene = coarse_release();
  ForecasterSettings settings = quick();
  settings.advice = AdviceSettings{ 10.0, 0.05, 0.3, 3, 1 };  // any rate will do
  settings.ensemble_period_s = 1e-3;                          // always due: advice gets its turn all the same
  LiveRun live(scene);
  Received received;
  auto ensemble = std::make_unique<LiveEnsemble>(
      draw_members(release_path(), coarse_overrides(),
                   std::string(GEOCONTAINER_MPM_SOURCE_DIR) + "/config/ensembles/release.yaml", 3, 7),
      1);
  Forecaster forecaster(scene, settings, std::move(ensemble), received.hooks());
  follow(live, forecaster, 1.5);
  ASSERT_TRUE(serve(live, forecaster, [&] {
    return !received.ensembles().empty() && received.ensembles().back().advice.verdict == Verdict::any_rate;
  }));
  bool grew = false;  // before all were tried: what had been tried
  for (const EnsembleForecast& told : received.ensembles())
    grew = grew || (told.advice.verdict == Verdict::rate && told.advice.slowest_rad_per_s > 0.05);
  EXPECT_TRUE(grew);
  const EnsembleForecast last = received.ensembles().back();
  EXPECT_EQ(last.seed, 7u);
  EXPECT_EQ(last.summary.completed, 3u);
  EXPECT_EQ(last.inputs.front(), "hull.friction");
  const ensemble::FigureSummary& release = last.summary.figures[ensemble::release_time_figure()];
  EXPECT_LT(release.p10, release.p90);
  EXPECT_GT(release.p10, 1.5);
  EXPECT_EQ(last.advice.verdict, Verdict::any_rate);
  EXPECT_EQ(last.advice.rate_rad_per_s, 0.3);

  follow(live, forecaster, log_end_s + 1.0);  // the hull is open: nothing is left to be advised
  EXPECT_TRUE(serve(live, forecaster, [&] { return received.ensembles().back().advice.verdict == Verdict::none; }));
}

}  // namespace
}  // namespace geocontainer_mpm::forecast
