// Contact of points with a closed sheet: what is conserved, what is not crossed, and Coulomb's law.

#include "geocontainer_mpm/contact/sheet_contact.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "two_fields.h"

namespace geocontainer_mpm::contact::testing {
namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double dt = 3e-3;
constexpr std::size_t corners = 31;  ///< of the sheet, about a cell apart

/// A disc of dust in a sheet that fits it, 1 m in radius, its nodes against the clock.
struct Parcel {
  Field fill, sheet;
  SheetContact<2> contact;

  explicit Parcel(double friction, const std::vector<Vec2>& grains = disc(), const std::vector<Vec2>& nodes = circle())
      : fill(lattice(2.0, 0.2), grains, 0.1, 1000.0)
      , sheet(lattice(2.0, 0.2), nodes, 0.0, 1.0)
      , contact(mpm::Shape::bspline2, SheetSide::inside, friction)
  {
    std::fill(sheet.particles.mass.begin(), sheet.particles.mass.end(), 2.0);
  }
  static std::vector<Vec2> disc()
  {
    std::vector<Vec2> points;
    for (int i = -10; i < 10; ++i)
      for (int j = -10; j < 10; ++j) {
        const Vec2 x(0.1 * (i + 0.5), 0.1 * (j + 0.5));
        if (x.norm() < 0.9)
          points.push_back(x);
      }
    return points;
  }
  static std::vector<Vec2> circle()
  {
    std::vector<Vec2> points;
    for (std::size_t k = 0; k < corners; ++k) {
      const double angle = 2.0 * pi * static_cast<double>(k) / static_cast<double>(corners);
      points.emplace_back(std::cos(angle), std::sin(angle));
    }
    return points;
  }
  /// The sheet's nodes in their order: the tests' transfers to the grid sort particles.
  mpm::Particles<2> chain() const
  {
    mpm::Particles<2> nodes = sheet.particles;
    for (std::size_t p = 0; p < nodes.size(); ++p)
      for (std::size_t d = 0; d < 2; ++d)
        nodes.position[d][sheet.particles.id[p]] = sheet.particles.position[d][p];
    return nodes;
  }
  void step()
  {
    fill.to_grid(dt);
    sheet.to_grid(dt);
    const mpm::Particles<2> nodes = chain();
    contact.begin(fill.points.front(), fill.grid, { &nodes, 1.0 }, sheet.grid, dt);
    contact.guess(fill.grid, sheet.grid);
    double change = 1.0;
    for (int number = 0; number < 100 && change > 1e-9; ++number)
      change = contact.sweep(number, fill.grid, sheet.grid);
    contact.end();
    fill.from_grid(dt);
    sheet.from_grid(dt);
  }
  static Vec2 momentum_of(const mpm::Particles<2>& particles)
  {
    Vec2 sum = Vec2::Zero();
    for (std::size_t p = 0; p < particles.size(); ++p)
      sum += particles.mass[p] * Vec2(particles.velocity[0][p], particles.velocity[1][p]);
    return sum;
  }
  Vec2 momentum() const { return momentum_of(fill.particles) + momentum_of(sheet.particles); }
  /// How far the outermost particle is beyond the sheet's nearest side, m; negative: all inside.
  double furthest_out() const
  {
    const mpm::Particles<2> nodes = chain();
    double furthest = -1.0;
    for (std::size_t p = 0; p < fill.particles.size(); ++p) {
      const Vec2 x(fill.particles.position[0][p], fill.particles.position[1][p]);
      double nearest = 1e9, out = 0.0;
      for (std::size_t k = 0; k < corners; ++k) {
        const std::size_t l = (k + 1) % corners;
        const Vec2 a(nodes.position[0][k], nodes.position[1][k]), b(nodes.position[0][l], nodes.position[1][l]);
        const Vec2 along = b - a;
        const double fraction = std::clamp((x - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
        const double distance = (x - a - fraction * along).norm();
        if (distance < nearest) {
          nearest = distance;
          out = -(x - a).dot(left_normal(along.normalized()));
        }
      }
      furthest = std::max(furthest, out);
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
    for (int k = 0; k < 70; ++k)
      parcel.step();
    EXPECT_LT((parcel.momentum() - before).norm(), 1e-11 * before.norm()) << friction;
    EXPECT_GT(Parcel::momentum_of(parcel.sheet.particles)[0], 0.1 * 62.0 * 0.7) << "its front is taken along";
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
  for (int k = 0; k < 100; ++k)
    parcel.step();
  EXPECT_LT(parcel.furthest_out(), 0.0);
}

TEST(SheetContact, DoesNothingBeforeTheGapCloses)
{
  Parcel parcel(0.5);
  parcel.fill.set_velocity({ 0.1, 0.0 });
  parcel.step();  // the nearest particles are further from the sheet than half their width and this step's way
  EXPECT_EQ(Parcel::momentum_of(parcel.sheet.particles).norm(), 0.0);
}

TEST(SheetContact, LeavesGrainsOnTheirSideOfAKink)
{
  // The sheet's top crosses itself and hangs down as a loop that goes around like the whole: fill within it and fill
  // around it are both inside. All is at rest, and no grain nearer to the loop than half its width: nothing may push.
  const std::vector<Vec2> loop{ { -0.2, 0.75 }, { -0.25, 0.5 }, { -0.1, 0.3 },
                                { 0.1, 0.3 },   { 0.25, 0.5 },  { 0.2, 0.75 } };
  std::vector<Vec2> nodes = Parcel::circle(), grains;
  for (const Vec2& grain : Parcel::disc()) {
    double nearest = grain[1] > 0.75 && std::abs(grain[0]) < 0.25 ? 0.0 : 1.0;
    for (std::size_t k = 0; k + 1 < loop.size(); ++k) {
      const Vec2 along = loop[k + 1] - loop[k];
      const double part = std::clamp((grain - loop[k]).dot(along) / along.squaredNorm(), 0.0, 1.0);
      nearest = std::min(nearest, (grain - loop[k] - part * along).norm());
    }
    if (nearest > 0.051)
      grains.push_back(grain);
  }
  nodes.insert(nodes.begin() + 8, loop.begin(), loop.end());  // corner 7 is right of the top, 8 left
  Parcel parcel(0.5, grains, nodes);
  parcel.step();
  for (std::size_t d = 0; d < 2; ++d) {
    for (const double v : parcel.fill.particles.velocity[d])
      EXPECT_EQ(v, 0.0);
    for (const double v : parcel.sheet.particles.velocity[d])
      EXPECT_EQ(v, 0.0);
  }
}

TEST(SheetContact, BringsBackWhatGotThrough)
{
  Parcel parcel(0.5, { { 0.0, 1.04 } });
  parcel.step();
  EXPECT_LT(parcel.fill.particles.velocity[1][0], -1e-3) << "m/s, the sheet yielding the other way";
}

}  // namespace
}  // namespace geocontainer_mpm::contact::testing
