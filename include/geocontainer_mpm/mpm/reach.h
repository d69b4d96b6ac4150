#pragma once
/// The grid nodes that a point reaches, with weights and gradients, for every shape. The transfers of bspline2 and
/// gimp have their own separable loops; everything that looks at few points, and the linear simplices, use these lists.

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "geocontainer_mpm/mpm/bspline.h"
#include "geocontainer_mpm/mpm/discretisation.h"
#include "geocontainer_mpm/mpm/gimp.h"
#include "geocontainer_mpm/mpm/grid.h"
#include "geocontainer_mpm/mpm/particles.h"

namespace geocontainer_mpm::mpm {

template <int Dim, int Most>
struct Reach {
  std::array<std::uint32_t, Most> node;  ///< storage index
  std::array<double, Most> weight;       ///< sum 1
  std::array<Vec<Dim>, Most> gradient;   ///< 1/m, sum 0
  int count;
};

template <int Dim>
inline constexpr int most_nodes = Dim == 2 ? 9 : 27;
template <int Dim>
using AnyReach = Reach<Dim, most_nodes<Dim>>;

/// The 3^Dim nodes of a stencil, fastest index last.
template <int Dim>
inline Reach<Dim, most_nodes<Dim>> reach_of(const Stencil<Dim>& s, const Grid<Dim>& grid)
{
  Reach<Dim, most_nodes<Dim>> reach;
  reach.count = most_nodes<Dim>;
  for (int k = 0; k < reach.count; ++k) {
    std::array<int, Dim> node;
    std::array<std::size_t, Dim> at;
    for (int d = Dim - 1, rest = k; d >= 0; --d, rest /= 3) {
      const auto slot = static_cast<std::size_t>(d);
      at[slot] = static_cast<std::size_t>(rest % 3);
      node[slot] = s.base[slot] + rest % 3;
    }
    const auto slot = static_cast<std::size_t>(k);
    reach.node[slot] = static_cast<std::uint32_t>(grid.index(node));
    reach.weight[slot] = 1.0;
    reach.gradient[slot].setOnes();
    for (std::size_t d = 0; d < Dim; ++d) {
      reach.weight[slot] *= s.weight[d][at[d]];
      for (std::size_t g = 0; g < Dim; ++g)
        reach.gradient[slot][static_cast<Eigen::Index>(g)] *= g == d ? s.gradient[d][at[d]] : s.weight[d][at[d]];
    }
  }
  return reach;
}

/// The 3^Dim nodes of quadratic B-splines at a point.
template <int Dim>
inline Reach<Dim, most_nodes<Dim>> bspline_reach(const Vec<Dim>& point, const Grid<Dim>& grid)
{
  std::array<double, Dim> x;
  for (int d = 0; d < Dim; ++d)
    x[static_cast<std::size_t>(d)] = point[d];
  return reach_of<Dim>(make_stencil<Dim>(x, grid.origin(), grid.dx(), grid.inverse_dx()), grid);
}

/// Stencil of row p; with gimp it has a box.
template <int Dim, Shape shape>
[[gnu::always_inline]] inline Stencil<Dim> stencil_of(const Particles<Dim>& particles, std::size_t p,
                                                      const Grid<Dim>& grid)
{
  static_assert(shape != Shape::linear_simplex);
  std::array<double, Dim> x;
  for (std::size_t d = 0; d < Dim; ++d)
    x[d] = particles.position[d][p];
  if constexpr (shape == Shape::bspline2) {
    return make_stencil<Dim>(x, grid.origin(), grid.dx(), grid.inverse_dx());
  } else {
    std::array<double, Dim> box;
    for (std::size_t d = 0; d < Dim; ++d)
      box[d] = particles.box[d][p];
    return make_box_stencil<Dim>(x, box, grid.origin(), grid.dx(), grid.inverse_dx());
  }
}

/// The linear simplex around a point. Every cell is cut along the order of a point's fractional coordinates
/// (Freudenthal 1942; Kuhn 1960): triangles 2, tetrahedra 6 a cell. Cells of odd index are mirrored, so that
/// neighbouring diagonals form a union jack and no direction is preferred. From node `start` its nodes follow one
/// another by `step` along order[0], order[1], ...
template <int Dim>
struct Simplex {
  std::array<int, Dim> cell;           ///< lowest node of the cell
  std::array<int, Dim> start, step;    ///< step: 1, or -1 where mirrored
  std::array<double, Dim> fraction;    ///< distance from `start` along the step, in cells, [0, 1]
  std::array<std::size_t, Dim> order;  ///< largest fraction first
};

template <int Dim>
inline Simplex<Dim> simplex_around(const Vec<Dim>& point, const Grid<Dim>& grid)
{
  Simplex<Dim> s;
  for (std::size_t d = 0; d < Dim; ++d) {
    const auto c = static_cast<Eigen::Index>(d);
    const double xi = (point[c] - grid.origin()[c]) * grid.inverse_dx();
    const double cell = std::floor(xi);
    s.cell[d] = static_cast<int>(cell);
    const bool mirrored = (s.cell[d] & 1) != 0;
    s.fraction[d] = mirrored ? 1.0 - (xi - cell) : xi - cell;
    s.start[d] = mirrored ? s.cell[d] + 1 : s.cell[d];
    s.step[d] = mirrored ? -1 : 1;
    s.order[d] = d;
  }
  for (std::size_t i = 1; i < Dim; ++i)  // insertion sort, stable
    for (std::size_t k = i; k > 0 && s.fraction[s.order[k]] > s.fraction[s.order[k - 1]]; --k)
      std::swap(s.order[k], s.order[k - 1]);
  return s;
}

/// The Dim + 1 nodes of the linear simplex around a point.
template <int Dim>
inline Reach<Dim, Dim + 1> simplex_reach(const Vec<Dim>& point, const Grid<Dim>& grid)
{
  const Simplex<Dim> s = simplex_around<Dim>(point, grid);
  std::array<int, Dim> node = s.start;
  Reach<Dim, Dim + 1> reach;
  reach.count = Dim + 1;
  for (std::size_t k = 0; k <= Dim; ++k) {
    if (k > 0)
      node[s.order[k - 1]] += s.step[s.order[k - 1]];
    const double high = k == 0 ? 1.0 : s.fraction[s.order[k - 1]], low = k == Dim ? 0.0 : s.fraction[s.order[k]];
    reach.node[k] = static_cast<std::uint32_t>(grid.index(node));
    reach.weight[k] = high - low;
    reach.gradient[k].setZero();
    if (k > 0)
      reach.gradient[k][static_cast<Eigen::Index>(s.order[k - 1])] += s.step[s.order[k - 1]] * grid.inverse_dx();
    if (k < Dim)
      reach.gradient[k][static_cast<Eigen::Index>(s.order[k])] -= s.step[s.order[k]] * grid.inverse_dx();
  }
  return reach;
}

/// The shape of a set: without boxes it is one of points.
template <int Dim>
inline Shape shape_of(Shape shape, const Particles<Dim>& particles)
{
  return particles.box[0].empty() ? shape_of_points(shape) : shape;
}

/// Calls `visit(reach)` with the nodes of row p, as many as its shape has.
template <int Dim, class Visitor>
inline void visit_reach_of(Shape shape, const Particles<Dim>& particles, std::size_t p, const Grid<Dim>& grid,
                           Visitor&& visit)
{
  if (shape == Shape::linear_simplex) {
    Vec<Dim> x;
    for (std::size_t d = 0; d < Dim; ++d)
      x[static_cast<Eigen::Index>(d)] = particles.position[d][p];
    visit(simplex_reach<Dim>(x, grid));
  } else if (shape_of(shape, particles) == Shape::gimp) {
    visit(reach_of<Dim>(stencil_of<Dim, Shape::gimp>(particles, p, grid), grid));
  } else {
    visit(reach_of<Dim>(stencil_of<Dim, Shape::bspline2>(particles, p, grid), grid));
  }
}

/// For a shape known at run time only; a point has no box.
template <int Dim>
inline AnyReach<Dim> reach_of(Shape shape, const Vec<Dim>& point, const Grid<Dim>& grid)
{
  if (shape != Shape::linear_simplex)
    return bspline_reach<Dim>(point, grid);
  const Reach<Dim, Dim + 1> few = simplex_reach<Dim>(point, grid);
  AnyReach<Dim> reach;
  reach.gradient.fill(Vec<Dim>::Zero());
  reach.count = few.count;
  for (std::size_t k = 0; k < most_nodes<Dim>; ++k) {
    const bool there = k <= Dim;
    reach.node[k] = few.node[there ? k : 0];
    reach.weight[k] = there ? few.weight[k] : 0.0;
    reach.gradient[k] = few.gradient[there ? k : 0] * (there ? 1.0 : 0.0);
  }
  return reach;
}

/// The same for a particle with its box, its middle moved by `shift`, m.
template <int Dim>
inline AnyReach<Dim> reach_of(Shape shape, const Particles<Dim>& particles, std::size_t p, const Vec<Dim>& shift,
                              const Grid<Dim>& grid)
{
  std::array<double, Dim> x, box;
  Vec<Dim> point;
  for (std::size_t d = 0; d < Dim; ++d)
    point[static_cast<Eigen::Index>(d)] = x[d] = particles.position[d][p] + shift[static_cast<Eigen::Index>(d)];
  if (shape_of(shape, particles) != Shape::gimp)
    return reach_of<Dim>(shape, point, grid);
  for (std::size_t d = 0; d < Dim; ++d)
    box[d] = particles.box[d][p];
  return reach_of<Dim>(make_box_stencil<Dim>(x, box, grid.origin(), grid.dx(), grid.inverse_dx()), grid);
}

}  // namespace geocontainer_mpm::mpm
