#pragma once
/// Linear shape functions averaged over the box of a particle (GIMP: Bardenhagen and Kober 2004, CMES 5:477), so that
/// boxes that tile a body integrate its internal force exactly, wherever the grid lines are. With edges of a cell they
/// are the quadratic B-splines, and up to there they reach the same three nodes a direction.

#include <algorithm>

#include "geocontainer_mpm/mpm/bspline.h"

namespace geocontainer_mpm::mpm {

/// Boxes count as no wider than a cell, so that three nodes do: particles that are pulled further apart leave gaps
/// between their boxes. The lower bound only keeps differences of weights above round-off.
inline constexpr double widest_box_cells = 1.0, narrowest_box_cells = 0.01;

/// Stencil of a box with middle `x` and edges `box` (m); the rest as for make_stencil().
template <int Dim>
inline Stencil<Dim> make_box_stencil(const std::array<double, Dim>& x, const std::array<double, Dim>& box,
                                     const Vec<Dim>& lower, double dx, double inverse_dx)
{
  Stencil<Dim> s;
  for (int d = 0; d < Dim; ++d) {
    const double xi = (x[d] - lower[d]) * inverse_dx;
    const double base = std::floor(xi - 0.5);
    const double f = xi - base;
    const double edge = std::clamp(box[d] * inverse_dx, narrowest_box_cells, widest_box_cells);
    const double inverse_edge = 1.0 / edge;
    // What the ends of the box have of the outer nodes' hats: the integral of a hat over its flank is half its square.
    const double low = f - 0.5 * edge, high = f + 0.5 * edge;
    const double low_0 = std::max(0.0, 1.0 - low), high_0 = std::max(0.0, 1.0 - high);
    const double low_2 = std::max(0.0, low - 1.0), high_2 = std::max(0.0, high - 1.0);
    const double w_0 = 0.5 * inverse_edge * (low_0 * low_0 - high_0 * high_0);
    const double w_2 = 0.5 * inverse_edge * (high_2 * high_2 - low_2 * low_2);
    const double g_0 = inverse_edge * inverse_dx * (high_0 - low_0), g_2 = inverse_edge * inverse_dx * (high_2 - low_2);
    s.base[d] = static_cast<int>(base);
    s.weight[d] = { w_0, 1.0 - w_0 - w_2, w_2 };
    s.gradient[d] = { g_0, -g_0 - g_2, g_2 };
    s.offset[d] = { -f * dx, (1.0 - f) * dx, (2.0 - f) * dx };
  }
  return s;
}

/// Second moment of the weights about the box's middle in direction d, m^2: the off-diagonal ones are 0. Above 0 for
/// any box, unlike that of a point on a linear node, so that the affine transfer is defined.
template <int Dim>
inline double box_inertia(const Stencil<Dim>& s, std::size_t d)
{
  double sum = 0.0;
  for (std::size_t k = 0; k < 3; ++k)
    sum += s.weight[d][k] * s.offset[d][k] * s.offset[d][k];
  return sum;
}

}  // namespace geocontainer_mpm::mpm
