// The force-strain law, rupture of sheets and their seams, and strength of sheet and seams.

#include "geocontainer_mpm/geotextile/strength.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "geocontainer_mpm/geotextile/membrane.h"
#include "geocontainer_mpm/geotextile/sheet.h"

namespace geocontainer_mpm::geotextile::testing {
namespace {

TEST(ForceStrain, IsLinearWithoutATable)
{
  const ForceStrain law(1.1e6);
  EXPECT_EQ(law.force(-0.1), 0.0);
  EXPECT_EQ(law.force(0.03), 1.1e6 * 0.03);
  EXPECT_DOUBLE_EQ(law.energy(0.03), 0.5 * 1.1e6 * 0.03 * 0.03);
  EXPECT_EQ(law.energy(-0.03), 0.0);
  EXPECT_EQ(law.strain(3.3e4), 3.3e4 / 1.1e6);
  EXPECT_EQ(law.steepest(), 1.1e6);
}

/// A woven sheet of 120 kN/m: 30 kN/m at 5 %, 120 at 15 %.
const std::vector<ForceStrainRow> woven{ { 0.0, 0.0 }, { 0.05, 3e4 }, { 0.15, 1.2e5 } };

TEST(ForceStrain, FollowsItsTableAndGoesOnWithItsLastSlope)
{
  const ForceStrain law(0.0, woven);
  EXPECT_EQ(law.force(-1.0), 0.0);
  EXPECT_DOUBLE_EQ(law.force(0.02), 1.2e4);
  EXPECT_DOUBLE_EQ(law.force(0.05), 3e4);
  EXPECT_DOUBLE_EQ(law.force(0.1), 7.5e4);
  EXPECT_DOUBLE_EQ(law.force(0.2), 1.65e5);
  EXPECT_DOUBLE_EQ(law.steepest(), 9e5);
  for (const double strain : { 0.0, 0.01, 0.05, 0.12, 0.3 })
    EXPECT_NEAR(law.strain(law.force(strain)), strain, 1e-15);
}

TEST(ForceStrain, StoresTheAreaBelowItsTable)
{
  const ForceStrain law(0.0, woven);
  EXPECT_EQ(law.energy(-0.1), 0.0);
  EXPECT_DOUBLE_EQ(law.energy(0.02), 120.0);
  EXPECT_DOUBLE_EQ(law.energy(0.05), 750.0);
  EXPECT_DOUBLE_EQ(law.energy(0.1), 750.0 + 0.5 * (3e4 + 7.5e4) * 0.05);
  EXPECT_DOUBLE_EQ(law.energy(0.2), 750.0 + 7500.0 + 0.5 * (1.2e5 + 1.65e5) * 0.05);
}

SheetParameters strip()
{
  SheetParameters p;
  p.force_strain = woven;
  p.rupture_strain = 0.15;
  p.mass = p.computational_mass = 1.0;
  p.unstretched_length = 1.0;
  p.segment_length = p.gauge_length = 0.25;
  return p;
}

TEST(Rupture, BreaksASegmentForGood)
{
  Sheet sheet({ { { 0.0, 0.0 }, { 1.0, 0.0 } }, false }, strip());
  const auto stretch_last = [&](double strain) {
    sheet.nodes().position[0][4] = 0.75 + 0.25 * (1.0 + strain);
    sheet.update_forces();
  };
  stretch_last(0.14);
  EXPECT_EQ(sheet.ruptures(), 0U);
  EXPECT_NEAR(sheet.tension()[3], 1.11e5, 1e-6);
  stretch_last(0.16);
  EXPECT_EQ(sheet.ruptures(), 1U);
  EXPECT_EQ(sheet.tension()[3], 0.0);
  EXPECT_NEAR(sheet.rupture_place()[0], 0.75 + 0.125 * 1.16, 1e-12);
  EXPECT_EQ(sheet.nodes().force[0][4], 0.0);
  EXPECT_EQ(sheet.elastic_energy(), 0.0);
  const double stored = ForceStrain(0.0, woven).energy(0.14);
  EXPECT_NEAR(sheet.rupture_energy(), 0.25 * (stored + 0.5 * 1.11e5 * 0.02), 1e-8);
  const double gone = sheet.rupture_energy();
  stretch_last(0.05);
  EXPECT_EQ(sheet.tension()[3], 0.0);
  stretch_last(0.3);
  EXPECT_EQ(sheet.rupture_energy(), gone) << "it breaks once";
}

TEST(Rupture, OfASeamIsAtItsOwnTension)
{
  SheetParameters p = strip();
  for (const bool whole : { true, false }) {
    p.rupture_strain = whole ? std::nullopt : std::optional<double>(0.05);
    Sheet sheet({ { { 0.0, 0.0 }, { 1.0, 0.0 } }, false }, p);
    sheet.tear_at(1, 5e4);
    const auto stretch = [&](double strain) {
      for (std::size_t i = 0; i < 5; ++i)
        sheet.nodes().position[0][i] = 0.25 * static_cast<double>(i) * (1.0 + strain);
      sheet.update_forces();
    };
    const double strain = ForceStrain(0.0, woven).strain(5e4);
    stretch((1.0 - 1e-9) * std::min(strain, p.rupture_strain.value_or(strain)));
    EXPECT_EQ(sheet.ruptures(), 0U);
    stretch((1.0 + 1e-9) * std::min(strain, p.rupture_strain.value_or(strain)));
    EXPECT_EQ(sheet.ruptures(), whole ? 1U : 4U) << "the sheet's own rupture comes first where it is the lower one";
    EXPECT_EQ(sheet.tension()[1], 0.0);
    EXPECT_EQ(sheet.tension()[0] > 0.0, whole);
  }
}

TEST(Rupture, OfASeamInSpaceIsAcrossItsWarpAlone)
{
  const SheetLayout line{ { { 0.0, 0.0 }, { 1.0, 0.0 } }, false };
  MembraneParameters p;
  p.warp_stiffness = 1.1e6;
  p.weft_stiffness = 0.4e6;
  p.mass = p.computational_mass = 1.0;
  p.gauge_length = 0.5;
  Membrane membrane(wrap(line, { 0.0, 0.25 }, {}, 0.25), p);
  const double tension = 0.05 * p.warp_stiffness;
  membrane.tear_at(2, tension);
  membrane.tear_at(3, tension);
  const auto stretch = [&](double strain) {
    for (std::size_t i = 0; i < 10; ++i)
      membrane.nodes().position[1][i] = 0.25 * static_cast<double>(i % 5) * (1.0 + strain);
    membrane.update_forces();
  };
  stretch(0.0499);
  EXPECT_EQ(membrane.ruptures(), 0U);
  stretch(0.0501);
  EXPECT_EQ(membrane.ruptures(), 2U);
  for (std::size_t t = 0; t < membrane.triangles().size(); ++t)
    EXPECT_EQ(membrane.warp_tension()[t] > 0.0, t != 2 && t != 3) << t;
}

TEST(Strength, OfASeamAnywhereIsThatOfTheSheetTimesItsEfficiency)
{
  const Strength strength(1e5, 0.8);
  const Utilisation used = strength.utilisation({ 1e4, 4e4, 2e4 });
  EXPECT_DOUBLE_EQ(used.sheet, 0.4);
  EXPECT_DOUBLE_EQ(used.seam, 0.5);
  EXPECT_DOUBLE_EQ(strength.weakest_seam(), 8e4);
}

TEST(Strength, OfNamedSeamsCountsWhereTheyAre)
{
  const Strength strength(1e5, 0.8, { { "left", 0, 0.5 }, { "right", 2, 0.9 } });
  const Utilisation used = strength.utilisation({ 1e4, 4e4, 2.7e4 });
  EXPECT_DOUBLE_EQ(used.sheet, 0.4);
  EXPECT_DOUBLE_EQ(used.seam, 0.3);
  EXPECT_DOUBLE_EQ(strength.weakest_seam(), 5e4);
}

}  // namespace
}  // namespace geocontainer_mpm::geotextile::testing
