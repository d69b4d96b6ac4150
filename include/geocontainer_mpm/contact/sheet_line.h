#pragma once
/// The segments of a closed sheet in the plane.

#include <cstddef>
#include <vector>

#include "geocontainer_mpm/contact/closed_sheet.h"
#include "geocontainer_mpm/mpm/grid.h"

namespace geocontainer_mpm::contact {

class SheetLine {
public:
  /// As the sheet lies now.
  void lay(const ClosedSheet<2>& sheet, SheetSide side, const mpm::Grid<2>& grid);
  std::size_t size() const { return segments_.size(); }
  /// Of no length worth the name: its neighbours stand in.
  bool is_degenerate(std::size_t segment) const { return segments_[segment].tangent == Vec2::Zero(); }
  Vec2 lower(std::size_t segment) const { return place(segment).cwiseMin(place(next(segment))); }
  Vec2 upper(std::size_t segment) const { return place(segment).cwiseMax(place(next(segment))); }
  /// Whether a segment may come into a box around `middle`, m: boxes of short segments are all that there is to it.
  bool may_reach(std::size_t, const Vec2&, double) const { return true; }
  /// Takes the segment's nearest point where it is nearer than the best so far. `best`: that distance squared, m^2.
  void look(std::size_t segment, const Vec2& point, double& best, SheetFoot<2>& foot) const;
  /// How often the sheet goes around a place.
  int winding(const Vec2& around) const;

private:
  struct Segment {
    Vec2 start, tangent, normal;  ///< tangent and normal unit; normal: to where points belong
    double length;                ///< m
  };
  const Vec2& place(std::size_t node) const { return segments_[node].start; }
  std::size_t next(std::size_t segment) const { return segment + 1 < segments_.size() ? segment + 1 : 0; }

  std::vector<Segment> segments_;
};

}  // namespace geocontainer_mpm::contact
