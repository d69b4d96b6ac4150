#pragma once
/// Small fixed-size algebra used everywhere. `Dim` is 2 (plane strain: the y-z plane of the barge frame,
/// component 0 = y to port, component 1 = z up) or 3 (x forward, y port, z up).

#include <Eigen/Core>

namespace geocontainer_mpm {

template <int Dim>
using Vec = Eigen::Matrix<double, Dim, 1>;
template <int Dim>
using Mat = Eigen::Matrix<double, Dim, Dim>;

using Vec2 = Vec<2>;
using Vec3 = Vec<3>;
using Mat2 = Mat<2>;

/// Where y and z are among the components.
template <int Dim>
inline constexpr int y_axis = Dim - 2;
template <int Dim>
inline constexpr int z_axis = Dim - 1;

/// The same vector in `To` dimensions, at least as many: what is new, along the barge, is zero.
template <int To, int From>
Vec<To> in_space(const Vec<From>& v)
{
  Vec<To> result = Vec<To>::Zero();
  result.template tail<From>() = v;
  return result;
}
/// What of a vector lies in the section, [y, z].
template <int Dim>
Vec2 in_section(const Vec<Dim>& v)
{
  return v.template tail<2>();
}

}  // namespace geocontainer_mpm
