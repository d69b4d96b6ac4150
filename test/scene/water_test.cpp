/// Bodies in water: Archimedes, added mass, drag, and their books.

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "geocontainer_mpm/error.h"
#include "geocontainer_mpm/scene/water.h"
#include "physics_fixture.h"

namespace geocontainer_mpm::scene {
namespace {

constexpr double fresh = 1000.0;

/// A block 0.6 m wide and 0.4 m high with its lower side at `bottom`, in water up to z = 0.
std::string block(double density, double bottom, double drag, double added, const std::string& more = "")
{
  return fmt::format(R"(
name: block
gravity_m_per_s2: [0, -9.81]
time: {{ end_s: 0.5, output_interval_s: 0.1, probe_interval_s: 0.01 }}
grid: {{ cell_size_m: 0.1, lower_m: [-1, -4], upper_m: [1, 3], faces: {{ y_min: free, y_max: free, z_min: free, z_max: free }} }}
materials:
  block: {{ law: linear_elastic, density_kg_per_m3: {}, young_modulus_pa: 1.0e6, poisson_ratio: 0.3 }}
bodies:
  block: {{ material: block, shape: {{ box: {{ lower_m: [-0.3, {}], upper_m: [0.3, {}] }} }} }}
water: {{ density_kg_per_m3: 1000, level_m: 0, drag_coefficient: {}, added_mass_coefficient: {} }}
probes:
  block: {{ body: block }}
{})",
                     density, bottom, bottom + 0.4, drag, added, more);
}

const std::vector<double>& column(const Simulation& simulation, const std::string& name, const std::string& probe)
{
  for (const ProbeFrame& series : simulation.probes())
    for (const ProbeFrame::Column& one : series.columns)
      if (series.name == probe && one.name == name)
        return one.values;
  throw std::runtime_error(name);
}

Simulation finished(const std::string& text, const std::vector<std::string>& overrides = {})
{
  Simulation simulation(parse_scene(text, "water", overrides), 1);
  EXPECT_EQ(run(simulation), Advance::finished) << simulation.failure().reason;
  return simulation;
}

TEST(Buoyancy, LeavesANeutralBodyWhereItIs)
{
  const Simulation simulation = finished(block(fresh, -2.0, 0.0, 0.0));
  EXPECT_NEAR(simulation.status().centroid_m.z(), -1.8, 1e-13);
  EXPECT_NEAR(simulation.water()->submerged_weight, 0.0, 1e-9);
}

TEST(Buoyancy, CarriesAsMuchAsABodyDisplaces)
{
  // A quarter of the density floats at a quarter of its height. What is left is the damped motion's rest, and the
  // block's own compression, rho g h / E = 1e-3 of a height.
  for (const double density : { 250.0, 500.0 }) {
    const Simulation simulation = finished(
        block(density, -0.15, 0.0, 0.0, "numerics: { damping_per_s: 5, skip_resting: false }"), { "time.end_s=4" });
    const double draught = 0.4 * density / fresh;
    EXPECT_NEAR(simulation.status().centroid_m.z(), 0.2 - draught, 2e-3 * 0.4) << density;
    EXPECT_NEAR(simulation.water()->submerged_share, density / fresh, 2e-3);
  }
}

TEST(Buoyancy, IsTakenFromWhatASupportCarries)
{
  // On a bed at -1 m the block is under water, at -0.1 m a quarter of it. Damped by its own viscosity: damping by mass
  // takes its part of the impulses on the bed. It ends 0.2 % shorter, and that much further out of the water.
  for (const auto& [bed, share] : { std::pair(-1.0, 1.0), std::pair(-0.1, 0.25) }) {
    const std::string surfaces =
        fmt::format("surfaces: {{ bed: {{ line_m: [[-1, {0}], [1, {0}]], friction: 0.5 }} }}", bed);
    const Simulation simulation =
        finished(block(2000, bed, 0.0, 0.0, surfaces),
                 { "time.end_s=1.5", "probes.bed={surface: bed}", "materials.block.stiffness_damping_s=0.002" });
    const double carried = -column(simulation, "force_z_n_per_m", "bed").back();
    const double weight = (2000 - share * fresh) * 0.24 * gravity;
    EXPECT_NEAR(carried, weight, 2e-3 * weight) << bed;
    EXPECT_NEAR(simulation.water()->submerged_weight, weight, 2e-3 * weight);
  }
}

TEST(AddedMass, SlowsAFallFromRest)
{
  // Leapfrog is exact for a constant acceleration, g (rho - rho_w) / (rho + Ca rho_w).
  for (const double added : { 0.0, 1.0, 3.0 }) {
    const Simulation simulation = finished(block(1800, -2.0, 0.0, added));
    const double fallen = 0.5 * gravity * (1800 - fresh) / (1800 + added * fresh) * 0.25;
    EXPECT_NEAR(-1.8 - simulation.status().centroid_m.z(), fallen, 1e-9 * fallen) << added;
    EXPECT_LT(simulation.counters().momentum_error, 1e-11);
    EXPECT_LT(simulation.energy().relative_balance_error, 1e-4);
  }
}

TEST(Water, AboveItABodyFallsFreely)
{
  const Simulation simulation = finished(block(1800, 1.5, 2.0, 2.0), { "time.end_s=0.4" });
  const double fallen = 0.5 * gravity * 0.16;
  EXPECT_NEAR(1.7 - simulation.status().centroid_m.z(), fallen, 1e-12 * fallen);
  EXPECT_EQ(simulation.water()->dissipated, 0.0);
}

/// Velocity of a rigid block of that density after a time, by the momentum of block and water: d((m + m_a) v)/dt = W -
/// B - drag while it goes in.
double fall_into(double density, double bottom, double drag, double added, double end_s)
{
  const double height = 0.4, width = 0.6, volume = width * height, dt = 1e-5;
  double z = bottom, v = 0.0;
  const auto share = [&] { return std::clamp(-z / height, 0.0, 1.0); };
  for (double t = 0.0; t < end_s - 0.5 * dt; t += dt) {
    const double s = share(), mass = (density + s * added * fresh) * volume;
    const double force = (s * fresh - density) * volume * gravity - 0.5 * fresh * drag * width * s * std::abs(v) * v;
    const double momentum = mass * v + dt * force;
    z += dt * v;
    v = momentum / ((density + share() * added * fresh) * volume);
  }
  return v;
}

TEST(Water, TakesMomentumFromABodyThatFallsIn)
{
  // Particles enter one row after the other, the body is elastic: it rings, by some per cent at an instant.
  const double end_s = 0.9;
  for (const auto& [drag, added] :
       { std::pair(0.0, 0.0), std::pair(1.0, 0.0), std::pair(0.0, 1.5), std::pair(1.0, 1.5) }) {
    const Simulation simulation = finished(block(1800, 1.0, drag, added), { fmt::format("time.end_s={}", end_s) });
    const double exact = fall_into(1800, 1.0, drag, added, end_s);
    EXPECT_NEAR(column(simulation, "velocity_z_m_per_s", "block").back(), exact, 0.01 * std::abs(exact))
        << drag << ", " << added;
    EXPECT_LT(simulation.energy().relative_balance_error, 0.002) << drag << ", " << added;
    EXPECT_LT(simulation.counters().momentum_error, 1e-11);
    EXPECT_GE(simulation.energy().dissipated_water, 0.0);
  }
}

TEST(Water, GivesNoEnergyToABodyThatLeapsOut)
{
  const Simulation simulation = finished(block(300, -2.5, 0.3, 0.5), { "time.end_s=1.4" });
  EXPECT_LT(simulation.water()->submerged_share, 0.5) << "out at least in part";
  EXPECT_LT(simulation.energy().relative_balance_error, 0.002);
  EXPECT_GT(simulation.energy().dissipated_water, 0.0);
}

TEST(Drag, HoldsAContainerAtItsTerminalVelocity)
{
  // A disc of slurry in a sheet: R = 0.5 m, b = 1 m. The sheet's inertia slows the way there, not the end; its weight
  // out of 393 kg/m of submerged slurry is 0.3 %. 3 % is the bar of the issue.
  const Simulation simulation = finished(R"(
name: container
gravity_m_per_s2: [0, -9.81]
time: { end_s: 5, output_interval_s: 1 }
grid: { cell_size_m: 0.1, lower_m: [-1.5, -14], upper_m: [1.5, 1], faces: { y_min: free, y_max: free, z_min: free, z_max: free } }
materials:
  clay: { law: linear_elastic, density_kg_per_m3: 1500, young_modulus_pa: 1.0e6, poisson_ratio: 0.3 }
bodies:
  fill: { material: clay, shape: { disc: { center_m: [0, 0], radius_m: 0.5 } } }
geotextiles:
  sheet:
    encloses: fill
    stiffness_n_per_m: 1.0e5
    mass_kg_per_m2: 0.4
    computational_mass_kg_per_m2: 4
    strength_n_per_m: 1.0e5
    segment_length_m: 0.1
water: { density_kg_per_m3: 1000, level_m: 5, drag_coefficient: 1.2, added_mass_coefficient: 1 }
probes:
  fill: { body: fill }
)");
  const double exact = std::sqrt(2.0 * 500.0 * gravity * 0.25 * 3.14159265 / (1000.0 * 1.2 * 1.0));
  EXPECT_NEAR(-column(simulation, "velocity_z_m_per_s", "fill").back(), exact, 0.03 * exact);
  EXPECT_NEAR(simulation.water()->fastest_fall_m_per_s, exact, 0.03 * exact);
  EXPECT_LT(simulation.energy().relative_balance_error, 0.005);
}

TEST(InitialStress, IsThatOfTheSubmergedWeight)
{
  // 2 m of fluid, the lower half under water: 1300 g above and (1300 - 1000) g below.
  Simulation simulation(parse_scene(R"(
name: column
gravity_m_per_s2: [0, -9.81]
time: { end_s: 0.1, output_interval_s: 0.1 }
grid: { cell_size_m: 0.1, lower_m: [0, -1], upper_m: [0.4, 1], faces: { y_min: roller, y_max: roller, z_min: roller, z_max: free } }
materials:
  slurry: { law: newtonian, density_kg_per_m3: 1300, bulk_modulus_pa: 1.0e8, viscosity_pa_s: 0 }
bodies:
  slurry: { material: slurry, shape: { box: { lower_m: [0, -1], upper_m: [0.4, 1] } }, initial_stress: hydrostatic }
water: { density_kg_per_m3: 1000, level_m: 0, drag_coefficient: 0, added_mass_coefficient: 0 }
)",
                                    "column"),
                        1);
  const Frame frame = simulation.frame();
  for (std::size_t p = 0; p < frame.soil[0].position.size(); ++p) {
    const double z = frame.soil[0].position[p].z();
    const double exact = gravity * (1300 * (1.0 - z) - 1000 * std::max(0.0, -z));
    // The fluid's compression, p / K: 1.6e-4.
    EXPECT_NEAR(-frame.soil[0].stress[p][2], exact, 2e-4 * exact);
  }
  // It is a start at rest: nothing moves but by the particles' rows, half a cell at surface and interface.
  EXPECT_EQ(run(simulation), Advance::finished);
  EXPECT_LT(simulation.energy().kinetic, 1e-4 * 1300 * 0.8 * gravity);
}

mpm::Particles<2> random_particles(const Water& water, double density, double height)
{
  mpm::Particles<2> particles;
  particles.resize(*rc::gen::inRange<std::size_t>(1, 20));
  const auto number = [] { return *rc::gen::inRange(-1000, 1000) * 1e-3; };
  for (std::size_t p = 0; p < particles.size(); ++p) {
    particles.initial_volume[p] = 2.0 + number();
    for (std::size_t d = 0; d < 2; ++d) {
      particles.position[d][p] = number();
      particles.velocity[d][p] = number();
    }
  }
  water.place(density, height, particles);
  return particles;
}

Water random_water()
{
  WaterDescription description;
  description.density_kg_per_m3 = 1000.0;
  description.drag_coefficient = *rc::gen::inRange(0, 3);
  description.added_mass_coefficient = *rc::gen::inRange(0, 3);
  return Water(description, 0.1, 9.81);
}

RC_GTEST_PROP(Water, BuoyancyIsTheSlopeOfItsEnergy, ())
{
  const Water water = random_water();
  const double z = *rc::gen::inRange(-1000, 1000) * 1e-3, height = *rc::gen::inRange(1, 1000) * 1e-3, h = 1e-6;
  const double slope = (water.depth(z - h, height) - water.depth(z + h, height)) / (2.0 * h);
  RC_ASSERT(std::abs(slope - water.submerged(z, height)) < h / height + 1e-8);  // kinks at both ends of the band
}

RC_GTEST_PROP(Water, NeitherGivesEnergyNorMomentumToWhatGoesInOrOut, ())
{
  const Water water = random_water();
  const double density = *rc::gen::inRange(200, 3000), height = 0.3;
  mpm::Particles<2> particles = random_particles(water, density, height);
  for (double& z : particles.position[1])
    z += *rc::gen::inRange(-300, 300) * 1e-3;
  const mpm::Particles<2> before = particles;
  const double left = water.immerse(density, height, particles).left_behind;
  double lost = 0.0, scale = 0.0;
  for (std::size_t p = 0; p < particles.size(); ++p) {
    const auto square = [p](const mpm::Particles<2>& all) {
      return all.velocity[0][p] * all.velocity[0][p] + all.velocity[1][p] * all.velocity[1][p];
    };
    const double energy = 0.5 * before.mass[p] * square(before), after = 0.5 * particles.mass[p] * square(particles);
    lost += energy - after;
    scale += energy;
    RC_ASSERT(energy - after >= -1e-12 * energy);
    for (std::size_t d = 0; d < 2; ++d) {
      const bool taken_up = particles.mass[p] >= before.mass[p];
      const double momentum =
          taken_up ? before.mass[p] * before.velocity[d][p] : particles.mass[p] * before.velocity[d][p];
      RC_ASSERT(std::abs(particles.mass[p] * particles.velocity[d][p] - momentum) <= 1e-12 * particles.mass[p]);
    }
  }
  RC_ASSERT(left >= 0.0);
  RC_ASSERT(std::abs(left - lost) <= 1e-12 * scale);
}

Vec2 sum_of(const std::array<mpm::Column, 2>& forces)
{
  Vec2 sum = Vec2::Zero();
  for (std::size_t p = 0; p < forces[0].size(); ++p)
    sum += Vec2(forces[0][p], forces[1][p]);
  return sum;
}

RC_GTEST_PROP(Water, DragActsAgainstTheMotionAndIsAllHandedOut, ())
{
  const Water water = random_water();
  mpm::Particles<2> particles = random_particles(water, 1500.0, 0.3);
  const Water::Drag<2> drag = water.resist(particles, 0.3, 0.3, particles);
  RC_ASSERT(drag.force.dot(drag.velocity) <= 0.0);
  water.spread(drag, 0.3, particles);
  RC_ASSERT((sum_of(particles.force) - drag.force).norm() <= 1e-12 * drag.force.norm());
}

TEST(Drag, PressesOnTheSideOfASheetThatFacesTheFlow)
{
  // A circle walked either way: all on the lower half, as the cosine of what faces downwards.
  WaterDescription description;
  description.density_kg_per_m3 = 1000.0;
  const Water water(description, 0.0, 9.81);
  Water::Drag<2> drag;
  drag.velocity = { 0.0, -2.0 };
  drag.force = { 0.0, 600.0 };
  for (const double sense : { 1.0, -1.0 }) {
    mpm::Particles<2> sheet;
    sheet.resize(36);
    for (std::size_t i = 0; i < 36; ++i) {
      sheet.position[0][i] = 5.0 + std::cos(sense * static_cast<double>(i) * 10.0 * degrees);
      sheet.position[1][i] = 3.0 + std::sin(sense * static_cast<double>(i) * 10.0 * degrees);
    }
    std::array<mpm::Column, 2> forces;
    water.press(drag, sheet, forces);
    EXPECT_NEAR((sum_of(forces) - drag.force).norm(), 0.0, 1e-10);
    for (std::size_t i = 0; i < 36; ++i) {
      EXPECT_EQ(forces[0][i], 0.0);
      const double down = 3.0 - sheet.position[1][i];
      if (std::abs(down) > 0.1) {  // not the two ends of the lower half
        EXPECT_NEAR(forces[1][i], std::max(0.0, down) * std::sin(10.0 * degrees) * 600.0 / 2.0, 1e-9);
      }
    }
  }
}

/// The key that is refused.
std::string refused(const std::string& text, const std::vector<std::string>& overrides)
{
  try {
    parse_scene(text, "water", overrides);
  } catch (const InputError& error) {
    return error.key();
  }
  return "";
}

TEST(WaterRules, SayWhereTheSurfaceIsInOneWay)
{
  const std::string scene = block(1800, -2.0, 1.0, 1.0);
  EXPECT_EQ(refused(scene, {}), "");
  EXPECT_EQ(refused(scene, { "water.draught_m=2" }), "water.draught_m");
  EXPECT_EQ(refused(scene, { "water={density_kg_per_m3: 1000, drag_coefficient: 1, added_mass_coefficient: 1}" }),
            "water.level_m");
  EXPECT_EQ(refused(scene, { "water.drag_coefficient=-1" }), "water.drag_coefficient");
  EXPECT_EQ(refused(scene, { "water.added_mass_coefficient=-1" }), "water.added_mass_coefficient");
  EXPECT_EQ(refused(scene, { "water.density_kg_per_m3=0" }), "water.density_kg_per_m3");
  EXPECT_EQ(refused(scene, { "gravity_m_per_s2=[0, 0]" }), "gravity_m_per_s2");
  EXPECT_EQ(refused(scene, { "gravity_m_per_s2=[1, -9.81]" }), "gravity_m_per_s2");

  const auto release = [](const std::string& override) {
    try {
      load_scene(scene_path("release_water"), { override });
    } catch (const InputError& error) {
      return error.key();
    }
    return std::string();
  };
  EXPECT_EQ(release("water.draught_m=4.3"), "");
  EXPECT_EQ(release("water.draught_m=4.4"), "water.draught_m") << "over the deck";
  EXPECT_EQ(release("water.level_m=-1"), "water.level_m");
  EXPECT_DOUBLE_EQ(load_scene(scene_path("release_water")).water_level_m(), -0.8);
}

TEST(ReleaseWater, IsTheDefaultReleaseWithWater)
{
  SceneDescription water = load_scene(scene_path("release_water")), release = load_scene(scene_path("release"));
  EXPECT_TRUE(water.water);
  water.water.reset();
  water.name = release.name;
  water.description = release.description;
  EXPECT_EQ(scene_text(water), scene_text(release));
}

}  // namespace
}  // namespace geocontainer_mpm::scene
