// Leapfrog on the grid: a cloud without stress falls by g t^2 / 2 exactly, whatever the steps.

#include <gtest/gtest.h>

#include "geocontainer_mpm/mpm/grid_update.h"
#include "random_cloud.h"

namespace geocontainer_mpm::mpm::testing {
namespace {

template <class D>
class FreeFall : public ::testing::Test {
};
using Dimensions = ::testing::Types<Dimension<2>, Dimension<3>>;
TYPED_TEST_SUITE(FreeFall, Dimensions);

TYPED_TEST(FreeFall, IsExactForRandomSteps)
{
  constexpr int Dim = TypeParam::Dim;
  EXPECT_TRUE(holds("free fall", [](Chance& chance) {
    constexpr std::size_t count = 20;
    Vec<Dim> lower = Vec<Dim>::Constant(-0.5), upper = Vec<Dim>::Constant(0.5);
    lower[Dim - 1] = -3.0;
    Grid<Dim> grid(lower, upper, 0.1, free_faces<Dim>());
    Particles<Dim> particles = random_cloud<Dim>(chance, count, Vec<Dim>::Constant(-0.15), Vec<Dim>::Constant(0.15));
    particles.weight_mass = particles.mass;
    for (Column& column : particles.velocity)
      std::fill(column.begin(), column.end(), 0.0);
    for (Column& column : particles.affine)
      std::fill(column.begin(), column.end(), 0.0);
    for (Column& column : particles.stress)
      std::fill(column.begin(), column.end(), 0.0);
    const std::array<Column, Dim> start = particles.position;
    Vec<Dim> gravity = Vec<Dim>::Zero();
    gravity[Dim - 1] = -9.81;

    double last = 0.0, time = 0.0;
    while (time < 0.6) {
      const double dt = chance(1e-4, 2e-2);
      scatter_body<Dim>(particles, gravity, grid);
      apply_forces(grid, 0.5 * (last + dt), 0.0);
      grid_to_particles(grid, dt, true, particles, 0, particles.size());
      last = dt;
      time += dt;
    }
    const double fall = 0.5 * 9.81 * time * time;
    for (std::size_t p = 0; p < count; ++p) {
      Vec<Dim> way = vector_at<Dim>(particles.position, p) - vector_at<Dim>(start, particles.id[p]);
      way[Dim - 1] += fall;
      RC_ASSERT(way.template lpNorm<Eigen::Infinity>() < 1e-12 * fall);
    }
  }));
}

}  // namespace
}  // namespace geocontainer_mpm::mpm::testing
