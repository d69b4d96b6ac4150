#pragma once
/// Unilateral Coulomb contact of the points of one velocity field with a closed sheet in another: fill that slips in
/// its geotextile, and two geotextiles that touch.
///
/// The condition is that of ContactSolver with both sides free, (v(x_c) - v(x_s)) . n >= -gap / dt. The point x_c is
/// a particle of the fill, whose surface is half its width outside, or a node of the other sheet; x_s is the nearest
/// point of the sheet's segments or triangles, whose velocity is that of the facet's corners, each taken from its grid.
/// So facets carry the normal and which side is inside, and what may not be crossed is the sheet itself (see
/// SheetSurface). Impulses are spread by the shape functions of both sides, equal and opposite: momentum is kept
/// exactly. So is angular momentum but for friction's part, which acts on a particle's middle and not on its surface: a
/// couple of half its width times friction. Near faces that mirror, point and sheet act together with their images.
///
/// Limits: sheets and particles that are further than half a cell on the wrong side are not seen any more.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "geocontainer_mpm/contact/contact_solver.h"
#include "geocontainer_mpm/contact/sheet_surface.h"
#include "geocontainer_mpm/state_access.h"

namespace geocontainer_mpm::contact {

template <int Dim>
class SheetContact {
public:
  SheetContact(mpm::Shape shape, SheetSide side, double friction) : shape_(shape), surface_(side), friction_(friction)
  {
  }

  /// While held, what touches sticks, whatever the friction.
  void hold(bool held) { held_ = held; }

  // In this order, with others of the same fields in between: see ContactSolver. Both grids have the same origin,
  // counts and cell, and are updated by the forces of this step. Points keep their number from step to step.
  /// Finds what touches. `dt`: time until the next positions, s.
  void begin(const ContactPoints<Dim>& points, const mpm::Grid<Dim>& point_grid, const ClosedSheet<Dim>& sheet,
             const mpm::Grid<Dim>& sheet_grid, double dt);
  bool empty() const { return contacts_.empty(); }
  /// Adds the nodes of the grids that impulses reach, each once, on the points' side and on the sheet's.
  void add_nodes(std::vector<std::uint32_t>& of_points, std::vector<std::uint32_t>& of_sheet);
  void guess(mpm::Grid<Dim>& point_grid, mpm::Grid<Dim>& sheet_grid) const;
  double sweep(int number, mpm::Grid<Dim>& point_grid, mpm::Grid<Dim>& sheet_grid);
  void end();

private:
  friend struct geocontainer_mpm::StateAccess;

  /// What a place has of a node, and the node's change of velocity by an impulse there, 1/kg; near a face that mirrors
  /// they differ by direction (see mirror.h).
  template <class Value>
  struct Share {
    std::uint32_t node;
    Value weight, mobility;
  };
  /// The shares of a place, one after the other in shares_ or, mirrored, in mirrored_.
  struct Handle {
    std::uint32_t begin, end;
    bool mirrored;
  };
  /// Velocity at a place per unit impulse there, 1/kg.
  struct Compliance {
    double all;  ///< the largest of all directions
    Vec<Dim> by_direction;
    bool mirrored;
  };
  struct Load {
    double pressed = 0.0;  ///< impulses so far, normal and tangential, N s (N s / m in plane strain)
    Drag<Dim> dragged = Drag<Dim>::Zero();
  };
  struct Contact {
    Handle point, sheet;
    Vec<Dim> normal;           ///< unit, from the sheet to where points belong
    double compliance, along;  ///< relative velocity per unit impulse, tangential (at most) and normal, 1/kg
    double approach;           ///< least relative normal velocity, m/s
    Load load;
    std::size_t id;  ///< of the point
  };
  struct Gathered {
    std::uint32_t node;
    Vec<Dim> weight;
  };

  void gather(const Vec<Dim>& at, double share, const mpm::Grid<Dim>& grid);
  Handle make_handle(const mpm::Grid<Dim>& grid, Compliance& compliance);
  void add(const Vec<Dim>& point, const SheetFoot<Dim>& foot, double gap, std::size_t id,
           const mpm::Grid<Dim>& point_grid, const ClosedSheet<Dim>& sheet, const mpm::Grid<Dim>& sheet_grid,
           double dt);
  Vec<Dim> velocity(const Handle& handle, const mpm::Grid<Dim>& grid) const;
  void push(const Handle& handle, const Vec<Dim>& impulse, mpm::Grid<Dim>& grid) const;
  double relax(Contact& contact, mpm::Grid<Dim>& point_grid, mpm::Grid<Dim>& sheet_grid) const;

  mpm::Shape shape_;
  SheetSurface<Dim> surface_;
  double friction_;
  bool held_ = false;
  std::vector<Contact> contacts_;
  std::vector<Share<double>> shares_;
  std::vector<Share<Vec<Dim>>> mirrored_;
  std::vector<Load> memory_;  ///< of the last step per point: a good first guess
  // Of the handle that is being made:
  std::vector<Gathered> gathered_;
  bool near_mirror_ = false;
  std::vector<std::uint32_t> slot_;  ///< per node of the grid its place in gathered_; `none` between calls
};

}  // namespace geocontainer_mpm::contact
