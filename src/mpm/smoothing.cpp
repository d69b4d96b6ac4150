/// Averages over elements: the stress that makes the forces, and the velocity gradient that the law sees.

#include "elements.h"

namespace geocontainer_mpm::mpm {
namespace {

/// An element filled to this part of its volume counts as full (Beuth, Wieckowski and Vermeer 2011, who take 0.9). In a
/// compressed body elements hold one row of particles less than their neighbours, and are full all the same: with
/// three rows a cell 0.9 would leave them to their particles, which settles an oedometer by tens of per cent too much.
constexpr double full = 0.5;

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

/// Sums over the particles of every element: `sums[0]` of volume, `sums[1 + k]` of volume times component k of
/// `value(p)`.
template <int Dim, Shape shape, class Value>
double* sum_over_elements(const Particles<Dim>& particles, const Strips& strips, Grid<Dim>& grid, ThreadTeam& team,
                          Value&& value)
{
  double* elements = empty_elements<Dim, shape>(grid, team);
  for_each_in_strips(strips, team, [&](std::size_t p) {
    double* element = elements + element_stride<Dim> * element_of<Dim, shape>(position_of(particles, p), grid);
    const double volume = particles.volume[p];
    element[0] += volume;
    const auto values = value(p);
    for (std::size_t k = 0; k < values.size(); ++k)
      element[1 + k] += volume * values[k];
  });
  return elements;
}

/// Calls `visit(element, cell, rank)` for the elements that hold particles.
template <int Dim, Shape shape, class Visitor>
void for_each_filled(double* elements, Grid<Dim>& grid, ThreadTeam& team, Visitor&& visit)
{
  constexpr std::size_t per_cell = elements_per_cell<Dim, shape>;
  for_each_cell(grid, team, [&](std::size_t cell, const std::array<int, Dim>& at) {
    for (std::size_t rank = 0; rank < per_cell; ++rank) {
      double* element = elements + element_stride<Dim> * (per_cell * cell + rank);
      if (element[0] > 0.0)
        visit(element, at, rank);
    }
  });
}

/// The mean, over the nodes of an element, of the means of `value(p)` over the elements around a node, as `[1]` of the
/// element. Both means are weighted with the volume of particles, so that sum V a smooth(b) = sum V b smooth(a): what
/// is strained by smooth rates is in balance with forces of smooth stresses.
template <int Dim, Shape shape, class Value>
const double* smooth_over_nodes(const Particles<Dim>& particles, const Strips& strips, Grid<Dim>& grid,
                                ThreadTeam& team, Value&& value)
{
  double* elements = sum_over_elements<Dim, shape>(particles, strips, grid, team,
                                                   [&](std::size_t p) { return std::array<double, 1>{ value(p) }; });
  double* nodes = grid.node_scratch(2);
  team.for_each(grid.blocks_of_rows(grid.window()), [&](int block) {
    grid.visit_block(block, [&](int slowest) {
      grid.visit_rows(slowest, [&](std::size_t first, const std::array<int, Dim>&, int length) {
        std::fill_n(nodes + 2 * first, 2 * static_cast<std::size_t>(length), 0.0);
      });
    });
  });
  for_each_filled<Dim, shape>(elements, grid, team,
                              [&](const double* element, const std::array<int, Dim>& cell, std::size_t rank) {
                                for (std::size_t node : nodes_of<Dim, shape>(cell, rank, grid)) {
                                  nodes[2 * node] += element[0];
                                  nodes[2 * node + 1] += element[1];
                                }
                              });
  for_each_filled<Dim, shape>(elements, grid, team,
                              [&](double* element, const std::array<int, Dim>& cell, std::size_t rank) {
                                const auto corners = nodes_of<Dim, shape>(cell, rank, grid);
                                double sum = 0.0;
                                for (std::size_t node : corners)
                                  sum += nodes[2 * node + 1] / nodes[2 * node];
                                element[1] = sum / static_cast<double>(corners.size());
                              });
  return elements;
}

template <int Dim, Shape shape>
void smooth_volume_rate(const Strips& strips, Particles<Dim>& particles, Grid<Dim>& grid, ThreadTeam& team)
{
  const auto rate_of = [&](std::size_t p) {
    double rate = 0.0;
    for (std::size_t d = 0; d < Dim; ++d)
      rate += particles.gradient[d * Dim + d][p];
    return rate;
  };
  const double* elements = smooth_over_nodes<Dim, shape>(particles, strips, grid, team, rate_of);
  for_each_in_strips(strips, team, [&](std::size_t p) {
    const double smooth = elements[element_stride<Dim> * element_of<Dim, shape>(position_of(particles, p), grid) + 1];
    const double change = (smooth - rate_of(p)) / Dim;
    for (std::size_t d = 0; d < Dim; ++d)
      particles.gradient[d * Dim + d][p] += change;
  });
}

/// The mean gradient of a cell for its particles, row by row: an element has room for one.
template <int Dim>
void average_gradient(const Strips& strips, Particles<Dim>& particles, Grid<Dim>& grid, ThreadTeam& team)
{
  for (std::size_t row = 0; row < Dim; ++row) {
    const auto row_of = [&](std::size_t p) {
      std::array<double, Dim> values;
      for (std::size_t d = 0; d < Dim; ++d)
        values[d] = particles.gradient[row * Dim + d][p];
      return values;
    };
    const double* elements = sum_over_elements<Dim, Shape::bspline2>(particles, strips, grid, team, row_of);
    for_each_in_strips(strips, team, [&](std::size_t p) {
      const double* element =
          elements + element_stride<Dim> * element_of<Dim, Shape::bspline2>(position_of(particles, p), grid);
      for (std::size_t d = 0; d < Dim; ++d)
        particles.gradient[row * Dim + d][p] = element[1 + d] / element[0];
    });
  }
}

}  // namespace

template <int Dim, Shape shape>
const double* smooth_stress(Smoothing smoothing, const Particles<Dim>& particles, const Strips& strips,
                            const StressDamping& damping, Grid<Dim>& grid, ThreadTeam& team)
{
  const auto stress_of = [&](std::size_t p) { return damped_stress<Dim>(particles, p, damping); };
  if (smoothing == Smoothing::nodal_mixed)
    return smooth_over_nodes<Dim, shape>(particles, strips, grid, team,
                                         [&](std::size_t p) { return isotropic_part<Dim>(stress_of(p)); });
  double* elements = sum_over_elements<Dim, shape>(particles, strips, grid, team, stress_of);
  const double own_volume = std::pow(grid.dx(), Dim) / static_cast<double>(elements_per_cell<Dim, shape>);
  for_each_filled<Dim, shape>(elements, grid, team, [&](double* element, const std::array<int, Dim>&, std::size_t) {
    const double volume = element[0];
    const bool own = shape == Shape::linear_simplex && volume >= full * own_volume;
    const double factor = (own ? own_volume / volume : 1.0) / volume;
    for (std::size_t k = 1; k < element_stride<Dim>; ++k)
      element[k] *= factor;
  });
  return elements;
}

template <int Dim>
void smooth_gradients(const Discretisation& method, const Strips& strips, Particles<Dim>& particles, Grid<Dim>& grid,
                      ThreadTeam& team)
{
  if (!smooths_gradients(method))
    return;
  if (method.smoothing == Smoothing::cell_average)
    average_gradient(strips, particles, grid, team);
  else if (method.shape != Shape::linear_simplex)
    smooth_volume_rate<Dim, Shape::bspline2>(strips, particles, grid, team);
  else
    smooth_volume_rate<Dim, Shape::linear_simplex>(strips, particles, grid, team);
}

template const double* smooth_stress<2, Shape::bspline2>(Smoothing, const Particles<2>&, const Strips&,
                                                         const StressDamping&, Grid<2>&, ThreadTeam&);
template const double* smooth_stress<3, Shape::bspline2>(Smoothing, const Particles<3>&, const Strips&,
                                                         const StressDamping&, Grid<3>&, ThreadTeam&);
template const double* smooth_stress<2, Shape::linear_simplex>(Smoothing, const Particles<2>&, const Strips&,
                                                               const StressDamping&, Grid<2>&, ThreadTeam&);
template const double* smooth_stress<3, Shape::linear_simplex>(Smoothing, const Particles<3>&, const Strips&,
                                                               const StressDamping&, Grid<3>&, ThreadTeam&);
template void smooth_gradients(const Discretisation&, const Strips&, Particles<2>&, Grid<2>&, ThreadTeam&);
template void smooth_gradients(const Discretisation&, const Strips&, Particles<3>&, Grid<3>&, ThreadTeam&);

}  // namespace geocontainer_mpm::mpm
