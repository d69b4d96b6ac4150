// The default release: all of it against real time, each stage's cost while the container passes the slot, and a big
// one.

#include <benchmark/benchmark.h>

#include <string>

#include "geocontainer_mpm/scene/simulation.h"

namespace {

using namespace geocontainer_mpm::scene;

const std::string default_scene = std::string(GEOCONTAINER_MPM_SOURCE_DIR) + "/config/scenes/release.yaml";

/// Cost by stage of the steps between two looks at a run, ns per particle and step, summed over threads' waiting time
/// too: it is wall-clock time.
class StageCost {
public:
  void add(const RunCounters& from, const RunCounters& to)
  {
    particle_steps_ += static_cast<double>((to.steps - from.steps) * to.particles);
    const auto grow = [&](double StageTimes::*stage) { times_.*stage += to.stages.*stage - from.stages.*stage; };
    grow(&StageTimes::p2g_s);
    grow(&StageTimes::forces_s);
    grow(&StageTimes::contact_s);
    grow(&StageTimes::membrane_s);
    grow(&StageTimes::g2p_s);
    grow(&StageTimes::material_s);
  }
  void report(benchmark::State& state) const
  {
    const auto ns = [&](double seconds) { return particle_steps_ > 0.0 ? 1e9 * seconds / particle_steps_ : 0.0; };
    state.counters["p2g_ns"] = ns(times_.p2g_s);
    state.counters["forces_ns"] = ns(times_.forces_s);
    state.counters["contact_ns"] = ns(times_.contact_s);
    state.counters["membrane_ns"] = ns(times_.membrane_s);
    state.counters["g2p_ns"] = ns(times_.g2p_s);
    state.counters["material_ns"] = ns(times_.material_s);
    state.counters["all_ns"] =
        ns(times_.p2g_s + times_.forces_s + times_.contact_s + times_.membrane_s + times_.g2p_s + times_.material_s);
  }

private:
  StageTimes times_;
  double particle_steps_ = 0.0;
};

bool failed(const Simulation& simulation, Advance result, benchmark::State& state)
{
  if (result != Advance::stopped && result != Advance::waiting)
    return false;
  state.SkipWithError(result == Advance::stopped ? simulation.failure().reason.c_str()
                                                 : "the run waits for its opening");
  return true;
}

/// All 60 s, settling excluded. Stages: while the outcome is `releasing`.
void whole_release(benchmark::State& state)
{
  StageCost cost;
  double simulated = 0.0;
  std::uint64_t steps = 0, particles = 0;
  for (auto _ : state) {
    state.PauseTiming();
    Simulation simulation(load_scene(default_scene), static_cast<int>(state.range(0)));
    simulation.use_scene_opening();
    state.ResumeTiming();
    for (Advance result = Advance::stepped; result != Advance::finished;) {
      const RunCounters before = simulation.counters();
      result = simulation.advance();
      if (failed(simulation, result, state))
        return;
      if (simulation.status().outcome == Outcome::releasing)
        cost.add(before, simulation.counters());
    }
    const RunCounters counters = simulation.counters();
    simulated += counters.simulated_time_s;
    steps = counters.steps;
    particles = counters.particles;
  }
  state.counters["real_time_factor"] = benchmark::Counter(simulated, benchmark::Counter::kIsRate);
  state.counters["steps"] = static_cast<double>(steps);
  state.counters["particles"] = static_cast<double>(particles);
  cost.report(state);
}
BENCHMARK(whole_release)->ArgName("threads")->Arg(1)->Arg(2)->Iterations(1)->UseRealTime()->Unit(benchmark::kSecond);

/// The same on a quarter of the cell size, some 70 000 particles, from the closed hull on: a fixed number of steps.
void big_release(benchmark::State& state)
{
  constexpr int steps_at_once = 50;
  Simulation simulation(
      load_scene(default_scene, { "grid.cell_size_m=0.025", "geotextiles.container.segment_length_m=0.025",
                                  "bodies.sand.initial_stress=k0", "numerics.skip_resting=false" }),
      static_cast<int>(state.range(0)));
  simulation.use_scene_opening();
  simulation.advance(1);
  StageCost cost;
  double particle_steps = 0.0;
  for (auto _ : state) {
    const RunCounters before = simulation.counters();
    while (simulation.counters().steps < before.steps + steps_at_once)
      if (failed(simulation, simulation.advance(steps_at_once), state))
        return;
    const RunCounters after = simulation.counters();
    cost.add(before, after);
    particle_steps += static_cast<double>((after.steps - before.steps) * after.particles);
  }
  state.counters["particles"] = static_cast<double>(simulation.counters().particles);
  state.counters["particle_steps"] = benchmark::Counter(particle_steps, benchmark::Counter::kIsRate);
  cost.report(state);
}
BENCHMARK(big_release)->ArgName("threads")->Arg(1)->Arg(2)->Iterations(4)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
