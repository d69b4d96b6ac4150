#pragma once
/// Reading and writing one particle of a batch, with the batch's pointers held as locals: the compiler then knows that
/// they do not change while the arrays are written.

#include "geocontainer_mpm/material/law.h"
#include "increment.h"

namespace geocontainer_mpm::material {

template <int Dim>
struct Access;

template <>
struct Access<2> {
  const double* __restrict l00, * __restrict l01, * __restrict l10, * __restrict l11;
  double* __restrict s00, * __restrict s11, * __restrict s01, * __restrict szz;

  explicit Access(const Batch<2>& b)
      : l00(b.velocity_gradient[0])
      , l01(b.velocity_gradient[1])
      , l10(b.velocity_gradient[2])
      , l11(b.velocity_gradient[3])
      , s00(b.stress[0])
      , s11(b.stress[1])
      , s01(b.stress[2])
      , szz(b.stress[3])
  {
  }
  Increment<2> increment(std::size_t p, double dt) const
  {
    return material::increment(dt * l00[p], dt * l01[p], dt * l10[p], dt * l11[p]);
  }
  Symmetric<2> stress(std::size_t p) const { return { s00[p], s11[p], s01[p], szz[p] }; }
  void set_stress(std::size_t p, const Symmetric<2>& s) const
  {
    s00[p] = s.s00;
    s11[p] = s.s11;
    s01[p] = s.s01;
    szz[p] = s.szz;
  }
};

template <>
struct Access<3> {
  const double* __restrict l00, * __restrict l01, * __restrict l02, * __restrict l10, * __restrict l11, * __restrict l12, * __restrict l20, * __restrict l21, * __restrict l22;
  double* __restrict s00, * __restrict s11, * __restrict s22, * __restrict s01, * __restrict s02, * __restrict s12;

  explicit Access(const Batch<3>& b)
      : l00(b.velocity_gradient[0])
      , l01(b.velocity_gradient[1])
      , l02(b.velocity_gradient[2])
      , l10(b.velocity_gradient[3])
      , l11(b.velocity_gradient[4])
      , l12(b.velocity_gradient[5])
      , l20(b.velocity_gradient[6])
      , l21(b.velocity_gradient[7])
      , l22(b.velocity_gradient[8])
      , s00(b.stress[0])
      , s11(b.stress[1])
      , s22(b.stress[2])
      , s01(b.stress[3])
      , s02(b.stress[4])
      , s12(b.stress[5])
  {
  }
  Increment<3> increment(std::size_t p, double dt) const
  {
    return material::increment(dt * l00[p], dt * l01[p], dt * l02[p], dt * l10[p], dt * l11[p], dt * l12[p],
                               dt * l20[p], dt * l21[p], dt * l22[p]);
  }
  Symmetric<3> stress(std::size_t p) const { return { s00[p], s11[p], s22[p], s01[p], s02[p], s12[p] }; }
  void set_stress(std::size_t p, const Symmetric<3>& s) const
  {
    s00[p] = s.s00;
    s11[p] = s.s11;
    s22[p] = s.s22;
    s01[p] = s.s01;
    s02[p] = s.s02;
    s12[p] = s.s12;
  }
};

template <int Dim>
void initialise_energy(const Elasticity& elasticity, const Batch<Dim>& batch, std::size_t begin, std::size_t end)
{
  const Access<Dim> access(batch);
  for (std::size_t p = begin; p < end; ++p)
    batch.elastic_energy[p] = batch.volume[p] * energy_density(elasticity, access.stress(p));
}

}  // namespace geocontainer_mpm::material
