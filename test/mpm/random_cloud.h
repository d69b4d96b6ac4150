#pragma once
/// Random grids and clouds of particles. One seed a case: rapidcheck prints it with a failure.

#include <rapidcheck.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <random>

#include "geocontainer_mpm/mpm/bspline.h"
#include "geocontainer_mpm/mpm/grid.h"
#include "geocontainer_mpm/mpm/grid_update.h"
#include "geocontainer_mpm/mpm/particles.h"
#include "geocontainer_mpm/mpm/sorting.h"
#include "geocontainer_mpm/mpm/transfer.h"

namespace geocontainer_mpm::mpm::testing {

template <int dimension>
struct Dimension {
  static constexpr int Dim = dimension;
};

class Chance {
public:
  explicit Chance(std::uint64_t seed) : engine_(seed) {}
  double operator()(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  int whole(int low, int high) { return std::uniform_int_distribution<int>(low, high)(engine_); }
  template <int Dim>
  Vec<Dim> vector(double size)
  {
    Vec<Dim> v;
    for (int d = 0; d < Dim; ++d)
      v[d] = (*this)(-size, size);
    return v;
  }
  template <int Dim>
  Mat<Dim> matrix(double size)
  {
    Mat<Dim> m;
    for (int i = 0; i < Dim; ++i)
      m.row(i) = vector<Dim>(size);
    return m;
  }

private:
  std::mt19937_64 engine_;
};

/// Checks `property(chance)` for many seeds.
template <class Property>
bool holds(const char* what, Property&& property)
{
  return rc::check(what, [&](std::uint64_t seed) {
    Chance chance(seed);
    property(chance);
  });
}

template <int Dim>
std::array<FaceCondition, 2 * Dim> free_faces()
{
  std::array<FaceCondition, 2 * Dim> faces;
  faces.fill(FaceCondition::free);
  return faces;
}

/// Somewhere in space, `cells` in each direction.
template <int Dim>
Grid<Dim> random_grid(Chance& chance, const std::array<int, Dim>& cells,
                      const std::array<FaceCondition, 2 * Dim>& faces = free_faces<Dim>())
{
  const double dx = chance(0.05, 0.5);
  const Vec<Dim> lower = chance.vector<Dim>(3.0);
  Vec<Dim> upper = lower;
  for (int d = 0; d < Dim; ++d)
    upper[d] += cells[static_cast<std::size_t>(d)] * dx;
  return Grid<Dim>(lower, upper, dx, faces);
}

template <int Dim>
Grid<Dim> random_grid(Chance& chance, int cells)
{
  std::array<int, Dim> all;
  all.fill(cells);
  return random_grid<Dim>(chance, all);
}

template <int Dim>
Window<Dim> everything(const Grid<Dim>& grid)
{
  Window<Dim> window;
  window.end = grid.counts();
  return window;
}

template <int Dim>
Vec<Dim> lower_of(const Grid<Dim>& grid)
{
  return grid.origin() + Vec<Dim>::Constant(Grid<Dim>::margin * grid.dx());
}
template <int Dim>
Vec<Dim> upper_of(const Grid<Dim>& grid)
{
  Vec<Dim> upper = lower_of(grid);
  for (int d = 0; d < Dim; ++d)
    upper[d] += (grid.high_face(d) - grid.low_face(d)) * grid.dx();
  return upper;
}

template <int Dim>
Vec<Dim> vector_at(const std::array<Column, Dim>& columns, std::size_t p)
{
  Vec<Dim> v;
  for (int d = 0; d < Dim; ++d)
    v[d] = columns[static_cast<std::size_t>(d)][p];
  return v;
}
template <int Dim>
void set_vector(std::array<Column, Dim>& columns, std::size_t p, const Vec<Dim>& v)
{
  for (int d = 0; d < Dim; ++d)
    columns[static_cast<std::size_t>(d)][p] = v[d];
}

template <int Dim, std::size_t size>
Mat<Dim> matrix_at(const std::array<Column, size>& columns, std::size_t p)
{
  static_assert(size == Dim * Dim);
  Mat<Dim> m;
  for (int i = 0; i < Dim; ++i)
    for (int j = 0; j < Dim; ++j)
      m(i, j) = columns[static_cast<std::size_t>(i * Dim + j)][p];
  return m;
}
template <int Dim, std::size_t size>
void set_matrix(std::array<Column, size>& columns, std::size_t p, const Mat<Dim>& m)
{
  static_assert(size == Dim * Dim);
  for (int i = 0; i < Dim; ++i)
    for (int j = 0; j < Dim; ++j)
      columns[static_cast<std::size_t>(i * Dim + j)][p] = m(i, j);
}

/// In-plane part of the stress, as material/law.h orders it.
template <int Dim>
Mat<Dim> stress_at(const Particles<Dim>& particles, std::size_t p)
{
  const auto s = [&](std::size_t k) { return particles.stress[k][p]; };
  Mat<Dim> m;
  if constexpr (Dim == 2)
    m << s(0), s(2), s(2), s(1);
  else
    m << s(0), s(3), s(4), s(3), s(1), s(5), s(4), s(5), s(2);
  return m;
}

/// Everything random, positions between `lower` and `upper`.
template <int Dim>
Particles<Dim> random_cloud(Chance& chance, std::size_t count, const Vec<Dim>& lower, const Vec<Dim>& upper)
{
  Particles<Dim> particles;
  particles.resize(count);
  for (std::size_t p = 0; p < count; ++p) {
    for (int d = 0; d < Dim; ++d)
      particles.position[static_cast<std::size_t>(d)][p] = chance(lower[d], upper[d]);
    set_vector<Dim>(particles.velocity, p, chance.vector<Dim>(2.0));
    set_vector<Dim>(particles.force, p, chance.vector<Dim>(10.0));
    set_matrix<Dim>(particles.affine, p, chance.matrix<Dim>(5.0));
    for (Column& component : particles.stress)
      component[p] = chance(-1e3, 1e3);
    particles.mass[p] = chance(0.1, 2.0);
    particles.weight_mass[p] = chance(0.1, 2.0);
    particles.volume[p] = particles.initial_volume[p] = chance(1e-3, 2e-3);
  }
  return particles;
}

template <int Dim>
Particles<Dim> random_cloud(Chance& chance, std::size_t count, const Grid<Dim>& grid)
{
  return random_cloud<Dim>(chance, count, lower_of(grid), upper_of(grid));
}

// One thread is enough for most tests.

template <int Dim>
void open(const Window<Dim>& window, Grid<Dim>& grid)
{
  ThreadTeam alone(1);
  grid.open(window, alone);
}

template <int Dim>
MotionSums<Dim> apply_forces(Grid<Dim>& grid, double kick, double damping_per_s, const Discretisation& choice = {})
{
  ThreadTeam alone(1);
  return GridUpdate<Dim>().apply_forces(choice, grid, kick, damping_per_s, alone);
}

template <int Dim>
void body_to_grid(const Particles<Dim>& particles, const Strips& strips, const Vec<Dim>& gravity, Grid<Dim>& grid,
                  const Discretisation& choice = {}, const BodyTerms& terms = {})
{
  ThreadTeam alone(1);
  mpm::body_to_grid(choice, particles, strips, terms, gravity, grid, alone);
}

template <int Dim>
void sheet_to_grid(const Particles<Dim>& nodes, const Vec<Dim>& gravity, Grid<Dim>& grid,
                   const Discretisation& choice = {})
{
  mpm::sheet_to_grid(choice, nodes, Part::all, gravity, grid);
}

template <int Dim>
void grid_to_particles(const Grid<Dim>& grid, double dt, bool want_gradient, Particles<Dim>& particles,
                       std::size_t begin, std::size_t end)
{
  mpm::grid_to_particles({}, grid, dt, want_gradient ? Gather::all : Gather::motion, particles, begin, end);
}
template <int Dim>
void gather(const Discretisation& choice, const Grid<Dim>& grid, double dt, Gather what, Particles<Dim>& particles)
{
  mpm::grid_to_particles(choice, grid, dt, what, particles, 0, particles.size());
}

/// Sorts and scatters on a cleared grid: what a step does first.
template <int Dim>
void scatter_body(Particles<Dim>& particles, const Vec<Dim>& gravity, Grid<Dim>& grid,
                  const Discretisation& choice = {}, const BodyTerms& terms = {})
{
  Strips strips;
  Sorter<Dim> sorter;
  sorter.sort(grid, particles, strips);
  open(everything(grid), grid);
  body_to_grid(particles, strips, gravity, grid, choice, terms);
}

template <int Dim, class Visitor>
void for_each_node(const Grid<Dim>& grid, Visitor&& visit)
{
  for (int slowest = grid.window().begin[0]; slowest < grid.window().end[0]; ++slowest)
    grid.visit_rows(slowest, [&](std::size_t first, std::array<int, Dim> node, int length) {
      node[Dim - 1] = grid.window().begin[Dim - 1];
      for (int k = 0; k < length; ++k, ++node[Dim - 1])
        visit(first + static_cast<std::size_t>(k), node);
    });
}

template <int Dim>
Vec<Dim> node_vector(const Grid<Dim>& grid, std::size_t i)
{
  return grid.nodes()[i].matrix().template head<Dim>();
}
template <int Dim>
Vec<Dim> node_force(const Grid<Dim>& grid, std::size_t i)
{
  return grid.forces()[i].matrix().template head<Dim>();
}
template <int Dim>
double node_mass(const Grid<Dim>& grid, std::size_t i)
{
  return grid.nodes()[i][Grid<Dim>::mass_slot];
}

/// Calls `visit(storage index, weight, offset, gradient)` for the 3^Dim nodes around `x`, by the plain product formula.
template <int Dim, class Visitor>
void for_each_stencil_node(const Grid<Dim>& grid, const Vec<Dim>& x, Visitor&& visit)
{
  std::array<double, Dim> point;
  for (int d = 0; d < Dim; ++d)
    point[static_cast<std::size_t>(d)] = x[d];
  const Stencil<Dim> s = make_stencil<Dim>(point, grid.origin(), grid.dx(), grid.inverse_dx());
  const int nodes = Dim == 2 ? 9 : 27;
  for (int n = 0; n < nodes; ++n) {
    std::array<int, Dim> node;
    std::array<std::size_t, Dim> k;
    Vec<Dim> offset, gradient = Vec<Dim>::Ones();
    double weight = 1.0;
    for (int d = 0, rest = n; d < Dim; ++d, rest /= 3) {
      const auto e = static_cast<std::size_t>(d);
      k[e] = static_cast<std::size_t>(rest % 3);
      node[e] = s.base[e] + rest % 3;
      offset[d] = s.offset[e][k[e]];
      weight *= s.weight[e][k[e]];
    }
    for (int d = 0; d < Dim; ++d)
      for (std::size_t e = 0; e < Dim; ++e)
        gradient[d] *= static_cast<int>(e) == d ? s.gradient[e][k[e]] : s.weight[e][k[e]];
    visit(grid.index(node), weight, offset, gradient);
  }
}

template <int Dim>
Vec<Dim> interpolated(const Grid<Dim>& grid, const Vec<Dim>& x)
{
  Vec<Dim> value = Vec<Dim>::Zero();
  for_each_stencil_node<Dim>(
      grid, x, [&](std::size_t i, double w, const Vec<Dim>&, const Vec<Dim>&) { value += w * node_vector(grid, i); });
  return value;
}

/// Largest difference of entries.
template <class A, class B>
double apart(const Eigen::MatrixBase<A>& a, const Eigen::MatrixBase<B>& b)
{
  return (a - b).template lpNorm<Eigen::Infinity>();
}

}  // namespace geocontainer_mpm::mpm::testing
