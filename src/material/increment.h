#pragma once
/// Strain, rotation and volume change of one step, and the objective elastic trial stress.
///
/// The grid moves a point by x_new = x + dt v(x), so the step maps by F = I + H with H = dt dv/dx. Hughes & Winget
/// (1980) take strain and spin from the gradient with respect to the mid-step positions, G = H (I + H / 2)^-1: its
/// symmetric part vanishes when F is a rotation of any size, and the Cayley transform of its skew part is that rotation
/// exactly. (The symmetric part of H itself would shrink a turning body by half the squared angle in every step.) The
/// volume follows the same map: V_new = V det F; volume_change holds det F - 1 without cancellation.
///
/// Everything is written out in scalars, free of branches, so that the loop over particles vectorises.

#include <cmath>

#include "elasticity.h"

namespace geocontainer_mpm::material {

/// Symmetric tensors, in the order of stress_size.
template <int Dim>
struct Symmetric;

template <>
struct Symmetric<2> {
  double s00, s11, s01, szz;
};

template <>
struct Symmetric<3> {
  double s00, s11, s22, s01, s02, s12;
};

inline double trace(const Symmetric<2>& a)
{
  return a.s00 + a.s11 + a.szz;
}
inline double trace(const Symmetric<3>& a)
{
  return a.s00 + a.s11 + a.s22;
}

inline double contract(const Symmetric<2>& a, const Symmetric<2>& b)
{
  return a.s00 * b.s00 + a.s11 * b.s11 + a.szz * b.szz + 2.0 * a.s01 * b.s01;
}

inline double contract(const Symmetric<3>& a, const Symmetric<3>& b)
{
  return a.s00 * b.s00 + a.s11 * b.s11 + a.s22 * b.s22 + 2.0 * (a.s01 * b.s01 + a.s02 * b.s02 + a.s12 * b.s12);
}

/// a + factor * b
inline Symmetric<2> add(const Symmetric<2>& a, double factor, const Symmetric<2>& b)
{
  return { a.s00 + factor * b.s00, a.s11 + factor * b.s11, a.s01 + factor * b.s01, a.szz + factor * b.szz };
}

inline Symmetric<3> add(const Symmetric<3>& a, double factor, const Symmetric<3>& b)
{
  return { a.s00 + factor * b.s00, a.s11 + factor * b.s11, a.s22 + factor * b.s22,
           a.s01 + factor * b.s01, a.s02 + factor * b.s02, a.s12 + factor * b.s12 };
}

/// mean * I + factor * b
inline Symmetric<2> spherical_plus(double mean, double factor, const Symmetric<2>& b)
{
  return { mean + factor * b.s00, mean + factor * b.s11, factor * b.s01, mean + factor * b.szz };
}

inline Symmetric<3> spherical_plus(double mean, double factor, const Symmetric<3>& b)
{
  return { mean + factor * b.s00, mean + factor * b.s11, mean + factor * b.s22,
           factor * b.s01,        factor * b.s02,        factor * b.s12 };
}

/// Stress of an elastic strain, Pa. In plane strain the strain's szz is zero and the stress's is not.
template <int Dim>
inline Symmetric<Dim> elastic_stress(const Elasticity& elasticity, const Symmetric<Dim>& strain)
{
  return spherical_plus(elasticity.lambda * trace(strain), 2.0 * elasticity.shear, strain);
}

/// Stored energy per volume, J/m^3.
template <int Dim>
inline double energy_density(const Elasticity& elasticity, const Symmetric<Dim>& stress)
{
  const double sum = trace(stress);
  return elasticity.energy_full * contract(stress, stress) + elasticity.energy_trace * sum * sum;
}

struct Rotation {
  double r00, r01, r02, r10, r11, r12, r20, r21, r22;
};

/// Of the quaternion (w, x, y, z), which need not have unit length.
inline Rotation rotation_of(double w, double x, double y, double z)
{
  const double ww = w * w, xx = x * x, yy = y * y, zz = z * z, norm = 1.0 / (ww + xx + yy + zz), twice = 2.0 * norm;
  return { (ww + xx - yy - zz) * norm, twice * (x * y - w * z),    twice * (x * z + w * y),
           twice * (x * y + w * z),    (ww - xx + yy - zz) * norm, twice * (y * z - w * x),
           twice * (x * z - w * y),    twice * (y * z + w * x),    (ww - xx - yy + zz) * norm };
}

inline Symmetric<3> rotate(const Symmetric<3>& s, const Rotation& by)
{
  const double t00 = by.r00 * s.s00 + by.r01 * s.s01 + by.r02 * s.s02;
  const double t01 = by.r00 * s.s01 + by.r01 * s.s11 + by.r02 * s.s12;
  const double t02 = by.r00 * s.s02 + by.r01 * s.s12 + by.r02 * s.s22;
  const double t10 = by.r10 * s.s00 + by.r11 * s.s01 + by.r12 * s.s02;
  const double t11 = by.r10 * s.s01 + by.r11 * s.s11 + by.r12 * s.s12;
  const double t12 = by.r10 * s.s02 + by.r11 * s.s12 + by.r12 * s.s22;
  const double t20 = by.r20 * s.s00 + by.r21 * s.s01 + by.r22 * s.s02;
  const double t21 = by.r20 * s.s01 + by.r21 * s.s11 + by.r22 * s.s12;
  const double t22 = by.r20 * s.s02 + by.r21 * s.s12 + by.r22 * s.s22;
  return { t00 * by.r00 + t01 * by.r01 + t02 * by.r02, t10 * by.r10 + t11 * by.r11 + t12 * by.r12,
           t20 * by.r20 + t21 * by.r21 + t22 * by.r22, t00 * by.r10 + t01 * by.r11 + t02 * by.r12,
           t00 * by.r20 + t01 * by.r21 + t02 * by.r22, t10 * by.r20 + t11 * by.r21 + t12 * by.r22 };
}

template <int Dim>
struct Increment;

template <>
struct Increment<2> {
  Symmetric<2> strain;          ///< in the frame at the end of the step
  double volume_change;         ///< det F - 1
  double cos_twice, sin_twice;  ///< of twice the rotation angle: what turns a tensor
};

template <>
struct Increment<3> {
  Symmetric<3> strain;   ///< in the frame at the end of the step
  double volume_change;  ///< det F - 1
  Rotation rotation;
};

/// hij = dt dv_i/dx_j
inline Increment<2> increment(double h00, double h01, double h10, double h11)
{
  const double sum = h00 + h11, det = h00 * h11 - h01 * h10;
  // In two dimensions H (I + H / 2)^-1 = (H + det(H) / 2 I) / det(I + H / 2).
  const double inverse = 1.0 / (1.0 + 0.5 * sum + 0.25 * det);
  const double tan_half = 0.25 * (h10 - h01) * inverse;
  const double square = tan_half * tan_half, norm = 1.0 / (1.0 + square);
  const double cosine = (1.0 - square) * norm, sine = 2.0 * tan_half * norm;
  const double mean = 0.5 * (sum + det) * inverse, half = 0.5 * (h00 - h11) * inverse,
               shear = 0.5 * (h01 + h10) * inverse;
  const double turned = cosine * half - sine * shear;
  return { { mean + turned, mean - turned, sine * half + cosine * shear, 0.0 },
           sum + det,
           (cosine - sine) * (cosine + sine),
           2.0 * cosine * sine };
}

inline Increment<3> increment(double h00, double h01, double h02, double h10, double h11, double h12, double h20,
                              double h21, double h22)
{
  const double m00 = 1.0 + 0.5 * h00, m11 = 1.0 + 0.5 * h11, m22 = 1.0 + 0.5 * h22;
  const double m01 = 0.5 * h01, m02 = 0.5 * h02, m10 = 0.5 * h10, m12 = 0.5 * h12, m20 = 0.5 * h20, m21 = 0.5 * h21;
  const double a00 = m11 * m22 - m12 * m21, a01 = m02 * m21 - m01 * m22, a02 = m01 * m12 - m02 * m11;
  const double a10 = m12 * m20 - m10 * m22, a11 = m00 * m22 - m02 * m20, a12 = m02 * m10 - m00 * m12;
  const double a20 = m10 * m21 - m11 * m20, a21 = m01 * m20 - m00 * m21, a22 = m00 * m11 - m01 * m10;
  const double inverse = 1.0 / (m00 * a00 + m01 * a10 + m02 * a20);
  const double g00 = (h00 * a00 + h01 * a10 + h02 * a20) * inverse, g01 = (h00 * a01 + h01 * a11 + h02 * a21) * inverse;
  const double g02 = (h00 * a02 + h01 * a12 + h02 * a22) * inverse, g10 = (h10 * a00 + h11 * a10 + h12 * a20) * inverse;
  const double g11 = (h10 * a01 + h11 * a11 + h12 * a21) * inverse, g12 = (h10 * a02 + h11 * a12 + h12 * a22) * inverse;
  const double g20 = (h20 * a00 + h21 * a10 + h22 * a20) * inverse, g21 = (h20 * a01 + h21 * a11 + h22 * a21) * inverse;
  const double g22 = (h20 * a02 + h21 * a12 + h22 * a22) * inverse;

  const double minors = (h00 * h11 - h01 * h10) + (h00 * h22 - h02 * h20) + (h11 * h22 - h12 * h21);
  const double det = h00 * (h11 * h22 - h12 * h21) - h01 * (h10 * h22 - h12 * h20) + h02 * (h10 * h21 - h11 * h20);

  // The Cayley transform of a spin with half axial vector (x, y, z) is the rotation of the quaternion (1, x, y, z).
  const double x = 0.25 * (g21 - g12), y = 0.25 * (g02 - g20), z = 0.25 * (g10 - g01);
  const Symmetric<3> middle{ g00, g11, g22, 0.5 * (g01 + g10), 0.5 * (g02 + g20), 0.5 * (g12 + g21) };
  const double half_w = 1.0 + std::sqrt(1.0 + x * x + y * y + z * z);
  return { rotate(middle, rotation_of(half_w, x, y, z)), (h00 + h11 + h22) + minors + det, rotation_of(1.0, x, y, z) };
}

inline Symmetric<2> rotate(const Symmetric<2>& s, const Increment<2>& by)
{
  const double mean = 0.5 * (s.s00 + s.s11), half = 0.5 * (s.s00 - s.s11);
  const double turned = by.cos_twice * half - by.sin_twice * s.s01;
  return { mean + turned, mean - turned, by.sin_twice * half + by.cos_twice * s.s01, s.szz };
}

inline Symmetric<3> rotate(const Symmetric<3>& s, const Increment<3>& by)
{
  return rotate(s, by.rotation);
}

}  // namespace geocontainer_mpm::material
