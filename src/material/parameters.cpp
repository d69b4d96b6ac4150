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

}  // namespace

void Parameters::validate(const std::string& key_prefix) const
{
  if (law != LawName::linear_elastic && law != LawName::mohr_coulomb)
    throw InputError("", key_prefix + ".law", fmt::format("{}", static_cast<int>(law)),
                     "must be linear_elastic or mohr_coulomb");
  require(finite_above_zero(density_kg_per_m3), key_prefix, "density_kg_per_m3", density_kg_per_m3,
          "a finite density above 0 kg/m^3");
  require(finite_above_zero(young_modulus_pa), key_prefix, "young_modulus_pa", young_modulus_pa,
          "a finite stiffness above 0 Pa");
  require(within(poisson_ratio, 0.0, 0.49), key_prefix, "poisson_ratio", poisson_ratio, "within [0, 0.49]");
  if (law != LawName::mohr_coulomb)
    return;

  require(friction_angle_deg > 0.0 && friction_angle_deg < 60.0, key_prefix, "friction_angle_deg", friction_angle_deg,
          "within (0, 60) degrees");
  require(within(dilation_angle_deg, 0.0, friction_angle_deg), key_prefix, "dilation_angle_deg", dilation_angle_deg,
          fmt::format("within [0, friction_angle_deg = {}] degrees", friction_angle_deg));
  require(cohesion_pa >= 0.0 && std::isfinite(cohesion_pa), key_prefix, "cohesion_pa", cohesion_pa,
          "a finite cohesion of at least 0 Pa");
  // A cut-off written down in decimals may miss the apex by its last digits.
  const double apex = cohesion_pa / std::tan(radians(friction_angle_deg));
  require(within(tension_cutoff_pa, 0.0, apex * (1.0 + 1e-9)), key_prefix, "tension_cutoff_pa", tension_cutoff_pa,
          fmt::format("within [0, cohesion_pa / tan(friction_angle_deg) = {:.6g}] Pa", apex));
}

}  // namespace geocontainer_mpm::material
