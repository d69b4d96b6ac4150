// Membrane points: stretch, stress and forces.

#include <gtest/gtest.h>

#include <numeric>

#include "fixture.h"
#include "geocontainer_mpm/geotextile/sheet.h"

namespace geocontainer_mpm::geotextile::testing {
namespace {

constexpr double stiffness = 1e5;

SheetParameters parameters(double length, double segment)
{
  SheetParameters p;
  p.formulation = Formulation::membrane_points;
  p.unstretched_length = length;
  p.stiffness = stiffness;
  p.mass = p.computational_mass = 1.0;
  p.segment_length = p.gauge_length = segment;
  return p;
}

Sheet ring(int corners, double strain)
{
  std::vector<Vec2> points;
  for (int k = 0; k < corners; ++k)
    points.emplace_back(std::cos(2.0 * pi * k / corners), std::sin(2.0 * pi * k / corners));
  const double side = 2.0 * std::sin(pi / corners);
  return Sheet({ points, true }, parameters(corners * side / (1.0 + strain), side));
}

Sheet straight(double angle, double strain, int pieces)
{
  const Vec2 to(std::cos(angle), std::sin(angle));
  return Sheet({ { Vec2::Zero(), to }, false }, parameters(1.0 / (1.0 + strain), 1.0 / pieces));
}

void set_gradient(Sheet& sheet, const Eigen::Matrix2d& l)
{
  for (std::size_t i = 0; i < sheet.nodes().size(); ++i)
    for (std::size_t k = 0; k < 4; ++k)
      sheet.nodes().gradient[k][i] = l(static_cast<Eigen::Index>(k / 2), static_cast<Eigen::Index>(k % 2));
}

TEST(MembranePoints, StartTautOrSlackAsTheyAreLaid)
{
  for (const double strain : { -0.05, 0.02 }) {
    for (Sheet sheet : { ring(40, strain), straight(0.4, strain, 12) }) {
      EXPECT_EQ(sheet.update_forces(), strain > 0.0);
      double length = 0.0;
      for (std::size_t i = 0; i < sheet.segments(); ++i)
        EXPECT_NEAR(sheet.tension()[i], std::max(0.0, strain) * stiffness, 1e-9 * stiffness);
      for (const double piece : sheet.nodes().volume)
        length += piece;
      EXPECT_NEAR(length, sheet.length(), 1e-12);
      const double t = std::max(0.0, strain);
      EXPECT_NEAR(sheet.elastic_energy(), 0.5 * stiffness * t * t * length / (1.0 + strain), 1e-8);
      EXPECT_NEAR(sheet.largest_strain(), t, 1e-12);
    }
  }
}

TEST(MembranePoints, StretchWithTheGridAlongTheirTangentOnly)
{
  EXPECT_TRUE(holds("stretch", [](Chance& chance) {
    const double angle = chance(0.0, 6.0), strain = chance(0.0, 0.05), along = chance(0.0, 1.0);
    Sheet sheet = straight(angle, strain, chance.whole(1, 9));
    sheet.update_forces();
    // In the sheet's own frame: stretching, and across it anything that does not turn it.
    Eigen::Matrix2d own, turn;
    own << along, chance(-9.0, 9.0), 0.0, chance(-9.0, 9.0);
    turn << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
    set_gradient(sheet, turn * own * turn.transpose());
    for (int k = 0; k < 10; ++k)
      sheet.update_stress(0.01);
    const double tension = stiffness * ((1.0 + strain) * std::exp(0.1 * along) - 1.0);
    const Vec2 t(std::cos(angle), std::sin(angle));
    for (std::size_t i = 0; i < sheet.nodes().size(); ++i) {
      RC_ASSERT(std::abs(sheet.nodes().stress[0][i] - tension * t[0] * t[0]) < 1e-9 * stiffness);
      RC_ASSERT(std::abs(sheet.nodes().stress[1][i] - tension * t[1] * t[1]) < 1e-9 * stiffness);
      RC_ASSERT(std::abs(sheet.nodes().stress[2][i] - tension * t[0] * t[1]) < 1e-9 * stiffness);
    }
  }));
}

TEST(MembranePoints, StretchIsSecondOrderInTimeWhereTheSheetTurns)
{
  // Simple shear across it by 0.5: lambda = sqrt(1 + 0.5^2).
  double last = 0.0;
  for (const int steps : { 10, 20, 40 }) {
    Sheet sheet = straight(0.0, 0.0, 5);
    Eigen::Matrix2d shear;
    shear << 0.0, 0.0, 1.0, 0.0;
    set_gradient(sheet, shear);
    for (int k = 1; k <= steps; ++k) {
      sheet.update_forces();
      for (std::size_t i = 0; i < sheet.nodes().size(); ++i)
        sheet.nodes().position[1][i] = 0.5 * k / steps * sheet.nodes().position[0][i];
      sheet.update_stress(0.5 / steps);
    }
    const double error = std::abs(1.0 + sheet.largest_strain() - std::sqrt(1.25));
    if (last > 0.0) {
      EXPECT_NEAR(last / error, 4.0, 0.3) << steps;
    }
    EXPECT_LT(error, 1e-3);
    last = error;
  }
}

TEST(MembranePoints, RotationChangesNoTensionAndTurnsItsStress)
{
  Sheet sheet = ring(24, 0.03);
  const Sheet start = sheet;
  const double step = 0.01;
  Eigen::Matrix2d spin;
  spin << 0.0, -1.0, 1.0, 0.0;
  set_gradient(sheet, spin);
  for (int k = 1; k <= 628; ++k) {  // once round
    sheet.update_forces();
    sheet.update_stress(step);
    const double c = std::cos(k * step), s = std::sin(k * step);
    for (std::size_t i = 0; i < 24; ++i) {
      const Vec2 x = start.node(i);
      set_vector<2>(sheet.nodes().position, i, { c * x[0] - s * x[1], s * x[0] + c * x[1] });
    }
  }
  sheet.update_forces();
  for (std::size_t i = 0; i < 24; ++i) {
    EXPECT_NEAR(sheet.tension()[i], 0.03 * stiffness, 1e-9 * stiffness);
    const Vec2 t(-sheet.node(i)[1], sheet.node(i)[0]);
    EXPECT_NEAR(sheet.nodes().stress[2][i], 0.03 * stiffness * t[0] * t[1], 1e-9 * stiffness);
  }
}

/// A layer with any stress, on a grid.
struct OnGrid {
  Sheet sheet;
  mpm::Grid<2> grid;
  mpm::Discretisation method;

  explicit OnGrid(Chance& chance, mpm::Shape shape)
      : sheet(ring(chance.whole(8, 40), chance(0.01, 0.1)))
      , grid({ -2.0, -2.0 }, { 2.0, 2.0 }, chance(0.08, 0.3), mpm::testing::free_faces<2>())
  {
    method.shape = shape;
    for (std::size_t i = 0; i < sheet.nodes().size(); ++i) {
      set_vector<2>(sheet.nodes().position, i, sheet.node(i) + chance.vector<2>(0.05));
      set_vector<2>(sheet.nodes().velocity, i, chance.vector<2>(1.0));
    }
    sheet.update_forces();
    mpm::testing::open(mpm::testing::everything(grid), grid);
    mpm::sheet_to_grid<2>(method, sheet.nodes(), mpm::Part::all, Vec2::Zero(), grid, true);
  }
};

TEST(MembranePoints, ForcesSumToNothingAndWorkAsTheTensionStretches)
{
  for (const mpm::Shape shape : { mpm::Shape::bspline2, mpm::Shape::linear_simplex })
    EXPECT_TRUE(holds("virtual work", [&](Chance& chance) {
      OnGrid now(chance, shape);
      // Any motion of the grid: it takes the place of momentum, and mass 1 makes it a velocity.
      Vec2 sum = Vec2::Zero();
      double power = 0.0, size = 1e-300;
      mpm::testing::for_each_node(now.grid, [&](std::size_t i, const std::array<int, 2>&) {
        const Vec2 force = now.grid.forces()[i].matrix().head<2>(), v = chance.vector<2>(1.0);
        now.grid.nodes()[i].matrix().head<2>() = v;
        sum += force;
        power += force.dot(v);
        size += force.norm();
      });
      RC_ASSERT(sum.norm() < 1e-11 * size);
      mpm::grid_to_particles<2>(now.method, now.grid, 0.0, mpm::Gather::gradient, now.sheet.nodes(), 0,
                                now.sheet.nodes().size());
      RC_ASSERT(std::abs(power + now.sheet.stress_power()) < 1e-11 * size);
      // And that is what the energy grows by.
      const double dt = 1e-7, before = now.sheet.elastic_energy(), rate = now.sheet.stress_power();
      now.sheet.update_stress(dt);
      RC_ASSERT(std::abs(now.sheet.elastic_energy() - before - dt * rate) < 1e-4 * dt * size);
    }));
}

TEST(MembranePoints, RingPressesInwardsByTensionOverRadius)
{
  // The weight of all forces along the radius is p times the circumference, T / R per length: 2 pi T.
  Sheet sheet = ring(120, 0.03);
  sheet.update_forces();
  mpm::Grid<2> grid({ -1.5, -1.5 }, { 1.5, 1.5 }, 0.05, mpm::testing::free_faces<2>());
  mpm::testing::open(mpm::testing::everything(grid), grid);
  mpm::sheet_to_grid<2>({}, sheet.nodes(), mpm::Part::all, Vec2::Zero(), grid, true);
  double inwards = 0.0;
  mpm::testing::for_each_node(grid, [&](std::size_t i, const std::array<int, 2>& node) {
    const Vec2 x = grid.origin() + grid.dx() * Vec2(node[0], node[1]);
    if (x.norm() > 0.5)
      inwards -= grid.forces()[i].matrix().head<2>().dot(x.normalized());
  });
  EXPECT_NEAR(inwards, 2.0 * pi * 0.03 * stiffness, 2e-3 * 2.0 * pi * 0.03 * stiffness);
}

TEST(MembranePoints, BreakOneByOne)
{
  SheetParameters p = parameters(1.0, 0.25);
  p.rupture_strain = 0.1;
  Sheet sheet({ { Vec2::Zero(), Vec2(1.0, 0.0) }, false }, p);
  sheet.update_forces();
  sheet.nodes().gradient[0] = { 0.0, 0.5, 1.0, 0.5, 0.0 };  // the middle most
  const auto stretch = [&](double strain) {
    sheet.update_stress(std::log((1.0 + strain) / (1.0 + sheet.largest_strain())));
  };
  stretch(0.09);
  const double beside = std::sqrt(1.09) - 1.0;
  EXPECT_EQ(sheet.ruptures(), 0U);
  EXPECT_NEAR(sheet.tension()[0], 0.5 * stiffness * beside, 1e-8 * stiffness);
  const double stored = sheet.elastic_energy();
  sheet.update_stress(std::log(1.1001 / 1.09));
  EXPECT_EQ(sheet.ruptures(), 1U);
  EXPECT_EQ(sheet.rupture_place(), Vec2(0.5, 0.0));
  // Its energy, and the half of the step's work that was done before: 0.25 J (e1^2 + e1 (e2 - e1)) / 2.
  EXPECT_NEAR(sheet.rupture_energy(), 0.25 * stiffness * 0.5 * 0.09 * 0.1001, 1e-6 * stored);
  EXPECT_EQ(sheet.nodes().stress[0][2], 0.0);
  EXPECT_EQ(sheet.active_pieces(), 4U);
  sheet.nodes().gradient[0][2] = -100.0;
  sheet.update_stress(0.01);
  EXPECT_EQ(sheet.nodes().stress[0][2], 0.0) << "it does not heal";
}

}  // namespace
}  // namespace geocontainer_mpm::geotextile::testing
