#pragma once
/// Weakly compressible fluids without tension: what Newtonian and Bingham fluid share.
///
/// Pressure p = K (rho / rho0 - 1) with rho / rho0 = initial_volume / volume, and 0 where the fluid is thinner than
/// rho0: there it has come apart (spray, a free surface), and its volume itself remembers the gap. Stress is
/// -p I + 2 eta dev(D). D is the mid-step strain rate of increment.h, turned into the frame at the end of the step, so
/// that a rigid rotation of any size meets no resistance; the viscous stress of a step is that of its middle.
///
/// elastic_energy is the work stored by compression from initial_volume, the integral of p dV: K V0 (e - ln(1 + e)), e
/// = V / V0 - 1. dissipated grows by the viscous work 2 eta dev(D) : dev(D) V dt.

#include <cmath>

#include "batch_access.h"
#include "elementary.h"

namespace geocontainer_mpm::material {

inline double fluid_pressure(double bulk, double expansion)  // expansion = V / V0 - 1
{
  return expansion < 0.0 ? -bulk * expansion / (1.0 + expansion) : 0.0;
}

inline double fluid_energy(double bulk, double expansion)  // per initial volume
{
  const double defect = logarithm(expansion).defect;
  return expansion < 0.0 ? bulk * defect : 0.0;
}

/// Flattened: a loop with a call in it does not vectorise, and the compiler finds this body too long to inline by
/// itself. viscosity(g): of the shear rate g = sqrt(2 dev(D) : dev(D)), 1/s -> Pa s
template <int Dim, class Viscosity>
[[gnu::flatten]] void flow(double bulk, const Viscosity& viscosity, const Batch<Dim>& batch, double dt,
                           std::size_t begin, std::size_t end)
{
  const Access<Dim> access(batch);
  const double* const __restrict initial_volume = batch.initial_volume;
  double* const __restrict volume = batch.volume;
  double* const __restrict energy = batch.elastic_energy;
  double* const __restrict dissipated = batch.dissipated;
  const double per_dt = 1.0 / dt, per_step = std::abs(per_dt);
#pragma omp simd
  for (std::size_t p = begin; p < end; ++p) {
    const Increment<Dim> step = access.increment(p, dt);
    const Symmetric<Dim> shear = spherical_plus(-trace(step.strain) / 3.0, 1.0, step.strain);
    const double square = contract(shear, shear);
    const double twice_viscosity = 2.0 * viscosity(std::sqrt(2.0 * square) * per_step) * per_dt;  // per strain
    const double old_volume = volume[p], start = initial_volume[p];
    const double new_volume = old_volume * (1.0 + step.volume_change);
    const double expansion = (new_volume - start) / start;
    access.set_stress(p, spherical_plus(-fluid_pressure(bulk, expansion), twice_viscosity, shear));
    volume[p] = new_volume;
    energy[p] = start * fluid_energy(bulk, expansion);
    dissipated[p] += 0.5 * (old_volume + new_volume) * twice_viscosity * square;
  }
}

/// At rest at the given volume.
template <int Dim>
inline void fluid_at_rest(double bulk, const Batch<Dim>& batch, std::size_t begin, std::size_t end)
{
  const Access<Dim> access(batch);
  for (std::size_t p = begin; p < end; ++p) {
    const double start = batch.initial_volume[p], expansion = (batch.volume[p] - start) / start;
    access.set_stress(p, spherical_plus(-fluid_pressure(bulk, expansion), 0.0, Symmetric<Dim>{}));
    batch.elastic_energy[p] = start * fluid_energy(bulk, expansion);
  }
}

/// -V dp/dV = K rho / rho0, and K where the fluid is apart: it may meet again in the next step. A viscous stress 2 eta
/// dev(D) bounds a wave as 4/3 eta. `viscosity`: the largest at any shear rate, for anything may come to rest.
template <int Dim>
inline Stiffness fluid_stiffness(double bulk, double viscosity, const Batch<Dim>& batch, std::size_t begin,
                                 std::size_t end)
{
  double densest = 1.0;
  for (std::size_t p = begin; p < end; ++p) {
    const double density = batch.initial_volume[p] / batch.volume[p];
    densest = density > densest ? density : densest;
  }
  return { begin < end ? bulk * densest : 0.0, begin < end ? 4.0 / 3.0 * viscosity : 0.0 };
}

}  // namespace geocontainer_mpm::material
