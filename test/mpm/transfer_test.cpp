// Particles to grid and back: what is conserved, reproduced and adjoint, to round-off.

#include <gtest/gtest.h>

#include "geocontainer_mpm/mpm/grid_update.h"
#include "random_cloud.h"

namespace geocontainer_mpm::mpm::testing {
namespace {

template <class D>
class Transfer : public ::testing::Test {
};
using Dimensions = ::testing::Types<Dimension<2>, Dimension<3>>;
TYPED_TEST_SUITE(Transfer, Dimensions);

constexpr std::size_t count = 60;
constexpr int cells = 5;

/// Mass, momentum and the first moment of momentum, sum x p^T, whose antisymmetric part is angular momentum.
template <int Dim>
struct Motion {
  double mass = 0.0;
  Vec<Dim> momentum = Vec<Dim>::Zero();
  Mat<Dim> moment = Mat<Dim>::Zero();
};

template <int Dim>
Motion<Dim> of_particles(const Particles<Dim>& particles, const std::array<Column, Dim>& position, double dx)
{
  Motion<Dim> sum;
  for (std::size_t p = 0; p < particles.size(); ++p) {
    const double m = particles.mass[p];
    const Vec<Dim> v = vector_at<Dim>(particles.velocity, p);
    sum.mass += m;
    sum.momentum += m * v;
    sum.moment += m * vector_at<Dim>(position, p) * v.transpose() +
                  m * bspline_inertia(dx) * matrix_at<Dim>(particles.affine, p).transpose();
  }
  return sum;
}

/// `node_is_velocity`: after the update velocity stands where momentum stood.
template <int Dim>
Motion<Dim> of_grid(const Grid<Dim>& grid, bool node_is_velocity)
{
  Motion<Dim> sum;
  for_each_node(grid, [&](std::size_t i, const std::array<int, Dim>& node) {
    const Vec<Dim> momentum = (node_is_velocity ? node_mass(grid, i) : 1.0) * node_vector(grid, i);
    sum.mass += node_mass(grid, i);
    sum.momentum += momentum;
    sum.moment += grid.coordinate(node) * momentum.transpose();
  });
  return sum;
}

template <int Dim>
void check_equal(const Motion<Dim>& a, const Motion<Dim>& b)
{
  RC_ASSERT(std::abs(a.mass - b.mass) < 1e-12 * count);
  RC_ASSERT(apart(a.momentum, b.momentum) < 1e-11 * count);
  RC_ASSERT(apart(a.moment, b.moment) < 1e-11 * count);
}

TYPED_TEST(Transfer, ConservesMassAndLinearAndAngularMomentumToTheGrid)
{
  constexpr int Dim = TypeParam::Dim;
  EXPECT_TRUE(holds("to grid", [](Chance& chance) {
    Grid<Dim> grid = random_grid<Dim>(chance, cells);
    Particles<Dim> particles = random_cloud(chance, count, grid);
    scatter_body<Dim>(particles, Vec<Dim>::Zero(), grid);
    check_equal(of_particles<Dim>(particles, particles.position, grid.dx()), of_grid(grid, false));
    open(everything(grid), grid);
    sheet_to_grid<Dim>(particles, Vec<Dim>::Zero(), grid);
    check_equal(of_particles<Dim>(particles, particles.position, grid.dx()), of_grid(grid, false));
  }));
}

TYPED_TEST(Transfer, ConservesLinearAndAngularMomentumFromTheGrid)
{
  constexpr int Dim = TypeParam::Dim;
  EXPECT_TRUE(holds("from grid", [](Chance& chance) {
    Grid<Dim> grid = random_grid<Dim>(chance, cells);
    Particles<Dim> particles = random_cloud(chance, count, grid);
    scatter_body<Dim>(particles, Vec<Dim>::Zero(), grid);
    for_each_node(grid, [&](std::size_t i, const std::array<int, Dim>&) {
      for (int d = 0; d < Dim; ++d)
        grid.nodes()[i][d] = chance(-2.0, 2.0);
    });
    const std::array<Column, Dim> before = particles.position;
    grid_to_particles(grid, 1e-3, true, particles, 0, particles.size());
    check_equal(of_particles<Dim>(particles, before, grid.dx()), of_grid(grid, true));
  }));
}

TYPED_TEST(Transfer, ReproducesALinearVelocityFieldThereAndBack)
{
  constexpr int Dim = TypeParam::Dim;
  EXPECT_TRUE(holds("linear field", [](Chance& chance) {
    Grid<Dim> grid = random_grid<Dim>(chance, cells);
    Particles<Dim> particles = random_cloud(chance, count, grid);
    const Vec<Dim> v0 = chance.vector<Dim>(2.0);
    const Mat<Dim> b = chance.matrix<Dim>(3.0);
    for (std::size_t p = 0; p < particles.size(); ++p) {
      set_vector<Dim>(particles.velocity, p, v0 + b * vector_at<Dim>(particles.position, p));
      set_matrix<Dim>(particles.affine, p, b);
    }
    scatter_body<Dim>(particles, Vec<Dim>::Zero(), grid);
    apply_forces(grid, 0.0, 0.0);
    for_each_node(grid, [&](std::size_t i, const std::array<int, Dim>& node) {
      if (node_mass(grid, i) > 1e-9)
        RC_ASSERT(apart(node_vector(grid, i), v0 + b * grid.coordinate(node)) < 1e-11);
    });
    const std::array<Column, Dim> before = particles.position;
    const double dt = chance(1e-4, 1e-2);
    grid_to_particles(grid, dt, true, particles, 0, particles.size());
    for (std::size_t p = 0; p < particles.size(); ++p) {
      const Vec<Dim> x = vector_at<Dim>(before, p), v = v0 + b * x;
      RC_ASSERT(apart(vector_at<Dim>(particles.velocity, p), v) < 1e-11);
      RC_ASSERT(apart(matrix_at<Dim>(particles.affine, p), b) < 1e-9);
      RC_ASSERT(apart(matrix_at<Dim>(particles.gradient, p), b) < 1e-9);
      RC_ASSERT(apart(vector_at<Dim>(particles.position, p), x + dt * v) < 1e-12);
    }
  }));
}

TYPED_TEST(Transfer, LeavesRowsOutsideTheRangeAndUnwantedGradientsAlone)
{
  constexpr int Dim = TypeParam::Dim;
  EXPECT_TRUE(holds("range", [](Chance& chance) {
    Grid<Dim> grid = random_grid<Dim>(chance, cells);
    Particles<Dim> particles = random_cloud(chance, count, grid);
    scatter_body<Dim>(particles, Vec<Dim>::Zero(), grid);
    for (Column& column : particles.gradient)
      std::fill(column.begin(), column.end(), 7.0);
    Particles<Dim> before = particles;
    const std::size_t begin = 11, end = 23;
    grid_to_particles(grid, 1e-3, false, particles, begin, end);
    RC_ASSERT(before.gradient == particles.gradient);
    for (std::size_t p = 0; p < particles.size(); ++p) {
      const bool same = vector_at<Dim>(particles.position, p) == vector_at<Dim>(before.position, p);
      RC_ASSERT(same == (p < begin || p >= end));
    }
  }));
}

TYPED_TEST(Transfer, InternalForcesSumToZeroWithTheStressAsTheirMoment)
{
  constexpr int Dim = TypeParam::Dim;
  EXPECT_TRUE(holds("internal forces", [](Chance& chance) {
    Grid<Dim> grid = random_grid<Dim>(chance, cells);
    Particles<Dim> particles = random_cloud(chance, count, grid);
    scatter_body<Dim>(particles, Vec<Dim>::Zero(), grid);
    Vec<Dim> force = Vec<Dim>::Zero();
    Mat<Dim> moment = Mat<Dim>::Zero(), expected = Mat<Dim>::Zero();
    double size = 0.0;
    for_each_node(grid, [&](std::size_t i, const std::array<int, Dim>& node) {
      force += node_force(grid, i);
      moment += node_force(grid, i) * grid.coordinate(node).transpose();
      size += node_force(grid, i).norm();
    });
    for (std::size_t p = 0; p < particles.size(); ++p)
      expected -= particles.volume[p] * stress_at(particles, p);
    RC_ASSERT(force.norm() < 1e-13 * size);
    RC_ASSERT(apart(moment, expected) < 1e-12 * size);
  }));
}

TYPED_TEST(Transfer, InternalForcesTakeThePowerThatTheGradientsGive)
{
  constexpr int Dim = TypeParam::Dim;
  EXPECT_TRUE(holds("power", [](Chance& chance) {
    Grid<Dim> grid = random_grid<Dim>(chance, cells);
    Particles<Dim> particles = random_cloud(chance, count, grid);
    scatter_body<Dim>(particles, Vec<Dim>::Zero(), grid);
    double power = 0.0, size = 0.0;
    for_each_node(grid, [&](std::size_t i, const std::array<int, Dim>&) {
      for (int d = 0; d < Dim; ++d)
        grid.nodes()[i][d] = chance(-2.0, 2.0);
      power += node_force(grid, i).dot(node_vector(grid, i));
      size += node_force(grid, i).norm();
    });
    grid_to_particles(grid, 0.0, true, particles, 0, particles.size());
    for (std::size_t p = 0; p < particles.size(); ++p)
      power += particles.volume[p] * stress_at(particles, p).cwiseProduct(matrix_at<Dim>(particles.gradient, p)).sum();
    RC_ASSERT(std::abs(power) < 1e-12 * size);
  }));
}

TYPED_TEST(Transfer, GravityPullsOnTheWeightAndASheetsForceActsAtItsNode)
{
  constexpr int Dim = TypeParam::Dim;
  EXPECT_TRUE(holds("external forces", [](Chance& chance) {
    Grid<Dim> grid = random_grid<Dim>(chance, cells);
    Particles<Dim> particles = random_cloud(chance, count, grid);
    const Vec<Dim> gravity = chance.vector<Dim>(10.0);
    const auto check = [&](bool sheet) {
      Vec<Dim> force = Vec<Dim>::Zero(), expected_force = Vec<Dim>::Zero();
      Mat<Dim> moment = Mat<Dim>::Zero(), expected_moment = Mat<Dim>::Zero();
      for_each_node(grid, [&](std::size_t i, const std::array<int, Dim>& node) {
        force += node_force(grid, i);
        moment += node_force(grid, i) * grid.coordinate(node).transpose();
      });
      for (std::size_t p = 0; p < particles.size(); ++p) {
        const Vec<Dim> x = vector_at<Dim>(particles.position, p);
        Vec<Dim> pull = particles.weight_mass[p] * gravity;
        if (sheet)
          pull += vector_at<Dim>(particles.force, p);
        else
          expected_moment -= particles.volume[p] * stress_at(particles, p);
        expected_force += pull;
        expected_moment += pull * x.transpose();
      }
      RC_ASSERT(apart(force, expected_force) < 1e-11 * count);
      RC_ASSERT(apart(moment, expected_moment) < 1e-11 * count);
    };
    scatter_body<Dim>(particles, gravity, grid);
    check(false);
    open(everything(grid), grid);
    sheet_to_grid<Dim>(particles, gravity, grid);
    check(true);
  }));
}

}  // namespace
}  // namespace geocontainer_mpm::mpm::testing
