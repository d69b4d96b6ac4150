// The stability bound against the true largest frequency: the stiffness operator of the code itself (gather, law,
// scatter), column by column, and a dense eigenvalue solve.

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <vector>

#include "geocontainer_mpm/material/law.h"
#include "geocontainer_mpm/mpm/frequency_bound.h"
#include "random_cloud.h"

namespace geocontainer_mpm::mpm::testing {
namespace {

template <class D>
class Stability : public ::testing::Test {
};
using Dimensions = ::testing::Types<Dimension<2>, Dimension<3>>;
TYPED_TEST_SUITE(Stability, Dimensions);

/// Largest angular frequency of the elastic cloud on its grid, rad/s. Nodal masses are lumped, as in the scheme.
template <int Dim>
double largest_frequency(const material::Parameters& elastic, Particles<Dim> particles, Grid<Dim> grid)
{
  const auto law = material::make_law<Dim>(elastic);
  Strips strips;
  Sorter<Dim>().sort(grid, particles, strips);
  for (Column& component : particles.stress)
    std::fill(component.begin(), component.end(), 0.0);
  open(everything(grid), grid);
  body_to_grid<Dim>(particles, strips, Vec<Dim>::Zero(), grid);
  std::vector<std::size_t> node;
  std::vector<double> mass;
  for_each_node(grid, [&](std::size_t i, const std::array<int, Dim>&) {
    if (node_mass(grid, i) > 0.0) {
      node.push_back(i);
      mass.push_back(node_mass(grid, i));
    }
  });

  const auto n = static_cast<Eigen::Index>(node.size());
  Eigen::MatrixXd stiffness(Dim * n, Dim * n);
  constexpr double small = 1e-7;  // of a cell: strains for which every law is linear to as many digits
  for (Eigen::Index column = 0; column < Dim * n; ++column) {
    Particles<Dim> moved = particles;
    open(everything(grid), grid);
    const auto at = static_cast<std::size_t>(column / Dim);
    grid.nodes()[node[at]][column % Dim] = small * grid.dx();
    grid_to_particles(grid, 1.0, true, moved, 0, moved.size());
    law->update(moved.batch(), 1.0, 0, moved.size());
    moved.position = particles.position;
    moved.volume = particles.volume;
    open(everything(grid), grid);
    body_to_grid<Dim>(moved, strips, Vec<Dim>::Zero(), grid);
    for (Eigen::Index row = 0; row < Dim * n; ++row) {
      const auto to = static_cast<std::size_t>(row / Dim);
      stiffness(row, column) =
          -grid.forces()[node[to]][row % Dim] / (small * grid.dx()) / std::sqrt(mass[at] * mass[to]);
    }
  }
  const Eigen::MatrixXd symmetric = 0.5 * (stiffness + stiffness.transpose());
  EXPECT_TRUE((stiffness - symmetric).norm() < 1e-5 * symmetric.norm());
  return std::sqrt(
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(symmetric, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff());
}

template <int Dim>
double frequency_bound(const material::Parameters& elastic, Particles<Dim> particles, Grid<Dim> grid)
{
  open(everything(grid), grid);
  scatter_body<Dim>(particles, Vec<Dim>::Zero(), grid);
  const double shear = material::shear_modulus(elastic);
  FrequencyBound<Dim> bound;
  bound.begin(grid, {});
  bound.add_body(particles, { material::constrained_modulus(elastic) - 2.0 * shear, shear });
  return std::sqrt(bound.bound().frequency_square);
}

TYPED_TEST(Stability, BoundIsSafeAndNotFarFromTheTruth)
{
  constexpr int Dim = TypeParam::Dim;
  double least = 10.0, most = 0.0;  // of the bound over the truth
  for (int seed = 0; seed < (Dim == 2 ? 30 : 8); ++seed) {
    Chance chance(static_cast<std::uint64_t>(seed));
    const Grid<Dim> grid = random_grid<Dim>(chance, Dim == 2 ? 5 : 1);
    material::Parameters elastic;
    elastic.density_kg_per_m3 = chance(1000.0, 2000.0);
    elastic.young_modulus_pa = chance(1e5, 1e7);
    elastic.poisson_ratio = chance(0.0, 0.45);
    const bool ordered = seed % 2 == 0;
    const int side = Dim == 2 ? 10 : 2;
    const std::size_t count = Dim == 2 ? 100 : 8;
    Particles<Dim> particles = random_cloud(chance, count, grid);
    for (std::size_t p = 0; p < count; ++p) {
      for (Column& component : particles.affine)
        component[p] = 0.0;
      set_vector<Dim>(particles.velocity, p, Vec<Dim>::Zero());
      if (ordered)  // a lattice, two a cell in each direction
        for (int d = 0, rest = static_cast<int>(p); d < Dim; ++d, rest /= side)
          particles.position[static_cast<std::size_t>(d)][p] =
              lower_of(grid)[d] + 0.5 * grid.dx() * (rest % side + chance(0.45, 0.55));
      particles.volume[p] = std::pow(0.5 * grid.dx(), Dim);
      particles.mass[p] = elastic.density_kg_per_m3 * particles.volume[p] * chance(0.9, 1.1);
    }
    const double ratio =
        frequency_bound<Dim>(elastic, particles, grid) / largest_frequency<Dim>(elastic, particles, grid);
    least = std::min(least, ratio);
    most = std::max(most, ratio);
  }
  EXPECT_GE(least, 1.0);
  EXPECT_LE(most, 1.45);  // the header's table has 1.40
  this->RecordProperty("least", std::to_string(least));
  this->RecordProperty("most", std::to_string(most));
}

}  // namespace
}  // namespace geocontainer_mpm::mpm::testing
