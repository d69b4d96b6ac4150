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

/// A stretch along the barge, x from and to, m.
struct Along {
  double from = 0.0, to = 0.0;
};

/// Where y and z are among the components.
template <int Dim>
inline constexpr int y_axis = Dim - 2;
template <int Dim>
inline constexpr int z_axis = Dim - 1;

/// A vector [y, z] of the section in the dimensions of a model: in space without a part along the barge.
template <int Dim>
Vec<Dim> in_space(const Vec2& of_section)
{
  Vec<Dim> v = Vec<Dim>::Zero();
  v.template tail<2>() = of_section;
  return v;
}
/// What of a vector lies in the section, [y, z].
template <typename Vector>
Vec2 in_section(const Eigen::MatrixBase<Vector>& vector)
{
  return vector.template tail<2>();
}

/// A vector of a model of either dimension in the barge frame; one of the plane-strain section has x = 0.
template <typename Vector>
Vec3 in_barge_frame(const Eigen::MatrixBase<Vector>& vector)
{
  constexpr int dim = Vector::RowsAtCompileTime;
  static_assert(dim == 2 || dim == 3);
  if constexpr (dim == 3)
    return vector;
  else
    return { 0.0, vector[0], vector[1] };
}

}  // namespace geocontainer_mpm
