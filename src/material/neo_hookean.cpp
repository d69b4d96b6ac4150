#include "neo_hookean.h"

#include "bounds.h"
#include "finite_strain.h"

namespace geocontainer_mpm::material {
namespace {

template <int Dim>
inline Response<Dim> respond(const Elasticity& elasticity, const Gradient<Dim>& u)
{
  const double change = volume_change(u);
  const Logarithm log = logarithm(change);
  const double per_volume = 1.0 / (1.0 + change);
  // tr B - 3 - 2 ln J = U : U + 2 (tr U - (J - 1)) + 2 (J - 1 - ln J)
  const double shape = square(u) - 2.0 * second_order_volume(u) + 2.0 * log.defect;
  return { spherical_plus(elasticity.lambda * log.value * per_volume, elasticity.shear * per_volume, left_strain(u)),
           change, 0.5 * (elasticity.shear * shape + elasticity.lambda * log.value * log.value) };
}

}  // namespace

template <int Dim>
void NeoHookean<Dim>::update(const Batch<Dim>& batch, double dt, std::size_t begin, std::size_t end) const
{
  const Elasticity elasticity = elasticity_;
  advance(batch, dt, begin, end, [elasticity](const Gradient<Dim>& u) { return respond<Dim>(elasticity, u); });
}

template <int Dim>
void NeoHookean<Dim>::initialise(const Batch<Dim>& batch, std::size_t begin, std::size_t end) const
{
  const Elasticity elasticity = elasticity_;
  evaluate(batch, begin, end, [elasticity](const Gradient<Dim>& u) { return respond<Dim>(elasticity, u); });
}

// The acoustic tensor is J Q = (lambda + mu - lambda ln J) n n^T + mu (n . B n) I.
template <int Dim>
Stiffness NeoHookean<Dim>::stiffness(const Batch<Dim>& batch, std::size_t begin, std::size_t end) const
{
  const double lambda = elasticity_.lambda, shear = elasticity_.shear;
  const DeformationAccess<Dim> deformation(batch);
  double largest = 0.0;
#pragma omp simd reduction(max : largest)
  for (std::size_t p = begin; p < end; ++p) {
    const Gradient<Dim> u = deformation.get(p);
    const double change = volume_change(u), along = lambda + shear - lambda * logarithm(change).value;
    const double modulus =
        ((along > 0.0 ? along : 0.0) + shear * (1.0 + largest_principal(left_strain(u)))) / (1.0 + change);
    largest = modulus > largest ? modulus : largest;
  }
  return { largest, damping_s_ * elasticity_.constrained };
}

template class NeoHookean<2>;
template class NeoHookean<3>;

}  // namespace geocontainer_mpm::material
