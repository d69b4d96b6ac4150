#include "bingham.h"

#include "fluid.h"

namespace geocontainer_mpm::material {

template <int Dim>
void Bingham<Dim>::update(const Batch<Dim>& batch, double dt, std::size_t begin, std::size_t end) const
{
  const double viscosity = viscosity_, extra = extra_viscosity_, per_rate = 1.0 / rate_;
  flow(
      bulk_, [=](double rate) { return viscosity + extra * mean_decay(rate * per_rate); }, batch, dt, begin, end);
}

template <int Dim>
void Bingham<Dim>::initialise(const Batch<Dim>& batch, std::size_t begin, std::size_t end) const
{
  fluid_at_rest(bulk_, batch, begin, end);
}

template <int Dim>
Stiffness Bingham<Dim>::stiffness(const Batch<Dim>& batch, std::size_t begin, std::size_t end) const
{
  return fluid_stiffness(bulk_, viscosity_ + extra_viscosity_, batch, begin, end);
}

template class Bingham<2>;
template class Bingham<3>;

}  // namespace geocontainer_mpm::material
