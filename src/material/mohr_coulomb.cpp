#include "mohr_coulomb.h"

#include <algorithm>
#include <cmath>

#include "bounds.h"
#include "spectral.h"

namespace geocontainer_mpm::material {
namespace {

constexpr std::size_t chunk_size = 128;  // its arrays stay in the first-level cache

// Bank beyond which a grain is alone.
const double most_apart = std::log(10.0);

// How far a stress may be beyond yield or cut-off, Pa: exact in plane strain.
inline double excess(const PrincipalReturn& surface, const Symmetric<2>& s)
{
  const double mean = 0.5 * (s.s00 + s.s11), half = 0.5 * (s.s00 - s.s11);
  const double radius = std::sqrt(half * half + s.s01 * s.s01);
  const double high = mean + radius, low = mean - radius;
  const double s1 = high > s.szz ? high : s.szz, s3 = low < s.szz ? low : s.szz;
  const double shear = surface.shear_excess(s1, s3), tension = surface.tension_excess(s1);
  return shear > tension ? shear : tension;
}

// In three dimensions an upper bound from the invariants, without eigenvalues: the largest that k s1 - s3 and s1 can be
// over all Lode angles. The particles in between are found elastic by their principal stresses.
inline double excess(const PrincipalReturn& surface, const Symmetric<3>& s)
{
  const double mean = (s.s00 + s.s11 + s.s22) / 3.0;
  const double d0 = s.s00 - mean, d1 = s.s11 - mean, d2 = s.s22 - mean;
  const double j2 = 0.5 * (d0 * d0 + d1 * d1 + d2 * d2) + s.s01 * s.s01 + s.s02 * s.s02 + s.s12 * s.s12;
  const double reach = 2.0 * std::sqrt(j2 / 3.0), k = surface.slope();
  // The margin covers the rounding of this bound against that of the eigenvalues.
  const double shear = (k - 1.0) * mean + (1.0 + 1e-12) * reach * std::sqrt(k * k + k + 1.0) - surface.strength();
  const double tension = mean + (1.0 + 1e-12) * reach - surface.cutoff();
  return shear > tension ? shear : tension;
}

// ln(1 + x): the series of the inverse hyperbolic tangent for the small steps that are the rule.
inline double log_one_plus(double x)
{
  const double z = x / (2.0 + x), square = z * z;
  if (square < 1e-4)
    return 2.0 * z * (1.0 + square * (1.0 / 3.0 + square * (1.0 / 5.0 + square * (1.0 / 7.0 + square / 9.0))));
  return std::log1p(x);
}

// The bank is to follow ln det F, from which the trace of the strain differs in third order. That difference goes with
// the share of the step that opened.
template <class Step>
double third_order(const Step& step, double opening)
{
  if (opening <= 0.0)
    return 0.0;
  const double strain = trace(step.strain);
  return std::min(1.0, opening / std::abs(strain)) * (log_one_plus(step.volume_change) - strain);
}

template <int Dim>
Symmetric<Dim> zero()
{
  return {};
}

}  // namespace

template <int Dim>
struct MohrCoulomb<Dim>::Step {
  Symmetric<Dim> strain;
  double volume_change;  ///< det F - 1
  double old_volume;
  double old_energy;  ///< stored energy per volume before the step, J/m^3
  double old_stored;  ///< stored energy before the step, J(/m)
};

template <>
struct MohrCoulomb<2>::Chunk {
  double e00[chunk_size], e11[chunk_size], e01[chunk_size];
  double volume_change[chunk_size], old_volume[chunk_size], old_energy[chunk_size], old_stored[chunk_size];
  double excess[chunk_size];
  void set_strain(std::size_t i, const Symmetric<2>& e)
  {
    e00[i] = e.s00;
    e11[i] = e.s11;
    e01[i] = e.s01;
  }
  Symmetric<2> strain(std::size_t i) const { return { e00[i], e11[i], e01[i], 0.0 }; }
};

template <>
struct MohrCoulomb<3>::Chunk {
  double e00[chunk_size], e11[chunk_size], e22[chunk_size], e01[chunk_size], e02[chunk_size], e12[chunk_size];
  double volume_change[chunk_size], old_volume[chunk_size], old_energy[chunk_size], old_stored[chunk_size];
  double excess[chunk_size];
  void set_strain(std::size_t i, const Symmetric<3>& e)
  {
    e00[i] = e.s00;
    e11[i] = e.s11;
    e22[i] = e.s22;
    e01[i] = e.s01;
    e02[i] = e.s02;
    e12[i] = e.s12;
  }
  Symmetric<3> strain(std::size_t i) const { return { e00[i], e11[i], e22[i], e01[i], e02[i], e12[i] }; }
};

template <int Dim>
void MohrCoulomb<Dim>::update(const Batch<Dim>& batch, double dt, std::size_t begin, std::size_t end) const
{
  Chunk chunk;
  for (std::size_t first = begin; first < end; first += chunk_size) {
    const std::size_t count = std::min(chunk_size, end - first);
    elastic_pass(batch, dt, first, first + count, chunk);
    for (std::size_t i = 0; i < count; ++i)
      if (chunk.excess[i] > 0.0)
        correct(
            batch, first + i,
            { chunk.strain(i), chunk.volume_change[i], chunk.old_volume[i], chunk.old_energy[i], chunk.old_stored[i] });
  }
}

// Advances every particle as if it stayed elastic and marks those that may not have, or that have a bank.
template <int Dim>
void MohrCoulomb<Dim>::elastic_pass(const Batch<Dim>& batch, double dt, std::size_t begin, std::size_t end,
                                    Chunk& chunk) const
{
  const Elasticity elasticity = elasticity_;
  const PrincipalReturn surface = surface_;
  const Access<Dim> access(batch);
  double* const __restrict volume = batch.volume;
  double* const __restrict energy = batch.elastic_energy;
  const double* const __restrict bank = batch.separated_strain;
#pragma omp simd
  for (std::size_t p = begin; p < end; ++p) {
    const std::size_t i = p - begin;
    const Increment<Dim> step = access.increment(p, dt);
    const Symmetric<Dim> old = access.stress(p);
    const Symmetric<Dim> trial = add(rotate(old, step), 1.0, elastic_stress(elasticity, step.strain));
    const double old_volume = volume[p], new_volume = old_volume * (1.0 + step.volume_change);
    const double beyond = excess(surface, trial), old_energy = energy_density(elasticity, old);
    chunk.set_strain(i, step.strain);
    chunk.volume_change[i] = step.volume_change;
    chunk.old_volume[i] = old_volume;
    chunk.old_energy[i] = old_energy;
    chunk.old_stored[i] = energy[p];
    chunk.excess[i] = beyond > bank[p] ? beyond : bank[p];
    access.set_stress(p, trial);
    volume[p] = new_volume;
    energy[p] += 0.5 * (old_volume + new_volume) * (energy_density(elasticity, trial) - old_energy);
  }
}

// Is a particle with something in its bank apart in this step? Either it has no stress, or its gap begins to close:
// then tension unloads elastically, and what is left of it goes as soon as anything would press.
template <int Dim>
bool MohrCoulomb<Dim>::is_apart(const Step& step, const Symmetric<Dim>& old, const Symmetric<Dim>& trial) const
{
  if (step.old_energy == 0.0)
    return true;
  if (surface_.cutoff() == 0.0 || step.volume_change >= 0.0)
    return false;
  const double pressed = -1e-9 * surface_.cutoff();  // rounding is no pressure
  return Spectral<Dim>(old).values().s3 >= pressed && Spectral<Dim>(trial).values().s3 < pressed;
}

// The bank of a particle that is apart follows its volume. True: it still is, and has no stress. False: the gap has
// closed, and `trial` becomes the elastic stress of the share of the strain that is left.
template <int Dim>
bool MohrCoulomb<Dim>::stays_apart(const Step& step, const Symmetric<Dim>& old, Symmetric<Dim>& trial,
                                   double& bank) const
{
  const double stretch = log_one_plus(step.volume_change);
  bank += stretch + trace(old) / (3.0 * elasticity_.bulk);
  if (bank >= 0.0)
    return true;
  trial = add(zero<Dim>(), bank / stretch, elastic_stress(elasticity_, step.strain));
  bank = 0.0;
  return false;
}

template <int Dim>
void MohrCoulomb<Dim>::correct(const Batch<Dim>& batch, std::size_t particle, const Step& step) const
{
  const Access<Dim> access(batch);
  const Symmetric<Dim> full_trial = access.stress(particle);
  // The stress before the step, turned with the material.
  const Symmetric<Dim> old = add(full_trial, -1.0, elastic_stress(elasticity_, step.strain));
  Symmetric<Dim> trial = full_trial, stress = zero<Dim>();
  double bank = batch.separated_strain[particle];
  const bool apart = bank > 0.0 && is_apart(step, old, trial);
  if (!(apart && stays_apart(step, old, trial, bank))) {
    const Spectral<Dim> spectral(trial);
    Principal values = spectral.values();
    bool elastic = !apart;
    if (bank > 0.0 && values.s1 < 0.0) {
      // A crack under load along it: it gives way first, at zero stress across the largest principal stress.
      const double closing = std::min(bank, -values.s1 / elasticity_.constrained);
      values.s1 = closing < bank ? 0.0 : values.s1 + elasticity_.constrained * closing;
      values.s2 += elasticity_.lambda * closing;
      values.s3 += elasticity_.lambda * closing;
      bank -= closing;
      elastic = false;
    }
    if (surface_.shear_excess(values.s1, values.s3) > 0.0 || surface_.tension_excess(values.s1) > 0.0) {
      const Returned returned = surface_.map(values);
      values = returned.stress;
      bank = std::max(0.0, bank + returned.opening + third_order(step, returned.opening));
      elastic = false;
    }
    if (elastic)
      return;  // the elastic pass was right
    stress = spectral.compose(values);
  }

  double energy = energy_density(elasticity_, stress);
  if (bank > 0.0 && energy <= no_energy_) {
    stress = zero<Dim>();
    energy = 0.0;
  }
  const double mid_volume = step.old_volume * (1.0 + 0.5 * step.volume_change);
  const double work = 0.5 * contract(add(old, 1.0, stress), step.strain);
  const double stored = energy > 0.0 ? step.old_stored + mid_volume * (energy - step.old_energy) : 0.0;
  batch.elastic_energy[particle] = stored;
  batch.dissipated[particle] += mid_volume * work - (stored - step.old_stored);
  if (energy == 0.0 && bank > most_apart) {
    batch.volume[particle] *= std::exp(most_apart - bank);
    bank = most_apart;
  }
  access.set_stress(particle, stress);
  batch.separated_strain[particle] = bank;
}

template <int Dim>
void MohrCoulomb<Dim>::initialise(const Batch<Dim>& batch, std::size_t begin, std::size_t end) const
{
  initialise_energy(elasticity_, batch, begin, end);
}

// Also of particles that are apart: they may meet again in the next step.
template <int Dim>
Stiffness MohrCoulomb<Dim>::stiffness(const Batch<Dim>& batch, std::size_t begin, std::size_t end) const
{
  return { constrained_ + geometric_stiffness(batch, begin, end), damping_s_ * elasticity_.constrained };
}

template class MohrCoulomb<2>;
template class MohrCoulomb<3>;

}  // namespace geocontainer_mpm::material
