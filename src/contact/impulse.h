#pragma once
/// Impulses at points, their friction, and how wide points are: shared by contact with boundary bodies and with sheets.

#include <algorithm>
#include <cmath>

#include "geocontainer_mpm/contact/contact_solver.h"

namespace geocontainer_mpm::contact {

/// Cells behind a surface within which a stray grain is seen.
constexpr double stray_cells = 4.0;

/// Half the width of a particle: of a square or a cube of its volume, m.
template <int Dim>
double half_width(double volume)
{
  return 0.5 * (Dim == 2 ? std::sqrt(volume) : std::cbrt(volume));
}

/// The part of a vector along the surface.
template <int Dim>
Drag<Dim> along_surface(const Vec<Dim>& v, const Vec<Dim>& normal)
{
  if constexpr (Dim == 2)
    return Drag<2>(v.dot(left_normal(normal)));
  else
    return v - v.dot(normal) * normal;
}

/// Nearest drag that friction can give.
template <int Dim>
Drag<Dim> within(const Drag<Dim>& drag, double limit)
{
  if constexpr (Dim == 2) {
    return Drag<2>(std::clamp(drag[0], -limit, limit));
  } else {
    const double size = drag.norm();
    return size > limit ? Drag<Dim>(limit / size * drag) : drag;
  }
}

template <int Dim>
Vec<Dim> impulse_of(double pressed, const Drag<Dim>& dragged, const Vec<Dim>& normal)
{
  if constexpr (Dim == 2)
    return pressed * normal + dragged[0] * left_normal(normal);
  else
    return pressed * normal + dragged;
}

}  // namespace geocontainer_mpm::contact
