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
  std::array<double*, Dim * Dim> deformation{};  ///< F = dx/dX, row-major (its out-of-plane entry is 1 in plane
                                                 ///< strain); updated by laws that need it, may be null for the others
  std::array<double*, stress_size<Dim>> stress;  ///< Cauchy stress, Pa, tension positive; updated
  const double* initial_volume{};                ///< volume at F = I, at density_kg_per_m3 for a fluid, m^2 or m^3
  double* volume;                                ///< current volume (per unit width in 2-D), m^2 or m^3; updated
  double* separated_strain;  ///< logarithmic volume strain opened by tension and not yet closed, >= 0; updated
  double* elastic_energy;    ///< stored energy of the particle, J(/m), see each law; updated
  double* dissipated;        ///< accumulated plastic or viscous work of the particle, J(/m); updated
};

/// What a time step has to resolve, bounds over some particles.
struct Stiffness {
  /// The acoustic tensor, geometric part included: a . d(sigma n) per displacement gradient a n^T, for unit vectors a
  /// and n, is nowhere larger, Pa.
  double constrained_modulus;
  double viscosity;  ///< the same per rate of the displacement gradient, lambda_v + 2 mu_v of a linear fluid, Pa s
};

template <int Dim>
class Law {
public:
  virtual ~Law() = default;
  /// Advances particles [begin, end) by one step of dt seconds, dt != 0. Touches nothing else: callers split a batch
  /// freely over threads. Never throws, never allocates. A particle turned inside out is left with a volume <= 0 and
  /// meaningless stress: the caller has to look.
  virtual void update(const Batch<Dim>& batch, double dt, std::size_t begin, std::size_t end) const = 0;
  /// Makes the state of [begin, end) consistent before the first step. Laws of rate form (linear_elastic,
  /// mohr_coulomb) take volume and stress as given and set elastic_energy. Laws with a deformation gradient take it and
  /// initial_volume, and set volume, stress and elastic_energy: they cannot represent a stress that does not belong to
  /// F, such as K0. Fluids take volume and initial_volume, and set stress (at rest) and elastic_energy: a hydrostatic
  /// start is volume < initial_volume.
  virtual void initialise(const Batch<Dim>& batch, std::size_t begin, std::size_t end) const = 0;
  /// Whether update() reads and writes Batch::deformation.
  virtual bool needs_deformation() const { return false; }
  /// Bounds over [begin, end) in their present state; zero for none.
  virtual Stiffness stiffness(const Batch<Dim>& batch, std::size_t begin, std::size_t end) const = 0;
};

/// Parameters must be valid. Instantiated for Dim 2 and 3.
template <int Dim>
std::unique_ptr<Law<Dim>> make_law(const Parameters& parameters);

/// Constrained (oedometer) modulus lambda + 2 G of the unstrained material, K of a fluid, Pa.
double constrained_modulus(const Parameters& parameters);
/// Shear modulus G, 0 for a fluid, Pa.
double shear_modulus(const Parameters& parameters);

struct DampingModuli {
  double lambda, shear;  ///< beta times Lame's constants, Pa s
};
/// Stiffness-proportional damping adds lambda tr(D) I + 2 shear D to the law's stress, D the rate of strain. The laws'
/// update() does not: the transfer adds it to the internal force, from the velocity gradient that a particle keeps, so
/// that it never becomes part of the state. (stiffness() does count it.) Zero for fluids.
DampingModuli damping_moduli(const Parameters& parameters);

}  // namespace geocontainer_mpm::material
