#pragma once
/// Isotropic linear elasticity: the constants that every law here shares.

#include "geocontainer_mpm/material/parameters.h"

namespace geocontainer_mpm::material {

struct Elasticity {
  double lambda;       ///< Lame's first constant, Pa
  double shear;        ///< G, Pa
  double bulk;         ///< K (three-dimensional), Pa
  double constrained;  ///< lambda + 2 G, Pa
  double energy_full;  ///< stored energy per volume = energy_full * sigma : sigma + energy_trace * tr(sigma)^2, 1/Pa
  double energy_trace;

  explicit Elasticity(const Parameters& parameters)
  {
    const double young = parameters.young_modulus_pa;
    const double poisson = parameters.poisson_ratio;
    lambda = young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson));
    shear = young / (2.0 * (1.0 + poisson));
    bulk = young / (3.0 * (1.0 - 2.0 * poisson));
    constrained = lambda + 2.0 * shear;
    energy_full = (1.0 + poisson) / (2.0 * young);
    energy_trace = -poisson / (2.0 * young);
  }
};

}  // namespace geocontainer_mpm::material
