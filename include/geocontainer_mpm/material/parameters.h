#pragma once
/// What a constitutive law needs to know: plain data, as a scene gives it.

#include <string>

namespace geocontainer_mpm::material {

enum class LawName { linear_elastic, mohr_coulomb, neo_hookean, hencky, newtonian, bingham };

constexpr bool is_fluid(LawName law)
{
  return law == LawName::newtonian || law == LawName::bingham;
}

struct Parameters {
  LawName law = LawName::linear_elastic;
  double density_kg_per_m3 = 0.0;  ///< bulk density, of a fluid that without pressure; > 0
  // all but fluids:
  double young_modulus_pa = 0.0;     ///< > 0
  double poisson_ratio = 0.0;        ///< [0, 0.49]
  double stiffness_damping_s = 0.0;  ///< Rayleigh's beta: viscous stress beta C : D on top of the law's, >= 0
  // mohr_coulomb only:
  double friction_angle_deg = 0.0;  ///< (0, 60)
  double dilation_angle_deg = 0.0;  ///< [0, friction angle]
  double cohesion_pa = 0.0;         ///< >= 0
  double tension_cutoff_pa = 0.0;   ///< largest principal tension, [0, cohesion / tan(friction angle)]
  // fluids only:
  double bulk_modulus_pa = 0.0;  ///< pressure per relative excess of density, > 0
  double viscosity_pa_s = 0.0;   ///< shear viscosity, of bingham that beyond yield (plastic viscosity), >= 0
  // bingham only:
  double yield_stress_pa = 0.0;  ///< shear stress below which the fluid hardly flows, >= 0
  /// Shear rate below which "hardly" begins: the yield stress builds up over it. The unyielded fluid has the viscosity
  /// viscosity + yield stress / this rate, which bounds the time step, at the
  /// order of density cell^2 / (4 viscosity): a tenth to a hundredth of the flow's own shear rate is sharp enough. > 0
  double regularisation_rate_per_s = 0.1;

  /// Throws InputError naming `key_prefix.<field>`, its value and what is allowed. Looks only at what the law uses.
  void validate(const std::string& key_prefix) const;
};

}  // namespace geocontainer_mpm::material
