#include "geocontainer_mpm/scene/simulation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include "geocontainer_mpm/barge/split_hull.h"
#include "geocontainer_mpm/error.h"
#include "geocontainer_mpm/scene/model.h"
#include "geocontainer_mpm/scene/release_watch.h"

namespace geocontainer_mpm::scene {
namespace {

/// Settling under gravity: damping as part of the lowest frequency's critical value, how still is still enough, and
/// when to give up.
constexpr double settling_damping = 0.5;
constexpr double settled_part_of_rest_velocity = 0.25;
constexpr double settled_for_s = 0.1;
constexpr double longest_settling_s = 10.0;

barge::OpeningSignalParameters signal_parameters(const SceneDescription& scene)
{
  return scene.hull ? scene.hull->signal : barge::OpeningSignalParameters{};
}

std::optional<barge::SplitHull> make_hull(const SceneDescription& scene)
{
  if (!scene.hull)
    return std::nullopt;
  return barge::SplitHull(scene.hull->hinge_m, scene.hull->port_section_m, "hull");
}

}  // namespace

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

struct Simulation::State {
  /// What reset() restores, beside the model.
  struct Progress {
    double time_s = 0.0;
    double dt_s = 0.0;
    double still_since_s = 0.0;  ///< everything has been slow since then
    bool resting = false;
    std::uint64_t next_frame = 0;
    double min_dt_s = 0.0, max_dt_s = 0.0;
    std::uint64_t steps = 0;
    double resting_time_s = 0.0;
    double interval_start_s = 0.0;
    std::vector<Vec2> interval_impulse, mean_force;  ///< per boundary body
    Failure failure;
    bool stopped = false;
  };

  State(const SceneDescription& description, int threads)
      : scene(description)
      , model(scene, threads)
      , opening(signal_parameters(scene))
      , hull(make_hull(scene))
      , watch(scene)
      , settled(settle())
  {
    progress.interval_impulse.assign(model.boundaries().size(), Vec2::Zero());
    progress.mean_force = progress.interval_impulse;
    watch.observe(model, 0.0, {}, 0.0);
  }

  bool damp_to_rest(double furthest_slide_m);
  Model settle();
  std::vector<contact::RigidPose> poses(const barge::OpeningAngles& angles) const;
  barge::OpeningAngles angles_at(double time_s) const;
  double output_time_s() const { return static_cast<double>(progress.next_frame) * scene.time.output_interval_s; }
  bool output_reached();
  double still_for_s() const;
  bool step_once(Advance& result);
  bool rest_on(Advance& result);

  SceneDescription scene;
  Model model;
  barge::OpeningSignal opening;
  std::optional<barge::SplitHull> hull;
  ReleaseWatch watch;
  Progress progress;
  Model settled;  ///< what reset() goes back to
};

/// Damped steps with the hull closed until everything is still. False if that did not happen, or the material slid
/// further than `furthest_slide_m` on the way.
bool Simulation::State::damp_to_rest(double furthest_slide_m)
{
  const std::vector<contact::RigidPose> closed = poses({});
  const double damping = 2.0 * settling_damping * model.fundamental_frequency();
  const double still = settled_part_of_rest_velocity * scene.numerics.rest_velocity_m_per_s;
  const Vec2 from = model.centroid();
  double time = 0.0, moved = 0.0;
  while (time - moved < settled_for_s) {
    const double dt = model.stable_dt();
    if (!model.step(dt, closed, closed, damping).ok || time > longest_settling_s ||
        (model.centroid() - from).norm() > furthest_slide_m)
      return false;
    time += dt;
    if (model.rms_velocity() > still)
      moved = time;
  }
  model.stop_motion();
  return true;
}

/// Lets bodies that ask for it come to rest under gravity with the hull closed: first held where they touch, then with
/// their true friction; where that cannot hold them, the held state is the start. Returns the state that a run starts
/// from.
Model Simulation::State::settle()
{
  if (std::any_of(scene.bodies.begin(), scene.bodies.end(),
                  [](const auto& body) { return body.second.initial_stress == InitialStress::gravity; })) {
    model.hold(true);
    damp_to_rest(std::numeric_limits<double>::infinity());
    model.hold(false);
    const Model held = model;
    if (!damp_to_rest(scene.grid.cell_size_m))
      model = held;
  }
  model.open_ledger();
  return model;
}

std::vector<contact::RigidPose> Simulation::State::poses(const barge::OpeningAngles& angles) const
{
  std::vector<contact::RigidPose> result(model.boundaries().size());
  if (hull) {
    const auto port = static_cast<std::size_t>(model.hull_index());
    result[port] = hull->pose(barge::HullHalf::port, angles);
    result[port + 1] = hull->pose(barge::HullHalf::starboard, angles);
  }
  return result;
}

barge::OpeningAngles Simulation::State::angles_at(double time_s) const
{
  return scene.hull && opening.known_until_s() >= 0.0 ? opening.angles(time_s) : barge::OpeningAngles{};
}

/// Closes an output interval when its end is reached.
bool Simulation::State::output_reached()
{
  if (progress.time_s < output_time_s() - 1e-9)
    return false;
  ++progress.next_frame;
  const double length = progress.time_s - progress.interval_start_s;
  if (length > 0.0 && !progress.resting)
    for (std::size_t b = 0; b < progress.mean_force.size(); ++b)
      progress.mean_force[b] = -progress.interval_impulse[b] / length;
  std::fill(progress.interval_impulse.begin(), progress.interval_impulse.end(), Vec2::Zero());
  progress.interval_start_s = progress.time_s;
  return true;
}

/// How long everything has been slow in a hull that stands still, s.
double Simulation::State::still_for_s() const
{
  // At rest the hull is known to have been still; the end of the known opening must not look like motion.
  const bool hull_still = progress.resting || !scene.hull || opening.next_motion_s(progress.time_s) > progress.time_s;
  return hull_still ? progress.time_s - progress.still_since_s : 0.0;
}

/// Jumps over rest. False while the opening is not known ahead.
bool Simulation::State::rest_on(Advance& result)
{
  const double from = progress.time_s;
  double to = std::min(output_time_s(), scene.time.end_s);
  if (scene.hull) {
    to = std::min(to, opening.known_until_s());
    const double motion = opening.next_motion_s(from);
    if (motion <= from && opening.known_until_s() > from) {
      progress.resting = false;
      progress.still_since_s = from;
      result = Advance::stepped;
      return true;
    }
    to = std::min(to, motion);
  }
  if (!(to > from))
    return false;
  progress.time_s = to;
  progress.resting_time_s += to - from;
  watch.observe(model, progress.time_s, angles_at(to), still_for_s());
  result = output_reached() ? Advance::frame_due : Advance::stepped;
  return true;
}

/// One step. False while the opening is not known far enough ahead.
bool Simulation::State::step_once(Advance& result)
{
  double dt = model.stable_dt();
  for (const double instant : { output_time_s(), scene.time.end_s }) {
    const double left = instant - progress.time_s;
    if (left > 0.0 && left < 2.0 * dt)
      dt = left > dt ? 0.5 * left : left;  // land on the instant without a sliver of a step
  }
  const double after = progress.time_s + dt;
  if (scene.hull && after >= opening.known_until_s())
    return false;
  const StepStatus status =
      model.step(dt, poses(angles_at(progress.time_s)), poses(angles_at(after)), scene.numerics.damping_per_s);
  progress.time_s = after;
  progress.dt_s = dt;
  progress.min_dt_s = progress.steps == 0 ? dt : std::min(progress.min_dt_s, dt);
  progress.max_dt_s = std::max(progress.max_dt_s, dt);
  ++progress.steps;
  if (!status.ok) {
    progress.stopped = true;
    progress.failure = status.failure;
    progress.failure.time_s = progress.time_s;
    result = Advance::stopped;
    return true;
  }
  for (std::size_t b = 0; b < progress.interval_impulse.size(); ++b)
    progress.interval_impulse[b] += model.boundary_impulses()[b].impulse;
  if (model.rms_velocity() > scene.numerics.rest_velocity_m_per_s)
    progress.still_since_s = after;
  if (scene.numerics.skip_resting && still_for_s() >= scene.numerics.rest_time_s) {
    model.stop_motion();
    progress.resting = true;
  }
  watch.observe(model, progress.time_s, angles_at(progress.time_s), still_for_s());
  result = output_reached() ? Advance::frame_due : Advance::stepped;
  return true;
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
  s.opening = barge::OpeningSignal(signal_parameters(s.scene));
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
    s.output_reached();
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
  s.model = s.settled;
  s.opening = barge::OpeningSignal(signal_parameters(s.scene));
  s.watch = ReleaseWatch(s.scene);
  s.progress = State::Progress{};
  s.progress.interval_impulse.assign(s.model.boundaries().size(), Vec2::Zero());
  s.progress.mean_force = s.progress.interval_impulse;
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

RunCounters Simulation::counters() const
{
  const State& s = *state_;
  RunCounters c;
  for (const Body& body : s.model.bodies())
    c.particles += body.particles.size();
  for (const EnclosingSheet& sheet : s.model.sheets())
    c.particles += sheet.sheet.nodes().size();
  c.steps = s.progress.steps;
  c.simulated_time_s = s.progress.time_s;
  c.min_dt_s = s.progress.min_dt_s;
  c.max_dt_s = s.progress.max_dt_s;
  c.momentum_error = s.model.momentum_error();
  c.skipped = s.model.skipped();
  c.skipped.resting_time_s = s.progress.resting_time_s;
  c.stages = s.model.stages();
  return c;
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
  fill_frame(s.model, s.scene, s.progress.mean_force, frame);
  const std::vector<contact::RigidPose> pose = s.poses(frame.opening);
  for (std::size_t b = 0; b < frame.boundary.size(); ++b)
    for (Vec2& x : frame.boundary[b].position)
      x = pose[b].apply(x);
  return frame;
}

}  // namespace geocontainer_mpm::scene
