#include "geocontainer_mpm/material/parameters.h"

#include <fmt/format.h>

#include <cmath>

#include "angle.h"
#include "geocontainer_mpm/error.h"

namespace geocontainer_mpm::material {
namespace {

void require(bool holds, const std::string& key_prefix, const char* field, double value, const std::string& allowed)
{
  if (!holds)
    throw InputError("", key_prefix + "." + field, fmt::format("{}", value), "must be " + allowed);
}

// Written so that a NaN fails every one of them.
bool finite_above_zero(double value)
{
  return value > 0.0 && std::isfinite(value);
}
bool within(double value, double low, double high)
{
  return value >= low && value <= high;
}

bool finite_from_zero(double value)
{
  return value >= 0.0 && std::isfinite(value);
}

void validate_elasticity(const Parameters& p, const std::string& key_prefix)
{
  require(finite_above_zero(p.young_modulus_pa), key_prefix, "young_modulus_pa", p.young_modulus_pa,
          "a finite stiffness above 0 Pa");
  require(within(p.poisson_ratio, 0.0, 0.49), key_prefix, "poisson_ratio", p.poisson_ratio, "within [0, 0.49]");
  require(finite_from_zero(p.stiffness_damping_s), key_prefix, "stiffness_damping_s", p.stiffness_damping_s,
          "a finite time of at least 0 s");
}

void validate_strength(const Parameters& p, const std::string& key_prefix)
{
  require(p.friction_angle_deg > 0.0 && p.friction_angle_deg < 60.0, key_prefix, "friction_angle_deg",
          p.friction_angle_deg, "within (0, 60) degrees");
  require(within(p.dilation_angle_deg, 0.0, p.friction_angle_deg), key_prefix, "dilation_angle_deg",
          p.dilation_angle_deg, fmt::format("within [0, friction_angle_deg = {}] degrees", p.friction_angle_deg));
  require(finite_from_zero(p.cohesion_pa), key_prefix, "cohesion_pa", p.cohesion_pa,
          "a finite cohesion of at least 0 Pa");
  // A cut-off written down in decimals may miss the apex by its last digits.
  const double apex = p.cohesion_pa / std::tan(radians(p.friction_angle_deg));
  require(within(p.tension_cutoff_pa, 0.0, apex * (1.0 + 1e-9)), key_prefix, "tension_cutoff_pa", p.tension_cutoff_pa,
          fmt::format("within [0, cohesion_pa / tan(friction_angle_deg) = {:.6g}] Pa", apex));
}

void validate_fluid(const Parameters& p, const std::string& key_prefix)
{
  require(finite_above_zero(p.bulk_modulus_pa), key_prefix, "bulk_modulus_pa", p.bulk_modulus_pa,
          "a finite stiffness above 0 Pa");
  require(finite_from_zero(p.viscosity_pa_s), key_prefix, "viscosity_pa_s", p.viscosity_pa_s,
          "a finite viscosity of at least 0 Pa s");
  if (p.law != LawName::bingham)
    return;
  require(finite_from_zero(p.yield_stress_pa), key_prefix, "yield_stress_pa", p.yield_stress_pa,
          "a finite stress of at least 0 Pa");
  require(finite_above_zero(p.regularisation_rate_per_s), key_prefix, "regularisation_rate_per_s",
          p.regularisation_rate_per_s, "a finite rate above 0 1/s");
}

}  // namespace

void Parameters::validate(const std::string& key_prefix) const
{
  switch (law) {
    case LawName::linear_elastic:
    case LawName::mohr_coulomb:
    case LawName::neo_hookean:
    case LawName::hencky:
    case LawName::newtonian:
    case LawName::bingham:
      break;
    default:
      throw InputError("", key_prefix + ".law", fmt::format("{}", static_cast<int>(law)),
                       "must be linear_elastic, mohr_coulomb, neo_hookean, hencky, newtonian or bingham");
  }
  require(finite_above_zero(density_kg_per_m3), key_prefix, "density_kg_per_m3", density_kg_per_m3,
          "a finite density above 0 kg/m^3");
  if (is_fluid(law))
    validate_fluid(*this, key_prefix);
  else
    validate_elasticity(*this, key_prefix);
  if (law == LawName::mohr_coulomb)
    validate_strength(*this, key_prefix);
}

}  // namespace geocontainer_mpm::material
