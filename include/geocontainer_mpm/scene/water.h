#pragma once
/// Still water around bodies: what it takes from their weight, adds to their inertia, and how it resists.

#include <array>
#include <vector>

#include "geocontainer_mpm/geotextile/mesh.h"
#include "geocontainer_mpm/mpm/particles.h"
#include "geocontainer_mpm/scene/description.h"

namespace geocontainer_mpm::scene {

/// Water of one density, at rest, with a horizontal surface. A particle displaces its initial volume V0. For saturated
/// soil that is exact: its pores are open to the water, so that what the skeleton's volume changes by is water in
/// water. A particle enters the water over its own height: the part s of it that is submerged is linear in its depth.
///
///   weight mass     (rho - s rho_w) V0        effective stress: what the skeleton carries of its weight
///   inertia         (rho + s Ca rho_w) V0     water that is moved along; it has no weight
///
/// Masses, forces and energies are per metre of length in plane strain; in space they are whole, of the part of a scene
/// that is computed.
class Water {
public:
  /// `gravity`: along -z, m/s^2, > 0. `symmetry`: of a scene in space, the part that is computed.
  Water(const WaterDescription& description, double level_m, double gravity, Symmetry symmetry = Symmetry::none);

  double density() const { return density_; }
  double level() const { return level_; }
  /// Part of a particle under water.
  double submerged(double z, double height) const;
  /// Integral of submerged() over z from here up, m: what buoyancy does per weight of displaced water.
  double depth(double z, double height) const;
  /// Mass per area of a column of soil from `z` up to `top`, less that of the water in its place, kg/m^2; not below
  /// zero.
  double overburden(double soil_density, double z, double top) const;

  /// Energy of buoyancy, J/m or J: zero above the water.
  template <int Dim>
  double potential(const mpm::Particles<Dim>& particles, double height) const;
  template <int Dim>
  struct Uptake {
    double left_behind = 0.0;            ///< kinetic energy, J/m or J
    Vec<Dim> slowed = Vec<Dim>::Zero();  ///< velocity that particles lost times their weight mass, kg/s or kg m/s
  };
  /// Sets weight and inertia of every particle by its depth. Water that is taken up was at rest: momentum stays, and
  /// the particle slows down. Water that is left behind keeps its speed, and so does the particle. Either way kinetic
  /// energy stays behind in the water. (Von Karman 1929, NACA TN 321: F = d(m_a v)/dt at entry, half of
  /// whose work goes into spray. At exit nothing pushes the body out.)
  template <int Dim>
  Uptake<Dim> immerse(double soil_density, double height, mpm::Particles<Dim>& particles) const;
  /// The same before the start, for water that moves with the body already.
  template <int Dim>
  void place(double soil_density, double height, mpm::Particles<Dim>& particles) const;

  template <int Dim>
  struct Drag {
    double submerged_volume = 0.0;         ///< m^2 or m^3
    Vec<Dim> velocity = Vec<Dim>::Zero();  ///< mean of that part, m/s; of the whole: without a part across symmetry
    Vec<Dim> force = Vec<Dim>::Zero();     ///< N/m or N
  };
  /// Resistance to the body's motion as a whole, F = rho_w / 2 Cd b v^2 times the share under water, against the mean
  /// velocity of that share. b is what of `surface` is seen along it: its extent across, or the area of its shadow
  /// (shadow.h), `margin` (m) wider where the surface stands that far out.
  template <int Dim>
  Drag<Dim> resist(const mpm::Particles<Dim>& surface, double margin, double height,
                   const mpm::Particles<Dim>& particles) const;
  /// Hands drag to the nodes of the closed sheet around the body: against the motion, evenly over the width of the side
  /// that faces the flow. It is there that the water presses, and holds the fill by the sheet. (The pressure behind is
  /// lower than outside but nearly uniform; a slack sheet takes none of it.)
  void press(const Drag<2>& drag, const mpm::Particles<2>& sheet, std::array<mpm::Column, 2>& forces) const;
  /// The same in space, with triangles that look outwards: a third of each one's share to every corner.
  void press(const Drag<3>& drag, const mpm::Particles<3>& sheet, const std::vector<geotextile::Triangle>& triangles,
             std::array<mpm::Column, 3>& forces) const;
  /// Hands drag to the particles of a bare body, whose surface is not known, by their submerged volume.
  template <int Dim>
  void spread(const Drag<Dim>& drag, double height, mpm::Particles<Dim>& particles) const;

private:
  double density_, level_, gravity_, drag_, added_;
  Symmetry symmetry_;
};

}  // namespace geocontainer_mpm::scene
