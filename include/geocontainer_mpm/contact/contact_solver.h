#pragma once
/// Unilateral Coulomb contact of the material with boundary bodies.
///
/// Boundary particles carry the prescribed motion (Hamad, Stolle and Moormann 2016, section 2). Where a point of the
/// material's surface closes the gap to the surface that they span, the grid's velocity field must not carry it
/// through: (v(x_c) - v_b) . n >= -gap / dt, with friction up to mu times the normal impulse. The conditions of all
/// touching points act on the same nodal velocities and are solved together by projected Gauss-Seidel on the impulses
/// (Moreau 1988; Jean 1999, CMAME 177:235), each impulse spread by the point's own shape functions. The gap is the
/// boundary's own, so nothing acts across the reach of a shape function, and the normal is exact (cf. Nairn,
/// Bardenhagen and Smith 2018).

#include <array>
#include <cstdint>
#include <vector>

#include "geocontainer_mpm/contact/boundary_body.h"
#include "geocontainer_mpm/mpm/grid.h"
#include "geocontainer_mpm/mpm/particles.h"

namespace geocontainer_mpm::contact {

/// Points at which material may touch: nodes of a sheet (its own surface), or the particles of a body without a sheet,
/// whose surface is half a particle's width outside.
struct ContactPoints {
  const mpm::Particles<2>* particles;
  bool has_width;
};

/// What one boundary body did in a step, per unit width.
struct BoundaryImpulse {
  Vec2 impulse = Vec2::Zero();  ///< on the material, N s / m; the body feels the opposite
  double work = 0.0;            ///< done on the material by the body's motion, J/m
};

struct ContactSums {
  double kinetic_change = 0.0;  ///< of the material, J/m
  double dissipated = 0.0;      ///< by friction and impact, J/m
  Vec2 impulse = Vec2::Zero();  ///< on the material, all bodies
  std::uint64_t skipped = 0;    ///< bodies not searched because nothing is near
};

class ContactSolver {
public:
  /// Corrects the velocities of `grid` (updated by the forces of this step). `bodies` have their motion set.
  /// `kick`: time over which those forces acted, s; `dt`: time until the next positions, s.
  /// `boundary[b]` receives what body b did.
  ContactSums solve(const std::vector<BoundaryBody>& bodies, const std::vector<ContactPoints>& points, double kick,
                    double dt, mpm::Grid<2>& grid, std::vector<BoundaryImpulse>& boundary);

  /// While held, what touches sticks, whatever the bodies' friction.
  void hold(bool held) { held_ = held; }

private:
  struct Contact {
    std::array<std::uint32_t, 9> node;
    std::array<double, 9> weight;
    Vec2 normal, velocity;  ///< of the boundary at the point
    double friction;
    double approach;          ///< least allowed relative normal velocity, m/s
    double compliance;        ///< velocity at the point per unit impulse on it, 1/kg
    double pressed, dragged;  ///< impulses so far: normal and tangential, N s / m
    std::uint32_t body;
    std::size_t memory;  ///< where this pair's impulses are remembered
  };

  void collect(std::uint32_t index, const BoundaryBody& body, const ContactPoints& points, std::size_t memory,
               double dt, const mpm::Grid<2>& grid);
  void add_contact(const Vec2& point, const Nearest& surface, double gap, double dt, const mpm::Grid<2>& grid,
                   Contact& contact) const;
  double relax(Contact& contact, mpm::Grid<2>& grid) const;
  void push(const Contact& contact, const Vec2& impulse, mpm::Grid<2>& grid) const;

  bool held_ = false;
  std::vector<Contact> contacts_;
  std::vector<std::array<double, 2>> memory_;  ///< impulses of the last step per body and point: a good first guess
  std::vector<std::array<double, 2>> next_memory_;
  std::vector<std::uint32_t> touched_;    ///< grid nodes of all contacts, each once
  std::vector<Vec2> untouched_velocity_;  ///< theirs before contact
};

}  // namespace geocontainer_mpm::contact
