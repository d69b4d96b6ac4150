#pragma once
/// Quadratic B-spline shape functions on a regular grid (Steffen, Kirby and Berzins 2008, IJNME 76:922): C1, partition
/// of unity, linear reproduction, three nodes a direction.

#include <array>
#include <cmath>

#include "geocontainer_mpm/mpm/types.h"

namespace geocontainer_mpm::mpm {

/// The 3^Dim nodes around a point: node (base + k) in direction d has the factor weight[d][k].
template <int Dim>
struct Stencil {
  std::array<int, Dim> base;                        ///< lowest node index in each direction
  std::array<std::array<double, 3>, Dim> weight;    ///< one-dimensional weights, sum 1
  std::array<std::array<double, 3>, Dim> gradient;  ///< their derivatives, 1/m, sum 0
  std::array<std::array<double, 3>, Dim> offset;    ///< node coordinate minus point coordinate, m
};

/// Stencil of the point `x` (m) for nodes at `lower + i * dx`. The caller knows that the nodes exist.
template <int Dim>
inline Stencil<Dim> make_stencil(const std::array<double, Dim>& x, const Vec<Dim>& lower, double dx, double inverse_dx)
{
  Stencil<Dim> s;
  for (int d = 0; d < Dim; ++d) {
    const double xi = (x[d] - lower[d]) * inverse_dx;
    const double base = std::floor(xi - 0.5);
    const double f = xi - base;  // in [0.5, 1.5): distance to the lowest node in cells
    s.base[d] = static_cast<int>(base);
    s.weight[d] = { 0.5 * (1.5 - f) * (1.5 - f), 0.75 - (f - 1.0) * (f - 1.0), 0.5 * (f - 0.5) * (f - 0.5) };
    s.gradient[d] = { (f - 1.5) * inverse_dx, -2.0 * (f - 1.0) * inverse_dx, (f - 0.5) * inverse_dx };
    s.offset[d] = { -f * dx, (1.0 - f) * dx, (2.0 - f) * dx };
  }
  return s;
}

/// Second moment of the weights about the point: sum_i w_i r_i r_i^T = (dx^2 / 4) I for every position, which is what
/// makes the affine transfer's inertia a constant (Jiang et al. 2015, APIC).
inline double bspline_inertia(double dx)
{
  return 0.25 * dx * dx;
}

}  // namespace geocontainer_mpm::mpm
