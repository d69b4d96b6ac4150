#include "geocontainer_mpm/scene/shapes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include <fmt/format.h>

#include "geocontainer_mpm/error.h"

namespace geocontainer_mpm::scene {
namespace {

constexpr double pi = 3.14159265358979323846;

Vec2 rotate(const Vec2& x, const Vec2& pivot, double angle_deg)
{
  const double c = std::cos(angle_deg * pi / 180.0), s = std::sin(angle_deg * pi / 180.0);
  const Vec2 r = x - pivot;
  return pivot + Vec2(c * r[0] - s * r[1], s * r[0] + c * r[1]);
}

/// The inner wall of the port half from where the halves part, the last vertex on the plane of symmetry, upwards.
std::vector<Vec2> hopper_wall(const HullDescription& hull)
{
  std::vector<Vec2> wall;
  for (const Vec2& vertex : hull.port_section_m)
    if (vertex[0] <= 1e-9)
      wall.assign(1, vertex);
    else if (!wall.empty())
      wall.push_back(vertex);
  return wall;
}

std::vector<Vec2> hopper_outline(double area, const HullDescription& hull)
{
  const std::vector<Vec2> wall = hopper_wall(hull);
  double filled = 0.0;
  std::vector<Vec2> half;
  if (!wall.empty())
    half.push_back(wall.front());
  for (std::size_t k = 0; k + 1 < wall.size(); ++k) {
    const Vec2 &a = wall[k], &b = wall[k + 1];
    const double height = b[1] - a[1];
    if (!(height > 0.0))
      break;                                     // the hopper closes again: nothing can be filled above
    const double band = (a[0] + b[0]) * height;  // both halves
    if (filled + band < area) {
      filled += band;
      half.push_back(b);
      continue;
    }
    // Level t in [0, 1] of this band: 2 height (a t + (b - a) t^2 / 2) = rest.
    const double rest = area - filled, slope = b[0] - a[0];
    const double t = slope * slope < 1e-24 ? rest / (2.0 * height * a[0])
                                           : (-a[0] + std::sqrt(a[0] * a[0] + slope * rest / height)) / slope;
    half.emplace_back(a + t * (b - a));
    std::vector<Vec2> closed = half;
    for (auto it = half.rbegin(); it != half.rend(); ++it)
      if ((*it)[0] > 1e-9)
        closed.emplace_back(-(*it)[0], (*it)[1]);
    return closed;
  }
  throw InputError("", "shape.hopper_fill.area_m2", fmt::format("{}", area),
                   fmt::format("the hopper holds less than {} m2 below its deck", filled));
}

/// Sides of about `resolution` for a smooth circle.
int sides_around(double radius, double resolution)
{
  return std::max(24, static_cast<int>(std::ceil(2.0 * pi * radius / resolution)));
}

/// As many corners of a polygon on a circle as the sheet will have nodes along it, so that every node is on the circle.
int segments_around(double radius, double segment_length)
{
  int sides = std::max(3, static_cast<int>(std::lround(2.0 * pi * radius / segment_length)));
  while (sides > 3 && std::lround(2.0 * radius * sides * std::sin(pi / sides) / segment_length) < sides)
    --sides;
  return sides;
}

/// Counter-clockwise polygon on a circle.
std::vector<Vec2> circle(const Vec2& center, int sides, double radius)
{
  std::vector<Vec2> points;
  for (int k = 0; k < sides; ++k) {
    const double angle = 2.0 * pi * k / sides;
    points.emplace_back(center + radius * Vec2(std::cos(angle), std::sin(angle)));
  }
  return points;
}

/// Circles of particles between two radii, each particle as long as it is thick, as nearly as whole numbers allow.
Sampling sample_ring(const Vec2& center, double inner, double outer, double spacing)
{
  Sampling result;
  const int layers = std::max(1, static_cast<int>(std::lround((outer - inner) / spacing)));
  const double thickness = (outer - inner) / layers;
  for (int k = 0; k < layers; ++k) {
    const double low = inner + k * thickness, high = low + thickness;
    const double area = pi * (high * high - low * low);
    const int count = low > 0.0 ? std::max(6, static_cast<int>(std::lround(area / (thickness * thickness)))) : 3;
    // At the centroid of its piece of the ring.
    const double radius = 2.0 / 3.0 * (high * high * high - low * low * low) / (high * high - low * low) *
                          std::sin(pi / count) / (pi / count);
    for (int i = 0; i < count; ++i) {
      const double angle = 2.0 * pi * (i + 0.5 * (k % 2)) / count;
      result.points.emplace_back(center + radius * Vec2(std::cos(angle), std::sin(angle)));
      result.volumes.push_back(area / count);
    }
  }
  return result;
}

bool contains(const std::vector<Vec2>& polygon, const Vec2& x)
{
  bool in = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Vec2 &a = polygon[i], &b = polygon[j];
    if ((a[1] > x[1]) != (b[1] > x[1]) && x[0] < (b[0] - a[0]) * (x[1] - a[1]) / (b[1] - a[1]) + a[0])
      in = !in;
  }
  return in;
}

}  // namespace

std::vector<Vec2> half_of_hopper(const HullDescription& hull)
{
  std::vector<Vec2> half;
  for (const Vec2& vertex : hopper_wall(hull)) {
    if (!half.empty() && vertex[1] <= half.back()[1])
      break;
    half.push_back(vertex);
  }
  half.emplace_back(0.0, half.back()[1]);
  return half;
}

std::vector<Vec2> port_arc(const std::vector<Vec2>& polygon)
{
  const std::size_t n = polygon.size();
  const auto crossing = [](const Vec2& a, const Vec2& b) {
    return Vec2(0.0, a[1] + a[0] / (a[0] - b[0]) * (b[1] - a[1]));
  };
  std::vector<Vec2> arc;
  for (std::size_t start = 0; start < n && arc.empty(); ++start) {
    const Vec2 &before = polygon[start], &after = polygon[(start + 1) % n];
    if (!(before[0] <= 0.0 && after[0] > 0.0))
      continue;
    arc.push_back(before[0] == 0.0 ? before : crossing(before, after));
    std::size_t i = (start + 1) % n;
    for (; polygon[i][0] > 0.0; i = (i + 1) % n)
      arc.push_back(polygon[i]);
    arc.push_back(polygon[i][0] == 0.0 ? polygon[i] : crossing(arc.back(), polygon[i]));
  }
  return arc;
}

double polygon_area(const std::vector<Vec2>& polygon)
{
  double twice = 0.0;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++)
    twice += polygon[j][0] * polygon[i][1] - polygon[j][1] * polygon[i][0];
  return 0.5 * twice;
}

std::vector<Vec2> outline(const ShapeDescription& shape, const std::optional<HullDescription>& hull, double resolution)
{
  std::vector<Vec2> result;
  if (shape.box) {
    const Vec2 &lower = shape.box->lower_m, &upper = shape.box->upper_m;
    for (const Vec2& corner : { lower, Vec2(upper[0], lower[1]), upper, Vec2(lower[0], upper[1]) })
      result.push_back(rotate(corner, shape.box->pivot_m, shape.box->rotation_deg));
  } else if (shape.disc) {
    result = circle(shape.disc->center_m, sides_around(shape.disc->radius_m, resolution), shape.disc->radius_m);
  } else if (shape.ring) {
    result =
        circle(shape.ring->center_m, sides_around(shape.ring->outer_radius_m, resolution), shape.ring->outer_radius_m);
  } else if (shape.polygon) {
    result = shape.polygon->vertices_m;
  } else {
    result = hopper_outline(shape.hopper_fill->area_m2, hull.value());
  }
  if (polygon_area(result) < 0.0)
    std::reverse(result.begin(), result.end());
  return result;
}

Sampling sample(const ShapeDescription& shape, const std::vector<Vec2>& outline, double spacing)
{
  Sampling result;
  if (shape.box) {
    const Vec2 size = shape.box->upper_m - shape.box->lower_m;
    const int columns = std::max(1, static_cast<int>(std::lround(size[0] / spacing)));
    const int rows = std::max(1, static_cast<int>(std::lround(size[1] / spacing)));
    for (int i = 0; i < columns; ++i)
      for (int j = 0; j < rows; ++j) {
        const Vec2 x = shape.box->lower_m + Vec2((i + 0.5) * size[0] / columns, (j + 0.5) * size[1] / rows);
        result.points.push_back(rotate(x, shape.box->pivot_m, shape.box->rotation_deg));
      }
    result.volumes.assign(result.points.size(), size[0] * size[1] / static_cast<double>(result.points.size()));
    const Vec2 along_y = rotate(Vec2(size[0] / columns, 0.0), Vec2::Zero(), shape.box->rotation_deg),
               along_z = rotate(Vec2(0.0, size[1] / rows), Vec2::Zero(), shape.box->rotation_deg);
    result.tile = Vec2(std::hypot(along_y[0], along_z[0]), std::hypot(along_y[1], along_z[1]));
    return result;
  }
  if (shape.disc)
    return sample_ring(shape.disc->center_m, 0.0, shape.disc->radius_m, spacing);
  if (shape.ring)
    return sample_ring(shape.ring->center_m, shape.ring->inner_radius_m, shape.ring->outer_radius_m, spacing);
  Vec2 lower = outline.front(), upper = outline.front();
  for (const Vec2& vertex : outline) {
    lower = lower.cwiseMin(vertex);
    upper = upper.cwiseMax(vertex);
  }
  // Symmetric about the middle of the shape in y, so that a symmetric shape is filled symmetrically.
  const int columns = static_cast<int>(std::ceil(0.5 * (upper[0] - lower[0]) / spacing));
  const int rows = static_cast<int>(std::ceil((upper[1] - lower[1]) / spacing));
  const double middle = 0.5 * (lower[0] + upper[0]);
  for (int i = -columns; i < columns; ++i)
    for (int j = 0; j < rows; ++j) {
      const Vec2 x(middle + (i + 0.5) * spacing, upper[1] - (j + 0.5) * spacing);
      if (contains(outline, x))
        result.points.push_back(x);
    }
  if (!result.points.empty())
    result.volumes.assign(result.points.size(), polygon_area(outline) / static_cast<double>(result.points.size()));
  return result;
}

std::vector<std::vector<Vec2>> boundary_lines(const ShapeDescription& shape, const std::optional<HullDescription>& hull,
                                              double resolution)
{
  std::vector<std::vector<Vec2>> lines{ outline(shape, hull, resolution) };
  if (shape.ring) {
    lines.push_back(
        circle(shape.ring->center_m, sides_around(shape.ring->inner_radius_m, resolution), shape.ring->inner_radius_m));
    std::reverse(lines.back().begin(), lines.back().end());
  }
  return lines;
}

template <int Dim>
void jitter(double size, std::vector<Vec<Dim>>& points)
{
  std::uint64_t state = 2016;
  const auto random = [&] {  // SplitMix64 (Steele, Lea and Flood 2014), to [-1, 1)
    std::uint64_t z = (state += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return 0x1p-52 * static_cast<double>((z ^ (z >> 31)) >> 11) - 1.0;
  };
  for (Vec<Dim>& x : points)
    for (double& component : x)
      component += size * random();
}
template void jitter(double size, std::vector<Vec2>& points);
template void jitter(double size, std::vector<Vec3>& points);

namespace {

geotextile::SheetLayout sheet_path(const GeotextileDescription& sheet, const SceneDescription& scene)
{
  if (sheet.line)
    return { sheet.line->points_m, sheet.line->closed, {} };
  if (sheet.circle)
    return { circle(sheet.circle->center_m, segments_around(sheet.circle->radius_m, sheet.segment_length_m),
                    sheet.circle->radius_m),
             true,
             {} };
  return { outline(scene.bodies.at(sheet.encloses).shape, scene.hull, sheet.segment_length_m), true, {} };
}

}  // namespace

geotextile::SheetLayout sheet_layout(const GeotextileDescription& sheet, const SceneDescription& scene)
{
  geotextile::SheetLayout path = sheet_path(sheet, scene);
  if (!sheet.wrinkles)
    return path;
  const Wrinkles& wrinkles = *sheet.wrinkles;
  return geotextile::fold(path,
                          { wrinkles.region.lower_m, wrinkles.region.upper_m, wrinkles.number, wrinkles.amplitude_m });
}

double unstretched_length(const GeotextileDescription& sheet, const geotextile::SheetLayout& layout)
{
  const double path = layout.cloth_length();
  if (sheet.circumference_m)
    return *sheet.circumference_m;
  if (sheet.slack)
    return path * (1.0 + *sheet.slack);
  const geotextile::ForceStrain law(sheet.stiffness_n_per_m, sheet.force_strain_table);
  return path / (1.0 + law.strain(sheet.pretension_n_per_m.value_or(0.0)));
}

double top_at(const std::vector<Vec2>& polygon, double y)
{
  double top = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Vec2 &a = polygon[i], &b = polygon[j];
    if (std::min(a[0], b[0]) > y || std::max(a[0], b[0]) < y)
      continue;
    const double span = b[0] - a[0];
    top = std::max(top, std::abs(span) < 1e-12 ? std::max(a[1], b[1]) : a[1] + (y - a[0]) / span * (b[1] - a[1]));
  }
  return top;
}

}  // namespace geocontainer_mpm::scene
