#pragma once
/// The deformation gradient of the laws with a stored energy, and the loop that they share.
///
/// F is kept; computed is with U = F - I, whose entries are exact: volume and energy then lose no digits at the small
/// strains of most soil, where J - 1 and the energy are far below the rounding of J and of tr B.

#include "batch_access.h"
#include "elementary.h"

namespace geocontainer_mpm::material {

/// U = F - I, or H = dt dv/dx.
template <int Dim>
struct Gradient;

template <>
struct Gradient<2> {
  double u00, u01, u10, u11;
};

template <>
struct Gradient<3> {
  double u00, u01, u02, u10, u11, u12, u20, u21, u22;
};

/// (I + H) (I + U) - I
inline Gradient<2> compose(const Gradient<2>& h, const Gradient<2>& u)
{
  return { u.u00 + h.u00 + (h.u00 * u.u00 + h.u01 * u.u10), u.u01 + h.u01 + (h.u00 * u.u01 + h.u01 * u.u11),
           u.u10 + h.u10 + (h.u10 * u.u00 + h.u11 * u.u10), u.u11 + h.u11 + (h.u10 * u.u01 + h.u11 * u.u11) };
}

inline Gradient<3> compose(const Gradient<3>& h, const Gradient<3>& u)
{
  return { u.u00 + h.u00 + (h.u00 * u.u00 + h.u01 * u.u10 + h.u02 * u.u20),
           u.u01 + h.u01 + (h.u00 * u.u01 + h.u01 * u.u11 + h.u02 * u.u21),
           u.u02 + h.u02 + (h.u00 * u.u02 + h.u01 * u.u12 + h.u02 * u.u22),
           u.u10 + h.u10 + (h.u10 * u.u00 + h.u11 * u.u10 + h.u12 * u.u20),
           u.u11 + h.u11 + (h.u10 * u.u01 + h.u11 * u.u11 + h.u12 * u.u21),
           u.u12 + h.u12 + (h.u10 * u.u02 + h.u11 * u.u12 + h.u12 * u.u22),
           u.u20 + h.u20 + (h.u20 * u.u00 + h.u21 * u.u10 + h.u22 * u.u20),
           u.u21 + h.u21 + (h.u20 * u.u01 + h.u21 * u.u11 + h.u22 * u.u21),
           u.u22 + h.u22 + (h.u20 * u.u02 + h.u21 * u.u12 + h.u22 * u.u22) };
}

inline double second_order_volume(const Gradient<2>& u)  // det(I + U) - 1 - tr U
{
  return u.u00 * u.u11 - u.u01 * u.u10;
}

inline double second_order_volume(const Gradient<3>& u)
{
  const double minors =
      (u.u00 * u.u11 - u.u01 * u.u10) + (u.u00 * u.u22 - u.u02 * u.u20) + (u.u11 * u.u22 - u.u12 * u.u21);
  return minors + (u.u00 * (u.u11 * u.u22 - u.u12 * u.u21) - u.u01 * (u.u10 * u.u22 - u.u12 * u.u20) +
                   u.u02 * (u.u10 * u.u21 - u.u11 * u.u20));
}

inline double trace(const Gradient<2>& u)
{
  return u.u00 + u.u11;
}
inline double trace(const Gradient<3>& u)
{
  return u.u00 + u.u11 + u.u22;
}

/// J - 1 = det(I + U) - 1
template <int Dim>
inline double volume_change(const Gradient<Dim>& u)
{
  return trace(u) + second_order_volume(u);
}

inline double square(const Gradient<2>& u)  // U : U
{
  return u.u00 * u.u00 + u.u01 * u.u01 + u.u10 * u.u10 + u.u11 * u.u11;
}
inline double square(const Gradient<3>& u)
{
  return u.u00 * u.u00 + u.u01 * u.u01 + u.u02 * u.u02 + u.u10 * u.u10 + u.u11 * u.u11 + u.u12 * u.u12 + u.u20 * u.u20 +
         u.u21 * u.u21 + u.u22 * u.u22;
}

/// B - I = F F^T - I; out of plane zero.
inline Symmetric<2> left_strain(const Gradient<2>& u)
{
  return { 2.0 * u.u00 + (u.u00 * u.u00 + u.u01 * u.u01), 2.0 * u.u11 + (u.u10 * u.u10 + u.u11 * u.u11),
           u.u01 + u.u10 + (u.u00 * u.u10 + u.u01 * u.u11), 0.0 };
}

inline Symmetric<3> left_strain(const Gradient<3>& u)
{
  return { 2.0 * u.u00 + (u.u00 * u.u00 + u.u01 * u.u01 + u.u02 * u.u02),
           2.0 * u.u11 + (u.u10 * u.u10 + u.u11 * u.u11 + u.u12 * u.u12),
           2.0 * u.u22 + (u.u20 * u.u20 + u.u21 * u.u21 + u.u22 * u.u22),
           u.u01 + u.u10 + (u.u00 * u.u10 + u.u01 * u.u11 + u.u02 * u.u12),
           u.u02 + u.u20 + (u.u00 * u.u20 + u.u01 * u.u21 + u.u02 * u.u22),
           u.u12 + u.u21 + (u.u10 * u.u20 + u.u11 * u.u21 + u.u12 * u.u22) };
}

template <int Dim>
struct DeformationAccess;

template <>
struct DeformationAccess<2> {
  double* __restrict f00, * __restrict f01, * __restrict f10, * __restrict f11;
  explicit DeformationAccess(const Batch<2>& b)
      : f00(b.deformation[0]), f01(b.deformation[1]), f10(b.deformation[2]), f11(b.deformation[3])
  {
  }
  Gradient<2> get(std::size_t p) const { return { f00[p] - 1.0, f01[p], f10[p], f11[p] - 1.0 }; }
  void set(std::size_t p, const Gradient<2>& u) const
  {
    f00[p] = 1.0 + u.u00;
    f01[p] = u.u01;
    f10[p] = u.u10;
    f11[p] = 1.0 + u.u11;
  }
};

template <>
struct DeformationAccess<3> {
  double* __restrict f00, * __restrict f01, * __restrict f02, * __restrict f10, * __restrict f11, * __restrict f12, * __restrict f20, * __restrict f21, * __restrict f22;
  explicit DeformationAccess(const Batch<3>& b)
      : f00(b.deformation[0])
      , f01(b.deformation[1])
      , f02(b.deformation[2])
      , f10(b.deformation[3])
      , f11(b.deformation[4])
      , f12(b.deformation[5])
      , f20(b.deformation[6])
      , f21(b.deformation[7])
      , f22(b.deformation[8])
  {
  }
  Gradient<3> get(std::size_t p) const
  {
    return { f00[p] - 1.0, f01[p], f02[p], f10[p], f11[p] - 1.0, f12[p], f20[p], f21[p], f22[p] - 1.0 };
  }
  void set(std::size_t p, const Gradient<3>& u) const
  {
    f00[p] = 1.0 + u.u00;
    f01[p] = u.u01;
    f02[p] = u.u02;
    f10[p] = u.u10;
    f11[p] = 1.0 + u.u11;
    f12[p] = u.u12;
    f20[p] = u.u20;
    f21[p] = u.u21;
    f22[p] = 1.0 + u.u22;
  }
};

inline Gradient<2> displacement(const Access<2>& a, std::size_t p, double dt)
{
  return { dt * a.l00[p], dt * a.l01[p], dt * a.l10[p], dt * a.l11[p] };
}

inline Gradient<3> displacement(const Access<3>& a, std::size_t p, double dt)
{
  return { dt * a.l00[p], dt * a.l01[p], dt * a.l02[p], dt * a.l10[p], dt * a.l11[p],
           dt * a.l12[p], dt * a.l20[p], dt * a.l21[p], dt * a.l22[p] };
}

/// What a law with a stored energy answers to F.
template <int Dim>
struct Response {
  Symmetric<Dim> stress;  ///< Cauchy, Pa
  double volume_change;   ///< J - 1
  double energy;          ///< stored per reference volume, J/m^3
};

/// Flattened: a loop with a call in it does not vectorise, and the compiler finds this body too long to inline by
/// itself. respond(U) -> Response<Dim>, for the present F of each particle.
template <int Dim, class Respond>
[[gnu::flatten]] void evaluate(const Batch<Dim>& batch, std::size_t begin, std::size_t end, const Respond& respond)
{
  const Access<Dim> access(batch);
  const DeformationAccess<Dim> deformation(batch);
  const double* const __restrict initial_volume = batch.initial_volume;
  double* const __restrict volume = batch.volume;
  double* const __restrict energy = batch.elastic_energy;
#pragma omp simd
  for (std::size_t p = begin; p < end; ++p) {
    const Response<Dim> response = respond(deformation.get(p));
    access.set_stress(p, response.stress);
    volume[p] = initial_volume[p] * (1.0 + response.volume_change);
    energy[p] = initial_volume[p] * response.energy;
  }
}

/// The same after F <- (I + dt dv/dx) F.
template <int Dim, class Respond>
[[gnu::flatten]] void advance(const Batch<Dim>& batch, double dt, std::size_t begin, std::size_t end,
                              const Respond& respond)
{
  const Access<Dim> access(batch);
  const DeformationAccess<Dim> deformation(batch);
  const double* const __restrict initial_volume = batch.initial_volume;
  double* const __restrict volume = batch.volume;
  double* const __restrict energy = batch.elastic_energy;
#pragma omp simd
  for (std::size_t p = begin; p < end; ++p) {
    const Gradient<Dim> u = compose(displacement(access, p, dt), deformation.get(p));
    deformation.set(p, u);
    const Response<Dim> response = respond(u);
    access.set_stress(p, response.stress);
    volume[p] = initial_volume[p] * (1.0 + response.volume_change);
    energy[p] = initial_volume[p] * response.energy;
  }
}

}  // namespace geocontainer_mpm::material
