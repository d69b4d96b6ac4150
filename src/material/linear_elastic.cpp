#include "linear_elastic.h"

#include "bounds.h"

namespace geocontainer_mpm::material {

template <int Dim>
void LinearElastic<Dim>::update(const Batch<Dim>& batch, double dt, std::size_t begin, std::size_t end) const
{
  const Elasticity elasticity = elasticity_;
  const Access<Dim> access(batch);
  double* const __restrict volume = batch.volume;
  double* const __restrict energy = batch.elastic_energy;
#pragma omp simd
  for (std::size_t p = begin; p < end; ++p) {
    const Increment<Dim> step = access.increment(p, dt);
    const Symmetric<Dim> old = access.stress(p);
    const Symmetric<Dim> stress = add(rotate(old, step), 1.0, elastic_stress(elasticity, step.strain));
    const double mid_volume = volume[p] * (1.0 + 0.5 * step.volume_change);
    const double change = energy_density(elasticity, stress) - energy_density(elasticity, old);
    access.set_stress(p, stress);
    volume[p] *= 1.0 + step.volume_change;
    energy[p] += mid_volume * change;
  }
}

template <int Dim>
void LinearElastic<Dim>::initialise(const Batch<Dim>& batch, std::size_t begin, std::size_t end) const
{
  initialise_energy(elasticity_, batch, begin, end);
}

template <int Dim>
Stiffness LinearElastic<Dim>::stiffness(const Batch<Dim>& batch, std::size_t begin, std::size_t end) const
{
  return { elasticity_.constrained + geometric_stiffness(batch, begin, end), damping_s_ * elasticity_.constrained };
}

template class LinearElastic<2>;
template class LinearElastic<3>;

}  // namespace geocontainer_mpm::material
