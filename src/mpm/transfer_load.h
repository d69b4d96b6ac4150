#pragma once
/// What a particle brings to the grid before weights, for the transfers of all shapes.

#include <array>
#include <cstddef>

#include "elements.h"
#include "geocontainer_mpm/mpm/transfer.h"

/// Left to itself, GCC calls what many instances of a loop share, and hands a stencil over through memory: a seventh of
/// the time of a step.
#define GEOCONTAINER_MPM_INLINE [[gnu::always_inline]] inline

namespace geocontainer_mpm::mpm {

// Grid nodes as the compiler's own vectors: built in registers from scalars, where a fixed-size array is written to
// memory slot by slot and read back whole, which stalls every particle.
using Quad [[gnu::vector_size(32)]] = double;
using Pair [[gnu::vector_size(16)]] = double;
template <int Dim>
struct ForceVectorOf {
  using Type = Quad;
};
template <>
struct ForceVectorOf<2> {
  using Type = Pair;
};
template <int Dim>
using ForceVector = typename ForceVectorOf<Dim>::Type;
// The same where they overlie the grid's storage.
using StoredQuad [[gnu::may_alias]] = Quad;
using StoredPair [[gnu::may_alias]] = Pair;

inline StoredQuad* stored(Eigen::Array<double, 4, 1>* node)
{
  return reinterpret_cast<StoredQuad*>(node);
}
inline const StoredQuad* stored(const Eigen::Array<double, 4, 1>* node)
{
  return reinterpret_cast<const StoredQuad*>(node);
}
inline StoredPair* stored(Eigen::Array<double, 2, 1>* force)
{
  return reinterpret_cast<StoredPair*>(force);
}
inline const StoredPair* stored(const Eigen::Array<double, 2, 1>* force)
{
  return reinterpret_cast<const StoredPair*>(force);
}

/// Value of row p in column i of some columns.
template <class Columns>
double entry(const Columns& columns, int i, std::size_t p)
{
  return columns[static_cast<std::size_t>(i)][p];
}

/// What pushes, known at compile time: nothing (momentum alone), a body's stress, the same with any of the terms of
/// `Extra`, or the external force of a sheet's node.
enum class Push { nothing, stress, extra, external };

struct Extra {
  bool external_force;
  StressDamping damping;
  Smoothing smoothing;
  const double* elements;  ///< of smooth_stress(), or nullptr
};

/// Vectors per weight and per gradient, and momentum per offset.
template <int Dim>
struct Load {
  Quad momentum;  ///< and mass
  std::array<Quad, Dim> affine;
  ForceVector<Dim> body;
  std::array<ForceVector<Dim>, Dim> stress;  ///< columns of -V sigma
};

/// Column j of a symmetric tensor of order material/law.h; `s(k)` is its component k.
template <int Dim, class Component>
ForceVector<Dim> tensor_column(int j, Component&& s)
{
  if constexpr (Dim == 2)
    return j == 0 ? Pair{ s(0), s(2) } : Pair{ s(2), s(1) };
  else
    return j == 0   ? Quad{ s(0), s(3), s(4), 0.0 }
           : j == 1 ? Quad{ s(3), s(1), s(5), 0.0 }
                    : Quad{ s(4), s(5), s(2), 0.0 };
}

template <int Dim, Shape shape, Part part, bool affine, Push push>
GEOCONTAINER_MPM_INLINE Load<Dim> load_of(const Particles<Dim>& particles, std::size_t p, const Vec<Dim>& gravity,
                                          const Extra& extra, const Grid<Dim>& grid)
{
  Load<Dim> load;
  if constexpr (part != Part::force) {
    const double mass = particles.mass[p];
    const auto v = [&](int i) { return mass * entry(particles.velocity, i, p); };
    const auto c = [&](int i, int d) { return mass * entry(particles.affine, i * Dim + d, p); };
    if constexpr (Dim == 2)
      load.momentum = Quad{ v(0), v(1), 0.0, mass };
    else
      load.momentum = Quad{ v(0), v(1), v(2), mass };
    if constexpr (affine)
      for (int d = 0; d < Dim; ++d) {
        if constexpr (Dim == 2)
          load.affine[static_cast<std::size_t>(d)] = Quad{ c(0, d), c(1, d), 0.0, 0.0 };
        else
          load.affine[static_cast<std::size_t>(d)] = Quad{ c(0, d), c(1, d), c(2, d), 0.0 };
      }
  }
  if constexpr (part != Part::momentum) {
    const bool external = push == Push::external || (push == Push::extra && extra.external_force);
    const auto f = [&](int i) {
      const double weight = particles.weight_mass[p] * gravity[i];
      return external ? weight + entry(particles.force, i, p) : weight;
    };
    if constexpr (Dim == 2)
      load.body = Pair{ f(0), f(1) };
    else
      load.body = Quad{ f(0), f(1), f(2), 0.0 };
  }
  if constexpr (push == Push::stress || push == Push::extra) {
    const double factor = -particles.volume[p];
    std::array<double, in_plane<Dim>> changed;
    if constexpr (push == Push::extra) {
      if (extra.elements)
        changed = smoothed_stress<Dim, shape_of_points(shape)>(extra.smoothing, particles, p, extra.damping,
                                                               extra.elements, grid);
      else
        changed = damped_stress<Dim>(particles, p, extra.damping);
    }
    for (int d = 0; d < Dim; ++d)
      load.stress[static_cast<std::size_t>(d)] = tensor_column<Dim>(d, [&](int k) {
        if constexpr (push == Push::extra)
          return factor * changed[static_cast<std::size_t>(k)];
        else
          return factor * entry(particles.stress, k, p);
      });
  }
  return load;
}

/// x += dt v where the gather moves particles.
template <int Dim, Gather what, class Velocity>
inline void move(Velocity velocity, double dt, Particles<Dim>& particles, std::size_t p)
{
  if constexpr (what == Gather::all || what == Gather::motion || what == Gather::position)
    for (std::size_t i = 0; i < Dim; ++i)
      particles.position[i][p] += dt * velocity[i];
}

/// The blend of transfer.h from the grid's velocities at the particle, now and before the forces.
template <int Dim>
inline void blend(Quad now, ForceVector<Dim> before, double flip_fraction, Particles<Dim>& particles, std::size_t p)
{
  for (std::size_t i = 0; i < Dim; ++i) {
    const double flip = particles.velocity[i][p] + (now[i] - before[i]);
    particles.velocity[i][p] = flip_fraction * flip + (1.0 - flip_fraction) * now[i];
  }
}

}  // namespace geocontainer_mpm::mpm
