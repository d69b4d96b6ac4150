#include "judge.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <vector>

#include "geocontainer_mpm/scene/description.h"
#include "geocontainer_mpm/scene/simulation.h"

namespace geocontainer_mpm::stability {
namespace {

using scene::Advance;
using scene::Frame;
using scene::SceneDescription;
using scene::Simulation;

// What "nonsense" means. Bounds are wide: no sound run comes near them, and a run that leaves them is not worth having.

/// Energy that particles gained and nobody paid for, over what was there at the start or changed hands since. Transfers
/// count in: what a force puts into nodes that hardly any mass reaches, and the next transfer takes out again, is no
/// gain. Remedies against locking keep stresses that do no work, so that their elastic energy says little.
constexpr double most_gained = 0.15, most_gained_smoothed = 1.0;
/// The same over the most that changed hands so far: at the top of a bounce hardly anything has.
constexpr double most_gained_of_turnover = 0.12;
/// The same lost without an account: by the method whose account closes, quadratic B-splines that strain by the
/// velocity that the forces worked on.
constexpr double most_lost = 0.1;
/// Contact works penetration off at up to 0.05 m/s: that much motion comes from a rough start, m/s.
constexpr double push_out_speed = 0.1;
/// Sum of momentum that no force accounts for, over all impulses: round-off.
constexpr double most_momentum_error = 1e-8;
/// Volume of a body over its volume at the start. Sand that flies apart takes up more.
constexpr double least_volume = 0.3, most_volume = 20.0;
/// Speed over what the fall through the whole grid, the motion at the start, pushing walls and elastic stress explain.
constexpr double most_speed = 6.0;
/// Cells behind a rigid surface; further behind than `elsewhere` is another place, reached round an end.
constexpr double most_depth = 1.0, elsewhere = 4.0;

/// What a run has to begin with, and may be compared with.
struct Start {
  std::vector<std::size_t> particles;
  std::vector<double> volume;
  double energy = 0.0;  ///< kinetic and elastic, and what contact may push, J/m
  double speed = 0.0;   ///< m/s, of what may move without anything going wrong
};

/// Of all looks so far: see Verdict.
struct Sums {
  double turnover = 0.0;  ///< J/m
  double gained = 0.0, lost = 0.0;
};

double volume_of(const scene::SoilFrame& soil)
{
  double sum = 0.0;
  for (const double v : soil.volume)
    sum += v;
  return sum;
}

double fastest_wall(const SceneDescription& scene)
{
  double speed = 0.0;
  const double arm = (scene.grid.upper_m - scene.grid.lower_m).norm();
  for (const auto& [name, surface] : scene.surfaces)
    if (surface.motion)
      for (std::size_t i = 1; i < surface.motion->table.size(); ++i) {
        const auto &a = surface.motion->table[i - 1], &b = surface.motion->table[i];
        speed = std::max(speed, (std::abs(b.value[0] - a.value[0]) + std::abs(b.value[1] - a.value[1]) +
                                 arm * std::abs(b.value[2] - a.value[2])) /
                                    (b.time_s - a.time_s));
      }
  for (const auto& [name, support] : scene.supports)
    for (const auto& row : support.velocity_table)
      speed = std::max(speed, std::abs(row.value[0]) + std::abs(row.value[1]));
  for (const auto& [name, sheet] : scene.geotextiles)
    for (const scene::SheetEnd& end : { sheet.start, sheet.end })
      for (std::size_t i = 1; i < end.motion_table.size(); ++i) {
        const auto &a = end.motion_table[i - 1], &b = end.motion_table[i];
        speed = std::max(
            speed, (std::abs(b.value[0] - a.value[0]) + std::abs(b.value[1] - a.value[1])) / (b.time_s - a.time_s));
      }
  if (scene.hull)
    for (std::size_t i = 1; i < scene.hull->opening_table.size(); ++i) {
      const auto &a = scene.hull->opening_table[i - 1], &b = scene.hull->opening_table[i];
      speed = std::max(speed, 1.5 * arm * std::max(b.port_rad - a.port_rad, b.starboard_rad - a.starboard_rad) /
                                  (b.time_s - a.time_s));
    }
  return speed;
}

/// Speed that loads give: stress over impedance, or for long, acceleration of what they act on.
double pushed_speed(const SceneDescription& scene)
{
  double lightest = 1e30;  // kg/m^2 of a row of particles
  for (const auto& [name, body] : scene.bodies)
    lightest = std::min(lightest, scene.materials.at(body.material).density_kg_per_m3 * scene.grid.cell_size_m /
                                      body.particles_per_cell);
  for (const auto& [name, sheet] : scene.geotextiles)
    lightest = std::min(lightest, sheet.computational_mass_kg_per_m2);
  double pressure = 0.0;
  for (const auto& [name, traction] : scene.tractions)
    pressure = std::max(pressure, traction.traction_pa.norm() + std::abs(traction.pressure_pa));
  for (const auto& [name, sheet] : scene.geotextiles)
    if (sheet.inside_pressure)
      pressure = std::max(
          pressure, std::abs(sheet.inside_pressure->pressure_pa) +
                        sheet.inside_pressure->gradient_pa_per_m * (scene.grid.upper_m - scene.grid.lower_m).norm());
  const double size = (scene.grid.upper_m - scene.grid.lower_m).norm();
  return std::min(pressure / lightest * scene.time.end_s, std::sqrt(2.0 * pressure / lightest * size));
}

Start start_of(const Simulation& simulation)
{
  const SceneDescription& scene = simulation.scene();
  const Frame frame = simulation.frame();
  Start start;
  double initial = 0.0;
  for (const scene::SoilFrame& soil : frame.soil) {
    start.particles.push_back(soil.position.size());
    start.volume.push_back(volume_of(soil));
    for (const Vec3& v : soil.velocity)
      initial = std::max(initial, v.norm());
  }
  double stressed = 0.0;  // sigma / (rho c) of what is stressed at the start
  for (const auto& [name, body] : scene.bodies) {
    initial = std::max(initial, body.initial_velocity_m_per_s.norm());
    const material::Parameters& m = scene.materials.at(body.material);
    const double modulus = m.young_modulus_pa > 0.0 ? m.young_modulus_pa : m.bulk_modulus_pa;
    for (const scene::SoilFrame& soil : frame.soil)
      for (const auto& stress : soil.stress)
        stressed =
            std::max(stressed, (std::abs(stress[1]) + std::abs(stress[2])) / std::sqrt(modulus * m.density_kg_per_m3));
  }
  double heaviest = 0.0;
  for (const auto& [name, material] : scene.materials)
    heaviest = std::max(heaviest, material.density_kg_per_m3);
  double volume = 0.0;
  for (const double v : start.volume)
    volume += v;
  start.energy =
      frame.energy.kinetic + frame.energy.elastic + 0.5 * heaviest * volume * push_out_speed * push_out_speed;
  const double height = (scene.grid.upper_m - scene.grid.lower_m).norm();
  start.speed = initial + stressed + fastest_wall(scene) + pushed_speed(scene) +
                std::sqrt(2.0 * scene.gravity_m_per_s2.norm() * height) + 1e-6;
  return start;
}

/// How far behind a rigid line a point is, m: 0 in front of it, beside its ends, or somewhere else altogether.
double depth_behind(const scene::BoundaryFrame& boundary, const Vec2& x, double far)
{
  const std::size_t n = boundary.position.size(), pieces = boundary.closed ? n : n - 1;
  double nearest = far, depth = 0.0;
  for (std::size_t i = 0; i < pieces; ++i) {
    const Vec2 a = boundary.position[i].tail<2>(), b = boundary.position[(i + 1) % n].tail<2>();
    const Vec2 along = b - a;
    const double length = along.norm();
    if (!(length > 0.0))
      continue;
    const double s = (x - a).dot(along) / (length * length);
    const bool beyond_end = !boundary.closed && ((i == 0 && s < 0.0) || (i + 1 == pieces && s > 1.0));
    const Vec2 from = x - (a + std::clamp(s, 0.0, 1.0) * along);
    if (from.norm() >= nearest)
      continue;
    nearest = from.norm();
    const double side = (along[0] * from[1] - along[1] * from[0]) / length;  // positive on the left: free
    depth = beyond_end || side >= 0.0 ? 0.0 : nearest;
  }
  return depth;
}

std::string look_at_points(const SceneDescription& scene, const Frame& frame, const Start& start,
                           const std::string& name, const std::vector<Vec3>& position,
                           const std::vector<Vec3>& velocity, bool touches, double speed_factor)
{
  const double dx = scene.grid.cell_size_m;
  for (std::size_t p = 0; p < position.size(); ++p) {
    const Vec2 x = position[p].tail<2>(), v = velocity[p].tail<2>();
    const auto where = [&] { return fmt::format("point {} of {} at [{:.4g}, {:.4g}]", p, name, x[0], x[1]); };
    if (!x.allFinite() || !v.allFinite())
      return where() + " is not finite";
    if (((x - scene.grid.lower_m).array() < -1e-9).any() || ((x - scene.grid.upper_m).array() > 1e-9).any())
      return where() + " is outside the grid";
    if (v.norm() > speed_factor * most_speed * start.speed)
      return where() + fmt::format(" moves with {:.4g} m/s where {:.4g} can be explained", v.norm(), start.speed);
    if (!touches)
      continue;
    for (const scene::BoundaryFrame& boundary : frame.boundary) {
      const double depth = depth_behind(boundary, x, elsewhere * dx);
      if (depth > most_depth * dx)
        return where() + fmt::format(" is {:.3g} cells behind {}", depth / dx, boundary.name);
    }
  }
  return "";
}

std::string look_at_energy(const scene::EnergyFrame& e, const Start& start, const mpm::Discretisation& method,
                           Sums& sums)
{
  for (const double value : { e.kinetic, e.elastic, e.potential, e.dissipated, e.work_in, e.unbalanced })
    if (!std::isfinite(value))
      return "an energy is not finite";
  const double exchanged = e.relative_balance_error > 0.0 ? std::abs(e.unbalanced) / e.relative_balance_error : 0.0;
  const double scale = start.energy + exchanged;
  const bool smoothed = method.smoothing != mpm::Smoothing::none;
  const double gained = e.unbalanced - e.dissipated_transfer;
  sums.turnover = std::max(sums.turnover, scale);
  if (sums.turnover > 0.0) {
    sums.gained = std::max(sums.gained, gained / sums.turnover);
    sums.lost = std::max(sums.lost, -e.unbalanced / sums.turnover);
  }
  if (gained > most_gained_of_turnover * sums.turnover)
    return fmt::format("{:.3g} J/m came from nowhere, of at most {:.3g} that there were or that changed hands", gained,
                       sums.turnover);
  if (gained > (smoothed ? most_gained_smoothed : most_gained) * scale)
    return fmt::format("{:.3g} J/m came from nowhere, of {:.3g} that there were or that changed hands", gained, scale);
  const bool closes = method.update == mpm::UpdateOrder::usl && method.shape != mpm::Shape::linear_simplex;
  if (closes && e.unbalanced < -most_lost * scale)
    return fmt::format("{:.3g} J/m went nowhere, of {:.3g} that there were or that changed hands", -e.unbalanced,
                       scale);
  return "";
}

/// What is wrong with a frame; empty: nothing.
std::string look_at(const Simulation& simulation, const Start& start, Sums& sums)
{
  const SceneDescription& scene = simulation.scene();
  const Frame frame = simulation.frame();
  if (frame.soil.size() != start.particles.size())
    return "a body is missing";
  for (std::size_t b = 0; b < frame.soil.size(); ++b) {
    const scene::SoilFrame& soil = frame.soil[b];
    if (soil.position.size() != start.particles[b])
      return soil.name + " has lost particles";
    for (std::size_t p = 0; p < soil.stress.size(); ++p)
      for (const double s : soil.stress[p])
        if (!std::isfinite(s))
          return fmt::format("stress of point {} of {} is not finite", p, soil.name);
    bool enclosed = false;
    for (const auto& [name, sheet] : scene.geotextiles)
      enclosed = enclosed || sheet.encloses == soil.name;
    std::string wrong = look_at_points(scene, frame, start, soil.name, soil.position, soil.velocity, !enclosed, 1.0);
    if (!wrong.empty())
      return wrong;
    const double ratio = volume_of(soil) / start.volume[b];
    if (!(ratio > least_volume && ratio < most_volume))
      return fmt::format("{} has {:.3g} times its volume", soil.name, ratio);
  }
  for (const scene::GeotextileFrame& sheet : frame.geotextile) {
    for (const double t : sheet.tension)
      if (!(t >= 0.0 && std::isfinite(t)))
        return "a tension of " + sheet.name + " is negative or not finite";
    // A taut, light sheet that snaps back is faster than what hangs on it.
    std::string wrong = look_at_points(scene, frame, start, sheet.name, sheet.node, sheet.velocity, true, 5.0);
    if (!wrong.empty())
      return wrong;
  }
  // Without weight hardly any impulse changes hands that the error could be compared with.
  if (scene.gravity_m_per_s2 != Vec2::Zero() && !(simulation.counters().momentum_error <= most_momentum_error))
    return fmt::format("momentum error {:.3g}", simulation.counters().momentum_error);
  return look_at_energy(frame.energy, start, scene.numerics.method, sums);
}

/// Runs to the end or through the budget; `verdict` says what was found. Returns the digest of the last look.
std::uint64_t run(Simulation& simulation, double budget, Verdict& verdict)
{
  simulation.use_scene_opening();
  Start start;
  Sums sums;
  bool started = false;
  std::uint64_t digest = 0;
  for (;;) {
    const Advance done = simulation.advance(16);
    if (!started) {
      start = start_of(simulation);
      started = true;
    }
    const scene::RunCounters counters = simulation.counters();
    verdict.time_s = simulation.time_s();
    verdict.steps = counters.steps;
    verdict.particles = counters.particles;
    verdict.retries = counters.retries;
    if (done == Advance::stopped) {
      const scene::Failure& failure = simulation.failure();
      verdict.what = failure.reason.empty() ? Class::failed : Class::stopped;
      verdict.reason = failure.reason.empty()
                           ? "stopped without a reason"
                           : fmt::format("{} at [{:.4g}, {:.4g}], t = {:.4g} s", failure.reason, failure.position_m.y(),
                                         failure.position_m.z(), failure.time_s);
      return digest;
    }
    const bool spent = static_cast<double>(counters.steps) * (static_cast<double>(counters.particles) + 60.0) > budget;
    if (done != Advance::stepped || spent) {
      const std::string wrong = look_at(simulation, start, sums);
      verdict.gained = sums.gained;
      verdict.lost = sums.lost;
      verdict.balance_error = simulation.energy().relative_balance_error;
      digest = digest * 31 + simulation.digest();
      if (!wrong.empty()) {
        verdict.what = Class::failed;
        verdict.reason = fmt::format("{}, t = {:.4g} s", wrong, simulation.time_s());
        return digest;
      }
    }
    if (done == Advance::waiting) {
      verdict.what = Class::failed;
      verdict.reason = "waits for an opening that is known";
      return digest;
    }
    if (done == Advance::finished || spent)
      return digest;
  }
}

}  // namespace

const char* to_string(Class what)
{
  return what == Class::survived ? "survived" : what == Class::stopped ? "stopped" : "failed";
}

Verdict judge(const Drawing& drawing)
{
  Verdict verdict;
  try {
    const SceneDescription scene = scene::parse_scene(drawing.yaml, "drawn scene");
    verdict.end_s = scene.time.end_s;
    Simulation simulation(scene, 1);
    const double budget = drawing.twice ? drawing.budget / 3.0 : drawing.budget;
    const std::uint64_t first = run(simulation, budget, verdict);
    if (!drawing.twice || verdict.what == Class::failed)
      return verdict;
    Verdict again;
    simulation.reset();
    const bool reset_differs = run(simulation, budget, again) != first;
    Simulation two(scene, 2);
    const bool threads_differ = run(two, budget, again) != first;
    if (reset_differs || threads_differ) {
      verdict.what = Class::failed;
      verdict.reason = reset_differs ? "other bits after reset()" : "other bits on two threads";
    }
  } catch (const std::exception& error) {
    verdict.what = Class::failed;
    verdict.reason = std::string("exception: ") + error.what();
  }
  return verdict;
}

}  // namespace geocontainer_mpm::stability
