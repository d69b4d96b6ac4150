/// Scenes in space: with one cell between rollers they are plane strain, and a quarter is as good as the whole.

#include "space_fixture.h"

namespace geocontainer_mpm::scene {
namespace {

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

TEST(Space, ASeamAlongTheBargeIsAPointOfTheSection)
{
  // Near the bag's lower corner on starboard, which half a model has as its image on port.
  const auto text = [](const std::string& space, const std::string& along) {
    return changed(falling_bag(0.2, space, along, 0.3), "strength_n_per_m: 1.0e5,",
                   "strength_n_per_m: 1.0e5, seams: { low: { at_m: [-0.6, 0.1], efficiency: 0.1 } },");
  };
  const Result plane = fall(text("", ""));
  ASSERT_GT(plane.status.peak_utilisation_seam, plane.status.peak_utilisation_sheet);
  ASSERT_LT(plane.status.peak_utilisation_seam, 9.9 * plane.status.peak_utilisation_sheet) << "not where it is tensest";
  EXPECT_EQ(plane.status.utilisation_sheet, plane.status.current_tension_n_per_m / 1.0e5) << "now";
  EXPECT_GT(plane.status.utilisation_seam, 0.0);
  EXPECT_LE(plane.status.utilisation_seam, plane.status.peak_utilisation_seam);
  for (const char* symmetry : { "none", "half" }) {
    const Result space =
        fall(text(fmt::format("space: {{ along_m: [0, 0.2], symmetry: {} }}", symmetry), "along_m: [0, 0.2],"));
    EXPECT_NEAR(space.status.peak_utilisation_seam, plane.status.peak_utilisation_seam,
                0.01 * plane.status.peak_utilisation_seam);
  }
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
