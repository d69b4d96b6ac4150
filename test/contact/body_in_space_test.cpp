// Bodies in space: extruded sections and plates across x, against their sections and areas.

#include <gtest/gtest.h>

#include <algorithm>

#include <Eigen/Geometry>

#include "contact_input.h"
#include "geocontainer_mpm/error.h"

namespace geocontainer_mpm::contact::testing {
namespace {

/// A closed outline around a middle, rarely convex; either sense.
std::vector<Vec2> random_outline(Chance& chance)
{
  const int corners = chance.whole(3, 9);
  const Vec2 middle = chance.vector<2>(2.0);
  std::vector<Vec2> outline;
  for (int k = 0; k < corners; ++k) {
    const double angle = 2.0 * pi * (k + chance(0.0, 0.7)) / corners, radius = chance(0.3, 1.5);
    outline.push_back(middle + radius * Vec2(std::cos(angle), std::sin(angle)));
  }
  if (chance.whole(0, 1) == 0)
    std::reverse(outline.begin(), outline.end());
  return outline;
}

double length_of(const std::vector<Vec2>& line)
{
  double length = 0.0;
  for (std::size_t k = 0; k + 1 < line.size(); ++k)
    length += (line[k + 1] - line[k]).norm();
  return length;
}

double area_of(const std::vector<Vec2>& outline)
{
  double twice = 0.0;
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const Vec2 &a = outline[k], &b = outline[(k + 1) % outline.size()];
    twice += a[0] * b[1] - a[1] * b[0];
  }
  return 0.5 * std::abs(twice);
}

/// Is it inside? By the angle that the outline turns through around it.
bool encloses(const std::vector<Vec2>& outline, const Vec2& x)
{
  double turned = 0.0;
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const Vec2 a = outline[k] - x, b = outline[(k + 1) % outline.size()] - x;
    turned += std::atan2(a[0] * b[1] - a[1] * b[0], a.dot(b));
  }
  return std::abs(turned) > pi;
}

RigidPose random_pose(Chance& chance)
{
  return RigidPose::motion(chance(-2.0, 2.0), chance.vector<2>(3.0), chance.vector<2>(3.0));
}

/// The triangles' area. Each looks into the free side, and no edge is longer than `longest`.
double area_of_triangles(const BoundaryBody<3>& body, double longest)
{
  double area = 0.0;
  for (const auto& [a, b, c] : body.triangles()) {
    const Vec<3> ab = body.reference(b) - body.reference(a), ac = body.reference(c) - body.reference(a);
    const Vec<3> across = ab.cross(ac);
    for (const std::uint32_t corner : { a, b, c })
      RC_ASSERT(across.dot(body.normal(corner)) > 0.0);
    RC_ASSERT(std::max({ ab.norm(), ac.norm(), (ac - ab).norm() }) < longest);
    area += 0.5 * across.norm();
  }
  return area;
}

TEST(BodyInSpace, AnExtrusionIsItsSectionBetweenItsEnds)
{
  EXPECT_TRUE(holds("extrusion", [](Chance& chance) {
    const bool closed = chance.whole(0, 1) == 0;
    const Surface section(closed ? random_outline(chance) : random_ground(chance, chance.whole(1, 5)), closed);
    const double from = chance(-2.0, 2.0);
    const Along along{ from, from + chance(0.1, 3.0) };
    BoundaryBody<3> body("hull", section, along, 0.3, 0.1);
    BoundaryBody<2> flat("hull", section, 0.3, 0.1);
    const RigidPose pose = random_pose(chance);
    body.set_motion(pose, pose, 1.0);
    flat.set_motion(pose, pose, 1.0);
    for (int k = 0; k < 20; ++k) {
      const Vec2 in_plane = flat.position(0) + chance.vector<2>(2.0);
      const Vec<3> x = with_section(Vec<3>::Constant(chance(along.from - 1.0, along.to + 1.0)), in_plane);
      const Nearest<3> nearest = body.nearest(x);
      const Nearest<2> expected = flat.nearest(in_plane);
      if (x[0] < along.from || x[0] > along.to) {
        RC_ASSERT(std::isinf(nearest.distance));
      } else {
        RC_ASSERT(nearest.distance == expected.distance);
        RC_ASSERT(nearest.normal == with_section(Vec<3>::Zero(), expected.normal));
      }
    }
  }));
}

TEST(BodyInSpace, APlateIsTheInsideOfItsOutlineSeenFromItsFreeSide)
{
  EXPECT_TRUE(holds("plate", [](Chance& chance) {
    const std::vector<Vec2> outline = random_outline(chance);
    const double at_x = chance(-2.0, 2.0), side = chance.whole(0, 1) == 0 ? 1.0 : -1.0, spacing = chance(0.05, 0.3);
    BoundaryBody<3> body = BoundaryBody<3>::plate("bulkhead", Surface(outline, true), at_x, side, 0.3, spacing);
    const RigidPose pose = random_pose(chance);
    body.set_motion(pose, pose, 1.0);
    for (int k = 0; k < 30; ++k) {
      const Vec2 in_plane = outline[0] + chance.vector<2>(2.0);
      const double distance = chance(-spacing, spacing);
      const Vec<3> x = with_section(Vec<3>::Constant(at_x + side * distance), pose.apply(in_plane));
      const Nearest<3> nearest = body.nearest(x);
      if (encloses(outline, in_plane) && distance > -0.5 * spacing) {
        RC_ASSERT(std::abs(nearest.distance - distance) < 1e-15);
        RC_ASSERT(nearest.normal == Vec<3>(side, 0.0, 0.0));
      } else {
        RC_ASSERT(std::isinf(nearest.distance));
      }
    }
  }));
}

TEST(BodyInSpace, TheParticlesOfAnExtrusionCoverItAndItsTrianglesLookIntoTheFreeSide)
{
  EXPECT_TRUE(holds("cover", [](Chance& chance) {
    const std::vector<Vec2> line = random_ground(chance, chance.whole(1, 5));
    const Along along{ -1.0, chance(-0.9, 1.0) };
    const double spacing = chance(0.05, 0.5);
    BoundaryBody<3> body("bed", Surface(line), along, 0.3, spacing);
    body.set_motion({}, {}, 1.0);
    for (std::size_t p = 0; p < body.size(); ++p) {
      RC_ASSERT(brute_nearest(line, in_section(body.reference(p))).distance < 1e-13);
      RC_ASSERT(body.reference(p)[0] >= along.from && body.reference(p)[0] <= along.to);
      RC_ASSERT(body.normal(p)[0] == 0.0);
      RC_ASSERT(std::abs(body.normal(p).norm() - 1.0) < 1e-12);
    }
    const double area = length_of(line) * (along.to - along.from);
    RC_ASSERT(std::abs(area_of_triangles(body, 1.5 * spacing) - area) < 1e-12 * area);
  }));
}

TEST(BodyInSpace, TheTrianglesOfAPlateFillItsOutline)
{
  EXPECT_TRUE(holds("fill", [](Chance& chance) {
    const std::vector<Vec2> outline = random_outline(chance);
    const double at_x = chance(-2.0, 2.0), side = chance.whole(0, 1) == 0 ? 1.0 : -1.0, spacing = chance(0.05, 0.5);
    BoundaryBody<3> body = BoundaryBody<3>::plate("bulkhead", Surface(outline, true), at_x, side, 0.3, spacing);
    body.set_motion({}, {}, 1.0);
    RC_ASSERT(body.closed());
    for (std::size_t p = 0; p < body.size(); ++p)
      RC_ASSERT(body.reference(p)[0] == at_x);
    for (const auto& [a, b, c] : body.triangles()) {
      const Vec<3> middle = (body.reference(a) + body.reference(b) + body.reference(c)) / 3.0;
      RC_ASSERT(encloses(outline, in_section(middle)));
    }
    const double area = area_of(outline);
    // A trapezium may lean: then a triangle's side is longer than its rows and columns are apart.
    RC_ASSERT(std::abs(area_of_triangles(body, 2.0 * spacing) - area) < 1e-9 * area);
  }));
}

TEST(BodyInSpace, IsTheExactMotionOfItsSection)
{
  EXPECT_TRUE(holds("motion", [](Chance& chance) {
    BoundaryBody<3> body("hull", Surface(random_ground(chance, 3)), Along{ 0.0, 0.5 }, 0.3, 0.2);
    const Vec2 pivot = chance.vector<2>(3.0);
    const RigidPose start = RigidPose::motion(chance(-1.0, 1.0), pivot, chance.vector<2>(1.0));
    const RigidPose end = RigidPose::motion(chance(-1.0, 1.0), pivot, chance.vector<2>(1.0));
    const double dt = chance(0.01, 0.1);
    body.set_motion(start, end, dt);
    for (std::size_t p = 0; p < body.size(); ++p) {
      const Vec<3> there = start.apply(body.reference(p));
      RC_ASSERT(body.position(p) == there);
      RC_ASSERT(apart(there + dt * body.velocity(p), end.apply(body.reference(p))) < 1e-14);
      RC_ASSERT(apart(body.velocity_at(there), body.velocity(p)) < 1e-14 / dt);
      const Vec2 lever = in_section(there) - pivot - start.shift, then = in_section(end.apply(body.reference(p)));
      RC_ASSERT(apart(body.arm_at(there), 0.5 * (lever + then - pivot - end.shift)) < 1e-13);
    }
  }));
}

TEST(BodyInSpace, NeverMissesAPointWithinReach)
{
  EXPECT_TRUE(holds("first look", [](Chance& chance) {
    const Surface outline(random_outline(chance), true);
    std::vector<BoundaryBody<3>> bodies{ BoundaryBody<3>("hull", outline, Along{ -0.5, 0.5 }, 0.3, 0.2),
                                         BoundaryBody<3>::plate("bulkhead", outline, 0.5, -1.0, 0.3, 0.2) };
    const double reach = chance(0.0, 0.5);
    for (BoundaryBody<3>& body : bodies) {
      const RigidPose pose = random_pose(chance);
      body.set_motion(pose, pose, 1.0);
      for (std::size_t p = 0; p < body.size(); ++p) {
        const Vec<3> x = body.position(p) + chance.vector<3>(0.5);
        if (std::abs(body.nearest(x).distance) < reach)
          RC_ASSERT(body.may_touch(x, reach));
      }
      RC_ASSERT(!body.may_touch(body.position(0) + Vec<3>(0.0, 100.0, 100.0), reach));
      RC_ASSERT(!body.may_touch(body.position(0) + Vec<3>(100.0, 0.0, 0.0), reach));
    }
  }));
}

TEST(BodyInSpace, RefusesWhatIsNoBody)
{
  const Surface line({ { 0.0, 0.0 }, { 1.0, 0.0 }, { 1.0, 1.0 } }), outline(line.line(), true);
  EXPECT_THROW(BoundaryBody<3>("hull", line, Along{ 1.0, 1.0 }, 0.3, 0.1), InputError);
  EXPECT_THROW(BoundaryBody<3>::plate("bulkhead", line, 0.0, 1.0, 0.3, 0.1), InputError);
  EXPECT_THROW(BoundaryBody<3>::plate("bulkhead", outline, 0.0, 0.5, 0.3, 0.1), InputError);
}

}  // namespace
}  // namespace geocontainer_mpm::contact::testing
