#pragma once

#include "batch_access.h"
#include "principal_return.h"

namespace geocontainer_mpm::material {

/// Elastic, perfectly plastic Mohr-Coulomb with dilation and a Rankine tension cut-off (principal_return.h) on the
/// hypoelastic trial stress of increment.h.
///
/// **Apart and together again.** The volume that the cut-off opens is banked in `separated_strain` as logarithmic
/// volume strain. A particle without stress and with something in its bank is apart: as it moves its bank follows ln
/// det F, so that it is empty exactly when the volume is back, and the stress stays zero whatever the shape does
/// meanwhile, since loose grains carry no shear. The step that empties the bank strains the material by the share of
/// its increment that remains. Neither opening nor closing does work. (The purpose is that of the volume correction of
/// Tampubolon et al. 2017: without it each open-close cycle adds volume.) With a cut-off above zero the tension holds
/// on while the gap opens; when the gap closes it unloads elastically, and the particle is then apart as above: torn
/// soil pulls again only once its gap has closed. With cohesion a crack may open across one direction while others stay
/// loaded: closing then strains the crack, at zero stress across it, before compression builds there.
///
/// A grain that has come apart to ten times its volume is alone: the gradient that it sees is that between it and
/// bodies that it has left, and its bank and its volume, with which it counts in means, grow no more.
///
/// **Energy.** The work of a step is trapezoidal, V_mid (sigma_old + sigma_new) / 2 : de: what a leapfrog scheme
/// exchanges with kinetic energy, so that the balance closes. V_mid (e_new - e_old) of it is stored, with e = sigma :
/// C^-1 : sigma / 2, and the rest dissipated: nothing in an elastic step, and >= 0 except in a step in which the stress
/// unloads and then yields, by at most the product of that step's stress and strain increments. Stored energy is this
/// sum and not V e, which for a Cauchy-stress law is no potential: it was a sixth short where sand was pressed to seven
/// tenths of its volume. Without stress nothing is stored; what flow at stress has made of the sum is then dissipated.
template <int Dim>
class MohrCoulomb final : public Law<Dim> {
public:
  explicit MohrCoulomb(const Parameters& parameters)
      : elasticity_(parameters)
      , surface_(parameters, elasticity_)
      , no_energy_(0.5e-24 * parameters.young_modulus_pa)
      , constrained_(surface_.constrained_tangent())
      , damping_s_(parameters.stiffness_damping_s)
  {
  }
  void update(const Batch<Dim>& batch, double dt, std::size_t begin, std::size_t end) const override;
  void initialise(const Batch<Dim>& batch, std::size_t begin, std::size_t end) const override;
  Stiffness stiffness(const Batch<Dim>& batch, std::size_t begin, std::size_t end) const override;

private:
  struct Step;   // one particle's elastic step
  struct Chunk;  // the same for some particles, as arrays
  void elastic_pass(const Batch<Dim>& batch, double dt, std::size_t begin, std::size_t end, Chunk& chunk) const;
  void correct(const Batch<Dim>& batch, std::size_t particle, const Step& step) const;
  bool is_apart(const Step& step, const Symmetric<Dim>& old, const Symmetric<Dim>& trial) const;
  bool stays_apart(const Step& step, const Symmetric<Dim>& old, Symmetric<Dim>& trial, double& bank) const;

  Elasticity elasticity_;
  PrincipalReturn surface_;
  double
      no_energy_;  ///< stored energy per volume of an elastic strain of 1e-12: an open particle with less has no stress
  double constrained_;  ///< bound of the elastic and every plastic tangent, Pa
  double damping_s_;
};

}  // namespace geocontainer_mpm::material
