// Quadratic B-splines: the laws that the transfers rest on.

#include <gtest/gtest.h>

#include "random_cloud.h"

namespace geocontainer_mpm::mpm::testing {
namespace {

template <class D>
class Bspline : public ::testing::Test {
};
using Dimensions = ::testing::Types<Dimension<2>, Dimension<3>>;
TYPED_TEST_SUITE(Bspline, Dimensions);

template <int Dim>
Vec<Dim> random_point(Chance& chance, const Grid<Dim>& grid)
{
  Vec<Dim> x = lower_of(grid);
  for (int d = 0; d < Dim; ++d)
    x[d] += grid.dx() * chance(0.0, 6.0);
  return x;
}

TYPED_TEST(Bspline, IsAPartitionOfUnityThatReproducesLinearFields)
{
  constexpr int Dim = TypeParam::Dim;
  EXPECT_TRUE(holds("moments", [](Chance& chance) {
    const Grid<Dim> grid = random_grid<Dim>(chance, 6);
    const double dx = grid.dx();
    double sum = 0.0;
    Vec<Dim> first = Vec<Dim>::Zero(), gradient_sum = Vec<Dim>::Zero();
    Mat<Dim> second = Mat<Dim>::Zero(), gradient_first = Mat<Dim>::Zero();
    for_each_stencil_node<Dim>(grid, random_point(chance, grid),
                               [&](std::size_t, double w, const Vec<Dim>& r, const Vec<Dim>& g) {
                                 RC_ASSERT(w >= 0.0);
                                 sum += w;
                                 first += w * r;
                                 second += w * r * r.transpose();
                                 gradient_sum += g;
                                 gradient_first += r * g.transpose();
                               });
    RC_ASSERT(std::abs(sum - 1.0) < 1e-14);
    RC_ASSERT(first.norm() < 1e-13 * dx);
    RC_ASSERT(apart(second, bspline_inertia(dx) * Mat<Dim>::Identity()) < 1e-13 * dx * dx);
    RC_ASSERT(gradient_sum.norm() < 1e-13 / dx);
    RC_ASSERT(apart(gradient_first, Mat<Dim>::Identity()) < 1e-13);
  }));
}

TYPED_TEST(Bspline, PlacesItsOffsetsOnTheNodesOfTheGrid)
{
  constexpr int Dim = TypeParam::Dim;
  EXPECT_TRUE(holds("offsets", [](Chance& chance) {
    const Grid<Dim> grid = random_grid<Dim>(chance, 6);
    const Vec<Dim> x = random_point(chance, grid);
    std::array<double, Dim> point;
    for (int d = 0; d < Dim; ++d)
      point[static_cast<std::size_t>(d)] = x[d];
    const Stencil<Dim> s = make_stencil<Dim>(point, grid.origin(), grid.dx(), grid.inverse_dx());
    for (int k = 0; k < 3; ++k) {
      std::array<int, Dim> node = s.base;
      for (int& index : node)
        index += k;
      for (int d = 0; d < Dim; ++d) {
        const double offset = s.offset[static_cast<std::size_t>(d)][static_cast<std::size_t>(k)];
        RC_ASSERT(std::abs(x[d] + offset - grid.coordinate(node)[d]) < 1e-13);
        RC_ASSERT(std::abs(offset) <= 1.5 * grid.dx() * (1.0 + 1e-12));
      }
    }
  }));
}

TYPED_TEST(Bspline, HasTheGradientsOfItsWeights)
{
  constexpr int Dim = TypeParam::Dim;
  EXPECT_TRUE(holds("differences", [](Chance& chance) {
    const Grid<Dim> grid = random_grid<Dim>(chance, 6);
    const Vec<Dim> x = random_point(chance, grid);
    const double h = 1e-6 * grid.dx();
    std::vector<Vec<Dim>> difference(grid.size(), Vec<Dim>::Zero());
    for (int d = 0; d < Dim; ++d)
      for (const double sign : { -1.0, 1.0 })
        for_each_stencil_node<Dim>(
            grid, x + sign * h * Vec<Dim>::Unit(d),
            [&](std::size_t i, double w, const Vec<Dim>&, const Vec<Dim>&) { difference[i][d] += 0.5 * sign * w / h; });
    for_each_stencil_node<Dim>(grid, x, [&](std::size_t i, double, const Vec<Dim>&, const Vec<Dim>& g) {
      RC_ASSERT(apart(g, difference[i]) < 1e-5 / grid.dx());
    });
  }));
}

}  // namespace
}  // namespace geocontainer_mpm::mpm::testing
