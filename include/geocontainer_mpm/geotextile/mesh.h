#pragma once
/// Triangles of a sheet in space as it is laid, and the mesh of a container: a wall along the barge and its ends.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "geocontainer_mpm/geotextile/layout.h"
#include "geocontainer_mpm/mpm/types.h"

namespace geocontainer_mpm::geotextile {

using Triangle = std::array<std::uint32_t, 3>;  ///< points, against the clock seen from outside

/// Pieces of cloth of a container, with seams between.
enum class Panel : std::uint8_t { wall, aft_end, bow_end };

/// A sheet as it is laid. All columns but the points are per triangle.
struct TriangleMesh {
  std::vector<Vec3> points;  ///< m
  std::vector<Triangle> triangles;
  std::vector<Vec3> warp, weft;  ///< directions of the yarns as laid, unit, in the triangle's plane
  std::vector<std::array<double, 2>>
      fullness;              ///< length of cloth over length laid, warp and weft; empty: 1 everywhere
  std::vector<Panel> panel;  ///< empty: all is one
  /// Has an inside: bounds a volume, by itself or together with vertical planes of symmetry. Triangles then look
  /// outwards.
  bool closed = false;

  double area(std::size_t triangle) const;  ///< m^2
};

struct ClosedEnds {
  bool aft = false, bow = false;  ///< at `from`, at `to`
};
/// Length of cloth over length laid; below 1 it is pretension.
struct Fullness {
  double around = 1.0;  ///< of the wall around the section, on top of what the outline says per side
  double along = 1.0;   ///< of the wall along x
  double ends = 1.0;    ///< of closed ends, both ways
};

/// A container of constant section: `outline`, in y and z, extruded along x. A closed outline is the whole section, an
/// open one half of it, whose first and last points lie on a vertical plane of symmetry.
///
/// The wall's warp goes around and its weft along x. Its points lie row by row, from `from` to `to`; row j, point i
/// of n is point j n + i. Those of a row divide the cloth of the outline into equal parts (see divide), so that a wall
/// of one row of quads has the segments of a Sheet of this layout. Diagonals change from row to row, which gives every
/// inner point six triangles of the same areas.
///
/// A closed end is flat and hangs on the wall's last points: rings, the outline scaled towards an inner point (the
/// centroid; of half a section that of the whole), with the fewer points the shorter they are. Its
/// warp is along y and its weft along z. The outline must be star-shaped about the inner point.
TriangleMesh wrap(const SheetLayout& outline, const Along& along, const ClosedEnds& closed_ends, double segment_length,
                  const Fullness& fullness = {});

}  // namespace geocontainer_mpm::geotextile
