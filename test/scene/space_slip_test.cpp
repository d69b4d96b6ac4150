/// Fill that slips in its geotextile in space: with one cell between rollers as in plane strain, a quarter as good as
/// the whole.

#include <gtest/gtest.h>

#include "space_fixture.h"

namespace geocontainer_mpm::scene {
namespace {

std::string slipping_bag(double cell, const std::string& space, const std::string& along, double end_s)
{
  return changed(falling_bag(cell, space, along, end_s), "bag: { encloses: sand,",
                 "bag: { encloses: sand, interface: frictional, interface_friction: 0.3,");
}

TEST(SpaceSlip, OneCellBetweenRollersIsPlaneStrain)
{
  const double cell = 0.1, end_s = 0.6;
  const Result plane = fall(slipping_bag(cell, "", "", end_s));
  const Result space = fall(slipping_bag(cell, "space: { along_m: [0, 0.1] }", "along_m: [0, 0.1],", end_s));
  ASSERT_GT(plane.status.peak_tension_n_per_m, 1000.0);
  expect_equal(space, plane, 1.0 / cell, 0.01);
  EXPECT_NEAR(space.energy.dissipated_contact / cell, plane.energy.dissipated_contact,
              0.01 * plane.energy.dissipated_contact);
  EXPECT_LT(space.energy.relative_balance_error, 0.01);
}

TEST(SpaceSlip, AQuarterIsAsGoodAsTheWhole)
{
  const auto text = [](const char* symmetry) {
    return slipping_bag(
        0.2, fmt::format("space: {{ along_m: [-1.6, 1.6], x_min: free, x_max: free, symmetry: {} }}", symmetry),
        "along_m: [-1, 1],", 0.5);
  };
  const Result whole = fall(text("none"));
  ASSERT_GT(whole.status.peak_tension_n_per_m, 1000.0);
  EXPECT_LT(whole.energy.relative_balance_error, 0.01);
  const Result half = fall(text("half")), quarter = fall(text("quarter"));
  expect_equal(half, whole, 2.0, 0.01);
  expect_equal(quarter, whole, 4.0, 0.01);
  EXPECT_NEAR(quarter.energy.dissipated_contact, whole.energy.dissipated_contact,
              0.01 * whole.energy.dissipated_contact);
  EXPECT_NEAR(quarter.status.length_m, whole.status.length_m, 0.01 * whole.status.length_m);
}

/// A bag on the bed, and another that falls on it: geotextile on geotextile.
std::string two_bags(const std::string& space, const std::string& along)
{
  std::string text = falling_bag(0.1, space, along, 0.3);
  text = changed(text, "sand: { material: sand,", "sand: { material: sand, velocity_field: lower,");
  text = changed(text, "initial_velocity_m_per_s: [0, -2],", "");
  text = changed(text, "geotextiles:\n",
                 "  top: { material: sand, velocity_field: upper, " + along +
                     " initial_velocity_m_per_s: [0, -2],\n"
                     "         shape: { box: { lower_m: [-0.5, 0.85], upper_m: [0.5, 1.25] } } }\n"
                     "contacts: { bags: { between: [lower, upper], friction: 0.3 } }\n"
                     "geotextiles:\n"
                     "  cover: { encloses: top, slack: 0.02, stiffness_n_per_m: 2.0e5, mass_kg_per_m2: 1,\n"
                     "           computational_mass_kg_per_m2: 20, strength_n_per_m: 1.0e5, segment_length_m: 0.1,\n"
                     "           gauge_length_m: 0.4 }\n");
  return text;
}

TEST(SpaceSlip, TwoContainersTouchAsInPlaneStrain)
{
  const Result plane = fall(two_bags("", ""));
  const Result space = fall(two_bags("space: { along_m: [0, 0.1] }", "along_m: [0, 0.1],"));
  ASSERT_GT(plane.force_z, 2.0 * 1800 * gravity * 1.4) << "the upper one has landed";
  expect_equal(space, plane, 10.0, 0.01);
  EXPECT_LT(space.energy.relative_balance_error, 0.01);
}

}  // namespace
}  // namespace geocontainer_mpm::scene
