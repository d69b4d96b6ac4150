// The pieces of a step on their own: a block of sand, two particles a cell in each direction, on a grid that fits it.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "geocontainer_mpm/contact/contact_solver.h"
#include "geocontainer_mpm/geotextile/sheet.h"
#include "geocontainer_mpm/material/law.h"
#include "geocontainer_mpm/mpm/grid_update.h"
#include "geocontainer_mpm/mpm/transfer.h"

namespace {

using namespace geocontainer_mpm;

constexpr double dx = 0.1;

template <int Dim>
struct Block {
  mpm::Grid<Dim> grid;
  mpm::Particles<Dim> particles;
  mpm::Strips strips;
  mpm::ThreadTeam team;
  Vec<Dim> gravity = -9.81 * Vec<Dim>::Unit(Dim - 1);

  explicit Block(int cells, int threads)
      : grid(Vec<Dim>::Zero(), Vec<Dim>::Constant(cells * dx), dx, faces()), team(threads)
  {
    const int side = 2 * (cells - 2);
    std::size_t count = 1;
    for (int d = 0; d < Dim; ++d)
      count *= static_cast<std::size_t>(side);
    particles.resize(count);
    std::mt19937_64 engine(1);
    std::uniform_real_distribution<double> jitter(-0.2 * dx, 0.2 * dx), any(-1.0, 1.0);
    for (std::size_t p = 0; p < count; ++p) {
      std::size_t rest = p;
      for (std::size_t d = 0; d < Dim; ++d, rest /= static_cast<std::size_t>(side)) {
        particles.position[d][p] =
            dx + (static_cast<double>(rest % static_cast<std::size_t>(side)) + 0.5) * 0.5 * dx + jitter(engine);
        particles.velocity[d][p] = 0.1 * any(engine);
      }
      for (mpm::Column& component : particles.affine)
        component[p] = 0.1 * any(engine);
      for (mpm::Column& component : particles.gradient)
        component[p] = 0.1 * any(engine);
      particles.volume[p] = particles.initial_volume[p] = std::pow(0.5 * dx, Dim);
      particles.mass[p] = particles.weight_mass[p] = 2000.0 * particles.volume[p];
    }
    mpm::Sorter<Dim>().sort(grid, particles, strips);
  }
  static std::array<mpm::FaceCondition, 2 * Dim> faces()
  {
    std::array<mpm::FaceCondition, 2 * Dim> all;
    all.fill(mpm::FaceCondition::free);
    return all;
  }
  void open()
  {
    mpm::Window<Dim> window;
    window.end = grid.counts();
    grid.open(window, team);
  }
  void to_grid() { mpm::body_to_grid(mpm::Discretisation{}, particles, strips, {}, gravity, grid, team); }
  void count(benchmark::State& state) const
  {
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(particles.size()));
  }
};

/// About 18 000 particles in the plane, 21 000 in space.
template <int Dim>
constexpr int block_cells = Dim == 2 ? 69 : 16;

template <int Dim>
void body_to_grid(benchmark::State& state)
{
  Block<Dim> block(block_cells<Dim>, static_cast<int>(state.range(0)));
  for (auto _ : state) {
    block.open();
    block.to_grid();
  }
  block.count(state);
}
BENCHMARK_TEMPLATE(body_to_grid, 2)->ArgName("threads")->Arg(1)->Arg(2)->UseRealTime();
BENCHMARK_TEMPLATE(body_to_grid, 3)->ArgName("threads")->Arg(1)->Arg(2)->UseRealTime();

template <int Dim>
void grid_to_particles(benchmark::State& state)
{
  Block<Dim> block(block_cells<Dim>, 1);
  block.open();
  block.to_grid();
  mpm::GridUpdate<Dim>().apply_forces(mpm::Discretisation{}, block.grid, 1e-4, 0.0, block.team);
  for (auto _ : state)
    mpm::grid_to_particles(mpm::Discretisation{}, block.grid, 0.0, mpm::Gather::all, block.particles, 0,
                           block.particles.size());
  block.count(state);
}
BENCHMARK_TEMPLATE(grid_to_particles, 2);
BENCHMARK_TEMPLATE(grid_to_particles, 3);

template <int Dim>
void apply_forces(benchmark::State& state)
{
  Block<Dim> block(block_cells<Dim>, 1);
  mpm::GridUpdate<Dim> update;
  for (auto _ : state) {
    block.open();
    for (std::size_t i = 0; i < block.grid.size(); ++i)
      block.grid.nodes()[i].setOnes();
    benchmark::DoNotOptimize(update.apply_forces(mpm::Discretisation{}, block.grid, 1e-4, 0.0, block.team));
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(block.grid.size()));
}
BENCHMARK_TEMPLATE(apply_forces, 2);
BENCHMARK_TEMPLATE(apply_forces, 3);

template <int Dim>
void sort(benchmark::State& state)
{
  Block<Dim> block(block_cells<Dim>, 1);
  mpm::Sorter<Dim> sorter;
  for (auto _ : state)
    sorter.sort(block.grid, block.particles, block.strips);
  block.count(state);
}
BENCHMARK_TEMPLATE(sort, 2);
BENCHMARK_TEMPLATE(sort, 3);

/// The same strains over and over from a state under pressure: part of the particles yields, part does not.
template <int Dim, material::LawName name>
void law_update(benchmark::State& state)
{
  Block<Dim> block(block_cells<Dim>, 1);
  material::Parameters p;
  p.law = name;
  p.density_kg_per_m3 = 1990.0;
  p.young_modulus_pa = 3e6;
  p.poisson_ratio = 0.3;
  if (name == material::LawName::mohr_coulomb)
    p.friction_angle_deg = 33.0;
  const auto law = material::make_law<Dim>(p);
  constexpr std::size_t normals = Dim == 2 ? 2 : 3;
  for (std::size_t k = 0; k < block.particles.stress.size(); ++k)
    if (k < normals || Dim == 2)
      std::fill(block.particles.stress[k].begin(), block.particles.stress[k].end(), Dim == 2 && k == 2 ? 0.0 : -2e4);
  for (auto _ : state) {
    // There and back, so that the state does not drift away.
    law->update(block.particles.batch(), 1e-3, 0, block.particles.size());
    law->update(block.particles.batch(), -1e-3, 0, block.particles.size());
  }
  state.SetItemsProcessed(2 * state.iterations() * static_cast<std::int64_t>(block.particles.size()));
}
BENCHMARK_TEMPLATE(law_update, 2, material::LawName::linear_elastic);
BENCHMARK_TEMPLATE(law_update, 2, material::LawName::mohr_coulomb);
BENCHMARK_TEMPLATE(law_update, 3, material::LawName::linear_elastic);
BENCHMARK_TEMPLATE(law_update, 3, material::LawName::mohr_coulomb);

/// A strip of sheet that slides on a wall, two points a cell, with the transfer and update that it needs afresh.
void contact_solve(benchmark::State& state)
{
  const auto points = static_cast<std::size_t>(state.range(0));
  const double length = 0.5 * dx * static_cast<double>(points);
  mpm::ThreadTeam alone(1);
  mpm::Grid<2> grid({ -1.0, -1.0 }, { std::ceil(length) + 1.0, 1.0 }, dx, Block<2>::faces());
  mpm::Particles<2> sheet;
  sheet.resize(points);
  for (std::size_t p = 0; p < points; ++p) {
    sheet.position[0][p] = (static_cast<double>(p) + 0.5) * 0.5 * dx;
    sheet.velocity[0][p] = 0.2;
    sheet.velocity[1][p] = -0.1;
    sheet.mass[p] = sheet.weight_mass[p] = 20.0;
  }
  std::vector<contact::BoundaryBody<2>> bodies;
  bodies.emplace_back("wall", contact::Surface({ { -0.9, 0.0 }, { length + 0.9, 0.0 } }), 0.3, 0.5 * dx);
  bodies.back().set_motion({}, {}, 1e-3);
  mpm::Window<2> window;
  window.end = grid.counts();
  mpm::GridUpdate<2> update;
  contact::ContactImpulses<2> impulses;
  const std::vector<contact::ContactPoints<2>> touching{ { &sheet, false } };
  contact::ContactSolver<2> solver;
  for (auto _ : state) {
    grid.open(window, alone);
    mpm::sheet_to_grid<2>({}, sheet, mpm::Part::all, { 0.0, -9.81 }, grid);
    update.apply_forces({}, grid, 1e-3, 0.0, alone);
    benchmark::DoNotOptimize(solver.solve(bodies, touching, {}, 1e-3, 1e-3, grid, impulses));
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(points));
}
BENCHMARK(contact_solve)->ArgName("points")->Arg(32)->Arg(128);

/// The default container's sheet as a circle: 183 segments of a cell.
struct Ring {
  mpm::ThreadTeam alone{ 1 };
  mpm::Grid<2> grid{ { -4.0, -4.0 }, { 4.0, 4.0 }, dx, Block<2>::faces() };
  geotextile::Sheet sheet{ { outline(), true }, parameters() };

  static std::vector<Vec2> outline()
  {
    std::vector<Vec2> points;
    for (int k = 0; k < 183; ++k)
      points.emplace_back(2.95 * std::cos(k * 2.0 * M_PI / 183), 2.95 * std::sin(k * 2.0 * M_PI / 183));
    return points;
  }
  static geotextile::SheetParameters parameters()
  {
    geotextile::SheetParameters p;
    p.unstretched_length = 18.3;
    p.stiffness = 1.1e6;
    p.mass = 0.84;
    p.computational_mass = 20.0;
    p.segment_length = dx;
    p.gauge_length = 0.5;
    return p;
  }
};

void sheet_forces(benchmark::State& state)
{
  Ring ring;
  for (auto _ : state)
    benchmark::DoNotOptimize(ring.sheet.update_forces());
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(ring.sheet.segments()));
}
BENCHMARK(sheet_forces);

void frequency_bound(benchmark::State& state)
{
  Ring ring;
  mpm::Window<2> window;
  window.end = ring.grid.counts();
  ring.grid.open(window, ring.alone);
  ring.sheet.update_forces();
  mpm::sheet_to_grid<2>({}, ring.sheet.nodes(), mpm::Part::all, { 0.0, -9.81 }, ring.grid);
  mpm::FrequencyBound<2> bound;
  for (auto _ : state) {
    bound.begin(ring.grid, {});
    bound.add_mass(ring.sheet.nodes());
    ring.sheet.add_stiffness(bound);
    benchmark::DoNotOptimize(bound.bound());
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(ring.sheet.segments()));
}
BENCHMARK(frequency_bound);

}  // namespace
