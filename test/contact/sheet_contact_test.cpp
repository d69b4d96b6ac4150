// Contact of points with a closed sheet: what is conserved, what is not crossed, and Coulomb's law.

#include "geocontainer_mpm/contact/sheet_contact.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "two_fields.h"

namespace geocontainer_mpm::contact::testing {
namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double cell = 0.1;
constexpr double dt = 1e-3;

mpm::Grid<2> lattice()
{
  std::array<mpm::FaceCondition, 4> faces{};
  return { { -2.0, -2.0 }, { 2.0, 2.0 }, cell, faces };
}

/// A disc of dust, 1 m in radius, in a sheet that fits it; sheet nodes a cell apart, against the clock.
struct Parcel {
  Field fill, sheet;
  SheetContact contact;

  explicit Parcel(double friction)
      : fill(lattice(), disc(), 0.05, 1000.0)
      , sheet(lattice(), circle(), 0.0, 1.0)
      , contact(mpm::Shape::bspline2, SheetSide::inside, friction)
  {
    for (double& mass : sheet.particles.mass)
      mass = 1.0;
  }
  static std::vector<Vec2> disc()
  {
    std::vector<Vec2> points;
    for (int i = -20; i < 20; ++i)
      for (int j = -20; j < 20; ++j) {
        const Vec2 x(0.05 * (i + 0.5), 0.05 * (j + 0.5));
        if (x.norm() < 0.95)
          points.push_back(x);
      }
    return points;
  }
  static std::vector<Vec2> circle()
  {
    std::vector<Vec2> points;
    for (int k = 0; k < 62; ++k)
      points.emplace_back(std::cos(2.0 * pi * k / 62), std::sin(2.0 * pi * k / 62));
    return points;
  }
  void step()
  {
    fill.to_grid(dt);
    sheet.to_grid(dt);
    contact.begin(fill.points.front(), fill.grid, { &sheet.particles, 1.0 }, sheet.grid, dt);
    contact.guess(fill.grid, sheet.grid);
    double change = 1.0;
    for (int number = 0; number < 300 && change > 1e-10; ++number)
      change = contact.sweep(number, fill.grid, sheet.grid);
    contact.end();
    fill.from_grid(dt);
    sheet.from_grid(dt);
  }
  Vec2 momentum() const { return fill.momentum() + sheet.momentum(); }
  /// How far the outermost particle is beyond the sheet's nearest side, m; negative: all inside.
  double furthest_out() const
  {
    double furthest = -1.0;
    for (std::size_t p = 0; p < fill.particles.size(); ++p) {
      const Vec2 x(fill.particles.position[0][p], fill.particles.position[1][p]);
      double nearest = 1e9, signed_distance = 0.0;
      for (std::size_t k = 0; k < 62; ++k) {
        const std::size_t l = (k + 1) % 62;
        const Vec2 a(sheet.particles.position[0][k], sheet.particles.position[1][k]);
        const Vec2 b(sheet.particles.position[0][l], sheet.particles.position[1][l]);
        const Vec2 t = (b - a).normalized();
        const double along = std::clamp((x - a).dot(t), 0.0, (b - a).norm());
        const double distance = (x - a - along * t).norm();
        if (distance < nearest) {
          nearest = distance;
          signed_distance = -(x - a).dot(left_normal(t));
        }
      }
      furthest = std::max(furthest, signed_distance);
    }
    return furthest;
  }
};

TEST(SheetContact, KeepsMomentumWhenTheFillRunsIntoItsSheet)
{
  for (const double friction : { 0.0, 0.5 }) {
    Parcel parcel(friction);
    parcel.fill.set_velocity({ 0.7, -0.4 });
    const Vec2 before = parcel.momentum();
    for (int k = 0; k < 200; ++k)
      parcel.step();
    EXPECT_LT((parcel.momentum() - before).norm(), 1e-11 * before.norm()) << friction;
    EXPECT_GT(parcel.sheet.momentum()[0], 0.3 * 62.0 * 0.7) << "its front half is taken along";
  }
}

TEST(SheetContact, NothingGetsOut)
{
  // The fill blows up at 1 m/s from its middle into a sheet that has no tension: it must carry the sheet before it.
  Parcel parcel(0.3);
  for (std::size_t p = 0; p < parcel.fill.particles.size(); ++p)
    for (std::size_t d = 0; d < 2; ++d) {
      parcel.fill.particles.velocity[d][p] = parcel.fill.particles.position[d][p];
      parcel.fill.particles.affine[3 * d][p] = 1.0;
    }
  for (int k = 0; k < 300; ++k)
    parcel.step();
  EXPECT_LT(parcel.furthest_out(), 0.0);
}

TEST(SheetContact, DoesNothingBeforeTheGapCloses)
{
  Parcel parcel(0.5);
  parcel.fill.set_velocity({ 0.1, 0.0 });
  parcel.step();  // the nearest particles are further from the sheet than half their width and this step's way
  EXPECT_LT(parcel.sheet.kinetic(), 1e-20);
}

}  // namespace
}  // namespace geocontainer_mpm::contact::testing
