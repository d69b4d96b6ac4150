#pragma once
/// Particles to grid and back, for every choice of discretisation.h. Mass and linear momentum are conserved to
/// round-off, angular momentum too by APIC (Jiang et al. 2015, ACM TOG 34:51), whose affine matrix on a linear simplex
/// is the element's velocity gradient: with linear weights sum w_i v_i r_i^T = (grad v) sum w_i r_i r_i^T.
///
/// A step of a driver, by order of update (Bardenhagen 2002, JCP 180:383). Everything works with the positions at its
/// start; they move in the last gather, so sorting, window and mass matrix hold for the whole step. `open`:
/// Grid::open(); `velocities`, `momenta`, `forces`, `faces`: GridUpdate; contact comes between forces and faces. With a
/// consistent mass the matrix is assembled once a step, after the first scatter.
///
///   usl:  open, scatter(all), forces, faces, gather(all), law
///   usf:  open, scatter(momentum), velocities, gather(gradient), law, momenta, scatter(force), forces, faces,
///         gather(motion)
///   musl: open, scatter(all), forces, faces, gather(velocity), Grid::keep_velocities, open, scatter(momentum),
///         velocities, gather(gradient), gather(position), law
///
/// Smoothing acts on gradients while the particles are where the gradients were taken: after gather(gradient) comes
/// smooth_gradients(); with usl, gather(all) becomes gather(gradient), smooth_gradients(), gather(motion) where
/// gradients change by it. Sheets take part in every scatter and gather but those of gradients; with usl and usf they
/// gather `motion`.

#include <cstddef>

#include "geocontainer_mpm/mpm/discretisation.h"
#include "geocontainer_mpm/mpm/grid.h"
#include "geocontainer_mpm/mpm/particles.h"
#include "geocontainer_mpm/mpm/sorting.h"

namespace geocontainer_mpm::mpm {

/// Viscous stress lambda tr(D) I + 2 shear D beside the particles' own, D the symmetric part of Particles::gradient
/// (that of the last step): stiffness-proportional damping with lambda = beta * Lame's, shear = beta * G. Pa s.
struct StressDamping {
  double lambda = 0.0, shear = 0.0;
};

/// What a scatter adds to the grid: mass and momentum, forces, or both.
enum class Part { all, momentum, force };

/// One body on its way to the grid.
struct BodyTerms {
  Part part = Part::all;
  bool external_force = false;  ///< Particles::force acts as well
  StressDamping damping;
};

/// What a gather takes from the grid. motion: velocity (APIC: and its matrix) and position. position: by the velocities
/// that the grid keeps (MUSL).
enum class Gather { all, motion, velocity, gradient, position };

/// Adds a sorted body: mass, momentum m v (APIC: m (v + C r)), gravity on `weight_mass` and internal force
/// -V sigma grad w. With smoothing, the stress is the one whose work on any motion is that of the particles' stress on
/// the smoothed gradients, so that no energy is made. cell_average: the volume-weighted mean of the body's particles in
/// the element; a simplex that the body fills about (see smoothing.cpp) is integrated with its own volume instead of
/// the particles' (Beuth, Wieckowski and Vermeer 2011, IJNAMG 35:1508), and that does make some. nodal_mixed: the
/// particle's own with its isotropic part smoothed as smooth_gradients() smooths rates (cf. the averaged nodal pressure
/// of Bonet and Burton 1998, CNME 14:437). The bare body (no external force, damping, smoothing) has loops of its own;
/// the others are asked for once a particle, not once a node.
template <int Dim>
void body_to_grid(const Discretisation& discretisation, const Particles<Dim>& particles, const Strips& strips,
                  const BodyTerms& terms, const Vec<Dim>& gravity, Grid<Dim>& grid, ThreadTeam& team);

/// The same for the nodes of a sheet: an external force each, and stress only where it is made of membrane points. Few
/// of them, so one thread.
template <int Dim>
void sheet_to_grid(const Discretisation& discretisation, const Particles<Dim>& nodes, Part part,
                   const Vec<Dim>& gravity, Grid<Dim>& grid, bool stressed = false);

/// Rows [begin, end) from the grid's velocities; positions move by dt times the grid's velocity at the particle.
/// FLIP and AFLIP: v <- f (v + sum w (v_new - v_old)) + (1 - f) sum w v_new with f the flip_fraction (Stomakhin et al.
/// 2013), v_old as kept by GridUpdate::apply_forces. FLIP leaves the affine matrix alone, AFLIP takes it from the grid.
template <int Dim>
void grid_to_particles(const Discretisation& discretisation, const Grid<Dim>& grid, double dt, Gather what,
                       Particles<Dim>& particles, std::size_t begin, std::size_t end);

/// A force (N, N/m in plane strain) at point + arm, on the surface, carried by the outermost particle p at `point`,
/// half of whose width the arm is: f_i += force (w_i(point - arm) + 2 arm . grad w_i(point)). Force and moment about
/// any point are exact. The second part is what a stress would do that carries the force through the particle's volume,
/// by the same one-point rule as the internal force: under a uniform stress that balances the force, nodes that only
/// the outermost particle reaches feel nothing, however light they are. (Taking w_i(point + arm) instead pulls them
/// away: the outermost row then moves by several per cent of a cell.) Cf. the virtual stress of Liang, Given and Soga
/// 2023, Comput. Geotech.
template <int Dim>
void add_surface_force(Shape shape, const Particles<Dim>& particles, std::size_t p, const Vec<Dim>& arm,
                       const Vec<Dim>& force, Grid<Dim>& grid);

/// nodal_mixed (Detournay and Dzik 2006, FLAC symposium 4): replaces the volumetric part of Particles::gradient (in
/// plane strain that in the plane) by the mean, over the nodes of the particle's element, of nodal means over the
/// elements around, both weighted by the volume of the body's particles. A uniform rate stays, the deviatoric part and
/// spin stay, and so does the total rate of volume, sum V tr(grad v). cell_average: the gradient becomes the
/// volume-weighted mean over the cell; on a simplex it is that already. Does nothing unless smooths_gradients().
template <int Dim>
void smooth_gradients(const Discretisation& discretisation, const Strips& strips, Particles<Dim>& particles,
                      Grid<Dim>& grid, ThreadTeam& team);

}  // namespace geocontainer_mpm::mpm
