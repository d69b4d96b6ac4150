#include "geocontainer_mpm/material/law.h"

#include "linear_elastic.h"
#include "mohr_coulomb.h"

namespace geocontainer_mpm::material {

template <int Dim>
std::unique_ptr<Law<Dim>> make_law(const Parameters& parameters)
{
  parameters.validate("material");
  switch (parameters.law) {
    case LawName::linear_elastic:
      return std::make_unique<LinearElastic<Dim>>(parameters);
    case LawName::mohr_coulomb:
      return std::make_unique<MohrCoulomb<Dim>>(parameters);
  }
  return nullptr;  // unreachable: validate() has refused every other value
}

template std::unique_ptr<Law<2>> make_law<2>(const Parameters& parameters);
template std::unique_ptr<Law<3>> make_law<3>(const Parameters& parameters);

double constrained_modulus(const Parameters& parameters)
{
  return Elasticity(parameters).constrained;
}

double shear_modulus(const Parameters& parameters)
{
  return Elasticity(parameters).shear;
}

}  // namespace geocontainer_mpm::material
