/// How long particles remember what the grid does not see of their velocities.

#include <cmath>

#include <fmt/format.h>

#include "physics_fixture.h"

namespace geocontainer_mpm::scene {
namespace {

constexpr double memory_s = 0.005;

/// A square as good as without stiffness, with a standing wave of velocity so slow that nothing moves: what becomes of
/// the wave is the transfer's doing alone. Particles are 5 cm apart, cells 10 cm. The rollers at both ends are where
/// the wave's mirror image continues it.
double wave_after(double time_s, double step_s, double length_m, const std::string& transfer)
{
  constexpr double amplitude = 1e-6;
  const std::string scene = fmt::format(R"(
name: wave
description: A wave of velocity in a square that has next to no stiffness.
gravity_m_per_s2: [0, 0]
time: {{ end_s: {0}, output_interval_s: {0} }}
grid: {{ cell_size_m: 0.1, lower_m: [0, 0], upper_m: [0.8, 0.4],
         faces: {{ y_min: roller, y_max: roller, z_min: roller, z_max: roller }} }}
numerics: {{ {1}, max_step_s: {2}, skip_resting: false }}
materials:
  dust: {{ law: linear_elastic, density_kg_per_m3: 1000, young_modulus_pa: 1.0e-6, poisson_ratio: 0 }}
bodies:
  square:
    material: dust
    shape: {{ box: {{ lower_m: [0, 0], upper_m: [0.8, 0.4] }} }}
    particles_per_cell: 2
    initial_velocity_wave: {{ amplitude_m_per_s: [{3}, 0], wave_number_rad_per_m: [{4:.17g}, 0] }}
)",
                                        time_s, transfer, step_s, amplitude, 360.0 * degrees / length_m);
  Simulation simulation(parse_scene(scene, "wave"), 1);
  const std::vector<Vec3> start = simulation.frame().soil.front().velocity;
  EXPECT_EQ(run(simulation), Advance::finished) << simulation.failure().reason;
  const std::vector<Vec3> end = simulation.frame().soil.front().velocity;
  double product = 0.0, square = 0.0;
  for (std::size_t p = 0; p < start.size(); ++p) {
    product += start[p].dot(end[p]);
    square += start[p].squaredNorm();
  }
  EXPECT_GT(square, 0.1 * amplitude * amplitude * static_cast<double>(start.size()));
  return product / square;
}

std::string remembering()
{
  return fmt::format("transfer: aflip, transfer_memory_s: {}", memory_s);
}

TEST(TransferMemory, OfWhatTheGridDoesNotSeeFallsExponentially)
{
  // Signs that change from particle to particle are nothing to the grid. Velocities live at mid-steps.
  for (const double step_s : { 1e-3, 2.5e-4 })
    EXPECT_NEAR(wave_after(0.01, step_s, 0.1, remembering()), std::exp(-(0.01 - 0.5 * step_s) / memory_s), 1e-6)
        << step_s;
  EXPECT_NEAR(wave_after(0.01, 1e-3, 0.1, "transfer: apic"), 0.0, 1e-6);
}

TEST(TransferMemory, MakesTheLossOneOfTimeAndNotOfSteps)
{
  // Four cells to a wave: the grid sees most of it, and apic takes the rest in every step.
  const auto loss = [](double step_s, const std::string& transfer) {
    return -std::log(wave_after(0.02, step_s, 0.4, transfer)) / 0.02;
  };
  constexpr double step_s = 5e-4, short_s = 0.25 * step_s;
  const double apic = loss(step_s, "transfer: apic"), apic_short = loss(short_s, "transfer: apic");
  EXPECT_NEAR(apic_short / apic, 4.0, 0.1);
  // A tenth: 1 - exp(-dt / memory) is less than dt / memory, and at first the affine matrices fall behind.
  const double blended = loss(step_s, remembering()), blended_short = loss(short_s, remembering());
  EXPECT_NEAR(blended_short / blended, 1.0, 0.1);
  EXPECT_LT(blended, 0.5 * apic);
  EXPECT_GT(blended, 0.0);
}

}  // namespace
}  // namespace geocontainer_mpm::scene
