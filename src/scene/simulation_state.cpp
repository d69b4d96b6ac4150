#include "simulation_state.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "explained_speed.h"

namespace geocontainer_mpm::scene {
namespace {

/// Angles of the halves further apart than this are not those of a symmetric opening, rad: half a degree, what sensors
/// and their mounting make of one.
constexpr double uneven_rad = 0.01;
/// Two instants closer than this are one, s.
constexpr double same_instant_s = 1e-9;
/// A run can be taken back by this many steps. Fewer cost more copies, more cost more steps to take again.
constexpr int steps_between_checkpoints = 32;
/// In so many steps the fastest grain of a release falls by three cells: within contact::stray_cells.
constexpr std::uint64_t steps_between_stray_searches = 128;
/// Energy from nowhere below this part of what is stored is not looked at: near rest the books of friction and of
/// grains that part and meet are not exact, while what is unstable grows through any bound.
constexpr double negligible_energy = 1e-3;
/// Over a whole run, in which errors of either sign should have met, this part of what is allowed between two looks.
constexpr double whole_run = 0.5;
/// A taut, light sheet that snaps back is faster than what hangs on it.
constexpr double sheet_over_body = 5.0;

/// Energy that nobody paid for. What the transfers between particles and grid have taken is not counted against it: it
/// is numerical itself, and with usf and musl the stress sees other velocities than the forces.
double from_nowhere(const EnergyFrame& e)
{
  return e.unbalanced - e.dissipated_transfer;
}

/// Half the sum of all changes, J/m.
double exchanged(const EnergyFrame& then, const EnergyFrame& now)
{
  return 0.5 * (std::abs(now.kinetic - then.kinetic) + std::abs(now.elastic - then.elastic) +
                std::abs(now.potential - then.potential) + std::abs(now.dissipated - then.dissipated) +
                std::abs(now.work_in - then.work_in));
}

ChangingTimes changing_times(const SceneDescription& scene)
{
  ChangingTimes changes;
  changes.add(scene.gravity_table);
  for (const auto& [name, surface] : scene.surfaces)
    if (surface.motion)
      changes.add(surface.motion->table);
  for (const auto& [name, traction] : scene.tractions)
    changes.add(traction.table);
  for (const auto& [name, support] : scene.supports)
    for (const TableRow<2>& row : support.velocity_table)
      if (row.value != std::array<double, 2>{})
        changes.always();
  for (const auto& [name, sheet] : scene.geotextiles) {
    for (const SheetEnd& end : { sheet.start, sheet.end }) {
      changes.add(end.motion_table);
      changes.add(end.force_table);
    }
    if (sheet.inside_pressure)
      changes.add(sheet.inside_pressure->table);
  }
  for (const auto& [name, body] : scene.bodies) {
    if (body.manufactured)
      changes.always();
    if (body.held_until_s > 0.0)
      changes.add_instant(body.held_until_s);
  }
  return changes;
}

}  // namespace

template <int Dim>
Run<Dim>::Run(const SceneDescription& description, int threads, Unsettled)
    : scene(description)
    , model(scene, threads)
    , opening(signal_parameters())
    , motion(scene)
    , changes(changing_times(scene))
    , watch(scene)
    , probes(scene, model)
    , fresh_probes(probes)
{
}

template <int Dim>
Run<Dim>::Run(const SceneDescription& description, int threads) : Run(description, threads, Unsettled{})
{
  settle();
  settled = model.state();
  explained_speed_ = explained_speed(scene, model);
  progress.mean_force.assign(model.boundaries().size(), Vec<Dim>::Zero());
  progress.interval_start = model.state().boundary_totals;
  fresh_progress = progress;
  watch.observe(model, 0.0, {}, 0.0);
}

template <int Dim>
barge::OpeningSignalParameters Run<Dim>::signal_parameters() const
{
  return scene.hull ? scene.hull->signal : barge::OpeningSignalParameters{};
}

template <int Dim>
barge::OpeningAngles Run<Dim>::angles_at(double time_s) const
{
  if (!scene.hull || opening.known_until_s() < 0.0)
    return {};
  const barge::OpeningAngles angles = opening.angles(time_s);
  if (scene.symmetry() == Symmetry::none)
    return angles;
  const double mean = 0.5 * (angles.port_rad + angles.starboard_rad);
  return { mean, mean };
}

/// A hull that opens unevenly while half of it is computed.
template <int Dim>
std::optional<Failure> Run<Dim>::find_uneven(double time_s) const
{
  if (scene.symmetry() == Symmetry::none || !scene.hull || opening.known_until_s() < 0.0)
    return std::nullopt;
  const barge::OpeningAngles angles = opening.angles(time_s);
  if (std::abs(angles.port_rad - angles.starboard_rad) <= uneven_rad)
    return std::nullopt;
  return Failure{ fmt::format("the hull opens unevenly, port {:.4f} and starboard {:.4f} rad, more than {} rad apart: "
                              "that needs space.symmetry none",
                              angles.port_rad, angles.starboard_rad, uneven_rad),
                  in_barge_frame(scene.hull->hinge_m), time_s };
}

/// The end counts as an output instant.
template <int Dim>
double Run<Dim>::output_time_s() const
{
  return std::min(static_cast<double>(progress.next_frame) * scene.time.output_interval_s, scene.time.end_s);
}

template <int Dim>
double Run<Dim>::sample_time_s() const
{
  if (probes.empty())
    return std::numeric_limits<double>::infinity();
  return static_cast<double>(progress.next_sample) * scene.time.probe_interval_s.value_or(scene.time.output_interval_s);
}

template <int Dim>
void Run<Dim>::sample_if_due()
{
  if (progress.time_s < sample_time_s() - same_instant_s)
    return;
  ++progress.next_sample;
  const barge::OpeningAngles angles = angles_at(progress.time_s);
  std::vector<double> rotation;
  for (std::size_t b = 0; b < model.boundaries().size(); ++b)
    rotation.push_back(motion.angle(b, progress.time_s, angles));
  probes.sample(model, progress.time_s, rotation);
}

/// Closes an output interval when its end is reached.
template <int Dim>
bool Run<Dim>::output_reached()
{
  sample_if_due();
  if (progress.time_s < output_time_s() - same_instant_s)
    return false;
  ++progress.next_frame;
  const std::vector<BoundaryTotal<Dim>>& totals = model.state().boundary_totals;
  const double length = progress.time_s - progress.interval_start_s;
  if (length > 0.0 && !progress.resting)
    for (std::size_t b = 0; b < totals.size(); ++b)
      progress.mean_force[b] = -(totals[b].impulse - progress.interval_start[b].impulse) / length;
  progress.interval_start = totals;
  progress.interval_start_s = progress.time_s;
  probes.close_frame();
  return true;
}

/// The first frame.
template <int Dim>
void Run<Dim>::begin()
{
  output_reached();
  progress.start = model.energy();
  save();
}

/// When something that the scene prescribes changes next: hull, surfaces, loads.
template <int Dim>
double Run<Dim>::next_change_s(double time_s) const
{
  return std::min(changes.next(time_s),
                  scene.hull ? opening.next_motion_s(time_s) : std::numeric_limits<double>::infinity());
}

/// How long everything has been slow while nothing was driven, s.
template <int Dim>
double Run<Dim>::still_for_s() const
{
  // At rest the hull is known to have been still; the end of the known opening must not look like motion.
  const bool undriven = progress.resting || next_change_s(progress.time_s) > progress.time_s;
  return undriven ? progress.time_s - progress.still_since_s : 0.0;
}

/// Jumps over rest. False while the opening is not known ahead.
template <int Dim>
bool Run<Dim>::rest_on(Advance& result)
{
  const double from = progress.time_s;
  double to = std::min({ output_time_s(), sample_time_s(), scene.time.end_s });
  const double change = next_change_s(from);
  const bool known = !scene.hull || opening.known_until_s() > from;
  if (change <= from && known) {
    progress.resting = false;
    progress.still_since_s = from;
    save();
    result = Advance::stepped;
    return true;
  }
  to = std::min(to, change);
  if (scene.hull)
    to = std::min(to, opening.known_until_s());
  if (!(to > from))
    return false;
  progress.time_s = to;
  progress.resting_time_s += to - from;
  watch.observe(model, progress.time_s, angles_at(to), still_for_s());
  result = output_reached() ? Advance::frame_due : Advance::stepped;
  return true;
}

/// As long as stability allows, halved where a step went wrong, and landing on what comes next without a sliver of a
/// step.
template <int Dim>
double Run<Dim>::step_length(double stable_dt) const
{
  double dt = std::ldexp(stable_dt, -progress.halvings);
  for (const double instant : { output_time_s(), sample_time_s(), scene.time.end_s, model.next_start_s() }) {
    const double left = instant - progress.time_s;
    if (left > 0.0 && left < 2.0 * dt)
      dt = left > dt ? 0.5 * left : left;
  }
  return dt;
}

template <int Dim>
void Run<Dim>::count_step(double dt)
{
  progress.time_s += dt;
  progress.dt_s = dt;
  progress.min_dt_s = progress.steps == 0 ? dt : std::min(progress.min_dt_s, dt);
  progress.max_dt_s = std::max(progress.max_dt_s, dt);
  ++progress.steps;
  ++steps_since_checkpoint_;
}

/// One step. False while the opening is not known far enough ahead.
template <int Dim>
bool Run<Dim>::step_once(Advance& result)
{
  const double dt = step_length(model.stable_dt(progress.time_s)), before = progress.time_s, after = before + dt;
  if (scene.hull && after >= opening.known_until_s())
    return false;
  if (const std::optional<Failure> uneven = find_uneven(after)) {
    progress.stopped = true;
    progress.failure = *uneven;
    result = Advance::stopped;
    return true;
  }
  const StepInput input{ before, dt, motion.poses(before, angles_at(before)), motion.poses(after, angles_at(after)),
                         scene.numerics.damping_per_s };
  const StepStatus status = model.step(input);
  count_step(dt);
  if (!status.ok) {
    result = undo(status.failure);
    return true;
  }
  const bool output_due = progress.time_s >= output_time_s() - same_instant_s;
  const bool look = output_due || steps_since_checkpoint_ >= steps_between_checkpoints;
  if (const std::optional<Failure> wrong = find_wrong(input, look)) {
    result = undo(*wrong);
    return true;
  }
  if (progress.steps % steps_between_stray_searches == 0)
    model.find_strays();
  if (model.rms_velocity() > scene.numerics.rest_velocity_m_per_s)
    progress.still_since_s = progress.time_s;
  if (scene.numerics.skip_resting.value_or(scene.hull.has_value()) && still_for_s() >= scene.numerics.rest_time_s) {
    model.stop_motion();
    progress.resting = true;
  }
  watch.observe(model, progress.time_s, angles_at(progress.time_s), still_for_s());
  result = output_reached() ? Advance::frame_due : Advance::stepped;
  if (look) {
    if (progress.halvings > 0 && progress.time_s > progress.doubtful_s)
      --progress.halvings;
    save();
  }
  return true;
}

/// What a step did that nothing explains; what costs more to find only where `look` says so.
template <int Dim>
std::optional<Failure> Run<Dim>::find_wrong(const StepInput& step, bool look)
{
  progress.wall_speed = std::max(progress.wall_speed, fastest_wall(model, step));
  const double explained = explained_speed_ + progress.wall_speed, limit = scene.numerics.speed_jump * explained;
  const bool bodies = model.state().fastest_of_bodies > limit;
  if (bodies || model.state().fastest > sheet_over_body * limit) {
    Failure failure = model.fastest(!bodies);
    failure.reason += fmt::format(" where {:.3g} can be explained", explained);
    return failure;
  }
  if (!look)
    return std::nullopt;
  Failure failure = model.distortion();
  if (!failure.reason.empty())
    return failure;
  if (!energy_jumped(model.energy()))
    return std::nullopt;
  failure = model.fastest(true);
  failure.reason = "energy came from nowhere; " + failure.reason;
  return failure;
}

/// Has energy appeared that nothing accounts for: since the last checkpoint, compared with the motion that there was
/// and what changed hands meanwhile, or since the start, compared with the most that changed hands?
template <int Dim>
bool Run<Dim>::energy_jumped(const EnergyFrame& now)
{
  const EnergyFrame& then = checkpoint_->energy;
  const double part = scene.numerics.energy_jump, negligible = negligible_energy * (now.kinetic + now.elastic);
  const auto jumped = [&](double gain, double most) { return !(gain <= most + negligible); };
  if (jumped(from_nowhere(now) - from_nowhere(then), part * (then.kinetic + exchanged(then, now))))
    return true;
  if (scene.numerics.damping_per_s > 0.0)
    return false;  // the books of a run that is led to rest are true to the order of a step only, and that adds up
  EnergyFrame start = progress.start;
  start.kinetic = model.state().ledger.kinetic_at_start;  // known since the first step
  progress.turnover = std::max(progress.turnover, exchanged(start, now));
  const double there = start.kinetic + start.elastic + 0.5 * model.soil_mass() * push_out_speed * push_out_speed;
  return jumped(from_nowhere(now), whole_run * part * (there + progress.turnover));
}

template struct Run<2>;
template struct Run<3>;

}  // namespace geocontainer_mpm::scene
