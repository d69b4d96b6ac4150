#include "newtonian.h"

#include "fluid.h"

namespace geocontainer_mpm::material {

template <int Dim>
void Newtonian<Dim>::update(const Batch<Dim>& batch, double dt, std::size_t begin, std::size_t end) const
{
  const double viscosity = viscosity_;
  flow(
      bulk_, [viscosity](double) { return viscosity; }, batch, dt, begin, end);
}

template <int Dim>
void Newtonian<Dim>::initialise(const Batch<Dim>& batch, std::size_t begin, std::size_t end) const
{
  fluid_at_rest(bulk_, batch, begin, end);
}

template <int Dim>
Stiffness Newtonian<Dim>::stiffness(const Batch<Dim>& batch, std::size_t begin, std::size_t end) const
{
  return fluid_stiffness(bulk_, viscosity_, batch, begin, end);
}

template class Newtonian<2>;
template class Newtonian<3>;

}  // namespace geocontainer_mpm::material
