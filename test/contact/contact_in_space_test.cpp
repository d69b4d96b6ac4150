// Contact in space: Coulomb's disc, sliding on an incline, plates, and the plane as a special case.

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "contact_input.h"

namespace geocontainer_mpm::contact::testing {
namespace {

constexpr double dt = 1e-3, gravity = 9.81;
/// The solver stops when velocities change by less than 1e-6 m/s in a sweep.
constexpr double converged = 1e-4;

using Patch3 = PatchIn<3>;
using Vec3 = Vec<3>;

template <int Dim>
struct Solved {
  ContactSums<Dim> sums;
  std::vector<BoundaryImpulse<Dim>> boundary;
  std::vector<AnchorImpulse<Dim>> anchor;
};

template <int Dim>
Solved<Dim> solve(ContactSolver<Dim>& solver, const std::vector<BoundaryBody<Dim>>& bodies, PatchIn<Dim>& patch,
                  double kick = 0.0, bool has_width = false, const std::vector<Anchor<Dim>>& anchors = {})
{
  ContactImpulses<Dim> impulses;
  const ContactSums<Dim> sums =
      solver.solve(bodies, { { &patch.points, has_width } }, anchors, kick, dt, patch.grid, impulses);
  return { sums, impulses.boundary, impulses.anchor };
}
Solved<3> solve(const std::vector<BoundaryBody<3>>& bodies, Patch3& patch, double kick = 0.0)
{
  ContactSolver<3> solver;
  return solve<3>(solver, bodies, patch, kick);
}

Vec3 in_space(double x, const Vec2& section)
{
  return { x, section[0], section[1] };
}

/// A wall through the origin that may look anywhere in the section, and its directions.
struct Slope {
  Vec3 normal, down;  ///< unit; down: along the surface in the section
  Vec2 section_normal;
  explicit Slope(double angle)
      : normal(0.0, std::sin(angle), std::cos(angle))
      , down(0.0, std::cos(angle), -std::sin(angle))
      , section_normal(in_section(normal))
  {
  }
  BoundaryBody<3> wall(double friction) const { return long_wall(Vec2::Zero(), section_normal, friction); }
  Vec3 along(double x, double down_part) const { return x * Vec3::UnitX() + down_part * down; }
};

/// Points a cell apart, `low` to `high` above the slope.
std::vector<Vec3> random_layer(Chance& chance, const Slope& slope, double low, double high)
{
  std::vector<Vec3> layer;
  const Vec3 shift = slope.along(chance(-0.05, 0.05), chance(-0.05, 0.05));
  for (int i = -2; i <= 2; ++i)
    for (int j = -2; j <= 2; ++j)
      layer.push_back(shift + slope.along(0.1 * i, 0.1 * j) + chance(low, high) * slope.normal);
  return layer;
}

TEST(ContactInSpace, GivesTheCoulombAnswerForOnePoint)
{
  EXPECT_TRUE(holds("one point", [](Chance& chance) {
    const Slope slope(chance(-pi, pi));
    const double friction = chance(0.0, 1.0), into = chance(0.1, 2.0);
    const Vec3 along = slope.along(chance(-2.0, 2.0), chance(-2.0, 2.0));
    Patch3 patch({ Vec3::Zero() }, 0.5);
    patch.set_velocity(along - into * slope.normal);
    patch.to_grid();
    const Vec3 before = patch.momentum();
    const Solved<3> solved = solve({ slope.wall(friction) }, patch);
    // Friction is against the slide, whichever way that is, and no more than stops it.
    const Vec3 left = std::max(0.0, 1.0 - friction * into / along.norm()) * along;
    RC_ASSERT(apart(patch.velocity_at(Vec3::Zero()), left) < 1e-12);
    RC_ASSERT(apart(patch.momentum() - before, solved.sums.impulse) < 1e-12);
    RC_ASSERT(apart(solved.boundary[0].impulse, solved.sums.impulse) < 1e-12);
  }));
}

TEST(ContactInSpace, KeepsToCoulombsConeAndSticksInside)
{
  EXPECT_TRUE(holds("cone", [](Chance& chance) {
    const Slope slope(chance(-pi, pi));
    const double friction = chance(0.05, 1.0), into = chance(0.1, 1.0);
    const Vec3 along = slope.along(chance(-1.5, 1.5), chance(-1.5, 1.5));
    Patch3 patch(random_layer(chance, slope, 0.0, 0.0), 0.5);
    patch.set_velocity(along - into * slope.normal);
    patch.to_grid();
    const Solved<3> solved = solve({ slope.wall(friction) }, patch);
    const double pressed = solved.sums.impulse.dot(slope.normal);
    const Vec3 dragged = solved.sums.impulse - pressed * slope.normal;
    RC_ASSERT(pressed > 0.0);
    RC_ASSERT(dragged.norm() <= friction * pressed * (1.0 + 1e-12));
    if (along.norm() < 0.8 * friction * into)
      for (std::size_t p = 0; p < patch.size(); ++p)
        RC_ASSERT(patch.velocity_at(patch.at(p)).norm() < converged);
    if (along.norm() > 1.2 * friction * into)
      RC_ASSERT(apart(dragged, -friction * pressed * along.normalized()) < 1e-2 * friction * pressed);
  }));
}

TEST(ContactInSpace, ChangesMomentumByTheImpulseItReportsAndEnergyByItsBook)
{
  EXPECT_TRUE(holds("books", [](Chance& chance) {
    const Slope slope(chance(-pi, pi));
    Patch3 patch(random_layer(chance, slope, -1e-4, 0.003), 0.5);
    for (std::size_t p = 0; p < patch.size(); ++p)
      patch.set_velocity(p, chance.vector<3>(2.0) - 1.0 * slope.normal);
    const double kick = chance(0.0, 2e-3);
    patch.to_grid(chance.vector<3>(100.0), kick);
    BoundaryBody<3> moving = slope.wall(chance(0.0, 1.0));
    const Vec2 pivot(0.0, 3.0), travel = chance.vector<2>(1.0) * dt;
    const double turn = chance(-1.0, 1.0) * dt;
    moving.set_motion(RigidPose::motion(0.0, pivot, Vec2::Zero()), RigidPose::motion(turn, pivot, travel), dt);
    const Vec3 momentum = patch.momentum();
    const double kinetic = patch.kinetic();
    const Solved<3> solved =
        solve({ moving, long_wall(-0.5 * slope.section_normal, slope.section_normal, 0.3) }, patch, kick);
    const double size = 1.0 + kinetic;
    RC_ASSERT(apart(patch.momentum() - momentum, solved.sums.impulse) < 1e-12 * size);
    RC_ASSERT(apart(solved.boundary[0].impulse + solved.boundary[1].impulse, solved.sums.impulse) < 1e-12 * size);
    RC_ASSERT(solved.boundary[1].impulse == Vec3::Zero());
    RC_ASSERT(std::abs(patch.kinetic() - kinetic - solved.sums.kinetic_change) < 1e-11 * size);
    // What force and moment do along the motion is the work; round-off of places over dt, and turn^2 / 12.
    const BoundaryImpulse<3>& did = solved.boundary[0];
    const double work = in_section(did.impulse).dot(travel) / dt + did.moment * turn / dt;
    RC_ASSERT(std::abs(did.work - work) < 1e-6 * (1.0 + did.impulse.norm()));
    if (kick == 0.0)
      RC_ASSERT(std::abs(solved.sums.kinetic_change + solved.sums.dissipated - did.work) < 1e-11 * size);
  }));
}

TEST(ContactInSpace, LoadThatOnlyRestsDissipatesNothing)
{
  EXPECT_TRUE(holds("rest", [](Chance& chance) {
    const Slope slope(chance(-pi, pi));
    Patch3 patch(random_layer(chance, slope, 0.0, 0.0), 0.5);
    const double kick = 1e-3, pull = chance(1.0, 20.0);
    patch.to_grid(-pull * slope.normal, kick);
    const Solved<3> solved = solve({ slope.wall(0.5) }, patch, kick);
    const double weight = 3.0 * static_cast<double>(patch.size());
    RC_ASSERT(apart(solved.sums.impulse, weight * pull * kick * slope.normal) < weight * converged);
    RC_ASSERT(std::abs(solved.sums.dissipated) < 1e-3 * 0.5 * weight * pull * pull * kick * kick);
  }));
}

TEST(ContactInSpace, ASectionsWidthOfPointsMovesAsInThePlane)
{
  EXPECT_TRUE(holds("plane", [](Chance& chance) {
    // One point across in the middle of a cell, so that both rows of nodes beside it carry half of everything.
    const Slope slope(chance(-pi, pi));
    std::vector<Vec2> row;
    for (int k = -3; k <= 3; ++k)
      row.push_back((0.1 * k) * in_section(slope.down) + chance(0.0, 0.002) * slope.section_normal);
    std::vector<Vec3> same;
    for (const Vec2& x : row)
      same.push_back(in_space(0.05, x));
    Patch flat(row, 0.5);
    Patch3 space(same, 0.5);
    for (std::size_t p = 0; p < row.size(); ++p) {
      const Vec2 v = chance.vector<2>(1.0) - 1.0 * slope.section_normal;
      flat.set_velocity(p, v);
      space.set_velocity(p, in_space(0.0, v));
    }
    const double friction = chance(0.0, 1.0);
    std::vector<BoundaryBody<2>> lines{ wall(Vec2::Zero(), slope.section_normal, friction) };
    std::vector<BoundaryBody<3>> walls{ slope.wall(friction) };
    const RigidPose end = RigidPose::motion(chance(-1.0, 1.0) * dt, { 0.0, 2.0 }, chance.vector<2>(1.0) * dt);
    const RigidPose start = RigidPose::rotation(0.0, { 0.0, 2.0 });
    lines[0].set_motion(start, end, dt);
    walls[0].set_motion(start, end, dt);
    ContactSolver<2> in_plane;
    ContactSolver<3> solver;
    for (int attempt = 0; attempt < 3; ++attempt) {  // cold, and from remembered impulses
      flat.to_grid({ 0.0, -gravity }, dt);
      space.to_grid({ 0.0, 0.0, -gravity }, dt);
      const Solved<2> expected = solve<2>(in_plane, lines, flat, dt);
      const Solved<3> solved = solve<3>(solver, walls, space, dt);
      RC_ASSERT(apart(solved.sums.impulse, in_space(0.0, expected.sums.impulse)) < 1e-11);
      RC_ASSERT(std::abs(solved.boundary[0].moment - expected.boundary[0].moment) < 1e-11);
      RC_ASSERT(std::abs(solved.boundary[0].work - expected.boundary[0].work) < 1e-11);
      RC_ASSERT(std::abs(solved.sums.dissipated - expected.sums.dissipated) < 1e-11);
      RC_ASSERT(std::abs(solved.sums.kinetic_change - expected.sums.kinetic_change) < 1e-11);
      for (std::size_t p = 0; p < row.size(); ++p)
        RC_ASSERT(apart(space.velocity_at(same[p]), in_space(0.0, flat.velocity_at(row[p]))) < 1e-12);
    }
  }));
}

/// A layer that lies on a slope, sliding for `steps` of `step_s`. Returns its velocity, the same everywhere.
Vec3 slide(const Slope& slope, double friction, const Vec3& start, int steps, double step_s = dt)
{
  std::vector<Vec3> layer;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      layer.push_back(slope.along(-0.6 + 0.05 * i, -0.6 + 0.05 * j));
  Patch3 patch(layer);
  patch.set_velocity(start);
  const std::vector<BoundaryBody<3>> bodies{ slope.wall(friction) };
  ContactSolver<3> solver;
  ContactImpulses<3> impulses;
  for (int step = 0; step < steps; ++step) {
    patch.to_grid({ 0.0, 0.0, -gravity }, step_s);
    solver.solve(bodies, { { &patch.points, false } }, {}, step_s, step_s, patch.grid, impulses);
    mpm::testing::gather<3>({}, patch.grid, step_s, mpm::Gather::motion, patch.points);
  }
  Vec3 mean = Vec3::Zero();
  for (std::size_t p = 0; p < patch.size(); ++p)
    mean += vector_at<3>(patch.points.velocity, p) / static_cast<double>(patch.size());
  for (std::size_t p = 0; p < patch.size(); ++p) {
    EXPECT_LT(apart(vector_at<3>(patch.points.velocity, p), mean), 1e-6);
    EXPECT_LT(std::abs(patch.at(p).dot(slope.normal)), 1e-6);
  }
  return mean;
}

TEST(ContactInSpace, SlidesDownASlopeByTheClosedForm)
{
  for (const double degrees : { 20.0, 35.0 })
    for (const double friction : { 0.0, 0.2, 0.3 }) {
      const double angle = degrees * pi / 180.0;
      const Slope slope(angle);
      const Vec3 v = slide(slope, friction, Vec3::Zero(), 200);
      const double expected = gravity * (std::sin(angle) - friction * std::cos(angle)) * 0.2;
      EXPECT_LT(apart(v, expected * slope.down), 1e-6) << degrees << " " << friction;
    }
}

TEST(ContactInSpace, StaysOnASlopeBelowTheAngleOfFriction)
{
  const Slope slope(20.0 * pi / 180.0);
  EXPECT_LT(slide(slope, 0.4, Vec3::Zero(), 200).norm(), 1e-6);
  // Sent off across it, it comes to rest and does not go on sideways or down.
  EXPECT_LT(slide(slope, 0.6, slope.along(0.5, 0.0), 300).norm(), 1e-6);
}

TEST(ContactInSpace, SentOffAcrossASlopeAtTheAngleOfFrictionItsSpeedAndItsDescentKeepTheirSum)
{
  // With mu = tan(slope) friction takes from the speed what gravity adds to the descent: |v| + v_down stays, and the
  // end is v_0 / 2 straight down. A step's friction acts against its last velocity: first order in its length.
  const double angle = 0.5, speed = 1.0;
  const Slope slope(angle);
  const auto error = [&](int steps, double step_s) {
    const Vec3 v = slide(slope, std::tan(angle), slope.along(speed, 0.0), steps, step_s);
    EXPECT_GT(v[0], 0.0);
    return std::abs(v.norm() + v.dot(slope.down) - speed);
  };
  for (const int steps : { 50, 300 }) {
    const double coarse = error(steps, dt), fine = error(2 * steps, 0.5 * dt);
    EXPECT_LT(coarse, 3e-3);
    EXPECT_NEAR(fine / coarse, 0.5, 0.01);
  }
}

TEST(ContactInSpace, SlidesAskewAsTheEquationOfMotionSays)
{
  const double angle = 0.6, friction = 0.4, duration = 0.3;
  const Slope slope(angle);
  const auto acceleration = [&](const Vec2& v) {  // across and down the slope
    return Vec2(Vec2(0.0, gravity * std::sin(angle)) - friction * gravity * std::cos(angle) * v.normalized());
  };
  const Vec2 start(0.8, -0.6);
  Vec2 v = start;
  const int fine_steps = 3000;
  const double h = duration / fine_steps;
  for (int k = 0; k < fine_steps; ++k)
    v += h * acceleration(v + 0.5 * h * acceleration(v));
  const auto error = [&](int steps) {
    const Vec3 slid = slide(slope, friction, slope.along(start[0], start[1]), steps, duration / steps);
    return (slid - slope.along(v[0], v[1])).norm();
  };
  const double coarse = error(300), fine = error(600);
  EXPECT_LT(coarse, 3e-3);
  EXPECT_NEAR(fine / coarse, 0.5, 0.02);
}

/// A cloud of particles of 5 cm pressed to a bulkhead by `pull` along x, for `steps` of dt.
void press(Patch3& patch, const BoundaryBody<3>& body, const Vec3& pull, int steps)
{
  ContactSolver<3> solver;
  for (int step = 0; step < steps; ++step) {
    patch.to_grid(pull, dt);
    solve<3>(solver, { body }, patch, dt, true);
    mpm::testing::gather<3>({}, patch.grid, dt, mpm::Gather::motion, patch.points);
  }
}

const std::vector<Vec2> bulkhead{ { -0.3, -0.3 }, { 0.3, -0.3 }, { 0.3, 0.3 }, { -0.3, 0.3 } };

TEST(ContactInSpace, APlateHoldsACloudThatIsPressedAgainstIt)
{
  EXPECT_TRUE(rc::check("cloud", [](std::uint64_t seed) {
    Chance chance(seed);
    const double side = chance.whole(0, 1) == 0 ? 1.0 : -1.0, half = 0.025;
    std::vector<Vec3> cloud;
    for (int k = 0; k < 30; ++k)
      cloud.emplace_back(side * chance(half, 0.15), chance(-0.2, 0.2), chance(-0.2, 0.2));
    Patch3 patch(cloud, 0.6);
    std::fill(patch.points.initial_volume.begin(), patch.points.initial_volume.end(), 8.0 * half * half * half);
    BoundaryBody<3> body = BoundaryBody<3>::plate("bulkhead", Surface(bulkhead, true), 0.0, side, 0.3, 0.05);
    body.set_motion({}, {}, dt);
    patch.set_velocity(-side * Vec3::UnitX());
    press(patch, body, -20.0 * side * Vec3::UnitX(), 100);
    double closest = 1.0;
    for (std::size_t p = 0; p < patch.size(); ++p)
      closest = std::min(closest, side * patch.at(p)[0] - half);
    RC_ASSERT(closest > -1e-4 * half);  // penetration: a ten-thousandth of a particle
    RC_ASSERT(closest < 1e-2 * half);   // they did come
  }));
}

TEST(ContactInSpace, NothingHappensBesideOrBehindAPlate)
{
  // Flying by, each alone: beside the outline, and from just deeper than half the spacing on behind it.
  BoundaryBody<3> body = BoundaryBody<3>::plate("bulkhead", Surface(bulkhead, true), 0.0, 1.0, 0.3, 0.05);
  body.set_motion({}, {}, dt);
  for (const Vec3& start :
       { Vec3(0.03, 0.31, 0.0), Vec3(0.03, 0.0, -0.31), Vec3(-0.026, 0.0, 0.0), Vec3(-0.2, 0.1, 0.1) }) {
    Patch3 patch({ start }, 0.8);
    patch.points.initial_volume[0] = 0.05 * 0.05 * 0.05;
    const Vec3 v(-2.0, 0.0, 0.0);
    patch.set_velocity(v);
    press(patch, body, Vec3::Zero(), 100);
    EXPECT_LT(apart(patch.at(0), start + 0.1 * v), 1e-12);
  }
}

TEST(ContactInSpace, TakesABodyWithoutASheetAtItsOwnSurface)
{
  EXPECT_TRUE(holds("width", [](Chance& chance) {
    const Slope slope(chance(-pi, pi));
    const double width = chance(0.02, 0.08), gap = chance(0.0, 0.001);
    Patch3 patch({ (0.5 * width + gap) * slope.normal }, 0.5);
    patch.points.initial_volume[0] = width * width * width;
    patch.set_velocity(-chance(1.5, 3.0) * slope.normal);
    patch.to_grid();
    ContactSolver<3> solver;
    solve<3>(solver, { slope.wall(0.0) }, patch, 0.0, true);
    RC_ASSERT(std::abs(gap + dt * patch.velocity_at(patch.at(0)).dot(slope.normal)) < 1e-14);
  }));
}

TEST(ContactInSpace, AnchorsArriveWhereTheyAreToBe)
{
  EXPECT_TRUE(holds("anchors", [](Chance& chance) {
    Patch3 patch(random_layer(chance, Slope(0.0), -0.05, 0.05), 0.5);
    patch.set_velocity(chance.vector<3>(2.0));
    patch.to_grid();
    std::vector<Anchor<3>> anchors;
    for (const std::size_t p : { std::size_t{ 0 }, patch.size() - 1 })
      anchors.push_back({ patch.at(p), patch.at(p) + chance.vector<3>(2.0) * dt });
    const Vec3 momentum = patch.momentum();
    ContactSolver<3> solver;
    const Solved<3> solved = solve<3>(solver, {}, patch, 0.0, false, anchors);
    Vec3 total = Vec3::Zero();
    for (std::size_t a = 0; a < anchors.size(); ++a) {
      RC_ASSERT(apart(anchors[a].point + dt * patch.velocity_at(anchors[a].point), anchors[a].target) < 1e-9 * dt);
      total += solved.anchor[a].impulse;
    }
    RC_ASSERT(apart(total, solved.sums.impulse) < 1e-11);
    RC_ASSERT(apart(patch.momentum() - momentum, total) < 1e-11);
    RC_ASSERT(std::abs(solved.sums.kinetic_change - solved.anchor[0].work - solved.anchor[1].work +
                       solved.sums.dissipated) < 1e-10);
  }));
}

}  // namespace
}  // namespace geocontainer_mpm::contact::testing
