#pragma once
/// Particles to grid and back: affine transfer (APIC, Jiang et al. 2015, ACM TOG 34:51) with the stress divergence of
/// the same quadratic B-splines. Mass, linear and angular momentum are conserved to round-off.

#include <cstddef>

#include "geocontainer_mpm/mpm/grid.h"
#include "geocontainer_mpm/mpm/particles.h"
#include "geocontainer_mpm/mpm/sorting.h"

namespace geocontainer_mpm::mpm {

/// Adds mass, momentum m (v + C r), gravity on `weight_mass` and internal force -V sigma grad w of a sorted body.
template <int Dim>
void body_to_grid(const Particles<Dim>& particles, const Strips& strips, const Vec<Dim>& gravity, Grid<Dim>& grid,
                  ThreadTeam& team);

/// The same for the nodes of a sheet: no stress, but an external force each. Few of them, so one thread.
template <int Dim>
void sheet_to_grid(const Particles<Dim>& nodes, const Vec<Dim>& gravity, Grid<Dim>& grid);

/// Velocity, affine matrix, velocity gradient and position x += dt v of rows [begin, end) from the grid's velocities.
/// `want_gradient` is false for sheets.
template <int Dim>
void grid_to_particles(const Grid<Dim>& grid, double dt, bool want_gradient, Particles<Dim>& particles,
                       std::size_t begin, std::size_t end);

}  // namespace geocontainer_mpm::mpm
