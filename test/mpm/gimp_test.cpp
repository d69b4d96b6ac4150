// What averaging over boxes is for: boxes that tile a body integrate what is uniform over them exactly.

#include "choices.h"

namespace geocontainer_mpm::mpm::testing {
namespace {

template <class D>
class Gimp : public ::testing::Test {
};
using Dimensions = ::testing::Types<Dimension<2>, Dimension<3>>;
TYPED_TEST_SUITE(Gimp, Dimensions);

const Discretisation gimp = choice_of(Shape::gimp, Transfer::apic);

/// Edges, m, that fill `length` between them, of 0.2 to 1 cell each.
std::vector<double> random_edges(Chance& chance, double dx, double length)
{
  std::vector<double> edges;
  double left = length;
  while (left > 1.2 * dx) {
    edges.push_back(chance(0.2, 1.0) * dx);
    left -= edges.back();
  }
  edges.insert(edges.end(), 2, 0.5 * left);
  return edges;
}

/// Boxes of many sizes that fill the grid, with one density and one stress.
template <int Dim>
Particles<Dim> tiling(Chance& chance, const Grid<Dim>& grid, double density)
{
  std::array<std::vector<double>, Dim> edges;
  std::size_t count = 1;
  for (std::size_t d = 0; d < Dim; ++d) {
    const auto c = static_cast<Eigen::Index>(d);
    edges[d] = random_edges(chance, grid.dx(), upper_of(grid)[c] - lower_of(grid)[c]);
    count *= edges[d].size();
  }
  Particles<Dim> particles;
  particles.resize(count);
  particles.use_boxes();
  const double stress = chance(-1e3, 1e3);
  for (std::size_t p = 0; p < count; ++p) {
    particles.volume[p] = 1.0;
    for (std::size_t d = 0, rest = p; d < Dim; ++d) {
      const std::size_t at = rest % edges[d].size();
      rest /= edges[d].size();
      double x = lower_of(grid)[static_cast<Eigen::Index>(d)] + 0.5 * edges[d][at];
      for (std::size_t k = 0; k < at; ++k)
        x += edges[d][k];
      particles.position[d][p] = x;
      particles.box[d][p] = edges[d][at];
      particles.volume[p] *= edges[d][at];
    }
    particles.mass[p] = density * particles.volume[p];
    for (std::size_t k = 0; k < particles.stress.size(); ++k)
      particles.stress[k][p] = stress * static_cast<double>(k + 1);
  }
  return particles;
}

TYPED_TEST(Gimp, BoxesThatTileFeelNoForceUnderUniformStressAndGiveEveryNodeItsCell)
{
  constexpr int Dim = TypeParam::Dim;
  EXPECT_TRUE(holds("tiling", [](Chance& chance) {
    Grid<Dim> grid = random_grid<Dim>(chance, 4);
    const double density = chance(1.0, 1e3), cell = density * std::pow(grid.dx(), Dim);
    Particles<Dim> particles = tiling(chance, grid, density);
    double pull = 0.0;
    for (const Column& component : particles.stress)
      pull = std::max(pull, std::abs(component[0]) * std::pow(grid.dx(), Dim - 1));
    scatter_body<Dim>(particles, Vec<Dim>::Zero(), grid, gimp);
    for_each_node(grid, [&](std::size_t i, const std::array<int, Dim>& node) {
      for (int d = 0; d < Dim; ++d)  // the neighbours too must lie within the material
        if (node[static_cast<std::size_t>(d)] <= grid.low_face(d) ||
            node[static_cast<std::size_t>(d)] >= grid.high_face(d))
          return;
      RC_ASSERT(node_force(grid, i).norm() < 1e-12 * pull);
      RC_ASSERT(std::abs(node_mass(grid, i) - cell) < 1e-12 * cell);
    });
  }));
}

TYPED_TEST(Gimp, WithABoxOfACellIsTheQuadraticBspline)
{
  constexpr int Dim = TypeParam::Dim;
  EXPECT_TRUE(holds("B-spline", [](Chance& chance) {
    const Grid<Dim> grid = random_grid<Dim>(chance, 4);
    const Vec<Dim> x = random_point(chance, grid);
    std::vector<double> weight(grid.size(), 0.0);
    std::vector<Vec<Dim>> gradient(grid.size(), Vec<Dim>::Zero());
    const Vec<Dim> points = Vec<Dim>::Zero(), wide = chance(1.0, 2.0) * Vec<Dim>::Constant(grid.dx());
    for (const auto& [box, sign] : { std::make_pair(points, -1.0), std::make_pair(wide, 1.0) })
      visit_reach<Dim>(Shape::gimp, grid, x, box, [&, s = sign](std::size_t i, double w, const Vec<Dim>& g) {
        weight[i] += s * w;
        gradient[i] += s * g;
      });
    for (std::size_t i = 0; i < grid.size(); ++i) {
      RC_ASSERT(std::abs(weight[i]) < 1e-14);
      RC_ASSERT(gradient[i].norm() * grid.dx() < 1e-14);
    }
  }));
}

TYPED_TEST(Gimp, WithASmallBoxIsMultilinear)
{
  constexpr int Dim = TypeParam::Dim;
  EXPECT_TRUE(holds("linear", [](Chance& chance) {
    const Grid<Dim> grid = random_grid<Dim>(chance, 3);
    const Vec<Dim> x = random_point(chance, grid), box = Vec<Dim>::Constant(0.02 * grid.dx());
    visit_reach<Dim>(Shape::gimp, grid, x, box, [&](std::size_t i, double w, const Vec<Dim>&) {
      const Vec<Dim> r = (grid.coordinate(node_at(grid, i)) - x).cwiseAbs() / grid.dx();
      // At a node the mean of a hat over a box of edge e is e / 4 below its top.
      RC_ASSERT(std::abs(w - (1.0 - r.array()).max(0.0).prod()) < Dim * 0.02 / 4.0);
    });
  }));
}

TYPED_TEST(Gimp, BoxesFollowTheStretchAlongTheirEdgesButNoShearOrSpin)
{
  constexpr int Dim = TypeParam::Dim;
  EXPECT_TRUE(holds("stretch", [](Chance& chance) {
    const Grid<Dim> grid = random_grid<Dim>(chance, 3);
    Particles<Dim> particles = random_cloud(chance, 20, grid);
    particles.use_boxes();
    const Vec<Dim> rate = chance.vector<Dim>(3.0);
    const double dt = 1e-2;
    for (std::size_t p = 0; p < particles.size(); ++p) {
      Mat<Dim> gradient = chance.matrix<Dim>(5.0);
      gradient.diagonal() = rate;
      set_matrix<Dim>(particles.gradient, p, gradient);
    }
    const Particles<Dim> before = particles;
    particles.stretch_boxes(dt);
    for (std::size_t p = 0; p < particles.size(); ++p) {
      const Vec<Dim> expected = box_of(before, p).cwiseProduct(Vec<Dim>::Ones() + dt * rate);
      RC_ASSERT(std::abs(box_of(before, p).prod() / particles.volume[p] - 1.0) < 1e-14);
      RC_ASSERT(apart(box_of(particles, p), expected) < 1e-15);
    }
    // However long it lasts, they stay near a cube.
    for (int step = 0; step < 200; ++step)
      particles.stretch_boxes(dt);
    for (std::size_t p = 0; p < particles.size(); ++p) {
      const Vec<Dim> ratio = box_of(particles, p) / std::pow(particles.volume[p], 1.0 / Dim);
      RC_ASSERT(ratio.maxCoeff() < std::sqrt(2.0) * (1.0 + 1e-12));
      RC_ASSERT(ratio.minCoeff() > std::sqrt(0.5) * (1.0 - 1e-12));
    }
  }));
}

TYPED_TEST(Gimp, PointsWithoutBoxesAreSpreadLikeBsplines)
{
  constexpr int Dim = TypeParam::Dim;
  EXPECT_TRUE(holds("points", [](Chance& chance) {
    Grid<Dim> grid = random_grid<Dim>(chance, 3), other = grid;
    const Particles<Dim> nodes = awkward_cloud(chance, 20, grid);
    const Vec<Dim> gravity = chance.vector<Dim>(10.0);
    open(everything(grid), grid);
    open(everything(other), other);
    sheet_to_grid<Dim>(nodes, gravity, grid, gimp);
    sheet_to_grid<Dim>(nodes, gravity, other, choice_of(Shape::bspline2, Transfer::apic));
    for (std::size_t i = 0; i < grid.size(); ++i) {
      RC_ASSERT((grid.nodes()[i] == other.nodes()[i]).all());
      RC_ASSERT((grid.forces()[i] == other.forces()[i]).all());
    }
  }));
}

}  // namespace
}  // namespace geocontainer_mpm::mpm::testing
