// Order in memory: nothing is lost, and strips may be shared by threads until a particle has drifted a cell.

#include <gtest/gtest.h>

#include <algorithm>

#include "random_cloud.h"

namespace geocontainer_mpm::mpm::testing {
namespace {

template <class D>
class Sorting : public ::testing::Test {
};
using Dimensions = ::testing::Types<Dimension<2>, Dimension<3>>;
TYPED_TEST_SUITE(Sorting, Dimensions);

constexpr double drift_cells = 0.9;  // when the model sorts again

/// Several strips long, whatever the number of threads.
template <int Dim>
Grid<Dim> long_grid(Chance& chance)
{
  std::array<int, Dim> cells;
  cells.fill(4);
  cells[0] = chance.whole(5, 40);
  return random_grid<Dim>(chance, cells);
}

template <int Dim>
int base_of(const Grid<Dim>& grid, double x)
{
  return static_cast<int>(std::floor((x - grid.origin()[0]) * grid.inverse_dx() - 0.5));
}

template <int Dim>
void drift(Chance& chance, const Grid<Dim>& grid, Particles<Dim>& particles)
{
  const Vec<Dim> lower = lower_of(grid), upper = upper_of(grid);
  const double far = drift_cells * grid.dx();
  for (std::size_t p = 0; p < particles.size(); ++p)
    for (int d = 0; d < Dim; ++d) {
      // All the way as often as part of it: the far end is what could go wrong.
      const double way = chance.whole(0, 1) == 0 ? chance(-far, far) : (chance.whole(0, 1) == 0 ? far : -far);
      double& x = particles.position[static_cast<std::size_t>(d)][p];
      x = std::clamp(x + way, lower[d], upper[d]);
    }
}

TYPED_TEST(Sorting, KeepsEveryParticleWhole)
{
  constexpr int Dim = TypeParam::Dim;
  EXPECT_TRUE(holds("permutation", [](Chance& chance) {
    const Grid<Dim> grid = long_grid<Dim>(chance);
    Particles<Dim> before = random_cloud(chance, static_cast<std::size_t>(chance.whole(0, 200)), grid);
    Particles<Dim> particles = before;
    Strips strips;
    Sorter<Dim> sorter;
    for (int again = 0; again < 2; ++again) {
      sorter.sort(grid, particles, strips);
      std::vector<bool> seen(before.size(), false);
      std::vector<const Column*> left, right;
      before.for_each_column([&](Column& column) { left.push_back(&column); });
      particles.for_each_column([&](Column& column) { right.push_back(&column); });
      RC_ASSERT(particles.size() == before.size());
      for (std::size_t p = 0; p < particles.size(); ++p) {
        const std::uint32_t id = particles.id[p];
        RC_ASSERT(!seen[id]);
        seen[id] = true;
        for (std::size_t k = 0; k < left.size(); ++k)
          RC_ASSERT((*left[k])[id] == (*right[k])[p]);
      }
      drift(chance, grid, before);
      for (std::size_t p = 0; p < particles.size(); ++p)
        set_vector<Dim>(particles.position, p, vector_at<Dim>(before.position, particles.id[p]));
    }
  }));
}

TYPED_TEST(Sorting, PutsEveryParticleInTheStripOfItsCell)
{
  constexpr int Dim = TypeParam::Dim;
  EXPECT_TRUE(holds("strips", [](Chance& chance) {
    const Grid<Dim> grid = long_grid<Dim>(chance);
    Particles<Dim> particles = random_cloud(chance, 150, grid);
    Strips strips;
    Sorter<Dim>().sort(grid, particles, strips);
    RC_ASSERT(strips.begin.front() == 0U);
    RC_ASSERT(strips.begin.back() == particles.size());
    RC_ASSERT(std::is_sorted(strips.begin.begin(), strips.begin.end()));
    for (std::size_t s = 0; s < strips.count(); ++s)
      for (std::size_t p = strips.begin[s]; p < strips.begin[s + 1]; ++p)
        RC_ASSERT(base_of(grid, particles.position[0][p]) / strip_width == static_cast<int>(s));
  }));
}

TYPED_TEST(Sorting, KeepsStripsTwoApartOffEachOthersNodesAfterDrift)
{
  constexpr int Dim = TypeParam::Dim;
  EXPECT_TRUE(holds("disjoint", [](Chance& chance) {
    const Grid<Dim> grid = long_grid<Dim>(chance);
    Particles<Dim> particles = random_cloud(chance, 400, grid);
    Strips strips;
    Sorter<Dim>().sort(grid, particles, strips);
    drift(chance, grid, particles);
    int last_written[2] = { -1, -1 };  // of even and odd strips so far
    for (std::size_t s = 0; s < strips.count(); ++s) {
      int first = grid.counts()[0], last = last_written[s % 2];
      for (std::size_t p = strips.begin[s]; p < strips.begin[s + 1]; ++p) {
        const int base = base_of(grid, particles.position[0][p]);
        first = std::min(first, base);
        last = std::max(last, base + 2);
      }
      RC_ASSERT(first > last_written[s % 2]);
      last_written[s % 2] = last;
    }
  }));
}

TYPED_TEST(Sorting, GivesTheSameBitsWithAnyNumberOfThreads)
{
  constexpr int Dim = TypeParam::Dim;
  EXPECT_TRUE(holds("threads", [](Chance& chance) {
    Grid<Dim> grid = long_grid<Dim>(chance);
    Particles<Dim> particles = random_cloud(chance, 2000, grid);
    const Vec<Dim> gravity = chance.vector<Dim>(10.0);
    Strips strips;
    Sorter<Dim>().sort(grid, particles, strips);
    drift(chance, grid, particles);
    const auto scattered = [&](int threads) {
      ThreadTeam team(threads);
      grid.open(everything(grid), team);
      mpm::body_to_grid({}, particles, strips, {}, gravity, grid, team);
      const auto* nodes = reinterpret_cast<const char*>(grid.nodes());
      const auto* forces = reinterpret_cast<const char*>(grid.forces());
      std::vector<char> bytes(nodes, nodes + grid.size() * sizeof(typename Grid<Dim>::Node));
      bytes.insert(bytes.end(), forces, forces + grid.size() * sizeof(typename Grid<Dim>::Force));
      return bytes;
    };
    const std::vector<char> one = scattered(1);
    RC_ASSERT(scattered(2) == one);
    RC_ASSERT(scattered(3) == one);
  }));
}

}  // namespace
}  // namespace geocontainer_mpm::mpm::testing
