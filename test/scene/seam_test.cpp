/// A seam that comes apart in a release.

#include "physics_fixture.h"

namespace geocontainer_mpm::scene {
namespace {

/// The default release on coarse cells, with seams beside the bottom, where the lips squeeze the sheet; in the slot
/// they are pulled with some 60 kN/m there.
StatusFrame release(const std::string& seam, double& energy_error, double& rupture_energy)
{
  const SceneDescription scene =
      load_scene(scene_path("release"),
                 { "grid.cell_size_m=0.4", "grid.lower_m=[-14, -10.4]", "grid.upper_m=[14, 0.8]",
                   "surfaces.bed.line_m=[[-14, -9.3], [14, -9.3]]",  // the sand of a torn container spreads
                   "geotextiles.container.segment_length_m=0.4", "time.end_s=24", "time.output_interval_s=1",
                   "geotextiles.container.seams={ port: { along: 0.13, " + seam + " }, starboard: { along: 0.87, " +
                       seam + " } }" });
  Simulation simulation(scene, 1);
  EXPECT_EQ(run(simulation), Advance::finished);
  energy_error = simulation.energy().relative_balance_error;
  rupture_energy = simulation.energy().dissipated_rupture;
  return simulation.status();
}

TEST(Seam, TearsWhereItsStrengthIsReachedAndNotWhereItIsNot)
{
  double error = 0.0, energy = 0.0;
  const StatusFrame whole = release("efficiency: 0.8, tears: true", error, energy);
  EXPECT_EQ(whole.ruptures, 0u);
  EXPECT_EQ(whole.outcome, Outcome::released);
  EXPECT_EQ(energy, 0.0);

  const StatusFrame torn = release("efficiency: 0.15, tears: true", error, energy);
  EXPECT_GE(torn.ruptures, 1u);
  EXPECT_LE(torn.ruptures, 2u) << "the seams alone";
  EXPECT_GT(torn.rupture_time_s, 10.0);
  EXPECT_LT(torn.rupture_time_s, whole.release_time_s) << "in the slot";
  EXPECT_LT(torn.rupture_position_m.z(), -3.0);
  // What the seam held when it broke: between its strength, 30 kN/m, and a step more, in one piece of 0.4 m or two.
  const double held = 0.5 * 30e3 * 30e3 / 1.1e6 * 0.4;
  EXPECT_GT(energy, 0.9 * held);
  EXPECT_LT(energy, 2.6 * held);
  EXPECT_LT(error, 0.03);

  const StatusFrame reported = release("efficiency: 0.15", error, energy);
  EXPECT_EQ(reported.ruptures, 0u);
  EXPECT_GT(reported.peak_utilisation_seam, 1.0) << "overloaded, and said to be so";
}

}  // namespace
}  // namespace geocontainer_mpm::scene
