#include "hencky.h"

#include "bounds.h"
#include "finite_strain.h"
#include "log_strain.h"

namespace geocontainer_mpm::material {
namespace {

template <int Dim>
inline Response<Dim> respond(const Elasticity& elasticity, const Gradient<Dim>& u)
{
  const double change = volume_change(u), log_volume = logarithm(change).value;
  const Symmetric<Dim> strain = log_strain(left_strain(u), change, log_volume);
  const double per_volume = 1.0 / (1.0 + change);
  return { spherical_plus(elasticity.lambda * log_volume * per_volume, 2.0 * elasticity.shear * per_volume, strain),
           change, 0.5 * elasticity.lambda * log_volume * log_volume + elasticity.shear * contract(strain, strain) };
}

}  // namespace

template <int Dim>
void Hencky<Dim>::update(const Batch<Dim>& batch, double dt, std::size_t begin, std::size_t end) const
{
  const Elasticity elasticity = elasticity_;
  advance(batch, dt, begin, end, [elasticity](const Gradient<Dim>& u) { return respond<Dim>(elasticity, u); });
}

template <int Dim>
void Hencky<Dim>::initialise(const Batch<Dim>& batch, std::size_t begin, std::size_t end) const
{
  const Elasticity elasticity = elasticity_;
  evaluate(batch, begin, end, [elasticity](const Gradient<Dim>& u) { return respond<Dim>(elasticity, u); });
}

// In principal axes, with stretches exp(e_i) and Kirchhoff stresses t_i (Bonet & Wood, ch. 6), J a . Q a is
//   lambda (a . n)^2 + sum_i (2 mu - t_i) w_ii + sum_{i != j} (g_ij w_ij + k_ij a_i n_i a_j n_j),   w_ij = a_i^2 n_j^2,
//   g_ij = 2 mu x / (1 - exp(-2 x)), x = e_j - e_i,   k_ij = k_ji = g_ij - t_j.
// The w_ij sum to 1, and |a_i n_i a_j n_j| <= (w_ij + w_ji) / 2. The largest coefficient, with |k| = max(k, -k), is
// that of the largest e_j and the smallest e_i: 2 g_ij - t_j, or t_j. The strains follow from the stress.
template <int Dim>
Stiffness Hencky<Dim>::stiffness(const Batch<Dim>& batch, std::size_t begin, std::size_t end) const
{
  const double lambda = elasticity_.lambda, two_mu = 2.0 * elasticity_.shear;
  const Access<Dim> access(batch);
  const DeformationAccess<Dim> deformation(batch);
  double most = 0.0;
#pragma omp simd reduction(max : most)
  for (std::size_t p = begin; p < end; ++p) {
    const double change = volume_change(deformation.get(p)), mean = lambda * logarithm(change).value;
    const double scale = (1.0 + change) / two_mu;
    const Symmetric<Dim> strain = spherical_plus(-mean / two_mu, scale, access.stress(p));
    const double largest = largest_principal(strain);
    const double apart = largest + largest_principal(spherical_plus(0.0, -1.0, strain));
    const double across = two_mu * (1.0 / mean_decay(2.0 * apart) - largest) - mean, tension = mean + two_mu * largest;
    const double modulus = (lambda + (across > tension ? across : tension)) / (1.0 + change);
    most = modulus > most ? modulus : most;
  }
  return { most, damping_s_ * elasticity_.constrained };
}

template class Hencky<2>;
template class Hencky<3>;

}  // namespace geocontainer_mpm::material
