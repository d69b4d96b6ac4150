#include "geocontainer_mpm/scene/simulation.h"

#include <fmt/format.h>

#include <cmath>

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

std::string place(const Vec3& position_m, int dimensions)
{
  const std::string section = fmt::format("y {:.3f} m, z {:.3f} m", position_m.y(), position_m.z());
  return dimensions == 3 ? fmt::format("x {:.3f} m, {}", position_m.x(), section) : section;
}

Simulation::Simulation(const SceneDescription& scene, int threads) : state_(std::make_unique<State>(scene, threads)) {}
Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;

barge::OpeningSignal& Simulation::opening()
{
  return state_->opening;
}

const barge::OpeningSignal& Simulation::opening() const
{
  return state_->opening;
}

void Simulation::use_scene_opening()
{
  State& s = *state_;
  s.opening = barge::OpeningSignal(s.signal_parameters());
  if (s.scene.hull) {
    std::vector<barge::OpeningPoint> points;
    for (const OpeningRow& row : s.scene.hull->opening_table)
      points.push_back({ row.time_s, { row.port_rad, row.starboard_rad } });
    s.opening = barge::OpeningSignal::through(points, "hull.opening_table");
    return;
  }
  s.opening.finish();
}

Advance Simulation::advance(int max_steps)
{
  State& s = *state_;
  if (s.progress.stopped)
    return Advance::stopped;
  if (s.progress.next_frame == 0) {
    s.begin();
    return Advance::frame_due;
  }
  Advance result = Advance::waiting;
  for (int k = 0; k < max_steps; ++k) {
    if (s.progress.time_s >= s.scene.time.end_s)
      return Advance::finished;
    if (s.scene.hull && s.opening.known_until_s() < 0.0)
      return Advance::waiting;
    Advance now = Advance::waiting;
    if (!(s.progress.resting ? s.rest_on(now) : s.step_once(now)))
      return result;
    result = now;
    if (result != Advance::stepped)
      return result;
  }
  return result;
}

void Simulation::reset()
{
  State& s = *state_;
  s.model.restore(s.settled);
  s.opening = barge::OpeningSignal(s.signal_parameters());
  s.watch = ReleaseWatch(s.scene);
  s.probes = s.fresh_probes;
  s.progress = s.fresh_progress;
  s.watch.observe(s.model, 0.0, {}, 0.0);
}

const SceneDescription& Simulation::scene() const
{
  return state_->scene;
}

double Simulation::time_s() const
{
  return state_->progress.time_s;
}

StatusFrame Simulation::status() const
{
  StatusFrame status = state_->watch.status(state_->model);
  status.resting = state_->progress.resting;
  return status;
}

EnergyFrame Simulation::energy() const
{
  return state_->model.energy();
}

std::optional<WaterFrame> Simulation::water() const
{
  return state_->model.water();
}

RunCounters Simulation::counters() const
{
  const State& s = *state_;
  RunCounters c;
  for (const Body& body : s.model.bodies())
    c.particles += body.particles.size();
  for (const ModelSheet& sheet : s.model.sheets())
    c.particles += sheet.sheet.nodes().size();
  c.steps = s.progress.steps;
  c.simulated_time_s = s.progress.time_s;
  c.min_dt_s = s.progress.min_dt_s;
  c.max_dt_s = s.progress.max_dt_s;
  c.retries = s.progress.retries;
  c.momentum_error = s.model.momentum_error();
  c.skipped = s.model.state().skipped;
  c.skipped.resting_time_s = s.progress.resting_time_s;
  c.stages = s.model.stages();
  return c;
}

const std::vector<ProbeFrame>& Simulation::probes() const
{
  return state_->probes.series();
}

const Failure& Simulation::failure() const
{
  return state_->progress.failure;
}

std::uint64_t Simulation::digest() const
{
  return state_->model.digest();
}

Frame Simulation::frame() const
{
  const State& s = *state_;
  Frame frame;
  frame.time_s = s.progress.time_s;
  frame.stamp_ns = s.opening.origin_ns() + std::llround(s.progress.time_s * 1e9);
  frame.step = s.progress.steps;
  frame.dt_s = s.progress.dt_s;
  frame.opening = s.angles_at(s.progress.time_s);
  frame.energy = energy();
  frame.status = status();
  frame.probes = s.probes.of_frame();
  if (s.scene.water)
    frame.water_level_m = s.scene.water_level_m();
  fill_frame(s.model, s.scene, s.progress.mean_force, frame);
  const std::vector<contact::RigidPose> pose = s.motion.poses(frame.time_s, frame.opening);
  for (std::size_t b = 0; b < frame.boundary.size(); ++b) {
    frame.boundary[b].angle_rad = s.motion.angle(b, frame.time_s, frame.opening);
    for (Vec3& x : frame.boundary[b].position)
      x = in_barge_frame(pose[b].apply(x.tail<2>()));
  }
  return frame;
}

}  // namespace geocontainer_mpm::scene
