// Nearest point, sign and normal of a polyline, against the brute force of the definition.

#include <gtest/gtest.h>

#include <algorithm>

#include "contact_input.h"
#include "geocontainer_mpm/error.h"

namespace geocontainer_mpm::contact::testing {
namespace {

TEST(Surface, IsPositiveAboveTheGroundAndNegativeInIt)
{
  EXPECT_TRUE(holds("sign", [](Chance& chance) {
    const std::vector<Vec2> ground = random_ground(chance, chance.whole(1, 6));
    const Surface surface(ground);
    for (int k = 0; k < 20; ++k) {
      const double y = chance(ground.front()[0], ground.back()[0]);
      const double above = chance(-1.0, 1.0);
      const Vec2 x(y, height_at(ground, y) + above);
      const Brute brute = brute_nearest(ground, x);
      if (brute.at_end)
        continue;
      const Nearest<2> nearest = surface.nearest(x);
      RC_ASSERT(std::abs(std::abs(nearest.distance) - brute.distance) < 1e-12);
      RC_ASSERT((nearest.distance > 0.0) == (above > 0.0));
    }
  }));
}

TEST(Surface, HasAUnitNormalThatPointsAwayFromItsNearestPoint)
{
  EXPECT_TRUE(holds("normal", [](Chance& chance) {
    const std::vector<Vec2> ground = random_ground(chance, chance.whole(1, 6));
    const Surface surface(ground);
    const double y = chance(ground.front()[0], ground.back()[0]);
    const Vec2 x(y, height_at(ground, y) + chance(-1.0, 1.0));
    if (brute_nearest(ground, x).at_end)
      return;
    const Nearest<2> nearest = surface.nearest(x);
    RC_ASSERT(std::abs(nearest.normal.norm() - 1.0) < 1e-12);
    RC_ASSERT(brute_nearest(ground, x - nearest.distance * nearest.normal).distance < 1e-12);
  }));
}

TEST(Surface, AtAConvexCornerLooksAwayFromTheVertex)
{
  const Surface roof({ { -1.0, -1.0 }, { 0.0, 0.0 }, { 1.0, -1.0 } });
  const Nearest<2> above = roof.nearest({ 0.1, 0.3 });
  EXPECT_NEAR(above.distance, std::hypot(0.1, 0.3), 1e-15);
  EXPECT_NEAR(above.normal[0], 0.1 / std::hypot(0.1, 0.3), 1e-15);
  const Nearest<2> on = roof.nearest({ 0.0, 0.0 });
  EXPECT_EQ(on.distance, 0.0);
  EXPECT_NEAR(on.normal.norm(), 1.0, 1e-15);
  EXPECT_GT(on.normal[1], 0.0);
}

TEST(Surface, InAConcaveCornerIsNegativeBehindTheVertex)
{
  const Surface valley({ { -1.0, 1.0 }, { 0.0, 0.0 }, { 1.0, 1.0 } });
  const Nearest<2> below = valley.nearest({ 0.1, -0.3 });
  EXPECT_NEAR(below.distance, -std::hypot(0.1, 0.3), 1e-15);
  EXPECT_GT(below.normal[1], 0.0);
  EXPECT_NEAR(valley.nearest({ 0.0, 0.2 }).distance, 0.2 * std::sqrt(0.5), 1e-15);
}

TEST(Surface, ReachesNoFurtherThanItsEnds)
{
  const Surface line({ { -1.0, 0.0 }, { 1.0, 0.0 } });
  EXPECT_TRUE(std::isinf(line.nearest({ 1.01, -0.01 }).distance));
  EXPECT_TRUE(std::isinf(line.nearest({ -1.01, 0.01 }).distance));
  EXPECT_EQ(line.nearest({ 0.99, -0.01 }).distance, -0.01);
  // The bottom and the side of a box, open at (2, 0): just beyond that end nothing is near, least of all the far side.
  const Surface box({ { 2.0, 0.0 }, { 0.0, 0.0 }, { 0.0, 1.0 }, { 2.0, 1.0 } });
  EXPECT_NEAR(box.nearest({ 1.9, -0.02 }).distance, 0.02, 1e-15);
  EXPECT_TRUE(std::isinf(box.nearest({ 2.1, -0.02 }).distance));
}

TEST(Surface, IsInfiniteWhereverAnEndIsNearest)
{
  EXPECT_TRUE(holds("ends", [](Chance& chance) {
    const std::vector<Vec2> ground = random_ground(chance, chance.whole(1, 6));
    const Vec2 end = chance.whole(0, 1) == 0 ? ground.front() : ground.back();
    const Vec2 x = end + chance.vector<2>(0.3);
    const Brute brute = brute_nearest(ground, x);
    RC_ASSERT(std::isinf(Surface(ground).nearest(x).distance) == brute.at_end);
  }));
}

/// A closed polygon of any shape around the origin, and whether a point is inside, by the angle that it turns through.
std::vector<Vec2> random_polygon(Chance& chance, int corners)
{
  std::vector<Vec2> polygon;
  for (int k = 0; k < corners; ++k) {
    const double angle = 2.0 * pi * (k + chance(0.0, 0.7)) / corners, radius = chance(0.3, 2.0);
    polygon.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return polygon;
}
bool inside(const std::vector<Vec2>& polygon, const Vec2& x)
{
  double turned = 0.0;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec2 a = polygon[k] - x, b = polygon[(k + 1) % polygon.size()] - x;
    turned += std::atan2(a[0] * b[1] - a[1] * b[0], a.dot(b));
  }
  return std::abs(turned) > pi;
}

TEST(Surface, ClosedHasItsSignEverywhereWhicheverWayItRuns)
{
  EXPECT_TRUE(holds("closed", [](Chance& chance) {
    std::vector<Vec2> polygon = random_polygon(chance, chance.whole(3, chance.whole(0, 1) == 0 ? 9 : 90));
    const bool with_the_clock = chance.whole(0, 1) == 0;  // a solid: its free side is outside
    if (with_the_clock)
      std::reverse(polygon.begin(), polygon.end());
    const Surface surface(polygon, true);
    std::vector<Vec2> line = polygon;
    line.push_back(polygon.front());
    for (int k = 0; k < 30; ++k) {
      const Vec2 x = chance.vector<2>(2.5);
      const Brute brute = brute_nearest(line, x);
      const Nearest<2> nearest = surface.nearest(x);
      RC_ASSERT(std::abs(std::abs(nearest.distance) - brute.distance) < 1e-12);
      RC_ASSERT(std::abs(nearest.normal.norm() - 1.0) < 1e-12);
      if (brute.distance < 1e-9)
        continue;
      RC_ASSERT((nearest.distance > 0.0) == (inside(polygon, x) != with_the_clock));
      RC_ASSERT(brute_nearest(line, x - nearest.distance * nearest.normal).distance < 1e-12);
    }
  }));
}

TEST(Surface, OfManySegmentsIsTheSameAsOfFew)
{
  EXPECT_TRUE(holds("chunks", [](Chance& chance) {
    const std::vector<Vec2> ground = random_ground(chance, chance.whole(20, 100));
    const Surface surface(ground);
    for (int k = 0; k < 20; ++k) {
      const double y = chance(ground.front()[0] - 0.5, ground.back()[0] + 0.5), above = chance(-1.0, 1.0);
      const Vec2 x(y, height_at(ground, y) + above);
      const Brute brute = brute_nearest(ground, x);
      const Nearest<2> nearest = surface.nearest(x);
      RC_ASSERT(std::isinf(nearest.distance) == brute.at_end);
      if (!brute.at_end)
        RC_ASSERT(std::abs(nearest.distance - std::copysign(brute.distance, above)) < 1e-12);
    }
  }));
}

TEST(Surface, RefusesWhatIsNoLine)
{
  EXPECT_THROW(Surface({ { 0.0, 0.0 }, { 1.0, 0.0 } }, true), InputError);
  EXPECT_THROW(Surface({ { 0.0, 0.0 }, { 1.0, 0.0 }, { 0.0, 0.0 } }, true), InputError);
  EXPECT_THROW(Surface({ { 0.0, 0.0 } }), InputError);
  EXPECT_THROW(Surface({ { 0.0, 0.0 }, { 0.0, 0.0 } }), InputError);
}

TEST(RigidPose, TurnsPortUpwardsAndBack)
{
  const RigidPose quarter = RigidPose::rotation(0.5 * pi, { 1.0, 1.0 });
  EXPECT_LT(apart(quarter.apply({ 2.0, 1.0 }), Vec2(1.0, 2.0)), 1e-15);
  EXPECT_TRUE(holds("inverse", [](Chance& chance) {
    const RigidPose pose = RigidPose::motion(chance(-4.0, 4.0), chance.vector<2>(5.0), chance.vector<2>(5.0));
    const Vec2 x = chance.vector<2>(5.0);
    RC_ASSERT(apart(pose.apply(pose.pivot), pose.pivot + pose.shift) < 1e-14);
    RC_ASSERT(apart(pose.invert(pose.apply(x)), x) < 1e-13);
    RC_ASSERT(apart(pose.turn_back(pose.turn(x)), x) < 1e-13);
  }));
}

TEST(RigidPose, MovesInSpaceAsInTheSectionAndLeavesXAlone)
{
  EXPECT_TRUE(holds("space", [](Chance& chance) {
    const RigidPose pose = RigidPose::motion(chance(-4.0, 4.0), chance.vector<2>(5.0), chance.vector<2>(5.0));
    const Vec<3> x = chance.vector<3>(5.0);
    RC_ASSERT(pose.apply(x) == with_section(x, pose.apply(in_section(x))));
    RC_ASSERT(pose.turn(x) == with_section(x, pose.turn(in_section(x))));
    RC_ASSERT(pose.invert(x) == with_section(x, pose.invert(in_section(x))));
    RC_ASSERT(pose.turn_back(x) == with_section(x, pose.turn_back(in_section(x))));
    RC_ASSERT(apart(pose.invert(pose.apply(x)), x) < 1e-13);
    RC_ASSERT(apart(pose.turn_back(pose.turn(x)), x) < 1e-13);
  }));
}

}  // namespace
}  // namespace geocontainer_mpm::contact::testing
