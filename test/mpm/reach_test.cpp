// The laws of a shape function, for every shape.

#include "choices.h"

namespace geocontainer_mpm::mpm::testing {
namespace {

template <class K>
class Reaches : public ::testing::Test {
};
TYPED_TEST_SUITE(Reaches, Kinds);

TYPED_TEST(Reaches, PartUnityAndReproduceLinearFieldsWithNodesThatExist)
{
  constexpr int Dim = TypeParam::Dim;
  EXPECT_TRUE(holds("linear fields", [](Chance& chance) {
    const Grid<Dim> grid = random_grid<Dim>(chance, chance.whole(1, 5));
    for (int n = 0; n < 20; ++n) {
      const Vec<Dim> x = random_point(chance, grid), box = random_box(chance, grid);
      double sum = 0.0;
      Vec<Dim> slope = Vec<Dim>::Zero(), place = Vec<Dim>::Zero();
      Mat<Dim> gradient = Mat<Dim>::Zero();
      visit_reach<Dim>(TypeParam::shape, grid, x, box, [&](std::size_t i, double w, const Vec<Dim>& g) {
        RC_ASSERT(i < grid.size());
        RC_ASSERT(w >= 0.0);
        const Vec<Dim> node = grid.coordinate(node_at(grid, i));
        RC_ASSERT(apart(node, x) < 1.5 * grid.dx() * (1.0 + 1e-9));
        sum += w;
        slope += g;
        place += w * (node - x);
        gradient += (node - x) * g.transpose();
      });
      RC_ASSERT(std::abs(sum - 1.0) < 1e-14);
      RC_ASSERT(slope.norm() * grid.dx() < 1e-14);
      // Coordinates of a few metres: node and point are known to 1e-15, cells are 0.05 m at least.
      RC_ASSERT(place.norm() < 1e-13);
      RC_ASSERT(apart(gradient, Mat<Dim>::Identity()) < 1e-12);
    }
  }));
}

TYPED_TEST(Reaches, HaveTheGradientsThatDifferencesShow)
{
  constexpr int Dim = TypeParam::Dim;
  EXPECT_TRUE(holds("gradients", [](Chance& chance) {
    const Grid<Dim> grid = random_grid<Dim>(chance, 4);
    Vec<Dim> x;
    for (int d = 0; d < Dim; ++d)
      x[d] = chance(lower_of(grid)[d], upper_of(grid)[d]);
    const Vec<Dim> box = random_box(chance, grid);
    const double small = 1e-5 * grid.dx();
    const auto weights = [&](const Vec<Dim>& at) {
      std::vector<double> all(grid.size(), 0.0);
      visit_reach<Dim>(TypeParam::shape, grid, at, box, [&](std::size_t i, double w, const Vec<Dim>&) { all[i] += w; });
      return all;
    };
    for (int d = 0; d < Dim; ++d) {
      const std::vector<double> low = weights(x - small * Vec<Dim>::Unit(d)),
                                high = weights(x + small * Vec<Dim>::Unit(d));
      // Pieces meet at 1e-5 of a cell from the point once in many thousand draws: there the slope of linear weights
      // jumps.
      bool same_piece = true;
      visit_reach<Dim>(TypeParam::shape, grid, x, box, [&](std::size_t, double w, const Vec<Dim>&) {
        same_piece = same_piece && (TypeParam::shape != Shape::linear_simplex || w > 4e-5);
      });
      if (same_piece)
        visit_reach<Dim>(TypeParam::shape, grid, x, box, [&](std::size_t i, double, const Vec<Dim>& g) {
          // Central differences of quadratic pieces: exact but for round-off, 1e-16 / 1e-5, and the kink of w''.
          RC_ASSERT(std::abs((high[i] - low[i]) / (2.0 * small) - g[d]) * grid.dx() < 2e-5);
        });
    }
  }));
}

TYPED_TEST(Reaches, AreContinuousAcrossThePiecesBorders)
{
  constexpr int Dim = TypeParam::Dim;
  EXPECT_TRUE(holds("continuous", [](Chance& chance) {
    const Grid<Dim> grid = random_grid<Dim>(chance, 3);
    std::vector<double> change(grid.size(), 0.0);
    const Vec<Dim> x = random_point(chance, grid), box = random_box(chance, grid);
    Vec<Dim> y = x + chance.vector<Dim>(1e-9 * grid.dx());
    y = y.cwiseMax(lower_of(grid)).cwiseMin(upper_of(grid));
    visit_reach<Dim>(TypeParam::shape, grid, x, box, [&](std::size_t i, double w, const Vec<Dim>&) { change[i] += w; });
    visit_reach<Dim>(TypeParam::shape, grid, y, box, [&](std::size_t i, double w, const Vec<Dim>&) { change[i] -= w; });
    for (double c : change)
      RC_ASSERT(std::abs(c) < 1e-8);
  }));
}

}  // namespace
}  // namespace geocontainer_mpm::mpm::testing
