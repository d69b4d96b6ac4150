#include "geocontainer_mpm/geotextile/layout.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace geocontainer_mpm::geotextile {
namespace {

/// Ends of a side; a closed line's last goes back to its first point.
std::array<Vec2, 2> side(const SheetLayout& layout, std::size_t i)
{
  return { layout.points[i], layout.points[i + 1 < layout.points.size() ? i + 1 : 0] };
}

/// Length of cloth along a side, m.
double cloth_along(const SheetLayout& layout, std::size_t i, const Vec2& along)
{
  return layout.fullness.empty() ? along.norm() : layout.fullness[i] * along.norm();
}

/// Part of the way from `a` to `b` that lies in a rectangle, as fractions (Liang and Barsky 1984); empty: begin >= end.
struct Inside {
  double begin = 0.0, end = 1.0;
};
Inside clip(const Vec2& a, const Vec2& b, const Vec2& lower, const Vec2& upper)
{
  Inside inside;
  for (int d = 0; d < 2; ++d) {
    const double way = b[d] - a[d];
    if (way == 0.0) {
      if (a[d] < lower[d] || a[d] > upper[d])
        inside.end = 0.0;
      continue;
    }
    const double to_lower = (lower[d] - a[d]) / way, to_upper = (upper[d] - a[d]) / way;
    inside.begin = std::max(inside.begin, std::min(to_lower, to_upper));
    inside.end = std::min(inside.end, std::max(to_lower, to_upper));
  }
  return inside;
}

/// Pieces of a side shorter than this part of it are round-off at the rectangle's edge.
constexpr double least_piece = 1e-9;

}  // namespace

double SheetLayout::cloth_length() const
{
  double length = 0.0;
  for (std::size_t i = 0; i < sides(); ++i) {
    const auto [a, b] = side(*this, i);
    length += cloth_along(*this, i, b - a);
  }
  return length;
}

SheetLayout fold(const SheetLayout& layout, const Folds& folds)
{
  SheetLayout folded;
  folded.closed = layout.closed;
  std::vector<bool> is_inside;
  double stretch = 0.0;
  for (std::size_t i = 0; i < layout.sides(); ++i) {
    const auto [a, b] = side(layout, i);
    Inside inside = clip(a, b, folds.lower, folds.upper);
    if (!(inside.end - inside.begin > least_piece))
      inside = { 1.0, 1.0 };
    const std::array<double, 4> cut{ 0.0, inside.begin, inside.end, 1.0 };
    for (std::size_t k = 0; k < 3; ++k) {
      if (!(cut[k + 1] - cut[k] > least_piece))
        continue;
      folded.points.emplace_back(a + cut[k] * (b - a));
      is_inside.push_back(k == 1);
      if (k == 1)
        stretch += (cut[2] - cut[1]) * (b - a).norm();
    }
  }
  if (!layout.closed)
    folded.points.push_back(layout.points.back());
  if (stretch == 0.0)
    return layout;
  const double fullness = std::hypot(stretch, 2.0 * folds.number * folds.height) / stretch;
  for (const bool inside : is_inside)
    folded.fullness.push_back(inside ? fullness : 1.0);
  return folded;
}

std::vector<Vec2> divide(const SheetLayout& layout, std::size_t steps, std::size_t count)
{
  const double step = layout.cloth_length() / static_cast<double>(steps);
  std::vector<Vec2> points;
  double passed = 0.0;
  for (std::size_t i = 0; i < layout.sides(); ++i) {
    const auto [a, b] = side(layout, i);
    const Vec2 along = b - a;
    const double length = cloth_along(layout, i, along);
    while (points.size() < count && static_cast<double>(points.size()) * step <= passed + length)
      points.emplace_back(a + (static_cast<double>(points.size()) * step - passed) / length * along);
    passed += length;
  }
  if (points.size() < count)  // round-off at the very end
    points.push_back(layout.closed ? layout.points.front() : layout.points.back());
  return points;
}

}  // namespace geocontainer_mpm::geotextile
