#pragma once

#include "batch_access.h"

namespace geocontainer_mpm::material {

/// Hencky elasticity: stored energy per reference volume lambda / 2 tr(e)^2 + mu e : e of the logarithmic strain e =
/// 1/2 ln B, B = F F^T (Hencky 1928; Anand 1979 on its range, stretches of 0.7 to 1.3), hence Kirchhoff stress
/// lambda tr(e) I + 2 mu e and Cauchy stress 1 / J times that. In plane strain F33 = 1. elastic_energy is
/// initial_volume times the stored energy. Never dissipates, never separates, knows no stress but that of F.
template <int Dim>
class Hencky final : public Law<Dim> {
public:
  explicit Hencky(const Parameters& parameters) : elasticity_(parameters), damping_s_(parameters.stiffness_damping_s) {}
  void update(const Batch<Dim>& batch, double dt, std::size_t begin, std::size_t end) const override;
  void initialise(const Batch<Dim>& batch, std::size_t begin, std::size_t end) const override;
  bool needs_deformation() const override { return true; }
  Stiffness stiffness(const Batch<Dim>& batch, std::size_t begin, std::size_t end) const override;

private:
  Elasticity elasticity_;
  double damping_s_;
};

}  // namespace geocontainer_mpm::material
