#pragma once

#include "batch_access.h"

namespace geocontainer_mpm::material {

/// Hypoelasticity: the Cauchy stress turns with the material and grows by lambda tr(de) I + 2 G de, with the increments
/// of increment.h. For a stretch without rotation it adds up to sigma = C : ln(stretch), to second order in the step.
/// elastic_energy is the work done, trapezoidal, V_mid (e_new - e_old) a step with e = sigma : C^-1 : sigma / 2: for a
/// Cauchy-stress law V e itself is no potential. Never dissipates, never separates.
template <int Dim>
class LinearElastic final : public Law<Dim> {
public:
  explicit LinearElastic(const Parameters& parameters)
      : elasticity_(parameters), damping_s_(parameters.stiffness_damping_s)
  {
  }
  void update(const Batch<Dim>& batch, double dt, std::size_t begin, std::size_t end) const override;
  void initialise(const Batch<Dim>& batch, std::size_t begin, std::size_t end) const override;
  Stiffness stiffness(const Batch<Dim>& batch, std::size_t begin, std::size_t end) const override;

private:
  Elasticity elasticity_;
  double damping_s_;
};

}  // namespace geocontainer_mpm::material
