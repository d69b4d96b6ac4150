/// Scenes in space: with one cell between rollers they are plane strain, and a quarter is as good as the whole.

#include <fmt/format.h>

#include "description_fixture.h"
#include "physics_fixture.h"

namespace geocontainer_mpm::scene {
namespace {

/// A bag of sand falls flat on a bed and spreads until its sheet holds it. Its steps are of one length, whatever the
/// model: how much the transfers smooth depends on their number. `space`, `along`: lines that make it a scene in space.
std::string falling_bag(double cell, const std::string& space, const std::string& along, double end_s)
{
  return fmt::format(R"(
name: bag
numerics: {{ max_step_s: 0.0005 }}
time: {{ end_s: {}, output_interval_s: 0.02 }}
grid:
  cell_size_m: {}
  lower_m: [-1.6, -0.4]
  upper_m: [1.6, 1.6]
  faces: {{ y_min: free, y_max: free, z_min: free, z_max: free }}
{}
materials:
  sand: {{ law: mohr_coulomb, density_kg_per_m3: 1800, young_modulus_pa: 1.0e6, poisson_ratio: 0.3,
          friction_angle_deg: 30, dilation_angle_deg: 0, cohesion_pa: 0, tension_cutoff_pa: 0 }}
bodies:
  sand: {{ material: sand, {} initial_velocity_m_per_s: [0, -2],
          shape: {{ polygon: {{ vertices_m: [[0, 0], [0.6, 0], [0.6, 0.8], [-0.6, 0.8], [-0.6, 0]] }} }} }}
geotextiles:
  bag: {{ encloses: sand, slack: 0.02, stiffness_n_per_m: 2.0e5, mass_kg_per_m2: 1, computational_mass_kg_per_m2: 20,
         strength_n_per_m: 1.0e5, segment_length_m: {}, gauge_length_m: 0.4 }}
surfaces:
  bed: {{ line_m: [[-1.6, 0], [1.6, 0]], friction: 0.4 }}
)",
                     end_s, cell, space, along, cell);
}

struct Result {
  StatusFrame status;
  EnergyFrame energy;
  double force_z;  ///< largest of the bed in an output interval
};

Result fall(const std::string& text)
{
  Simulation simulation(parse_scene(text, "bag.yaml"), 1);
  Result result{ {}, {}, 0.0 };
  EXPECT_EQ(run(simulation,
                [&](const Simulation& now) {
                  result.force_z = std::max(result.force_z, -now.frame().boundary.front().force[2]);
                }),
            Advance::finished)
      << simulation.failure().reason;
  result.status = simulation.status();
  result.energy = simulation.energy();
  return result;
}

/// The bed's force is per width in plane strain.
void expect_equal(const Result& space, const Result& other, double force_factor, double tolerance)
{
  const auto within = [&](double a, double b, const char* what) { EXPECT_NEAR(a, b, tolerance * std::abs(b)) << what; };
  within(space.status.peak_tension_n_per_m, other.status.peak_tension_n_per_m, "peak tension");
  within(space.status.current_tension_n_per_m, other.status.current_tension_n_per_m, "tension at the end");
  within(space.status.width_m, other.status.width_m, "width");
  within(space.status.height_m, other.status.height_m, "height");
  within(space.status.centroid_m[2], other.status.centroid_m[2], "centroid");
  within(space.force_z * force_factor, other.force_z, "force on the bed");
}

TEST(Space, OneCellBetweenRollersIsPlaneStrain)
{
  const double cell = 0.1, end_s = 0.6;
  const Result plane = fall(falling_bag(cell, "", "", end_s));
  const Result space = fall(falling_bag(cell, "space: { along_m: [0, 0.1] }", "along_m: [0, 0.1],", end_s));
  ASSERT_GT(plane.status.peak_tension_n_per_m, 1000.0);
  expect_equal(space, plane, 1.0 / cell, 0.01);
  EXPECT_NEAR(space.status.soil_volume, plane.status.soil_volume * cell, 0.01 * plane.status.soil_volume * cell);
}

TEST(Space, AQuarterIsAsGoodAsTheWhole)
{
  const auto text = [](const char* symmetry) {
    return falling_bag(
        0.2, fmt::format("space: {{ along_m: [-1.6, 1.6], x_min: free, x_max: free, symmetry: {} }}", symmetry),
        "along_m: [-1, 1],", 0.5);
  };
  const Result whole = fall(text("none"));
  ASSERT_GT(whole.status.peak_tension_n_per_m, 1000.0);
  const Result half = fall(text("half")), quarter = fall(text("quarter"));
  expect_equal(half, whole, 2.0, 0.01);
  expect_equal(quarter, whole, 4.0, 0.01);
  EXPECT_NEAR(half.energy.potential, whole.energy.potential, 0.01 * std::abs(whole.energy.potential));
  EXPECT_NEAR(quarter.energy.potential, whole.energy.potential, 0.01 * std::abs(whole.energy.potential));
  EXPECT_NEAR(quarter.energy.dissipated, whole.energy.dissipated, 0.01 * whole.energy.dissipated);
  EXPECT_NEAR(quarter.status.length_m, whole.status.length_m, 0.01 * whole.status.length_m);
  EXPECT_NEAR(quarter.status.soil_volume, whole.status.soil_volume, 0.01 * whole.status.soil_volume);
}

TEST(Space, AnUnevenOpeningStopsHalfAModel)
{
  Simulation simulation(parse_scene(solid_scene, "solid.yaml", { "bodies.fill.initial_stress=k0" }), 1);
  simulation.opening() = barge::OpeningSignal::through({ { 0.0, { 0.0, 0.0 } }, { 1.0, { 0.05, 0.02 } } }, "opening");
  Advance now = Advance::stepped;
  while (now == Advance::stepped || now == Advance::frame_due)
    now = simulation.advance();
  EXPECT_EQ(now, Advance::stopped);
  EXPECT_NE(simulation.failure().reason.find("opens unevenly"), std::string::npos) << simulation.failure().reason;
  EXPECT_GT(simulation.time_s(), 0.2);
  EXPECT_LT(simulation.time_s(), 0.7);
}

}  // namespace
}  // namespace geocontainer_mpm::scene
