#pragma once
/// Generators: integers underneath, so that a failure shrinks to round numbers.

#include <rapidcheck.h>

#include "one_particle.h"

namespace geocontainer_mpm::material::testing {

inline double uniform(double low, double high)
{
  // At the nominal size from the first case on: small sizes would crowd the values at `low`.
  return low + (high - low) * *rc::gen::resize(rc::kNominalSize, rc::gen::inRange(0, 1000001)) * 1e-6;
}

template <int Dim>
Mat<Dim> random_gradient(double size)
{
  Mat<Dim> h;
  for (int i = 0; i < Dim; ++i)
    for (int j = 0; j < Dim; ++j)
      h(i, j) = uniform(-size, size);
  return h;
}

template <int Dim>
Mat<Dim> turn(double angle, const Eigen::Vector3d& axis)
{
  if constexpr (Dim == 2)
    return Eigen::Rotation2Dd(angle).toRotationMatrix();
  else
    return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
}

inline Eigen::Vector3d random_axis()
{
  return { uniform(-1.0, 1.0), uniform(-1.0, 1.0), uniform(0.1, 1.0) };
}

/// A stress with in-plane (Dim 2) or any (Dim 3) principal directions and the given principal values in any order.
template <int Dim>
Eigen::Matrix3d random_stress(double size)
{
  const Eigen::Vector3d values(uniform(-size, size), uniform(-size, size), uniform(-size, size));
  Eigen::Matrix3d q = Eigen::Matrix3d::Identity();
  q.topLeftCorner<Dim, Dim>() = turn<Dim>(uniform(-3.0, 3.0), random_axis());
  const Eigen::Matrix3d s = q * values.asDiagonal() * q.transpose();
  return 0.5 * (s + s.transpose());
}

inline Parameters random_mohr_coulomb()
{
  const double friction = uniform(5.0, 50.0);
  Parameters p = sand(friction, friction * uniform(0.0, 1.0));
  p.poisson_ratio = uniform(0.0, 0.45);
  switch (*rc::gen::element(0, 1, 2, 3)) {
    case 0:
      break;  // cohesionless
    case 1:   // no tension
      p.cohesion_pa = uniform(1e2, 1e5);
      break;
    case 2:
      p.cohesion_pa = uniform(1e2, 1e5);
      p.tension_cutoff_pa = uniform(0.05, 0.95) * p.cohesion_pa / std::tan(friction * pi / 180.0);
      break;
    default:  // the full apex
      p.cohesion_pa = uniform(1e2, 1e5);
      p.tension_cutoff_pa = p.cohesion_pa / std::tan(friction * pi / 180.0);
  }
  return p;
}

}  // namespace geocontainer_mpm::material::testing
