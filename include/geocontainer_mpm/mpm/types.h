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
using Mat2 = Mat<2>;

}  // namespace geocontainer_mpm
