#pragma once
/// Unilateral Coulomb contact of the material with boundary bodies, and points that are held (anchors).
///
/// Boundary particles carry the prescribed motion (Hamad, Stolle and Moormann 2016, section 2). Where a point of the
/// material's surface closes the gap to the surface that they span, the grid's velocity field must not carry it
/// through: (v(x_c) - v_b) . n >= -gap / dt, with friction up to mu times the normal impulse. The conditions of all
/// touching points act on the same nodal velocities and are solved together by projected Gauss-Seidel on the impulses
/// (Moreau 1988; Jean 1999, CMAME 177:235), the tangential one kept in the disc of radius mu times the normal one, each
/// impulse spread by the point's own shape functions. The gap is the
/// boundary's own, so nothing acts across the reach of a shape function, and the normal is exact (cf. Nairn,
/// Bardenhagen and Smith 2018). An anchor is the same condition with two sides: v(x_a) is what is prescribed.

#include <array>
#include <cstdint>
#include <vector>

#include "geocontainer_mpm/contact/boundary_body.h"
#include "geocontainer_mpm/mpm/discretisation.h"
#include "geocontainer_mpm/mpm/grid.h"
#include "geocontainer_mpm/mpm/particles.h"
#include "geocontainer_mpm/mpm/reach.h"
#include "geocontainer_mpm/state_access.h"

namespace geocontainer_mpm::contact {

/// Points at which material may touch: nodes of a sheet (its own surface), or the particles of a body without a sheet,
/// whose surface is half a particle's width outside.
template <int Dim>
struct ContactPoints {
  const mpm::Particles<Dim>* particles;
  bool has_width;
  /// By id: those that are meant, and are not pushed back to where they may be but kept from going further. Not given:
  /// all.
  const std::vector<std::uint8_t>* strays = nullptr;
};

/// A material point whose way is prescribed: the held end of a sheet.
template <int Dim>
struct Anchor {
  Vec<Dim> point;   ///< where it is now, m
  Vec<Dim> target;  ///< where it is to be at the end of the step, m: drift corrects itself
};

// Impulses, moments and energies are per unit width in the plane (N s / m, N m s / m, J/m), whole in space.

/// What one boundary body did in a step.
template <int Dim>
struct BoundaryImpulse {
  Vec<Dim> impulse = Vec<Dim>::Zero();  ///< on the material, N s; the body feels the opposite
  double moment = 0.0;  ///< of `impulse` about x through the pose's present pivot (pivot + shift), y towards z, N m s
  double work = 0.0;    ///< done on the material by the body's motion, J
};

/// What one anchor did in a step.
template <int Dim>
struct AnchorImpulse {
  Vec<Dim> impulse = Vec<Dim>::Zero();  ///< on the material, N s
  double work = 0.0;                    ///< done on the material, J
};

/// Of all bodies and anchors together.
template <int Dim>
struct ContactImpulses {
  std::vector<BoundaryImpulse<Dim>> boundary;  ///< in the order of the bodies
  std::vector<AnchorImpulse<Dim>> anchor;      ///< in the order of the anchors
};

template <int Dim>
struct ContactSums {
  double kinetic_change = 0.0;          ///< of the material, J
  double dissipated = 0.0;              ///< by friction and impact, J
  Vec<Dim> impulse = Vec<Dim>::Zero();  ///< on the material, all bodies and anchors, N s
  std::uint64_t skipped = 0;            ///< bodies not searched because nothing is near
};

/// What an impulse is along a surface: in the plane one number, to the left of the normal; in space a vector.
template <int Dim>
using Drag = Vec<Dim == 2 ? 1 : Dim>;

/// Gauss-Seidel ends when no point's velocity changes by more than this in a sweep, or after so many sweeps.
inline constexpr double velocity_tolerance = 1e-6;  // m/s
inline constexpr int most_sweeps = 30;

/// One for each velocity field: it remembers the impulses of its last step.
template <int Dim>
class ContactSolver {
public:
  explicit ContactSolver(mpm::Shape shape = mpm::Shape::bspline2) : shape_(shape) {}

  /// Corrects the velocities of `grid` (updated by the forces of this step). `bodies` have their motion set. Bodies,
  /// sets of points and anchors keep their order and number from step to step.
  /// `kick`: time over which those forces acted, s; `dt`: time until the next positions, s.
  ContactSums<Dim> solve(const std::vector<BoundaryBody<Dim>>& bodies, const std::vector<ContactPoints<Dim>>& points,
                         const std::vector<Anchor<Dim>>& anchors, double kick, double dt, mpm::Grid<Dim>& grid,
                         ContactImpulses<Dim>& impulses);

  /// While held, what touches sticks, whatever the bodies' friction.
  void hold(bool held) { held_ = held; }

  // The parts of solve(), in this order, for contacts that are solved together with those of other fields.
  /// Finds what touches.
  void begin(const std::vector<BoundaryBody<Dim>>& bodies, const std::vector<ContactPoints<Dim>>& points,
             const std::vector<Anchor<Dim>>& anchors, double dt, const mpm::Grid<Dim>& grid, ContactSums<Dim>& sums);
  /// Nodes of the grid that other contacts push: they count in the sums of end().
  void also_touches(const std::vector<std::uint32_t>& nodes);
  /// Impulses of the last step as a first guess. Before it no contact may have pushed the grid.
  void guess(mpm::Grid<Dim>& grid);
  /// Makes each contact right given all others, odd sweeps from the last to the first. Returns the largest change of a
  /// point's velocity, m/s.
  double sweep(int number, mpm::Grid<Dim>& grid);
  void end(const std::vector<BoundaryBody<Dim>>& bodies, double kick, const mpm::Grid<Dim>& grid,
           ContactImpulses<Dim>& impulses, ContactSums<Dim>& sums);

private:
  friend struct geocontainer_mpm::StateAccess;

  /// A point's share of the nodes around it.
  struct Handle {
    std::array<std::uint32_t, mpm::most_nodes<Dim>> node;
    std::array<double, mpm::most_nodes<Dim>> weight;    ///< zero where there is no mass
    std::array<double, mpm::most_nodes<Dim>> mobility;  ///< weight over mass, 1/kg
    std::size_t count;
    double compliance;    ///< velocity at the point per unit impulse on it, 1/kg; of a mirrored one the largest
    int mirrored = none;  ///< index of what takes the place of weight and mobility, or none
    static constexpr int none = -1;
  };
  /// Within reach of a roller or fixed face a point has an image behind it, and both push: nodes beyond the face stand
  /// for their images inside, and what a node has of a point differs by direction.
  struct Mirrored {
    std::array<Vec<Dim>, mpm::most_nodes<Dim>> weight, mobility;
    Vec<Dim> compliance;  ///< by direction, 1/kg
  };
  /// Impulses of a contact so far, N s.
  struct Load {
    double pressed = 0.0;  ///< along the normal
    Drag<Dim> dragged = Drag<Dim>::Zero();
  };
  struct Contact {
    Handle handle;
    Vec<Dim> point;             ///< m
    Vec<Dim> normal, velocity;  ///< of the boundary at the point
    double friction;
    double approach;  ///< least allowed relative normal velocity, m/s
    Load load;
    std::uint32_t body;
    std::size_t memory;  ///< where this pair's load is remembered
  };
  struct Hold {
    Handle handle;
    Vec<Dim> velocity, impulse;
  };

  template <class Reach>
  Handle make_handle(const Reach& reach, const Vec<Dim>& point, const mpm::Grid<Dim>& grid);
  void mirror(const mpm::Grid<Dim>& grid, Handle& handle);
  Vec<Dim> velocity_of(const Handle& handle, const mpm::Grid<Dim>& grid) const;
  void collect(std::uint32_t index, const BoundaryBody<Dim>& body, const ContactPoints<Dim>& points, double widest,
               std::size_t memory, double dt, const mpm::Grid<Dim>& grid);
  void remember_untouched(const mpm::Grid<Dim>& grid);
  double compliance_along(const Contact& contact) const;
  double relax(Contact& contact, mpm::Grid<Dim>& grid) const;
  double relax(Hold& hold, mpm::Grid<Dim>& grid) const;
  void push(const Handle& handle, const Vec<Dim>& impulse, mpm::Grid<Dim>& grid) const;
  void report(const std::vector<BoundaryBody<Dim>>& bodies, ContactImpulses<Dim>& impulses, ContactSums<Dim>& sums);

  mpm::Shape shape_;
  bool held_ = false;
  std::vector<Contact> contacts_;
  std::vector<Mirrored> mirrored_;  ///< of handles near faces
  std::vector<Hold> holds_;
  std::vector<Load> memory_;                  ///< loads of the last step per body and point: a good first guess
  std::vector<std::size_t> remembered_;       ///< those that may differ from zero
  std::vector<Vec<Dim>> anchor_memory_;       ///< the same of the anchors
  std::vector<double> widest_;                ///< half the width of the widest point of each set, m
  std::vector<std::uint32_t> others_;         ///< see also_touches()
  std::vector<std::uint32_t> touched_;        ///< grid nodes of all contacts, each once
  std::vector<std::uint8_t> seen_;            ///< per node; 0 between calls
  std::vector<Vec<Dim>> untouched_velocity_;  ///< of touched_ before contact
};

}  // namespace geocontainer_mpm::contact
