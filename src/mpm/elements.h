#pragma once
/// Elements of the grid, for what is averaged over them: the linear simplices, or the cells for B-splines. Their
/// numbers lie in Grid::element_scratch(), elements of a cell side by side, cells by the index of their lowest node.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "geocontainer_mpm/mpm/reach.h"
#include "geocontainer_mpm/mpm/transfer.h"

namespace geocontainer_mpm::mpm {

template <int Dim, Shape shape>
inline constexpr std::size_t elements_per_cell = shape == Shape::bspline2 ? 1
                                                 : Dim == 2               ? 2
                                                                          : 6;
template <int Dim, Shape shape>
inline constexpr std::size_t nodes_per_element = shape == Shape::linear_simplex ? Dim + 1
                                                 : Dim == 2                     ? 4
                                                                                : 8;
/// Stress components that act within the space of the grid: the first of the order in material/law.h.
template <int Dim>
inline constexpr std::size_t in_plane = Dim == 2 ? 3 : 6;
/// Numbers kept of an element: volume of its particles, and sums of at most as many values as a stress has.
template <int Dim>
inline constexpr std::size_t element_stride = 1 + in_plane<Dim>;

template <int Dim>
Vec<Dim> position_of(const Particles<Dim>& particles, std::size_t p)
{
  Vec<Dim> x;
  for (int d = 0; d < Dim; ++d)
    x[d] = particles.position[static_cast<std::size_t>(d)][p];
  return x;
}

/// Which element of its cell: the rank of the order among all orders.
template <int Dim>
std::size_t rank_of(const std::array<std::size_t, Dim>& order)
{
  if constexpr (Dim == 2)
    return order[0];
  else
    return 2 * order[0] + (order[1] > order[2] ? 1 : 0);
}

template <int Dim, Shape shape>
std::size_t element_of(const Vec<Dim>& x, const Grid<Dim>& grid)
{
  if constexpr (shape == Shape::bspline2) {
    std::array<int, Dim> cell;
    for (int d = 0; d < Dim; ++d)
      cell[static_cast<std::size_t>(d)] = static_cast<int>(std::floor((x[d] - grid.origin()[d]) * grid.inverse_dx()));
    return grid.index(cell);
  } else {
    const Simplex<Dim> s = simplex_around<Dim>(x, grid);
    return elements_per_cell<Dim, shape> * grid.index(s.cell) + rank_of<Dim>(s.order);
  }
}

/// Storage indices of the nodes of element `rank` of a cell.
template <int Dim, Shape shape>
std::array<std::size_t, nodes_per_element<Dim, shape>> nodes_of(const std::array<int, Dim>& cell, std::size_t rank,
                                                                const Grid<Dim>& grid)
{
  std::array<std::size_t, nodes_per_element<Dim, shape>> nodes;
  if constexpr (shape == Shape::bspline2) {
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      std::array<int, Dim> node = cell;
      for (std::size_t d = 0; d < Dim; ++d)
        node[d] += static_cast<int>(k >> d) & 1;
      nodes[k] = grid.index(node);
    }
  } else {
    std::array<int, Dim> node, step;
    for (std::size_t d = 0; d < Dim; ++d) {
      const bool mirrored = (cell[d] & 1) != 0;
      node[d] = mirrored ? cell[d] + 1 : cell[d];
      step[d] = mirrored ? -1 : 1;
    }
    std::array<std::size_t, Dim> order;
    if constexpr (Dim == 2) {
      order = { rank, 1 - rank };
    } else {
      const std::size_t first = rank / 2, low = first == 0 ? 1 : 0, high = 3 - first - low;
      order = { first, rank % 2 == 0 ? low : high, rank % 2 == 0 ? high : low };
    }
    nodes[0] = grid.index(node);
    for (std::size_t k = 0; k < Dim; ++k) {
      node[order[k]] += step[order[k]];
      nodes[k + 1] = grid.index(node);
    }
  }
  return nodes;
}

/// Calls `visit(storage index of the cell, cell)` for all cells of the window with slowest index `slowest`.
template <int Dim, class Visitor>
void visit_cells(const Grid<Dim>& grid, int slowest, Visitor&& visit)
{
  if (slowest >= grid.window().end[0] - 1)
    return;
  grid.visit_rows(slowest, [&](std::size_t first, std::array<int, Dim> cell, int length) {
    if (Dim == 3 && cell[1] >= grid.window().end[1] - 1)
      return;
    cell[Dim - 1] = grid.window().begin[Dim - 1];
    for (int k = 0; k < length - 1; ++k, ++cell[Dim - 1])
      visit(first + static_cast<std::size_t>(k), cell);
  });
}

/// The particle's stress and the viscous one of its velocity gradient.
template <int Dim>
std::array<double, in_plane<Dim>> damped_stress(const Particles<Dim>& particles, std::size_t p,
                                                const StressDamping& damping)
{
  std::array<double, in_plane<Dim>> s;
  for (std::size_t k = 0; k < s.size(); ++k)
    s[k] = particles.stress[k][p];
  const auto l = [&](std::size_t i, std::size_t j) { return particles.gradient[i * Dim + j][p]; };
  double trace = 0.0;
  for (std::size_t i = 0; i < Dim; ++i)
    trace += l(i, i);
  for (std::size_t i = 0; i < Dim; ++i)
    s[i] += damping.lambda * trace + 2.0 * damping.shear * l(i, i);
  const auto shear = [&](std::size_t i, std::size_t j) { return damping.shear * (l(i, j) + l(j, i)); };
  if constexpr (Dim == 2) {
    s[2] += shear(0, 1);
  } else {
    s[3] += shear(0, 1);
    s[4] += shear(0, 2);
    s[5] += shear(1, 2);
  }
  return s;
}

/// Mean of the normal stresses within the space of the grid.
template <int Dim>
double isotropic_part(const std::array<double, in_plane<Dim>>& stress)
{
  double sum = 0.0;
  for (std::size_t i = 0; i < Dim; ++i)
    sum += stress[i];
  return sum / Dim;
}

/// What stands for the particle's stress after smooth_stress() of this kind.
template <int Dim, Shape shape>
std::array<double, in_plane<Dim>> smoothed_stress(Smoothing smoothing, const Particles<Dim>& particles, std::size_t p,
                                                  const StressDamping& damping, const double* elements,
                                                  const Grid<Dim>& grid)
{
  const double* element = elements + element_stride<Dim> * element_of<Dim, shape>(position_of(particles, p), grid);
  std::array<double, in_plane<Dim>> s;
  if (smoothing == Smoothing::cell_average) {
    std::copy_n(element + 1, s.size(), s.begin());
  } else {
    s = damped_stress<Dim>(particles, p, damping);
    const double change = element[1] - isotropic_part<Dim>(s);
    for (std::size_t i = 0; i < Dim; ++i)
      s[i] += change;
  }
  return s;
}

/// Calls `work(p)` for all particles, strips of one colour at once: for sums into nodes or elements.
template <class Work>
void for_each_in_strips(const Strips& strips, ThreadTeam& team, Work&& work)
{
  const int count = static_cast<int>(strips.count());
  for (int color = 0; color < 2; ++color)
    team.for_each((count - color + 1) / 2, [&](int i) {
      const auto s = static_cast<std::size_t>(2 * i + color);
      for (std::size_t p = strips.begin[s]; p < strips.begin[s + 1]; ++p)
        work(p);
    });
}

/// By element, what the forces are made of in place of the stress of particles, viscous part included: see
/// body_to_grid().
template <int Dim, Shape shape>
const double* smooth_stress(Smoothing smoothing, const Particles<Dim>& particles, const Strips& strips,
                            const StressDamping& damping, Grid<Dim>& grid, ThreadTeam& team);

}  // namespace geocontainer_mpm::mpm
