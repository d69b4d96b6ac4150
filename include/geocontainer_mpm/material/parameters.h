#pragma once
/// What a constitutive law needs to know: plain data, as a scene gives it.

#include <string>

namespace geocontainer_mpm::material {

enum class LawName { linear_elastic, mohr_coulomb };

struct Parameters {
  LawName law = LawName::linear_elastic;
  double density_kg_per_m3 = 0.0;  ///< bulk density, > 0
  double young_modulus_pa = 0.0;   ///< > 0
  double poisson_ratio = 0.0;      ///< [0, 0.49]
  // mohr_coulomb only:
  double friction_angle_deg = 0.0;  ///< (0, 60)
  double dilation_angle_deg = 0.0;  ///< [0, friction angle]
  double cohesion_pa = 0.0;         ///< >= 0
  double tension_cutoff_pa = 0.0;   ///< largest principal tension, [0, cohesion / tan(friction angle)]

  /// Throws InputError naming `key_prefix.<field>`, its value and what is allowed.
  void validate(const std::string& key_prefix) const;
};

}  // namespace geocontainer_mpm::material
