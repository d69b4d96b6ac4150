#pragma once
/// Principal stresses, sorted, and the way back.

#include <Eigen/Eigenvalues>
#include <cmath>

#include "increment.h"
#include "principal_return.h"

namespace geocontainer_mpm::material {

template <int Dim>
class Spectral;

/// Plane strain: the closed form in the plane, the out-of-plane stress sorted in between.
template <>
class Spectral<2> {
public:
  explicit Spectral(const Symmetric<2>& s)
  {
    const double mean = 0.5 * (s.s00 + s.s11), half = 0.5 * (s.s00 - s.s11);
    const double radius = std::sqrt(half * half + s.s01 * s.s01);
    const double inverse = radius > 0.0 ? 1.0 / radius : 0.0;
    cosine_ = half * inverse;
    sine_ = s.s01 * inverse;
    const double high = mean + radius, low = mean - radius;
    if (s.szz >= high) {
      place_ = 0;
      values_ = { s.szz, high, low };
    } else if (s.szz >= low) {
      place_ = 1;
      values_ = { high, s.szz, low };
    } else {
      place_ = 2;
      values_ = { high, low, s.szz };
    }
  }

  const Principal& values() const { return values_; }

  /// The tensor with the same directions and other principal values.
  Symmetric<2> compose(const Principal& v) const
  {
    const double high = place_ == 0 ? v.s2 : v.s1, low = place_ == 2 ? v.s2 : v.s3;
    const double out = place_ == 0 ? v.s1 : (place_ == 1 ? v.s2 : v.s3);
    const double mean = 0.5 * (high + low), radius = 0.5 * (high - low);
    return { mean + radius * cosine_, mean - radius * cosine_, radius * sine_, out };
  }

private:
  double cosine_, sine_;  ///< of twice the angle of the in-plane major direction
  int place_;             ///< of the out-of-plane stress among the three
  Principal values_;
};

/// Three dimensions: the iterative solver. Eigen's direct one loses half of the digits of the directions where two
/// principal stresses nearly agree, which is where most yielding sand stands (on an edge).
template <>
class Spectral<3> {
public:
  explicit Spectral(const Symmetric<3>& s)
  {
    Eigen::Matrix3d full;
    full << s.s00, s.s01, s.s02, s.s01, s.s11, s.s12, s.s02, s.s12, s.s22;
    solver_.compute(full);
    values_ = { solver_.eigenvalues()[2], solver_.eigenvalues()[1], solver_.eigenvalues()[0] };
  }

  const Principal& values() const { return values_; }

  Symmetric<3> compose(const Principal& v) const
  {
    const Eigen::Matrix3d& n = solver_.eigenvectors();
    const auto entry = [&](int i, int j) {
      return v.s3 * n(i, 0) * n(j, 0) + v.s2 * n(i, 1) * n(j, 1) + v.s1 * n(i, 2) * n(j, 2);
    };
    return { entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(0, 2), entry(1, 2) };
  }

private:
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver_;
  Principal values_;
};

}  // namespace geocontainer_mpm::material
