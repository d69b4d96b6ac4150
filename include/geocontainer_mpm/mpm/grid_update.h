#pragma once
/// The momentum equation on the grid: forces to velocities, kinematic conditions on the faces, and the sums that the
/// energy and momentum balances are made of.

#include <vector>

#include "geocontainer_mpm/mpm/grid.h"

namespace geocontainer_mpm::mpm {

/// Sums over the nodes of the window, in an order that does not depend on the number of threads.
template <int Dim>
struct MotionSums {
  double kinetic_before = 0.0;                  ///< of the transferred momentum, J (J/m in plane strain)
  double kinetic_after = 0.0;                   ///< after the forces, before contact, J
  double damped = 0.0;                          ///< taken by mass-proportional damping, J
  Vec<Dim> momentum_before = Vec<Dim>::Zero();  ///< kg m/s
  Vec<Dim> momentum_after = Vec<Dim>::Zero();
  bool touches_faces = false;  ///< a face condition acted: momentum is not conserved in this step
};

template <int Dim>
class GridUpdate {
public:
  /// Mirrors what was scattered beyond roller and fixed faces back inside, so that the face is a plane of
  /// (anti)symmetry, then v = (p + kick * f) / m * max(0, 1 - damping * kick) at every node of the window. `kick`: time
  /// between the mid-steps, s (leapfrog: half of the last step plus half of this one).
  MotionSums<Dim> apply_forces(Grid<Dim>& grid, double kick, double damping_per_s, ThreadTeam& team);

  /// Sets the velocities on and beyond roller and fixed faces. Returns the kinetic energy taken, J.
  double apply_faces(Grid<Dim>& grid) const;

private:
  std::vector<MotionSums<Dim>> rows_;
};

/// Largest stable step of the explicit scheme for elastic moduli (Pa) and the largest current volume per mass (m^3/kg),
/// s: dt = 2 / omega with omega bounded by the largest eigenvalue of a single particle's "element" (Irons and Treharne
/// 1971: the assembled system cannot exceed it when nodal mass is the sum of w_i m over particles). For quadratic
/// B-splines sum_i |dw_i/dx|^2 / w_i <= 6 / dx^2 in each direction.
template <int Dim>
double stable_step(double constrained_modulus, double shear_modulus, double volume_per_mass, double dx);

}  // namespace geocontainer_mpm::mpm
