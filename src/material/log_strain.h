#pragma once
/// Logarithmic strain 1/2 ln B from B - I, free of branches: the loop over particles vectorises.

#include <cmath>

#include "elementary.h"
#include "increment.h"

namespace geocontainer_mpm::material {

/// With m and r the centre and radius of Mohr's circle of B: J^2 = (m + r) (m - r), hence the mean of the logarithms is
/// ln(J) / 2 and half their difference ln((m + r) / J) / 2.
inline Symmetric<2> log_strain(const Symmetric<2>& b_minus_one, double volume_change, double log_volume)
{
  const double mean = 0.5 * (b_minus_one.s00 + b_minus_one.s11), half = 0.5 * (b_minus_one.s00 - b_minus_one.s11);
  const double radius = std::sqrt(half * half + b_minus_one.s01 * b_minus_one.s01);
  const double per_radius = 1.0 / (radius > 1e-300 ? radius : 1e-300);
  const double middle = 0.5 * log_volume;
  const double difference = 0.5 * logarithm((mean + radius - volume_change) / (1.0 + volume_change)).value;
  const double cosine = difference * (half * per_radius), sine = difference * (b_minus_one.s01 * per_radius);
  return { middle + cosine, middle - cosine, sine, 0.0 };
}

struct Vector3 {
  double x, y, z;
};

/// One Jacobi rotation (Golub & Van Loan, 8.5) in the plane of two axes p and q; r is the third. Annihilates apq.
inline void annihilate(double& app, double& aqq, double& apq, double& apr, double& aqr, Vector3& vp, Vector3& vq)
{
  const double half = 0.5 * (aqq - app);
  const double root = std::sqrt(half * half + apq * apq);
  const double divisor = half >= 0.0 ? half + root : half - root;
  const double tangent = divisor != 0.0 ? apq / divisor : 0.0;
  const double cosine = 1.0 / std::sqrt(1.0 + tangent * tangent), sine = tangent * cosine;
  app -= tangent * apq;
  aqq += tangent * apq;
  apq = 0.0;
  const double old = apr;
  apr = cosine * old - sine * aqr;
  aqr = sine * old + cosine * aqr;
  const Vector3 v = vp;
  vp = { cosine * v.x - sine * vq.x, cosine * v.y - sine * vq.y, cosine * v.z - sine * vq.z };
  vq = { sine * v.x + cosine * vq.x, sine * v.y + cosine * vq.y, sine * v.z + cosine * vq.z };
}

/// Cyclic Jacobi: converges quadratically, usually in three or four sweeps; five give the matrix logarithm of the tests
/// to round-off, with stretches that agree or nearly agree too. A fixed number, so that the loop has no branch.
inline Symmetric<3> log_strain(const Symmetric<3>& b_minus_one, double /*volume_change*/, double /*log_volume*/)
{
  Symmetric<3> a = b_minus_one;
  Vector3 v0{ 1.0, 0.0, 0.0 }, v1{ 0.0, 1.0, 0.0 }, v2{ 0.0, 0.0, 1.0 };
  const auto sweep = [&]() {
    annihilate(a.s00, a.s11, a.s01, a.s02, a.s12, v0, v1);
    annihilate(a.s00, a.s22, a.s02, a.s01, a.s12, v0, v2);
    annihilate(a.s11, a.s22, a.s12, a.s01, a.s02, v1, v2);
  };
  sweep();
  sweep();
  sweep();
  sweep();
  sweep();
  const double e0 = 0.5 * logarithm(a.s00).value, e1 = 0.5 * logarithm(a.s11).value, e2 = 0.5 * logarithm(a.s22).value;
  return {
    e0 * v0.x * v0.x + e1 * v1.x * v1.x + e2 * v2.x * v2.x, e0 * v0.y * v0.y + e1 * v1.y * v1.y + e2 * v2.y * v2.y,
    e0 * v0.z * v0.z + e1 * v1.z * v1.z + e2 * v2.z * v2.z, e0 * v0.x * v0.y + e1 * v1.x * v1.y + e2 * v2.x * v2.y,
    e0 * v0.x * v0.z + e1 * v1.x * v1.z + e2 * v2.x * v2.z, e0 * v0.y * v0.z + e1 * v1.y * v1.z + e2 * v2.y * v2.z
  };
}

}  // namespace geocontainer_mpm::material
