/// Closed forms of motion: free fall, a block on a plane, a block between two walls.

#include <fmt/format.h>

#include "geocontainer_mpm/contact/surface.h"
#include "physics_fixture.h"

namespace geocontainer_mpm::scene {
namespace {

constexpr const char* falling_block = R"(
name: falling_block
description: A block falls freely.
gravity_m_per_s2: [0, -9.81]
time: { end_s: 0.5, output_interval_s: 0.1 }
grid: { cell_size_m: 0.1, lower_m: [-1, -2], upper_m: [1, 1], faces: { y_min: free, y_max: free, z_min: free, z_max: free } }
materials:
  block: { law: linear_elastic, density_kg_per_m3: 2000, young_modulus_pa: 1.0e6, poisson_ratio: 0.3 }
bodies:
  block:
    material: block
    shape: { box: { lower_m: [-0.23, 0.1], upper_m: [0.31, 0.7] } }
    initial_velocity_m_per_s: [0.3, 0.4]
)";

TEST(FreeFall, FollowsTheParabolaToRoundOff)
{
  // With half-steps at both ends of every kick the leapfrog's own solution for constant acceleration is the parabola
  // itself, whatever the steps, so one bound covers both comparisons.
  Simulation simulation(parse_scene(falling_block, "falling_block"), 1);
  const Vec3 start = simulation.status().centroid_m;
  EXPECT_EQ(run(simulation), Advance::finished);
  const double t = simulation.time_s();
  EXPECT_DOUBLE_EQ(t, 0.5);
  const Vec3 moved = simulation.status().centroid_m - start;
  const double fallen = 0.4 * t - 0.5 * gravity * t * t;
  EXPECT_NEAR(moved.y(), 0.3 * t, 1e-9 * 0.3 * t);
  EXPECT_NEAR(moved.z(), fallen, 1e-9 * std::abs(fallen));
  EXPECT_LT(simulation.counters().momentum_error, 1e-11);
  // Struck at mid-step, half a step's parabola is what the balance leaves open: g^2 dt^2 / 8 over g h.
  EXPECT_LT(simulation.energy().relative_balance_error, 1e-5);
  EXPECT_GT(simulation.counters().steps, 100U);
}

/// Distance that the block of config/scenes/block_on_incline.yaml moves down its plane.
double slide(double friction, double until_s)
{
  Simulation simulation(
      load_scene(scene_path("block_on_incline"),
                 { fmt::format("surfaces.plane.friction={}", friction), fmt::format("time.end_s={}", until_s) }),
      1);
  const Vec3 start = simulation.status().centroid_m;
  EXPECT_EQ(run(simulation), Advance::finished) << simulation.failure().reason;
  const Vec3 moved = simulation.status().centroid_m - start;
  return moved.y() * std::cos(30 * degrees) - moved.z() * std::sin(30 * degrees);
}

TEST(BlockOnIncline, SlidesAsTheClosedForm)
{
  for (const double friction : { 0.0, 0.1, 0.2, 0.3, 0.4 }) {
    const double t = 1.2;
    const double exact = 0.5 * gravity * (std::sin(30 * degrees) - friction * std::cos(30 * degrees)) * t * t;
    EXPECT_NEAR(slide(friction, t), exact, 0.02 * exact) << "friction " << friction;
  }
}

TEST(BlockOnIncline, SticksWithoutCreep)
{
  // Above tan 30 = 0.577. A micrometre is what the elastic block gives when it is let go from the held state.
  for (const double friction : { 0.6, 0.7, 1.0 }) {
    const double early = slide(friction, 0.6), late = slide(friction, 1.2);
    EXPECT_LT(std::abs(early), 1e-3) << "friction " << friction;
    EXPECT_LT(std::abs(late - early), 1e-6) << "friction " << friction;
  }
}

/// Opening angle, deg, at which a block on each hull wall starts to slide while the hull opens at 1 deg/s. The walls
/// stand at `wall_deg` when closed. The blocks do not touch each other: two walls that converge would hold any one
/// block.
double sliding_angle(double wall_deg, double friction)
{
  const double rise = std::tan(wall_deg * degrees);
  const double y = 1.6, z = -3.0 + rise * y;
  const auto block = [&](double side) {
    return fmt::format(
        "{{ material: block, initial_stress: gravity, shape: {{ box: {{ lower_m: [{}, {}], upper_m: [{}, {}], "
        "rotation_deg: {}, pivot_m: [{}, {}] }} }} }}",
        side * y - 0.5, z, side * y + 0.5, z + 0.3, side * wall_deg, side * y, z);
  };
  const std::string yaml = fmt::format(R"(
name: two_walls
description: A block on each wall of an opening hull.
gravity_m_per_s2: [0, -9.81]
time: {{ end_s: 4.0, output_interval_s: 0.02 }}
grid: {{ cell_size_m: 0.1, lower_m: [-4, -5], upper_m: [4, 1], faces: {{ y_min: free, y_max: free, z_min: free, z_max: free }} }}
materials:
  block: {{ law: linear_elastic, density_kg_per_m3: 2000, young_modulus_pa: 1.0e7, poisson_ratio: 0.2 }}
bodies:
  port: {0}
  starboard: {1}
hull:
  hinge_m: [0, 0]
  port_section_m: [[1.5, -3.4], [0, -3.4], [0, -3.0], [3.0, {2}]]
  lip_radius_m: 0
  friction: {3}
  opening_table: [[0, 0, 0], [4, {4}, {4}]]
)",
                                       block(1.0), block(-1.0), -3.0 + 3.0 * rise, friction, 4.0 * degrees);
  Simulation simulation(parse_scene(yaml, "two_walls"), 1);
  double angle = -1.0;
  const auto centroid = [](const SoilFrame& soil) {
    Vec2 sum = Vec2::Zero();
    for (const Vec3& x : soil.position)
      sum += x.tail<2>();
    return Vec2(sum / static_cast<double>(soil.position.size()));
  };
  Vec2 start = Vec2::Zero();
  run(simulation, [&](const Simulation& s) {
    const Frame frame = s.frame();
    // The port block as the wall sees it.
    const Vec2 seen =
        contact::RigidPose::rotation(frame.opening.port_rad, Vec2::Zero()).invert(centroid(frame.soil[0]));
    if (frame.time_s == 0.0)
      start = seen;
    if (angle < 0.0 && (seen - start).norm() > 1e-3)
      angle = frame.opening.port_rad / degrees;
  });
  return angle;
}

TEST(BlockBetweenWalls, ReleasesWhereTheInclinationPassesTheFrictionAngle)
{
  for (const double friction : { 0.2, 0.4, 0.6 }) {
    const double wall = std::atan(friction) / degrees - 2.0;
    EXPECT_NEAR(wall + sliding_angle(wall, friction), std::atan(friction) / degrees, 0.5) << "friction " << friction;
  }
}

}  // namespace
}  // namespace geocontainer_mpm::scene
