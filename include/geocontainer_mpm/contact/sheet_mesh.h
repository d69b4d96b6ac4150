#pragma once
/// The triangles of a closed sheet in space.
///
/// Which side of the sheet a point is on follows from the triangle that its nearest place is in; on a side or a corner
/// from the pseudo-normal there, the sum of the normals that meet, at a corner weighted by angle (Baerentzen and Aanaes
/// 2005, IEEE Trans. Vis. Comput. Graph. 11:243). On a rim, which lies in a plane of symmetry, the images behind it
/// meet there as well, so that nothing is left of the sum across the plane. No image is nearer than what it is the
/// image of.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "geocontainer_mpm/contact/closed_sheet.h"
#include "geocontainer_mpm/mpm/grid.h"

namespace geocontainer_mpm::contact {

/// As SheetLine.
class SheetMesh {
public:
  void lay(const ClosedSheet<3>& sheet, SheetSide side, const mpm::Grid<3>& grid);
  std::size_t size() const { return facets_.size(); }
  bool is_degenerate(std::size_t triangle) const { return facets_[triangle].normal == Vec3::Zero(); }
  Vec3 lower(std::size_t triangle) const;
  Vec3 upper(std::size_t triangle) const;
  /// Whether its plane comes into a cube of half side `half` (m) around `middle`.
  bool may_reach(std::size_t triangle, const Vec3& middle, double half) const;
  void look(std::size_t triangle, const Vec3& point, double& best, SheetFoot<3>& foot) const;
  /// Of the sheet with its images: crossings of a ray straight up, which crosses no vertical plane. A place in the
  /// sheet's one inside has 1.
  int winding(const Vec3& around) const;

private:
  using Corners = std::array<std::uint32_t, 3>;
  struct Facet {
    Corners node;
    std::array<Vec3, 3> corner;  ///< m
    Vec3 normal;                 ///< unit, to where points belong; zero: the triangle has no area
  };
  /// Nearest place of a triangle: shares of its corners, and how many are not zero (3: in the middle of it).
  struct Place {
    std::array<double, 3> share;
    int corners;
  };

  void join(const std::vector<Corners>& triangles, std::size_t nodes);
  void add_normals(const mpm::Grid<3>& grid);
  static Place nearest_place(const Facet& facet, const Vec3& point);
  Vec3 pseudo_normal(std::size_t triangle, const Place& place) const;

  double inwards_ = 1.0;  ///< 1 if points belong where the triangles look
  std::vector<Facet> facets_;
  std::vector<Corners> neighbour_;        ///< behind the side from corner k to the next; `none`: a rim
  std::vector<std::uint8_t> on_rim_;      ///< per node
  std::vector<Vec3> node_normal_;         ///< not unit
  std::vector<std::uint8_t> rim_mirror_;  ///< per node of a rim, bit d: it lies in a plane across direction d
};

}  // namespace geocontainer_mpm::contact
