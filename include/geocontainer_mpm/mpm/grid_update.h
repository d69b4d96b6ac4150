#pragma once
/// The momentum equation on the grid: forces to velocities, kinematic conditions on the faces, and the sums that the
/// energy and momentum balances are made of.

#include <vector>

#include "geocontainer_mpm/mpm/consistent_mass.h"
#include "geocontainer_mpm/mpm/discretisation.h"
#include "geocontainer_mpm/mpm/grid.h"

namespace geocontainer_mpm::mpm {

/// Sums over the nodes of the window, in an order that does not depend on the number of threads. Kinetic energy is the
/// grid's, p . v / 2 with v = M^-1 p: where the transfer is blended the particles hold more of it than the grid sees,
/// so that what the ledger of transfers takes from one step's end to the next one's start can be negative for a step.
/// Contact and faces book with lumped masses whatever the matrix.
template <int Dim>
struct MotionSums {
  double kinetic_before = 0.0;                  ///< of the transferred momentum, J (J/m in plane strain)
  double kinetic_after = 0.0;                   ///< after the forces, before contact, J
  double power_before = 0.0;                    ///< of the forces on the transferred velocities, W
  double damped = 0.0;                          ///< taken by mass-proportional damping, J
  Vec<Dim> momentum_before = Vec<Dim>::Zero();  ///< kg m/s
  Vec<Dim> momentum_after = Vec<Dim>::Zero();
  bool touches_faces = false;  ///< a face condition acted: momentum is not conserved in this step
  int iterations = 0;          ///< of the slower of the two solves with a consistent mass
};

template <int Dim>
class GridUpdate {
public:
  /// Mirrors what was scattered beyond roller and fixed faces back inside, so that the face is a plane of
  /// (anti)symmetry, then v = (v_old + M^-1 kick f) * max(0, 1 - damping * kick) with M v_old = p at every node of the
  /// window. `kick`: time between the mid-steps, s (leapfrog: half of the last step plus half of this one).
  /// For a blended transfer the grid keeps v_old, under the same face conditions. A consistent mass must be assembled.
  MotionSums<Dim> apply_forces(const Discretisation& discretisation, Grid<Dim>& grid, double kick, double damping_per_s,
                               ThreadTeam& team);

  /// Velocities from momenta, face conditions included; forces are left alone (see transfer.h, usf and musl).
  void velocities(const Discretisation& discretisation, Grid<Dim>& grid, ThreadTeam& team);
  /// The way back: momenta from the velocities that velocities() made (usf).
  void momenta(const Discretisation& discretisation, Grid<Dim>& grid, ThreadTeam& team);

  ConsistentMass<Dim>& mass() { return mass_; }

  /// Sets the velocities on and beyond roller and fixed faces. Returns the kinetic energy taken, J.
  double apply_faces(Grid<Dim>& grid) const;

private:
  template <bool keeps_old>
  MotionSums<Dim> update_lumped(Grid<Dim>& grid, double kick, double keep, ThreadTeam& team);
  MotionSums<Dim> update_consistent(Grid<Dim>& grid, double kick, double keep, ThreadTeam& team);

  std::vector<MotionSums<Dim>> rows_;
  ConsistentMass<Dim> mass_;
  std::vector<typename ConsistentMass<Dim>::Value> old_, change_, momentum_, impulse_;  ///< of its active nodes
};

}  // namespace geocontainer_mpm::mpm
