#pragma once
/// Upper bounds of principal values, without an eigenvalue solver.

#include <cmath>

#include "batch_access.h"

namespace geocontainer_mpm::material {

/// The largest in-plane principal value: exact.
inline double largest_principal(const Symmetric<2>& s)
{
  const double half = 0.5 * (s.s00 - s.s11);
  return 0.5 * (s.s00 + s.s11) + std::sqrt(half * half + s.s01 * s.s01);
}

/// s : s of the deviator
inline double deviator_square(const Symmetric<3>& s)
{
  const double mean = trace(s) / 3.0, d0 = s.s00 - mean, d1 = s.s11 - mean, d2 = s.s22 - mean;
  return d0 * d0 + d1 * d1 + d2 * d2 + 2.0 * (s.s01 * s.s01 + s.s02 * s.s02 + s.s12 * s.s12);
}

/// The largest that it can be over all Lode angles.
inline double largest_principal(const Symmetric<3>& s)
{
  return trace(s) / 3.0 + std::sqrt(2.0 / 3.0 * deviator_square(s));
}

/// Half the difference of largest and smallest principal value: in the plane exact, in three dimensions over all Lode
/// angles.
inline double largest_shear(const Symmetric<2>& s)
{
  const double half = 0.5 * (s.s00 - s.s11);
  return std::sqrt(half * half + s.s01 * s.s01);
}

inline double largest_shear(const Symmetric<3>& s)
{
  return std::sqrt(0.5 * deviator_square(s));
}

/// Geometric part of the acoustic tensor of a law of rate form: the spin turns the stress, which adds
/// (n . sigma n - a . sigma a) / 2 for a motion along a of a wave along n. Pa
template <int Dim>
double geometric_stiffness(const Batch<Dim>& batch, std::size_t begin, std::size_t end)
{
  const Access<Dim> access(batch);
  double largest = 0.0;
#pragma omp simd reduction(max : largest)
  for (std::size_t p = begin; p < end; ++p) {
    const double shear = largest_shear(access.stress(p));
    largest = shear > largest ? shear : largest;
  }
  return largest;
}

}  // namespace geocontainer_mpm::material
