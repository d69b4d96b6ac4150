// Boundary particles after any history of angles: the exact rotation of where they began.

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "contact_input.h"

namespace geocontainer_mpm::contact::testing {
namespace {

BoundaryBody<2> random_body(Chance& chance, double spacing)
{
  return BoundaryBody<2>("hull", Surface(random_ground(chance, chance.whole(1, 5))), 0.3, spacing);
}

TEST(BoundaryBody, CoversItsSurfaceAtTheSpacing)
{
  EXPECT_TRUE(holds("spacing", [](Chance& chance) {
    const std::vector<Vec2> line = random_ground(chance, chance.whole(1, 5));
    const double spacing = chance(0.01, 0.5);
    BoundaryBody<2> body("hull", Surface(line), 0.3, spacing);
    body.set_motion({}, {}, 1.0);
    for (std::size_t p = 0; p < body.size(); ++p) {
      RC_ASSERT(brute_nearest(line, body.reference(p)).distance < 1e-13);
      RC_ASSERT(std::abs(body.nearest(body.position(p)).distance) < 1e-13);
      RC_ASSERT(apart(body.nearest(body.position(p)).normal, body.normal(p)) < 1e-9);
      if (p > 0)
        RC_ASSERT((body.reference(p) - body.reference(p - 1)).norm() < spacing * (1.0 + 1e-6));
    }
    RC_ASSERT((body.reference(0) - line.front()).norm() < 0.5 * spacing * (1.0 + 1e-6));
    RC_ASSERT((body.reference(body.size() - 1) - line.back()).norm() < 0.5 * spacing * (1.0 + 1e-6));
  }));
}

TEST(BoundaryBody, CoversAClosedSurfaceToItsLastSegment)
{
  BoundaryBody<2> body("block", Surface({ { 0.0, 0.0 }, { 0.0, 1.0 }, { 1.0, 1.0 }, { 1.0, 0.0 } }, true), 0.3, 0.25);
  ASSERT_EQ(body.size(), 16U);
  Vec2 middle = Vec2::Zero();
  for (std::size_t p = 0; p < body.size(); ++p)
    middle += body.reference(p) / 16.0;
  EXPECT_LT(apart(middle, Vec2(0.5, 0.5)), 1e-15);
}

TEST(BoundaryBody, IsTheExactMotionAfterAnyHistory)
{
  EXPECT_TRUE(holds("history", [](Chance& chance) {
    BoundaryBody<2> body = random_body(chance, 0.1);
    const Vec2 pivot = chance.vector<2>(3.0);
    double angle = chance(-1.0, 1.0);
    Vec2 shift = chance.vector<2>(2.0);
    for (int step = 0; step < 50; ++step) {
      const double next = angle + chance(-0.05, 0.05), dt = chance(1e-4, 1e-2);
      const Vec2 next_shift = shift + chance.vector<2>(0.05);
      body.set_motion(RigidPose::motion(angle, pivot, shift), RigidPose::motion(next, pivot, next_shift), dt);
      const Eigen::Rotation2Dd now(angle), then(next);
      for (std::size_t p = 0; p < body.size(); ++p) {
        const Vec2 arm = body.reference(p) - pivot;
        RC_ASSERT(apart(body.position(p), pivot + shift + now * arm) < 1e-12);
        RC_ASSERT(apart(body.position(p) + dt * body.velocity(p), pivot + next_shift + then * arm) < 1e-12);
        RC_ASSERT(apart(body.velocity_at(body.position(p)), body.velocity(p)) < 1e-12 / dt);
        RC_ASSERT(std::abs(body.normal(p).norm() - 1.0) < 1e-12);
      }
      angle = next;
      shift = next_shift;
    }
  }));
}

TEST(BoundaryBody, CarriesItsSurfaceWithIt)
{
  EXPECT_TRUE(holds("nearest", [](Chance& chance) {
    BoundaryBody<2> body = random_body(chance, 0.1);
    body.set_motion({}, {}, 1.0);
    const Vec2 x = body.reference(0) + chance.vector<2>(1.0);
    const Nearest<2> before = body.nearest(x);
    const RigidPose pose = RigidPose::motion(chance(-2.0, 2.0), chance.vector<2>(3.0), chance.vector<2>(3.0));
    body.set_motion(pose, pose, 1.0);
    const Nearest<2> after = body.nearest(pose.apply(x));
    if (std::isinf(before.distance) || std::isinf(after.distance))
      return;  // at the very end of the line rounding may decide
    RC_ASSERT(std::abs(after.distance - before.distance) < 1e-12);
    RC_ASSERT(apart(after.normal, pose.turn(before.normal)) < 1e-6);
    RC_ASSERT(body.velocity_at(pose.apply(x)).norm() < 1e-12);
  }));
}

TEST(BoundaryBody, NeverMissesAPointWithinReach)
{
  EXPECT_TRUE(holds("first look", [](Chance& chance) {
    BoundaryBody<2> body = random_body(chance, 0.1);
    const RigidPose pose = RigidPose::rotation(chance(-2.0, 2.0), chance.vector<2>(3.0));
    body.set_motion(pose, pose, 1.0);
    const double reach = chance(0.0, 0.5);
    for (std::size_t p = 0; p < body.size(); ++p) {
      const Vec2 x = body.position(p) + chance.vector<2>(0.5);
      if (std::abs(body.nearest(x).distance) < reach)
        RC_ASSERT(body.may_touch(x, reach));
    }
    const Vec2 far = body.position(0) + Vec2(100.0, 100.0);
    RC_ASSERT(!body.may_touch(far, reach));
  }));
}

}  // namespace
}  // namespace geocontainer_mpm::contact::testing
