// Rigid motion of the halves, slot and lips against closed forms; rounding of corners.

#include "geocontainer_mpm/barge/split_hull.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "geocontainer_mpm/error.h"

namespace geocontainer_mpm::barge {
namespace {

// Flat bottom, vertical lip face 0.4 m high, sloping wall, vertical wall to the deck at the hinge's level.
const std::vector<Vec2> section{ Vec2(4.0, -4.0), Vec2(0.0, -4.0), Vec2(0.0, -3.6), Vec2(2.0, -1.5), Vec2(2.0, 0.0) };
const Vec2 hinge(0.0, 0.0);

double cross(const Vec2& a, const Vec2& b)
{
  return a[0] * b[1] - a[1] * b[0];
}

RC_GTEST_PROP(SplitHull, PoseIsTheRigidRotationAfterAnyHistory, ())
{
  const Vec2 pivot(*rc::gen::inRange(-100, 100) * 0.01, *rc::gen::inRange(-100, 100) * 0.01);
  const SplitHull hull(pivot, section, "hull");
  contact::RigidPose pose;
  double angle = 0.0;
  const int steps = *rc::gen::inRange(1, 2000);
  for (int i = 0; i < steps; ++i) {
    angle += *rc::gen::inRange(-100, 101) * 1e-4;
    pose = hull.pose(HullHalf::port, angle);
  }
  RC_ASSERT(std::abs(pose.cosine * pose.cosine + pose.sine * pose.sine - 1.0) < 1e-12);
  const std::vector<Vec2> turned = hull.section_m(HullHalf::port, { angle, 0.0 });
  for (std::size_t i = 0; i < section.size(); ++i) {
    const double radius = (section[i] - pivot).norm();
    const double at = std::atan2(section[i][1] - pivot[1], section[i][0] - pivot[0]) + angle;
    RC_ASSERT((turned[i] - pivot - radius * Vec2(std::cos(at), std::sin(at))).norm() < 1e-12);
    RC_ASSERT((pose.invert(turned[i]) - section[i]).norm() < 1e-12);
  }
}

TEST(SplitHull, OpeningMovesTheBottomOutboard)
{
  const SplitHull hull(hinge, section, "hull");
  const OpeningAngles opening{ 0.2, 0.1 };
  EXPECT_NEAR(hull.section_m(HullHalf::port, opening)[1][0], 4.0 * std::sin(0.2), 1e-12);
  EXPECT_NEAR(hull.section_m(HullHalf::starboard, opening)[3][0], -4.0 * std::sin(0.1), 1e-12);
}

TEST(SplitHull, StarboardIsTheMirrorImageWithTheFreeSideOnTheLeft)
{
  const SplitHull hull(Vec2(0.1, 0.2), section, "hull");
  const std::vector<Vec2> port = hull.section_m(HullHalf::port, { 0.3, 0.3 });
  const std::vector<Vec2> starboard = hull.section_m(HullHalf::starboard, { 0.3, 0.3 });
  ASSERT_EQ(port.size(), starboard.size());
  for (std::size_t i = 0; i < port.size(); ++i) {
    const Vec2& mirror = starboard[starboard.size() - 1 - i];
    EXPECT_NEAR(port[i][0], -mirror[0], 1e-12);
    EXPECT_NEAR(port[i][1], mirror[1], 1e-12);
  }
  // The middle of the hopper is to the left of both inner walls.
  const Vec2 inside(0.0, -1.0);
  const auto& p = hull.closed_section_m(HullHalf::port);
  const auto& s = hull.closed_section_m(HullHalf::starboard);
  EXPECT_GT(cross(p[3] - p[2], inside - p[2]), 0.0);
  EXPECT_GT(cross(s[2] - s[1], inside - s[1]), 0.0);
}

TEST(SplitHull, SlotWidthAndLevelMatchTheClosedForm)
{
  const SplitHull hull(hinge, section, "hull");
  EXPECT_NEAR(hull.slot_width_m({ 0.0, 0.0 }), 0.0, 1e-15);
  EXPECT_NEAR(hull.lowest_level_m({ 0.0, 0.0 }), -4.0, 1e-15);
  for (double a = 0.01; a < 0.4; a += 0.01) {
    // The upper edge of the lip face moves least: it bounds the slot.
    EXPECT_NEAR(hull.slot_width_m({ a, a }), 2.0 * 3.6 * std::sin(a), 1e-12);
    EXPECT_NEAR(hull.slot_width_m({ a, 0.0 }), 3.6 * std::sin(a), 1e-12);
    // The lower edge of the lip stays lowest: the bottom plate rises outboard.
    EXPECT_NEAR(hull.lowest_level_m({ a, 0.9 * a }),
                -4.0 * std::cos(a) < -4.0 * std::cos(0.9 * a) ? -4.0 * std::cos(a) : -4.0 * std::cos(0.9 * a), 1e-12);
  }
}

TEST(SplitHull, NamesABadSection)
{
  const auto key = [](std::vector<Vec2> line) -> std::string {
    try {
      const SplitHull hull(hinge, std::move(line), "hull");
    } catch (const InputError& error) {
      return error.key();
    }
    return "no error";
  };
  EXPECT_EQ(key({ Vec2(0.0, 0.0) }), "hull.port_section_m");
  EXPECT_EQ(key({ Vec2(0.0, 0.0), Vec2(-0.1, 0.0) }), "hull.port_section_m[1]");
  EXPECT_EQ(key({ Vec2(0.0, 0.0), Vec2(0.0, 0.0) }), "hull.port_section_m[1]");
  EXPECT_EQ(key({ Vec2(0.0, NAN), Vec2(0.0, 0.0) }), "hull.port_section_m[0]");
  EXPECT_THROW(SplitHull(Vec2(NAN, 0.0), section, "hull"), InputError);
}

TEST(RoundCorners, ArcIsTangentToBothSides)
{
  const double radius = 0.1;
  const std::vector<Vec2> line{ Vec2(1.0, 0.0), Vec2(0.0, 0.0), Vec2(0.0, 1.0) };
  const std::vector<Vec2> rounded = round_corners(line, radius, 0.1, "lip_radius_m");
  const Vec2 center(radius, radius);
  ASSERT_EQ(rounded.size(), 2U + 17U);  // 16 chords of a right angle at 0.1 rad
  EXPECT_LT((rounded[1] - Vec2(radius, 0.0)).norm(), 1e-12);
  EXPECT_LT((rounded[17] - Vec2(0.0, radius)).norm(), 1e-12);
  for (std::size_t i = 1; i <= 17; ++i)
    EXPECT_NEAR((rounded[i] - center).norm(), radius, 1e-12);
  EXPECT_EQ(rounded.front(), line.front());
  EXPECT_EQ(rounded.back(), line.back());
}

TEST(RoundCorners, TurnsEitherWayAndNeverByMoreThanAllowed)
{
  const double max_turn = 0.2;
  const std::vector<Vec2> rounded = round_corners(section, 0.15, max_turn, "lip_radius_m");
  double total = 0.0;
  for (std::size_t i = 1; i + 1 < rounded.size(); ++i) {
    const Vec2 a = rounded[i] - rounded[i - 1];
    const Vec2 b = rounded[i + 1] - rounded[i];
    const double turn = std::atan2(cross(a, b), a.dot(b));
    EXPECT_LE(std::abs(turn), max_turn + 1e-9);
    total += turn;
  }
  // From heading -y to heading +z by the right-hand way round: a quarter turn to the right.
  EXPECT_NEAR(total, -M_PI / 2.0, 1e-9);
}

TEST(RoundCorners, LeavesStraightLinesAndZeroRadiusAlone)
{
  EXPECT_EQ(round_corners(section, 0.0, 0.1, "r"), section);
  const std::vector<Vec2> straight{ Vec2(0.0, 0.0), Vec2(1.0, 0.0), Vec2(2.0, 0.0) };
  EXPECT_EQ(round_corners(straight, 0.3, 0.1, "r"), straight);
}

TEST(RoundCorners, NamesARadiusThatDoesNotFit)
{
  // 0.4 m of lip face between two right-angled-ish corners.
  try {
    round_corners(section, 0.5, 0.1, "hull.lip_radius_m");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.key(), "hull.lip_radius_m");
    EXPECT_NE(error.allowed().find("corner [0, -4]"), std::string::npos) << error.what();
  }
  EXPECT_THROW(round_corners(section, -0.1, 0.1, "r"), InputError);
  EXPECT_THROW(round_corners(section, NAN, 0.1, "r"), InputError);
  EXPECT_THROW(round_corners({ Vec2(0.0, 0.0), Vec2(1.0, 0.0), Vec2(0.0, 0.0) }, 0.1, 0.1, "r"), InputError);
}

}  // namespace
}  // namespace geocontainer_mpm::barge
