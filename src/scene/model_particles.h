#pragma once
/// The particles of a body at the start: where they are, and with which stress and velocity.

#include <optional>
#include <vector>

#include "geocontainer_mpm/mpm/particles.h"
#include "geocontainer_mpm/scene/description.h"
#include "geocontainer_mpm/scene/manufactured.h"
#include "geocontainer_mpm/scene/shapes.h"
#include "geocontainer_mpm/scene/water.h"

namespace geocontainer_mpm::scene {

/// The particles of a body: of its section, in space row behind row along it, of what is computed of it.
template <int Dim>
struct Places {
  std::vector<Vec<Dim>> points;  ///< m
  std::vector<double> volumes;
  std::optional<Vec<Dim>> tile;  ///< as Sampling::tile
};

/// Of what is computed of a body, from its section.
template <int Dim>
Places<Dim> places(const Sampling& section, const BodyDescription& body, Symmetry symmetry, double spacing);
template <int Dim>
void place(const Places<Dim>& places, double density, mpm::Particles<Dim>& particles);

/// Vertical stress from the weight of what lies above, horizontal stress by K0 (both horizontal directions).
template <int Dim>
void set_k0_stress(const BodyDescription& description, double density, const std::vector<Vec2>& shape, double gravity_z,
                   const std::optional<Water>& water, mpm::Particles<Dim>& particles);
/// A weakly compressible fluid at rest, d p / d depth = rho g with rho = rho0 (1 + p / K): more mass in the same
/// volume, so that the law, which knows the volume at zero pressure, finds the pressure: under water that beyond the
/// water's own.
template <int Dim>
void set_hydrostatic(const material::Parameters& material, const std::vector<Vec2>& shape, double gravity_z,
                     const std::optional<Water>& water, mpm::Particles<Dim>& particles);
/// A velocity, a spin from y towards z about the middle of mass, and a sine over space, all in the section.
template <int Dim>
void set_velocity(const Vec2& velocity, double spin, const std::optional<VelocityWave>& wave,
                  mpm::Particles<Dim>& particles);
void start_on_solution(const Manufactured& solution, mpm::Particles<2>& particles);

/// Side of a square, or cube, of the particles' mean volume, m.
template <int Dim>
double mean_width(const mpm::Particles<Dim>& particles);

}  // namespace geocontainer_mpm::scene
