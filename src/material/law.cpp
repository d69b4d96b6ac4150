#include "geocontainer_mpm/material/law.h"

#include "bingham.h"
#include "hencky.h"
#include "linear_elastic.h"
#include "mohr_coulomb.h"
#include "neo_hookean.h"
#include "newtonian.h"

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
    case LawName::neo_hookean:
      return std::make_unique<NeoHookean<Dim>>(parameters);
    case LawName::hencky:
      return std::make_unique<Hencky<Dim>>(parameters);
    case LawName::newtonian:
      return std::make_unique<Newtonian<Dim>>(parameters);
    case LawName::bingham:
      return std::make_unique<Bingham<Dim>>(parameters);
  }
  return nullptr;  // unreachable: validate() has refused every other value
}

template std::unique_ptr<Law<2>> make_law<2>(const Parameters& parameters);
template std::unique_ptr<Law<3>> make_law<3>(const Parameters& parameters);

double constrained_modulus(const Parameters& parameters)
{
  return is_fluid(parameters.law) ? parameters.bulk_modulus_pa : Elasticity(parameters).constrained;
}

double shear_modulus(const Parameters& parameters)
{
  return is_fluid(parameters.law) ? 0.0 : Elasticity(parameters).shear;
}

DampingModuli damping_moduli(const Parameters& parameters)
{
  if (is_fluid(parameters.law))
    return { 0.0, 0.0 };
  const Elasticity elasticity(parameters);
  return { parameters.stiffness_damping_s * elasticity.lambda, parameters.stiffness_damping_s * elasticity.shear };
}

}  // namespace geocontainer_mpm::material
