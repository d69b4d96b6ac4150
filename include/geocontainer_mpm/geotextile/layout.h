#pragma once
/// Where a sheet is laid, and how much cloth lies where.

#include <cstddef>
#include <vector>

#include "geocontainer_mpm/mpm/types.h"

namespace geocontainer_mpm::geotextile {

/// Where a sheet is laid.
struct SheetLayout {
  std::vector<Vec2> points;           ///< at least 2 (closed: 3), m
  bool closed = false;                ///< joined from the last point to the first
  std::vector<double> fullness = {};  ///< per side, length of cloth over length of side, >= 1; empty: 1 everywhere

  std::size_t sides() const { return closed ? points.size() : points.size() - 1; }
  double cloth_length() const;  ///< m
};

/// Folds of a sheet: each rises from the line to a height and comes back along two straight sides.
struct Folds {
  Vec2 lower, upper;  ///< corners of the rectangle in which the line is folded, m
  int number;
  double height;  ///< m
};

/// The same line, cut where it enters and leaves the rectangle, with the cloth of the folds laid evenly along what is
/// inside: n folds of height a on a stretch of length L take sqrt(L^2 + (2 n a)^2) of it. Unchanged where nothing is
/// inside.
SheetLayout fold(const SheetLayout& layout, const Folds& folds);

/// The first `count` of the points that divide the cloth into equal `steps`, from the line's first point on.
std::vector<Vec2> divide(const SheetLayout& layout, std::size_t steps, std::size_t count);

}  // namespace geocontainer_mpm::geotextile
