#pragma once
/// Finds the place on a closed sheet that is nearest to a point, by lists of the facets near each cell of a grid, and
/// on which side of it the point is.
///
/// A slack sheet that collapses may cross itself, since the grid does not see layers that are closer than a cell. In
/// the kink that it leaves there is fill on either side of the sheet, and the sense of its facets no longer says what
/// is inside. So a point on the wrong side of the facet nearest to it has got through only if the sheet as a whole
/// does not wind around it (or, where points belong outside, does); otherwise it touches from the side where it is.
///
/// Limits: a point sees one facet, the nearest.

#include <optional>
#include <type_traits>

#include "geocontainer_mpm/contact/sheet_line.h"
#include "geocontainer_mpm/contact/sheet_mesh.h"

namespace geocontainer_mpm::contact {

template <int Dim>
class SheetSurface {
public:
  explicit SheetSurface(SheetSide side) : side_(side) {}

  /// The sheet as it lies now, for points that are nearer than `reach` (m).
  void lay_out(const ClosedSheet<Dim>& sheet, double reach, const mpm::Grid<Dim>& grid);
  /// None where nothing is within reach.
  std::optional<SheetFoot<Dim>> nearest(const Vec<Dim>& point, const mpm::Grid<Dim>& grid) const;

private:
  struct Entry {
    std::uint32_t facet, next;
  };

  SheetSide side_;
  double reach_ = 0.0;
  std::conditional_t<Dim == 2, SheetLine, SheetMesh> facets_;
  std::vector<Entry> entries_;        ///< lists of the facets near a cell
  std::vector<std::uint32_t> first_;  ///< per cell the head of its list, or `none`
  std::vector<std::size_t> cells_;    ///< that have a list
};

}  // namespace geocontainer_mpm::contact
