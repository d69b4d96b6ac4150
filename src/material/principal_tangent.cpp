#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <tuple>
#include <type_traits>

#include "principal_return.h"

namespace geocontainer_mpm::material {
namespace {

// The largest d . Q . d over |d0| + |d1| + |d2| <= 1, an octahedron: at a vertex, or at the one stationary point of an
// edge or a face, where that lies within it. The form is even: half of the vertices, edges and faces will do.
template <int N>
double stationary_value(const Eigen::Matrix3d& form, const Eigen::Matrix<double, 3, N>& corners)
{
  using Vector = Eigen::Matrix<double, N, 1>;
  const Eigen::Matrix<double, N, N> reduced = corners.transpose() * form * corners;
  const Vector direction = reduced.inverse() * Vector::Ones();
  const Vector weights = direction / direction.sum();
  // Not finite or outside: nothing stationary here. The value at any point within is attained, so never too large.
  return (weights.array() >= 0.0).all() ? weights.dot(reduced * weights) : 0.0;
}

double largest_on_octahedron(const Eigen::Matrix3d& form)
{
  double largest = std::max(0.0, form.diagonal().maxCoeff());
  for (const double s1 : { -1.0, 1.0 })
    for (const double s2 : { -1.0, 1.0 }) {
      const Eigen::Matrix3d corners = Eigen::Vector3d(1.0, s1, s2).asDiagonal();
      largest = std::max(largest, stationary_value<3>(form, corners));
      for (int left_out = 0; left_out < 3; ++left_out) {
        Eigen::Matrix<double, 3, 2> edge;
        edge << corners.col((left_out + 1) % 3), corners.col((left_out + 2) % 3);
        largest = std::max(largest, stationary_value<2>(form, edge));
      }
    }
  return largest;
}

}  // namespace

// For a motion along a of a wave along n the strain is sym(a n^T). Elastic: G + (lambda + G) (a . n)^2. Where shear
// planes are active their flow takes off (a n : C : g) (C_fg)^-1 (f : C : a n), which depends on d_i = a_i n_i alone,
// and |d0| + |d1| + |d2| <= 1. With a flow rule that is not associated this can be negative: extension along the
// smallest principal stress at psi < phi answers stiffer than elastic. The cut-off flows along its own gradient, and
// where it meets shear planes all flows together span what all gradients do: that only softens. So does the rotation of
// the principal axes.
double PrincipalReturn::constrained_tangent() const
{
  const auto stress = [this](const Eigen::Vector3d& strain) -> Eigen::Vector3d {
    const Flow s = flow(strain[0], strain[1], strain[2]);
    return { s.d1, s.d2, s.d3 };
  };
  const double lambda = elasticity_.lambda, shear = elasticity_.shear;
  const Eigen::Matrix3d elastic = Eigen::Matrix3d::Constant(lambda + shear);
  const auto plane = [](double slope, int i, int j) -> Eigen::Vector3d {
    return slope * Eigen::Vector3d::Unit(i) - Eigen::Vector3d::Unit(j);
  };
  const auto with_active = [&](const auto& planes) {
    constexpr int count = std::tuple_size_v<std::decay_t<decltype(planes)>>;
    Eigen::Matrix<double, 3, count> gradient, across_gradient, across_flow;
    for (int column = 0; column < count; ++column) {
      const auto [i, j] = planes[static_cast<std::size_t>(column)];
      gradient.col(column) = plane(slope_, i, j);
      across_gradient.col(column) = stress(plane(slope_, i, j));
      across_flow.col(column) = stress(plane(dilation_slope_, i, j));
    }
    const Eigen::Matrix<double, count, count> rates = gradient.transpose() * across_flow;
    const Eigen::Matrix3d taken = across_flow * rates.inverse() * across_gradient.transpose();
    return shear + largest_on_octahedron(elastic - 0.5 * (taken + taken.transpose()));
  };
  using Plane = std::array<int, 2>;
  const std::array<Plane, 1> one{ Plane{ 0, 2 } };
  const std::array<Plane, 2> edge12{ Plane{ 0, 2 }, Plane{ 1, 2 } }, edge23{ Plane{ 0, 2 }, Plane{ 0, 1 } };
  return std::max({ elasticity_.constrained, with_active(one), with_active(edge12), with_active(edge23) });
}

}  // namespace geocontainer_mpm::material
