// Folds: how much cloth they take, where it lies, and what a sheet laid along them carries.

#include "geocontainer_mpm/geotextile/layout.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geocontainer_mpm/geotextile/sheet.h"

namespace geocontainer_mpm::geotextile {
namespace {

/// 4 m x 2 m, against the clock from the lower left corner.
SheetLayout rectangle()
{
  return { { { 0.0, 0.0 }, { 4.0, 0.0 }, { 4.0, 2.0 }, { 0.0, 2.0 } }, true };
}

/// Ten folds 0.15 m high on the middle 2 m of the bottom: sqrt(2^2 + 3^2) m of cloth.
Folds folds()
{
  return { { 1.0, -0.1 }, { 3.0, 0.1 }, 10, 0.15 };
}

constexpr double round_off = 1e-12;

TEST(Layout, WithoutFoldsClothIsAsLongAsTheLine)
{
  EXPECT_DOUBLE_EQ(rectangle().cloth_length(), 12.0);
  const SheetLayout open{ { { 0.0, 0.0 }, { 3.0, 4.0 } } };
  EXPECT_DOUBLE_EQ(open.cloth_length(), 5.0);
  EXPECT_TRUE(fold(rectangle(), { { 5.0, 5.0 }, { 6.0, 6.0 }, 3, 1.0 }).fullness.empty()) << "nothing is inside";
}

TEST(Layout, FoldsTakeTheClothOfTheirTwoSides)
{
  const SheetLayout folded = fold(rectangle(), folds());
  EXPECT_NEAR(folded.cloth_length(), 10.0 + std::sqrt(13.0), round_off);
  ASSERT_EQ(folded.points.size(), 6U) << "cut where the rectangle begins and ends";
  EXPECT_EQ(folded.points[1], Vec2(1.0, 0.0));
  EXPECT_EQ(folded.points[2], Vec2(3.0, 0.0));
  EXPECT_NEAR(folded.fullness[1], std::sqrt(13.0) / 2.0, round_off);
  EXPECT_EQ(folded.fullness[2], 1.0);
}

TEST(Layout, AStretchMayGoRoundACorner)
{
  const SheetLayout folded = fold(rectangle(), { { 3.0, -0.1 }, { 4.1, 0.5 }, 2, 1.0 });  // 1.5 m round (4, 0)
  EXPECT_NEAR(folded.cloth_length(), 10.5 + std::hypot(1.5, 4.0), round_off);
}

TEST(Layout, SegmentsHaveEqualClothAndLieCloserInTheFolds)
{
  const SheetLayout layout = fold(rectangle(), folds());
  SheetParameters parameters;
  parameters.unstretched_length = layout.cloth_length();
  parameters.stiffness = 1e6;
  parameters.mass = 0.8;
  parameters.computational_mass = 20.0;
  parameters.segment_length = 0.05;
  parameters.gauge_length = 0.5;
  Sheet sheet(layout, parameters);
  sheet.update_forces();
  EXPECT_LT(sheet.largest_strain(), round_off) << "laid without tension";
  EXPECT_EQ(sheet.segments(), static_cast<std::size_t>(std::lround(layout.cloth_length() / 0.05)));
  double inside = 0.0;
  const double rest = layout.cloth_length() / static_cast<double>(sheet.segments());
  for (std::size_t i = 0; i < sheet.segments(); ++i) {
    const Vec2 a = sheet.node(i), b = sheet.node(sheet.end_of(i));
    const double length = (b - a).norm();
    const Vec2 middle = 0.5 * (a + b);
    const bool folded = middle[1] < 0.01 && middle[0] > 1.1 && middle[0] < 2.9;
    if (folded) {
      EXPECT_NEAR(length, rest / (std::sqrt(13.0) / 2.0), round_off);
    } else if (middle[1] > 0.1) {
      EXPECT_LE(length, rest + round_off);
    }
    inside += sheet.nodes().mass[i];
  }
  EXPECT_NEAR(inside, 20.0 * layout.cloth_length(), 1e-9) << "cloth in folds has its mass";
}

TEST(Layout, AFoldedStringCarriesNothingUntilItsClothIsUsedUp)
{
  // 1 m with one fold of height sqrt(3)/2 m: 2 m of cloth. Pulled straight by its last node it is taut at 2 m.
  const SheetLayout layout =
      fold({ { { 0.0, 0.0 }, { 1.0, 0.0 } } }, { { 0.0, 0.0 }, { 1.0, 0.0 }, 1, std::sqrt(0.75) });
  SheetParameters parameters;
  parameters.unstretched_length = layout.cloth_length();
  parameters.stiffness = 1e5;
  parameters.mass = parameters.computational_mass = 1.0;
  parameters.segment_length = 0.5;
  parameters.gauge_length = 0.5;
  Sheet sheet(layout, parameters);
  ASSERT_EQ(sheet.segments(), 4U);
  const auto pull_to = [&sheet](double length) {
    for (std::size_t i = 0; i < sheet.nodes().size(); ++i)
      sheet.nodes().position[0][i] = length * static_cast<double>(i) / 4.0;
    sheet.update_forces();
    return sheet.tension()[2];
  };
  EXPECT_EQ(pull_to(1.99), 0.0);
  EXPECT_NEAR(pull_to(2.02), 1e5 * 0.01, 1e-6);
}

}  // namespace
}  // namespace geocontainer_mpm::geotextile
