/// Averages over elements: the stress that makes the forces, and the rate of volume that the law sees.

#include "elements.h"

namespace geocontainer_mpm::mpm {
namespace {

/// An element filled to this part of its volume counts as full (Beuth, Wieckowski and Vermeer 2011).
constexpr double full = 0.9;

/// Rows of cells in blocks, all even blocks before all odd ones: cells of a block write nodes of the next block's first
/// row, so blocks of one colour never write the same node and the order of sums is that of the rows.
template <int Dim, class Visitor>
void for_each_cell(const Grid<Dim>& grid, ThreadTeam& team, Visitor&& visit)
{
  const int blocks = Grid<Dim>::blocks_of_rows(grid.window());
  for (int color = 0; color < 2; ++color)
    team.for_each((blocks - color + 1) / 2, [&](int i) {
      grid.visit_block(2 * i + color, [&](int slowest) { visit_cells<Dim>(grid, slowest, visit); });
    });
}

/// Empties the elements of the window.
template <int Dim, Shape shape>
double* empty_elements(Grid<Dim>& grid, ThreadTeam& team)
{
  constexpr std::size_t per_cell = elements_per_cell<Dim, shape> * element_stride<Dim>;
  double* elements = grid.element_scratch(per_cell);
  for_each_cell(grid, team, [&](std::size_t cell, const std::array<int, Dim>&) {
    std::fill_n(elements + per_cell * cell, per_cell, 0.0);
  });
  return elements;
}

template <int Dim, Shape shape>
void smooth(const Strips& strips, Particles<Dim>& particles, Grid<Dim>& grid, ThreadTeam& team)
{
  constexpr std::size_t stride = element_stride<Dim>, per_cell = elements_per_cell<Dim, shape>;
  double* elements = empty_elements<Dim, shape>(grid, team);
  const auto element_at = [&](std::size_t p) {
    return elements + stride * element_of<Dim, shape>(position_of(particles, p), grid);
  };
  const auto rate_of = [&](std::size_t p) {
    double rate = 0.0;
    for (std::size_t d = 0; d < Dim; ++d)
      rate += particles.gradient[d * Dim + d][p];
    return rate;
  };
  for_each_in_strips(strips, team, [&](std::size_t p) {
    double* element = element_at(p);
    element[0] += particles.volume[p];
    element[1] += particles.volume[p] * rate_of(p);
  });

  double* nodes = grid.node_scratch(2);
  team.for_each(grid.blocks_of_rows(grid.window()), [&](int block) {
    grid.visit_block(block, [&](int slowest) {
      grid.visit_rows(slowest, [&](std::size_t first, const std::array<int, Dim>&, int length) {
        std::fill_n(nodes + 2 * first, 2 * static_cast<std::size_t>(length), 0.0);
      });
    });
  });
  const auto for_each_filled = [&](auto&& visit) {
    for_each_cell(grid, team, [&](std::size_t cell, const std::array<int, Dim>& at) {
      for (std::size_t rank = 0; rank < per_cell; ++rank) {
        double* element = elements + stride * (per_cell * cell + rank);
        if (element[0] > 0.0)
          visit(element, nodes_of<Dim, shape>(at, rank, grid));
      }
    });
  };
  for_each_filled([&](const double* element, const auto& corners) {
    for (std::size_t node : corners) {
      nodes[2 * node] += element[0];
      nodes[2 * node + 1] += element[1];
    }
  });
  for_each_filled([&](double* element, const auto& corners) {
    double sum = 0.0;
    for (std::size_t node : corners)
      sum += nodes[2 * node + 1] / nodes[2 * node];
    element[1] = sum / static_cast<double>(corners.size());
  });
  for_each_in_strips(strips, team, [&](std::size_t p) {
    const double change = (element_at(p)[1] - rate_of(p)) / Dim;
    for (std::size_t d = 0; d < Dim; ++d)
      particles.gradient[d * Dim + d][p] += change;
  });
}

}  // namespace

template <int Dim, Shape shape>
const double* average_stress(const Particles<Dim>& particles, const Strips& strips, const StressDamping& damping,
                             Grid<Dim>& grid, ThreadTeam& team)
{
  constexpr std::size_t stride = element_stride<Dim>, per_cell = elements_per_cell<Dim, shape>;
  double* elements = empty_elements<Dim, shape>(grid, team);
  for_each_in_strips(strips, team, [&](std::size_t p) {
    double* element = elements + stride * element_of<Dim, shape>(position_of(particles, p), grid);
    const double volume = particles.volume[p];
    const std::array<double, in_plane<Dim>> stress = damped_stress<Dim>(particles, p, damping);
    element[0] += volume;
    for (std::size_t k = 0; k < stress.size(); ++k)
      element[1 + k] += volume * stress[k];
  });
  const double own_volume = std::pow(grid.dx(), Dim) / static_cast<double>(per_cell);
  for_each_cell(grid, team, [&](std::size_t cell, const std::array<int, Dim>&) {
    for (std::size_t rank = 0; rank < per_cell; ++rank) {
      double* element = elements + stride * (per_cell * cell + rank);
      const double volume = element[0];
      if (!(volume > 0.0))
        continue;
      const bool own = shape == Shape::linear_simplex && volume >= full * own_volume;
      const double factor = (own ? own_volume / volume : 1.0) / volume;
      for (std::size_t k = 1; k < stride; ++k)
        element[k] *= factor;
    }
  });
  return elements;
}

template <int Dim>
void smooth_volume_rate(Shape shape, const Strips& strips, Particles<Dim>& particles, Grid<Dim>& grid, ThreadTeam& team)
{
  if (shape == Shape::bspline2)
    smooth<Dim, Shape::bspline2>(strips, particles, grid, team);
  else
    smooth<Dim, Shape::linear_simplex>(strips, particles, grid, team);
}

template const double* average_stress<2, Shape::bspline2>(const Particles<2>&, const Strips&, const StressDamping&,
                                                          Grid<2>&, ThreadTeam&);
template const double* average_stress<3, Shape::bspline2>(const Particles<3>&, const Strips&, const StressDamping&,
                                                          Grid<3>&, ThreadTeam&);
template const double* average_stress<2, Shape::linear_simplex>(const Particles<2>&, const Strips&,
                                                                const StressDamping&, Grid<2>&, ThreadTeam&);
template const double* average_stress<3, Shape::linear_simplex>(const Particles<3>&, const Strips&,
                                                                const StressDamping&, Grid<3>&, ThreadTeam&);
template void smooth_volume_rate(Shape, const Strips&, Particles<2>&, Grid<2>&, ThreadTeam&);
template void smooth_volume_rate(Shape, const Strips&, Particles<3>&, Grid<3>&, ThreadTeam&);

}  // namespace geocontainer_mpm::mpm
