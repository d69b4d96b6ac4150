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

inline Parameters random_parameters(LawName law)
{
  if (law == LawName::mohr_coulomb)
    return random_mohr_coulomb();
  if (is_fluid(law)) {
    Parameters p = slurry(law);
    p.bulk_modulus_pa = uniform(1e5, 1e7);
    p.viscosity_pa_s = uniform(0.0, 10.0);
    p.yield_stress_pa = uniform(0.0, 200.0);
    p.regularisation_rate_per_s = uniform(0.01, 10.0);
    return p;
  }
  Parameters p = finite(law);
  p.poisson_ratio = uniform(0.0, 0.49);
  return p;
}

template <int Dim>
Mat<Dim> random_deformation(double size)  // never inside out
{
  const Mat<Dim> f = Mat<Dim>::Identity() + random_gradient<Dim>(size);
  return f.determinant() > 0.2 ? f : random_deformation<Dim>(0.5 * size);
}

inline constexpr double stress_size_pa = 1e5;

/// A random state that the law admits, everything counted from there.
template <int Dim>
OneParticle<Dim> random_state(const Parameters& parameters)
{
  OneParticle<Dim> particle(parameters);
  if (is_fluid(parameters.law))
    particle.set_volume(uniform(0.8, 1.1));
  else if (parameters.law == LawName::neo_hookean || parameters.law == LawName::hencky)
    particle.set_deformation(random_deformation<Dim>(0.4));
  else {
    particle.set_stress(random_stress<Dim>(stress_size_pa));
    particle.step(Mat<Dim>::Zero());  // one step at rest returns any stress to the yield surface
  }
  particle.work = particle.dissipated = 0.0;
  return particle;
}

}  // namespace geocontainer_mpm::material::testing
