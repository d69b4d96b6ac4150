#include "description_shapes.h"

#include <algorithm>
#include <cmath>

namespace geocontainer_mpm::scene {

namespace {

constexpr double pi = 3.14159265358979323846;

double cross(const Vec2& a, const Vec2& b)
{
  return a[0] * b[1] - a[1] * b[0];
}

bool on_segment(const Vec2& a, const Vec2& b, const Vec2& p)
{
  return cross(b - a, p - a) == 0.0 && (p - a).dot(p - b) <= 0.0;
}

bool segments_meet(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d)
{
  const double c_side = cross(b - a, c - a);
  const double d_side = cross(b - a, d - a);
  const double a_side = cross(d - c, a - c);
  const double b_side = cross(d - c, b - c);
  if (((c_side > 0.0 && d_side < 0.0) || (c_side < 0.0 && d_side > 0.0)) &&
      ((a_side > 0.0 && b_side < 0.0) || (a_side < 0.0 && b_side > 0.0)))
    return true;
  return on_segment(a, b, c) || on_segment(a, b, d) || on_segment(c, d, a) || on_segment(c, d, b);
}

/// Neighbours share a vertex by nature; they cross only by folding straight back.
bool folds_back(const Vec2& before, const Vec2& shared, const Vec2& after)
{
  const Vec2 in = shared - before;
  const Vec2 out = after - shared;
  return cross(in, out) == 0.0 && in.dot(out) < 0.0;
}

}  // namespace

std::optional<std::pair<std::size_t, std::size_t>> crossing_sides(const std::vector<Vec2>& vertices, bool closed)
{
  const std::size_t n = vertices.size();
  const std::size_t sides = closed ? n : n - 1;
  const auto vertex = [&](std::size_t i) -> const Vec2& { return vertices[i % n]; };
  for (std::size_t i = 0; i < sides; ++i)
    if (vertex(i) == vertex(i + 1))
      return std::make_pair(i, i);
  for (std::size_t i = 0; i < sides; ++i)
    for (std::size_t j = i + 1; j < sides; ++j) {
      const bool follows = j == i + 1;
      const bool wraps = closed && i == 0 && j == sides - 1;
      bool bad = false;
      if (follows)
        bad = folds_back(vertex(i), vertex(j), vertex(j + 1));
      if (wraps)
        bad = bad || folds_back(vertex(j), vertex(0), vertex(1));
      if (!follows && !wraps)
        bad = segments_meet(vertex(i), vertex(i + 1), vertex(j), vertex(j + 1));
      if (bad)
        return std::make_pair(i, j);
    }
  return std::nullopt;
}

double line_length(const std::vector<Vec2>& vertices, bool closed)
{
  double length = closed ? (vertices.front() - vertices.back()).norm() : 0.0;
  for (std::size_t i = 1; i < vertices.size(); ++i)
    length += (vertices[i] - vertices[i - 1]).norm();
  return length;
}

std::vector<Vec2> corners(const Box& box)
{
  const Eigen::Rotation2Dd rotation(box.rotation_deg * pi / 180.0);
  std::vector<Vec2> list{
    box.lower_m, { box.upper_m[0], box.lower_m[1] }, box.upper_m, { box.lower_m[0], box.upper_m[1] }
  };
  for (Vec2& corner : list)
    corner = box.pivot_m + rotation * (corner - box.pivot_m);
  return list;
}

std::vector<double> fillet_share(const std::vector<Vec2>& line, double radius_m)
{
  std::vector<double> share(line.size() - 1, 0.0);
  for (std::size_t i = 1; i + 1 < line.size(); ++i) {
    const Vec2 in = line[i] - line[i - 1];
    const Vec2 out = line[i + 1] - line[i];
    const double turn = std::atan2(std::abs(cross(in, out)), in.dot(out));
    const double tangent = radius_m * std::tan(turn / 2.0);
    share[i - 1] += tangent / in.norm();
    share[i] += tangent / out.norm();
  }
  return share;
}

std::optional<Eigen::AlignedBox2d> extent(const ShapeDescription& shape)
{
  std::vector<Vec2> points;
  if (shape.box)
    points = corners(*shape.box);
  if (shape.polygon)
    points = shape.polygon->vertices_m;
  if (shape.disc) {
    const Vec2 radius = Vec2::Constant(shape.disc->radius_m);
    points = { shape.disc->center_m - radius, shape.disc->center_m + radius };
  }
  if (shape.ring) {
    const Vec2 radius = Vec2::Constant(shape.ring->outer_radius_m);
    points = { shape.ring->center_m - radius, shape.ring->center_m + radius };
  }
  if (points.empty())
    return std::nullopt;
  Eigen::AlignedBox2d box;
  for (const Vec2& point : points)
    box.extend(point);
  return box;
}

std::optional<double> outline_length(const ShapeDescription& shape)
{
  if (shape.box)
    return line_length(corners(*shape.box), true);
  if (shape.polygon)
    return line_length(shape.polygon->vertices_m, true);
  if (shape.disc)
    return 2.0 * pi * shape.disc->radius_m;
  if (shape.ring)
    return 2.0 * pi * shape.ring->outer_radius_m;
  return std::nullopt;
}

}  // namespace geocontainer_mpm::scene
