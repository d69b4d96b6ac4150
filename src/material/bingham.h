#pragma once

#include "geocontainer_mpm/material/law.h"

namespace geocontainer_mpm::material {

/// Weakly compressible Bingham fluid without tension (fluid.h), regularised as Papanastasiou (1987): shear stress
/// 2 eta_eff dev(D) with eta_eff = eta + tau_y (1 - exp(-m g)) / g, g = sqrt(2 dev(D) : dev(D)), and 1 / m =
/// regularisation_rate_per_s. Below that rate it is a fluid of viscosity eta + m tau_y: it creeps where a Bingham fluid
/// would stand still, and an explicit step has to resolve this viscosity. m is therefore a parameter, not a constant:
/// the shear rates that matter, and with them what is slow enough to pass for rest, scale with the case.
template <int Dim>
class Bingham final : public Law<Dim> {
public:
  explicit Bingham(const Parameters& parameters)
      : bulk_(parameters.bulk_modulus_pa)
      , viscosity_(parameters.viscosity_pa_s)
      , rate_(parameters.regularisation_rate_per_s)
      , extra_viscosity_(parameters.yield_stress_pa / rate_)
  {
  }
  void update(const Batch<Dim>& batch, double dt, std::size_t begin, std::size_t end) const override;
  void initialise(const Batch<Dim>& batch, std::size_t begin, std::size_t end) const override;
  Stiffness stiffness(const Batch<Dim>& batch, std::size_t begin, std::size_t end) const override;

private:
  double bulk_, viscosity_;
  double rate_;             ///< 1 / m, 1/s
  double extra_viscosity_;  ///< m tau_y, Pa s
};

}  // namespace geocontainer_mpm::material
