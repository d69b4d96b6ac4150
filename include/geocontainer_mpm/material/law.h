#pragma once
/// Constitutive laws act on a batch of particles at once: one virtual call a batch, none a particle.

#include <array>
#include <cstddef>
#include <memory>

#include "geocontainer_mpm/material/parameters.h"

namespace geocontainer_mpm::material {

/// Components of a symmetric tensor kept per particle. Dim 2 (plane strain): 00, 11, 01, out-of-plane normal.
/// Dim 3: 00, 11, 22, 01, 02, 12.
template <int Dim>
inline constexpr int stress_size = Dim == 2 ? 4 : 6;

/// Structure-of-arrays view of the particles of one body; every pointer is an array over particles, none overlaps
/// another. The step maps positions by x + dt v(x): strain, rotation and volume are those of the map I + dt dv/dx,
/// exactly so for a rotation of any size.
template <int Dim>
struct Batch {
  std::array<const double*, Dim * Dim>
      velocity_gradient;  ///< [i * Dim + j] = dv_i/dx_j, 1/s: mid-step velocity, start-of-step positions
  std::array<double*, stress_size<Dim>> stress;  ///< Cauchy stress, Pa, tension positive; updated
  double* volume;                                ///< current volume (per unit width in 2-D), m^2 or m^3; updated
  double* separated_strain;  ///< logarithmic volume strain opened by tension and not yet closed, >= 0; updated
  double* elastic_energy;    ///< stored energy of the particle, J(/m): volume times sigma : C^-1 : sigma / 2; updated
  double* dissipated;        ///< accumulated plastic work of the particle, J(/m); updated
};

template <int Dim>
class Law {
public:
  virtual ~Law() = default;
  /// Advances particles [begin, end) by one step of dt seconds. Touches nothing else: callers split a batch freely
  /// over threads. Never throws, never allocates.
  virtual void update(const Batch<Dim>& batch, double dt, std::size_t begin, std::size_t end) const = 0;
  /// Volume and stored energy are consistent with a given stress: sets elastic_energy of [begin, end).
  virtual void initialise(const Batch<Dim>& batch, std::size_t begin, std::size_t end) const = 0;
};

/// Parameters must be valid. Instantiated for Dim 2 and 3.
template <int Dim>
std::unique_ptr<Law<Dim>> make_law(const Parameters& parameters);

/// Constrained (oedometer) modulus lambda + 2 G, Pa: bounds every wave speed of the laws here.
double constrained_modulus(const Parameters& parameters);
/// Shear modulus G, Pa.
double shear_modulus(const Parameters& parameters);

}  // namespace geocontainer_mpm::material
