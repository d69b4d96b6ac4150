#include "geocontainer_mpm/scene/shadow.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace geocontainer_mpm::scene {
namespace {

/// Twice the area of a triangle, positive against the clock.
double turn(const Vec2& a, const Vec2& b, const Vec2& c)
{
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// Drops what lies inside the polygon of the outermost points in eight directions: no corner of the hull, and most of
/// all points (Akl and Toussaint 1978).
void drop_inner(std::vector<Vec2>& points)
{
  std::array<Vec2, 8> corner;
  for (std::size_t k = 0; k < corner.size(); ++k) {
    const double angle = 0.25 * 3.14159265358979323846 * static_cast<double>(k);
    const Vec2 direction(std::cos(angle), std::sin(angle));
    corner[k] = *std::max_element(points.begin(), points.end(),
                                  [&](const Vec2& a, const Vec2& b) { return a.dot(direction) < b.dot(direction); });
  }
  const auto is_inside = [&](const Vec2& point) {
    for (std::size_t k = 0; k < corner.size(); ++k) {
      const Vec2 &a = corner[k], &b = corner[(k + 1) % corner.size()];
      if (a != b && !(turn(a, b, point) > 0.0))
        return false;
    }
    return true;
  };
  points.erase(std::remove_if(points.begin(), points.end(), is_inside), points.end());
}

/// Corners of the convex hull against the clock, by monotone chains (Andrew 1979).
std::vector<Vec2> convex_hull(std::vector<Vec2> points)
{
  if (points.size() < 2)
    return points;
  if (points.size() > 16)
    drop_inner(points);
  std::sort(points.begin(), points.end(),
            [](const Vec2& a, const Vec2& b) { return a[0] != b[0] ? a[0] < b[0] : a[1] < b[1]; });
  std::vector<Vec2> hull;
  const auto chain = [&hull](auto from, auto to) {
    const std::size_t first = hull.size();
    for (auto point = from; point != to; ++point) {
      while (hull.size() >= first + 2 && turn(hull[hull.size() - 2], hull.back(), *point) <= 0.0)
        hull.pop_back();
      hull.push_back(*point);
    }
    hull.pop_back();  // where the other chain begins
  };
  chain(points.begin(), points.end());
  chain(points.rbegin(), points.rend());
  return hull;
}

}  // namespace

double shadow_area(const std::array<mpm::Column, 3>& points, double margin, const Vec3& ahead, Symmetry symmetry)
{
  // Across the motion, one direction as nearly along y as can be: a plane of symmetry then mirrors one coordinate
  // alone.
  const Vec3 aside = std::abs(ahead[1]) < 0.9 ? Vec3::UnitY() : Vec3::UnitX();
  const Vec3 second = (aside - aside.dot(ahead) * ahead).normalized(), first = second.cross(ahead);
  std::vector<Vec2> flat(points[0].size());
  for (std::size_t p = 0; p < flat.size(); ++p) {
    const Vec3 x(points[0][p], points[1][p], points[2][p]);
    flat[p] = { first.dot(x), second.dot(x) };
  }
  if (flat.empty())
    return 0.0;
  std::vector<Vec2> hull = convex_hull(std::move(flat));
  const auto add_images = [&hull](const Vec2& sign) {
    const std::size_t count = hull.size();
    for (std::size_t k = 0; k < count; ++k)
      hull.emplace_back(sign.cwiseProduct(hull[k]));
  };
  double parts = 1.0;
  if (symmetry != Symmetry::none) {
    add_images({ 1.0, -1.0 });
    parts = 2.0;
  }
  if (symmetry == Symmetry::quarter) {
    add_images({ -1.0, 1.0 });
    parts = 4.0;
  }
  for (std::size_t k = 0, count = hull.size(); k < count; ++k)
    for (const Vec2& corner : { Vec2(1.0, 1.0), Vec2(1.0, -1.0), Vec2(-1.0, 1.0), Vec2(-1.0, -1.0) })
      hull.emplace_back(hull[k] + 0.5 * margin * corner);
  hull = convex_hull(std::move(hull));
  double twice_area = 0.0;
  for (std::size_t k = 1; k + 1 < hull.size(); ++k)
    twice_area += turn(hull[0], hull[k], hull[k + 1]);
  return 0.5 * twice_area / parts;
}

}  // namespace geocontainer_mpm::scene
