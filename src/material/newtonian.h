#pragma once

#include "geocontainer_mpm/material/law.h"

namespace geocontainer_mpm::material {

/// Weakly compressible Newtonian fluid without tension (fluid.h): shear stress 2 eta dev(D).
template <int Dim>
class Newtonian final : public Law<Dim> {
public:
  explicit Newtonian(const Parameters& parameters)
      : bulk_(parameters.bulk_modulus_pa), viscosity_(parameters.viscosity_pa_s)
  {
  }
  void update(const Batch<Dim>& batch, double dt, std::size_t begin, std::size_t end) const override;
  void initialise(const Batch<Dim>& batch, std::size_t begin, std::size_t end) const override;
  Stiffness stiffness(const Batch<Dim>& batch, std::size_t begin, std::size_t end) const override;

private:
  double bulk_, viscosity_;
};

}  // namespace geocontainer_mpm::material
