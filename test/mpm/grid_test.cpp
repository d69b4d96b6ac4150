// The grid's geometry and its active window.

#include <gtest/gtest.h>

#include <set>

#include "random_cloud.h"

namespace geocontainer_mpm::mpm::testing {
namespace {

template <class D>
class GridOf : public ::testing::Test {
};
using Dimensions = ::testing::Types<Dimension<2>, Dimension<3>>;
TYPED_TEST_SUITE(GridOf, Dimensions);

template <int Dim>
Window<Dim> random_window(Chance& chance, const Grid<Dim>& grid)
{
  Window<Dim> window;
  for (std::size_t d = 0; d < Dim; ++d) {
    window.begin[d] = chance.whole(0, grid.counts()[d] - 1);
    window.end[d] = chance.whole(window.begin[d], grid.counts()[d]);
  }
  return window;
}

TYPED_TEST(GridOf, HasItsFacesWhereTheSpaceEnds)
{
  constexpr int Dim = TypeParam::Dim;
  EXPECT_TRUE(holds("faces", [](Chance& chance) {
    std::array<int, Dim> cells;
    for (int& n : cells)
      n = chance.whole(1, 9);
    const Vec<Dim> lower = chance.vector<Dim>(50.0);
    const double dx = chance(0.01, 1.0);
    Vec<Dim> upper = lower;
    for (int d = 0; d < Dim; ++d)
      upper[d] += cells[static_cast<std::size_t>(d)] * dx;
    const Grid<Dim> grid(lower, upper, dx, free_faces<Dim>());
    std::array<int, Dim> low, high;
    std::size_t nodes = 1;
    for (int d = 0; d < Dim; ++d) {
      const auto e = static_cast<std::size_t>(d);
      low[e] = grid.low_face(d);
      high[e] = grid.high_face(d);
      nodes *= static_cast<std::size_t>(grid.counts()[e]);
      RC_ASSERT(grid.counts()[e] == cells[e] + 1 + 2 * Grid<Dim>::margin);
    }
    RC_ASSERT(grid.size() == nodes);
    RC_ASSERT(apart(grid.coordinate(low), lower) < 1e-12 * 50.0);
    RC_ASSERT(apart(grid.coordinate(high), upper) < 1e-12 * 50.0);
  }));
}

TYPED_TEST(GridOf, VisitsEveryNodeOfItsWindowOnce)
{
  constexpr int Dim = TypeParam::Dim;
  EXPECT_TRUE(holds("window", [](Chance& chance) {
    Grid<Dim> grid = random_grid<Dim>(chance, 5);
    const Window<Dim> window = random_window(chance, grid);
    open(window, grid);
    std::set<std::size_t> seen;
    for_each_node(grid, [&](std::size_t i, const std::array<int, Dim>& node) {
      RC_ASSERT(i == grid.index(node));
      for (std::size_t d = 0; d < Dim; ++d)
        RC_ASSERT(node[d] >= window.begin[d] && node[d] < window.end[d]);
      RC_ASSERT(seen.insert(i).second);
    });
    RC_ASSERT(seen.size() == window.nodes());
    if (!seen.empty())
      RC_ASSERT(*seen.rbegin() < grid.size());
  }));
}

TYPED_TEST(GridOf, ClearsItsWindowAndNothingElse)
{
  constexpr int Dim = TypeParam::Dim;
  EXPECT_TRUE(holds("clear", [](Chance& chance) {
    Grid<Dim> grid = random_grid<Dim>(chance, 5);
    for (std::size_t i = 0; i < grid.size(); ++i) {
      grid.nodes()[i].setConstant(3.0);
      grid.forces()[i].setConstant(4.0);
    }
    ThreadTeam team(chance.whole(1, 3));
    grid.open(random_window(chance, grid), team);
    std::size_t cleared = 0;
    for (std::size_t i = 0; i < grid.size(); ++i) {
      const bool zero = (grid.nodes()[i] == 0.0).all() && (grid.forces()[i] == 0.0).all();
      RC_ASSERT(zero || ((grid.nodes()[i] == 3.0).all() && (grid.forces()[i] == 4.0).all()));
      cleared += zero ? 1 : 0;
    }
    for_each_node(grid, [&](std::size_t i, const std::array<int, Dim>&) { RC_ASSERT((grid.nodes()[i] == 0.0).all()); });
    RC_ASSERT(cleared == grid.window().nodes());
  }));
}

TEST(WindowOf, HasNoNodesWhenItIsEmpty)
{
  Window<3> window;
  EXPECT_EQ(window.nodes(), 0U);
  window.end = { 2, 3, 4 };
  EXPECT_EQ(window.nodes(), 24U);
  window.begin[1] = 5;
  EXPECT_EQ(window.nodes(), 0U);
}

}  // namespace
}  // namespace geocontainer_mpm::mpm::testing
