#pragma once
/// Unilateral Coulomb contact of the points of one velocity field with a closed sheet in another: fill that slips in
/// its geotextile, and two geotextiles that touch.
///
/// The condition is that of ContactSolver with both sides free, (v(x_c) - v(x_s)) . n >= -gap / dt. The point x_c is
/// a particle of the fill, whose surface is half its width outside, or a node of the other sheet; x_s is the nearest
/// point of the sheet's segments, whose velocity is that of the segment's ends, each taken from its grid. So segments
/// carry the normal and which side is inside, and what may not be crossed is the sheet itself. Impulses are spread by
/// the shape functions of both sides, equal and opposite: momentum is kept exactly. So is angular momentum but for
/// friction's part, which acts on a particle's middle and not on its surface: a couple of half its width times
/// friction.
///
/// A slack sheet that collapses may cross itself, since the grid does not see layers that are closer than a cell. In
/// the kink that it leaves there is fill on either side of the sheet, and the sense of its segments no longer says what
/// is inside. So a point on the wrong side of the segment nearest to it has got through only if the sheet as a whole
/// does not wind around it (or, where points belong outside, does); otherwise it touches from the side where it is.
///
/// Limits: a point sees one segment, the nearest. Sheets and particles that are further than half a cell on the wrong
/// side are not seen any more.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "geocontainer_mpm/contact/contact_solver.h"
#include "geocontainer_mpm/state_access.h"

namespace geocontainer_mpm::contact {

/// A closed sheet as contact sees it: a segment goes from each node to the next, the last to the first.
struct ClosedSheet {
  const mpm::Particles<2>* nodes;
  double outwards;  ///< 1: the right side of the segments looks outwards; -1: the left
};

/// On which side of a sheet points belong.
enum class SheetSide { inside, outside };

class SheetContact {
public:
  SheetContact(mpm::Shape shape, SheetSide side, double friction) : shape_(shape), side_(side), friction_(friction) {}

  /// While held, what touches sticks, whatever the friction.
  void hold(bool held) { held_ = held; }

  // In this order, with others of the same fields in between: see ContactSolver. Both grids have the same origin,
  // counts and cell, and are updated by the forces of this step. Points keep their number from step to step.
  /// Finds what touches. `dt`: time until the next positions, s.
  void begin(const ContactPoints<2>& points, const mpm::Grid<2>& point_grid, const ClosedSheet& sheet,
             const mpm::Grid<2>& sheet_grid, double dt);
  bool empty() const { return contacts_.empty(); }
  /// Adds the nodes of the grids that impulses reach, each once, on the points' side and on the sheet's.
  void add_nodes(std::vector<std::uint32_t>& of_points, std::vector<std::uint32_t>& of_sheet);
  void guess(mpm::Grid<2>& point_grid, mpm::Grid<2>& sheet_grid) const;
  double sweep(int number, mpm::Grid<2>& point_grid, mpm::Grid<2>& sheet_grid);
  void end();

private:
  friend struct geocontainer_mpm::StateAccess;

  /// Share of the nodes around a place: velocity there, and the change of velocity by an impulse there.
  template <std::size_t Most>
  struct Handle {
    std::array<std::uint32_t, Most> node;
    std::array<double, Most> weight;    ///< zero where there is no mass
    std::array<double, Most> mobility;  ///< weight over mass, 1/kg
    std::size_t count = 0;

    void add(std::uint32_t at, double share);
    double weigh(const mpm::Grid<2>& grid);  ///< fills mobility; velocity per unit impulse, 1/kg
    Vec2 velocity(const mpm::Grid<2>& grid) const;
    void push(const Vec2& impulse, mpm::Grid<2>& grid) const;
  };
  struct Contact {
    Handle<9> point;
    Handle<18> sheet;
    Vec2 normal;              ///< unit, from the sheet to where points belong
    double compliance;        ///< relative velocity per unit impulse, 1/kg
    double approach;          ///< least relative normal velocity, m/s
    double pressed, dragged;  ///< impulses so far: normal and tangential, N s / m
    std::size_t id;           ///< of the point
  };
  struct Segment {
    Vec2 start, tangent, normal;  ///< tangent and normal unit; normal: to where points belong
    double length;                ///< m
  };
  struct Entry {
    std::uint32_t segment, next;
  };
  /// The sheet's point nearest to a place.
  struct Foot {
    std::size_t segment = 0;
    double fraction = 0.0;  ///< from the segment's start to its end
    Nearest<2> seen;
  };

  void lay_out(const ClosedSheet& sheet, double reach, const mpm::Grid<2>& grid);
  Foot foot_of(const Vec2& point, std::uint32_t first) const;
  void add(const Vec2& point, const Foot& foot, double gap, std::size_t id, const mpm::Grid<2>& point_grid,
           const ClosedSheet& sheet, const mpm::Grid<2>& sheet_grid, double dt);
  double relax(Contact& contact, mpm::Grid<2>& point_grid, mpm::Grid<2>& sheet_grid) const;

  mpm::Shape shape_;
  SheetSide side_;
  double friction_;
  bool held_ = false;
  std::vector<Contact> contacts_;
  std::vector<std::array<double, 2>> memory_;  ///< impulses of the last step per point: a good first guess
  std::vector<Segment> segments_;
  std::vector<Entry> entries_;        ///< lists of the segments near a cell
  std::vector<std::uint32_t> first_;  ///< per cell the head of its list; `none` between calls
  std::vector<std::size_t> cells_;    ///< that have a list
  std::vector<std::uint8_t> seen_;    ///< per node; 0 between calls
};

}  // namespace geocontainer_mpm::contact
