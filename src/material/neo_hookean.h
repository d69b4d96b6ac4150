#pragma once

#include "batch_access.h"

namespace geocontainer_mpm::material {

/// Compressible neo-Hookean elasticity (Bonet & Wood, ch. 6): stored energy per reference volume
/// mu / 2 (tr B - 3 - 2 ln J) + lambda / 2 (ln J)^2 with B = F F^T, hence Cauchy stress (lambda ln J I + mu (B - I)) /
/// J. In plane strain F33 = 1. elastic_energy is initial_volume times this. Never dissipates, never separates, knows no
/// stress but that of F.
template <int Dim>
class NeoHookean final : public Law<Dim> {
public:
  explicit NeoHookean(const Parameters& parameters)
      : elasticity_(parameters), damping_s_(parameters.stiffness_damping_s)
  {
  }
  void update(const Batch<Dim>& batch, double dt, std::size_t begin, std::size_t end) const override;
  void initialise(const Batch<Dim>& batch, std::size_t begin, std::size_t end) const override;
  bool needs_deformation() const override { return true; }
  Stiffness stiffness(const Batch<Dim>& batch, std::size_t begin, std::size_t end) const override;

private:
  Elasticity elasticity_;
  double damping_s_;
};

}  // namespace geocontainer_mpm::material
