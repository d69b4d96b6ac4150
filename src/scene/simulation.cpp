#include "geocontainer_mpm/scene/simulation.h"

#include <fmt/format.h>

#include <cmath>

#include "fill_frame.h"
#include "simulation_state.h"

namespace geocontainer_mpm::scene {

const char* to_string(Outcome outcome)
{
  switch (outcome) {
    case Outcome::waiting:
      return "waiting";
    case Outcome::releasing:
      return "releasing";
    case Outcome::released:
      return "released";
    case Outcome::hung_up:
      return "hung_up";
    case Outcome::none:
      break;
  }
  return "none";
}

EnergyFrame EnergyFrame::times(double parts) const
{
  EnergyFrame result = *this;
  for (double* energy : { &result.kinetic, &result.elastic, &result.potential, &result.dissipated,
                          &result.dissipated_plastic, &result.dissipated_contact, &result.dissipated_transfer,
                          &result.dissipated_water, &result.work_in, &result.unbalanced, &result.dissipated_rupture })
    *energy *= parts;
  return result;
}

std::string place(const Vec3& position_m, int dimensions)
{
  const std::string section = fmt::format("y {:.3f} m, z {:.3f} m", position_m.y(), position_m.z());
  return dimensions == 3 ? fmt::format("x {:.3f} m, {}", position_m.x(), section) : section;
}

namespace {

template <int Dim>
void use_opening_of_scene(Run<Dim>& run)
{
  run.opening = barge::OpeningSignal(run.signal_parameters());
  if (run.scene.hull) {
    std::vector<barge::OpeningPoint> points;
    for (const OpeningRow& row : run.scene.hull->opening_table)
      points.push_back({ row.time_s, { row.port_rad, row.starboard_rad } });
    run.opening = barge::OpeningSignal::through(points, "hull.opening_table");
    return;
  }
  run.opening.finish();
}

template <int Dim>
Advance advance_by(Run<Dim>& run, int max_steps)
{
  if (run.progress.stopped)
    return Advance::stopped;
  if (run.progress.next_frame == 0) {
    run.begin();
    return Advance::frame_due;
  }
  Advance result = Advance::waiting;
  for (int k = 0; k < max_steps; ++k) {
    if (run.progress.time_s >= run.scene.time.end_s)
      return Advance::finished;
    if (run.scene.hull && run.opening.known_until_s() < 0.0)
      return Advance::waiting;
    Advance now = Advance::waiting;
    if (!(run.progress.resting ? run.rest_on(now) : run.step_once(now)))
      return result;
    result = now;
    if (result != Advance::stepped)
      return result;
  }
  return result;
}

template <int Dim>
void start_again(Run<Dim>& run)
{
  run.model.restore(run.settled);
  run.opening = barge::OpeningSignal(run.signal_parameters());
  run.watch = ReleaseWatch<Dim>(run.scene);
  run.probes = run.fresh_probes;
  run.progress = run.fresh_progress;
  run.watch.observe(run.model, 0.0, {}, 0.0);
}

/// Of the whole.
template <int Dim>
EnergyFrame energy_of(const Run<Dim>& run)
{
  return run.model.energy().times(run.scene.parts());
}

template <int Dim>
StatusFrame status_of(const Run<Dim>& run)
{
  StatusFrame status = run.watch.status(run.model);
  status.resting = run.progress.resting;
  return status;
}

template <int Dim>
RunCounters count(const Run<Dim>& run)
{
  RunCounters c;
  for (const Body<Dim>& body : run.model.bodies())
    c.particles += body.particles.size();
  for (const ModelSheet<Dim>& sheet : run.model.sheets())
    c.particles += sheet.sheet.nodes().size();
  c.steps = run.progress.steps;
  c.simulated_time_s = run.progress.time_s;
  c.min_dt_s = run.progress.min_dt_s;
  c.max_dt_s = run.progress.max_dt_s;
  c.retries = run.progress.retries;
  c.momentum_error = run.model.momentum_error();
  c.skipped = run.model.state().skipped;
  c.skipped.resting_time_s = run.progress.resting_time_s;
  c.stages = run.model.stages();
  return c;
}

template <int Dim>
Frame frame_of(const Run<Dim>& run)
{
  Frame frame;
  frame.time_s = run.progress.time_s;
  frame.stamp_ns = run.opening.origin_ns() + std::llround(run.progress.time_s * 1e9);
  frame.step = run.progress.steps;
  frame.dt_s = run.progress.dt_s;
  frame.opening = run.angles_at(run.progress.time_s);
  frame.energy = energy_of(run);
  frame.status = status_of(run);
  frame.probes = run.probes.of_frame();
  if (run.scene.water)
    frame.water_level_m = run.scene.water_level_m();
  fill_frame<Dim>(run.model, run.scene, run.progress.mean_force, frame);
  const std::vector<contact::RigidPose> pose = run.motion.poses(frame.time_s, frame.opening);
  for (std::size_t b = 0; b < frame.boundary.size(); ++b) {
    frame.boundary[b].angle_rad = run.motion.angle(b, frame.time_s, frame.opening);
    for (Vec3& x : frame.boundary[b].position)
      x = pose[b].apply(x);
  }
  return frame;
}

}  // namespace

Simulation::Simulation(const SceneDescription& scene, int threads) : state_(std::make_unique<State>())
{
  if (scene.dimensions() == 3)
    state_->run = std::make_unique<Run<3>>(scene, threads);
  else
    state_->run = std::make_unique<Run<2>>(scene, threads);
}
namespace {

template <int Dim>
std::unique_ptr<Run<Dim>> run_from(const SceneDescription& scene, int threads, const Kept<Dim>& kept)
{
  auto run = std::make_unique<Run<Dim>>(scene, threads, typename Run<Dim>::Unsettled{});
  run->go_on_from(kept);
  return run;
}

}  // namespace

Simulation::Simulation(const SceneDescription& scene, int threads, const Snapshot& from)
    : state_(std::make_unique<State>())
{
  std::visit([&](const auto& kept) { state_->run = run_from(scene, threads, kept); }, from.state_->kept);
}
Simulation::Simulation(std::unique_ptr<State> state) : state_(std::move(state)) {}
Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;

barge::OpeningSignal& Simulation::opening()
{
  return state_->with([](auto& run) -> auto& { return run.opening; });
}

const barge::OpeningSignal& Simulation::opening() const
{
  return state_->with([](const auto& run) -> const auto& { return run.opening; });
}

void Simulation::use_scene_opening()
{
  state_->with([](auto& run) { use_opening_of_scene(run); });
}

Advance Simulation::advance(int max_steps)
{
  return state_->with([&](auto& run) { return advance_by(run, max_steps); });
}

std::optional<Snapshot> Simulation::snapshot() const
{
  return state_->with([](const auto& run) -> std::optional<Snapshot> {
    auto kept = run.keep();
    if (!kept)
      return std::nullopt;
    return Snapshot(std::make_shared<const Snapshot::State>(Snapshot::State{ std::move(*kept) }));
  });
}

Snapshot::Snapshot(std::shared_ptr<const State> state) : state_(std::move(state)) {}

double Snapshot::time_s() const
{
  return std::visit([](const auto& kept) { return kept.now.progress.time_s; }, state_->kept);
}

const barge::OpeningSignal& Snapshot::opening() const
{
  return std::visit(
      [](const auto& kept) -> const auto& { return kept.opening; }, state_->kept);
}

void Simulation::reset()
{
  state_->with([](auto& run) { start_again(run); });
}

const SceneDescription& Simulation::scene() const
{
  return state_->with([](const auto& run) -> const auto& { return run.scene; });
}

double Simulation::time_s() const
{
  return state_->with([](const auto& run) { return run.progress.time_s; });
}

StatusFrame Simulation::status() const
{
  return state_->with([](const auto& run) { return status_of(run); });
}

EnergyFrame Simulation::energy() const
{
  return state_->with([](const auto& run) { return energy_of(run); });
}

std::optional<WaterFrame> Simulation::water() const
{
  return state_->with([](const auto& run) {  // of the whole
    std::optional<WaterFrame> frame = run.model.water();
    if (frame) {
      for (double* sum : { &frame->buoyancy, &frame->submerged_weight, &frame->dissipated })
        *sum *= run.scene.parts();
      frame->drag_impulse *= run.scene.parts();
    }
    return frame;
  });
}

RunCounters Simulation::counters() const
{
  return state_->with([](const auto& run) { return count(run); });
}

const std::vector<ProbeFrame>& Simulation::probes() const
{
  return state_->with([](const auto& run) -> const auto& { return run.probes.series(); });
}

const Failure& Simulation::failure() const
{
  return state_->with([](const auto& run) -> const auto& { return run.progress.failure; });
}

std::uint64_t Simulation::digest() const
{
  return state_->with([](const auto& run) { return run.model.digest(); });
}

Frame Simulation::frame() const
{
  return state_->with([](const auto& run) { return frame_of(run); });
}

}  // namespace geocontainer_mpm::scene
