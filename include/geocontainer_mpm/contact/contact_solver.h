#pragma once
/// Unilateral Coulomb contact of the material with boundary bodies, and points that are held (anchors).
///
/// Boundary particles carry the prescribed motion (Hamad, Stolle and Moormann 2016, section 2). Where a point of the
/// material's surface closes the gap to the surface that they span, the grid's velocity field must not carry it
/// through: (v(x_c) - v_b) . n >= -gap / dt, with friction up to mu times the normal impulse. The conditions of all
/// touching points act on the same nodal velocities and are solved together by projected Gauss-Seidel on the impulses
/// (Moreau 1988; Jean 1999, CMAME 177:235), each impulse spread by the point's own shape functions. The gap is the
/// boundary's own, so nothing acts across the reach of a shape function, and the normal is exact (cf. Nairn,
/// Bardenhagen and Smith 2018). An anchor is the same condition with two sides: v(x_a) is what is prescribed.

#include <array>
#include <cstdint>
#include <vector>

#include "geocontainer_mpm/contact/boundary_body.h"
#include "geocontainer_mpm/mpm/discretisation.h"
#include "geocontainer_mpm/mpm/grid.h"
#include "geocontainer_mpm/mpm/particles.h"

namespace geocontainer_mpm::contact {

/// Points at which material may touch: nodes of a sheet (its own surface), or the particles of a body without a sheet,
/// whose surface is half a particle's width outside.
struct ContactPoints {
  const mpm::Particles<2>* particles;
  bool has_width;
};

/// A material point whose way is prescribed: the held end of a sheet.
struct Anchor {
  Vec2 point;   ///< where it is now, m
  Vec2 target;  ///< where it is to be at the end of the step, m: drift corrects itself
};

/// What one boundary body did in a step, per unit width.
struct BoundaryImpulse {
  Vec2 impulse = Vec2::Zero();  ///< on the material, N s / m; the body feels the opposite
  double moment = 0.0;          ///< of `impulse` about the pose's present pivot (pivot + shift), y towards z, N m s / m
  double work = 0.0;            ///< done on the material by the body's motion, J/m
};

/// What one anchor did in a step, per unit width.
struct AnchorImpulse {
  Vec2 impulse = Vec2::Zero();  ///< on the material, N s / m
  double work = 0.0;            ///< done on the material, J/m
};

/// Of all bodies and anchors together.
struct ContactImpulses {
  std::vector<BoundaryImpulse> boundary;  ///< in the order of the bodies
  std::vector<AnchorImpulse> anchor;      ///< in the order of the anchors
};

struct ContactSums {
  double kinetic_change = 0.0;  ///< of the material, J/m
  double dissipated = 0.0;      ///< by friction and impact, J/m
  Vec2 impulse = Vec2::Zero();  ///< on the material, all bodies and anchors
  std::uint64_t skipped = 0;    ///< bodies not searched because nothing is near
};

/// Gauss-Seidel ends when no point's velocity changes by more than this in a sweep, or after so many sweeps.
inline constexpr double velocity_tolerance = 1e-6;  // m/s
inline constexpr int most_sweeps = 30;

/// One for each velocity field: it remembers the impulses of its last step.
class ContactSolver {
public:
  explicit ContactSolver(mpm::Shape shape = mpm::Shape::bspline2) : shape_(shape) {}

  /// Corrects the velocities of `grid` (updated by the forces of this step). `bodies` have their motion set. Bodies,
  /// sets of points and anchors keep their order and number from step to step.
  /// `kick`: time over which those forces acted, s; `dt`: time until the next positions, s.
  ContactSums solve(const std::vector<BoundaryBody>& bodies, const std::vector<ContactPoints>& points,
                    const std::vector<Anchor>& anchors, double kick, double dt, mpm::Grid<2>& grid,
                    ContactImpulses& impulses);

  /// While held, what touches sticks, whatever the bodies' friction.
  void hold(bool held) { held_ = held; }

  // The parts of solve(), in this order, for contacts that are solved together with those of other fields.
  /// Finds what touches.
  void begin(const std::vector<BoundaryBody>& bodies, const std::vector<ContactPoints>& points,
             const std::vector<Anchor>& anchors, double dt, const mpm::Grid<2>& grid, ContactSums& sums);
  /// Nodes of the grid that other contacts push: they count in the sums of end().
  void also_touches(const std::vector<std::uint32_t>& nodes);
  /// Impulses of the last step as a first guess. Before it no contact may have pushed the grid.
  void guess(mpm::Grid<2>& grid);
  /// Makes each contact right given all others, odd sweeps from the last to the first. Returns the largest change of a
  /// point's velocity, m/s.
  double sweep(int number, mpm::Grid<2>& grid);
  void end(const std::vector<BoundaryBody>& bodies, double kick, const mpm::Grid<2>& grid, ContactImpulses& impulses,
           ContactSums& sums);

private:
  /// A point's share of the nodes around it.
  struct Handle {
    std::array<std::uint32_t, 9> node;
    std::array<double, 9> weight;  ///< zero where there is no mass
    std::size_t count;
    double compliance;  ///< velocity at the point per unit impulse on it, 1/kg
  };
  struct Contact {
    Handle handle;
    Vec2 point;             ///< m
    Vec2 normal, velocity;  ///< of the boundary at the point
    double friction;
    double approach;          ///< least allowed relative normal velocity, m/s
    double pressed, dragged;  ///< impulses so far: normal and tangential, N s / m
    std::uint32_t body;
    std::size_t memory;  ///< where this pair's impulses are remembered
  };
  struct Hold {
    Handle handle;
    Vec2 velocity, impulse;
  };

  template <class Reach>
  static Handle make_handle(const Reach& reach, const mpm::Grid<2>& grid);
  void collect(std::uint32_t index, const BoundaryBody& body, const ContactPoints& points, std::size_t memory,
               double dt, const mpm::Grid<2>& grid);
  void remember_untouched(const mpm::Grid<2>& grid);
  double relax(Contact& contact, mpm::Grid<2>& grid) const;
  double relax(Hold& hold, mpm::Grid<2>& grid) const;
  void push(const Handle& handle, const Vec2& impulse, mpm::Grid<2>& grid) const;
  void report(const std::vector<BoundaryBody>& bodies, ContactImpulses& impulses, ContactSums& sums);

  mpm::Shape shape_;
  bool held_ = false;
  std::vector<Contact> contacts_;
  std::vector<Hold> holds_;
  std::vector<std::array<double, 2>> memory_;  ///< impulses of the last step per body and point: a good first guess
  std::vector<std::array<double, 2>> next_memory_;
  std::vector<Vec2> anchor_memory_;       ///< the same of the anchors
  std::vector<std::uint32_t> touched_;    ///< grid nodes of all contacts, each once from guess() on
  std::vector<Vec2> untouched_velocity_;  ///< theirs before contact
};

}  // namespace geocontainer_mpm::contact
