#include "geocontainer_mpm/contact/boundary_body.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "geocontainer_mpm/error.h"

namespace geocontainer_mpm::contact {
namespace {

/// Depth to which a plate is seen, in its spacing.
constexpr double plate_depth_spacings = 0.5;

int pieces_of(double length, double spacing)
{
  return std::max(1, static_cast<int>(std::ceil(length / spacing - 1e-9)));
}

/// Exact at both ends.
Vec<3> between(const Vec<3>& a, const Vec<3>& b, double part)
{
  return part < 1.0 ? Vec<3>(a + part * (b - a)) : b;
}

/// Y of the edge from `a` to `b`, which is not level, at height z.
double edge_at(const Vec2& a, const Vec2& b, double z)
{
  return between({ 0.0, a[0], a[1] }, { 0.0, b[0], b[1] }, (z - a[1]) / (b[1] - a[1]))[1];
}

/// Calls `visit(a, b)` for the edges of a closed line that cross the height z.
template <class Visitor>
void visit_edges_at(const std::vector<Vec2>& line, double z, Visitor&& visit)
{
  for (std::size_t k = 0; k < line.size(); ++k) {
    const Vec2 &a = line[k], &b = line[k + 1 < line.size() ? k + 1 : 0];
    if ((a[1] > z) != (b[1] > z))
      visit(a, b);
  }
}

/// By the edges on the one side of it (even: outside).
bool is_inside(const std::vector<Vec2>& outline, const Vec2& x)
{
  bool inside = false;
  visit_edges_at(outline, x[1], [&](const Vec2& a, const Vec2& b) { inside ^= edge_at(a, b, x[1]) > x[0]; });
  return inside;
}

}  // namespace

template <int Dim>
BoundaryBody<Dim>::BoundaryBody(std::string name, Surface surface, double friction)
    : name_(std::move(name)), surface_(std::move(surface)), friction_(friction)
{
  Vec2 lower = surface_.line().front(), upper = lower;
  for (const Vec2& vertex : surface_.line()) {
    lower = lower.cwiseMin(vertex);
    upper = upper.cwiseMax(vertex);
  }
  reference_lower_ = with_section(Vec<Dim>::Zero(), lower);
  reference_upper_ = with_section(Vec<Dim>::Zero(), upper);
}

/// Particles sit at the middle of equal pieces of each segment, so that every one has one clear normal.
template <int Dim>
void BoundaryBody<Dim>::line_up(double spacing)
{
  const std::vector<Vec2>& line = surface_.line();
  for (std::size_t k = 0; k < surface_.segments(); ++k) {
    const Vec2 along = line[k + 1 < line.size() ? k + 1 : 0] - line[k];
    const int pieces = pieces_of(along.norm(), spacing);
    for (int i = 0; i < pieces; ++i) {
      reference_.push_back(line[k] + (i + 0.5) / pieces * along);
      normal_.push_back(left_normal(along.normalized()));
    }
  }
}

/// Each segment has its own lattice to its very edges, and so its own normals, and the whole has no gaps.
template <int Dim>
void BoundaryBody<Dim>::extrude(const Along& along, double spacing)
{
  if (!(along.to > along.from))
    throw InputError("", "surface", "x from " + std::to_string(along.from) + " to " + std::to_string(along.to),
                     "a stretch of x longer than 0");
  reference_lower_[0] = along.from;
  reference_upper_[0] = along.to;
  const std::vector<Vec2>& line = surface_.line();
  for (std::size_t k = 0; k < surface_.segments(); ++k) {
    const Vec2 &a = line[k], &b = line[k + 1 < line.size() ? k + 1 : 0];
    add_lattice({ { { along.from, a[0], a[1] },
                    { along.to, a[0], a[1] },
                    { along.from, b[0], b[1] },
                    { along.to, b[0], b[1] } } },
                with_section(Vec<3>::Zero(), left_normal((b - a).normalized())), spacing);
  }
}

/// Cut at the height of every vertex, the inside is trapezia.
template <int Dim>
void BoundaryBody<Dim>::fill_outline(double at_x, double free_side, double spacing)
{
  if (!surface_.closed())
    throw InputError("", "surface", "an open outline", "the outline of a plate is closed");
  if (std::abs(free_side) != 1.0)
    throw InputError("", "surface", "free side " + std::to_string(free_side), "1 or -1, along x");
  free_side_ = free_side;
  depth_ = plate_depth_spacings * spacing;
  reference_lower_[0] = reference_upper_[0] = at_x;
  std::vector<double> level;
  for (const Vec2& vertex : surface_.line())
    level.push_back(vertex[1]);
  std::sort(level.begin(), level.end());
  level.erase(std::unique(level.begin(), level.end()), level.end());
  std::vector<std::array<double, 3>> edge;  // y in the middle of the strip, at its bottom and at its top
  for (std::size_t k = 0; k + 1 < level.size(); ++k) {
    const double low = level[k], high = level[k + 1], middle = 0.5 * (low + high);
    edge.clear();
    visit_edges_at(surface_.line(), middle, [&](const Vec2& a, const Vec2& b) {
      edge.push_back({ edge_at(a, b, middle), edge_at(a, b, low), edge_at(a, b, high) });
    });
    std::sort(edge.begin(), edge.end());
    for (std::size_t e = 0; e + 1 < edge.size(); e += 2)
      add_lattice({ { { at_x, edge[e][1], low },
                      { at_x, edge[e + 1][1], low },
                      { at_x, edge[e][2], high },
                      { at_x, edge[e + 1][2], high } } },
                  { free_side, 0.0, 0.0 }, spacing);
  }
}

/// A flat piece with corners 0-1 on one side and 2-3 on the other.
template <int Dim>
void BoundaryBody<Dim>::add_lattice(const std::array<Vec<3>, 4>& corner, const Vec<3>& normal, double spacing)
{
  const auto pieces = [&](std::size_t a, std::size_t b, std::size_t c, std::size_t d) {
    return pieces_of(std::max((corner[b] - corner[a]).norm(), (corner[d] - corner[c]).norm()), spacing);
  };
  const int columns = pieces(0, 1, 2, 3), rows = pieces(0, 2, 1, 3);
  const auto first = static_cast<std::uint32_t>(reference_.size());
  for (int row = 0; row <= rows; ++row) {
    const double up = static_cast<double>(row) / rows;
    const Vec<3> left = between(corner[0], corner[2], up), right = between(corner[1], corner[3], up);
    for (int column = 0; column <= columns; ++column) {
      reference_.push_back(between(left, right, static_cast<double>(column) / columns));
      normal_.push_back(normal);
    }
  }
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const double area = (reference_[b] - reference_[a]).cross(reference_[c] - reference_[a]).dot(normal);
    if (area > 0.0)
      triangles_.push_back({ a, b, c });
    else if (area < 0.0)
      triangles_.push_back({ a, c, b });
  };
  const auto across = static_cast<std::uint32_t>(columns) + 1;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const std::uint32_t at = first + static_cast<std::uint32_t>(row) * across + static_cast<std::uint32_t>(column);
      add(at, at + 1, at + across);
      add(at + 1, at + across + 1, at + across);
    }
}

template <int Dim>
Nearest<Dim> BoundaryBody<Dim>::nearest(const Vec<Dim>& point) const
{
  if constexpr (Dim == 2) {
    Nearest<2> result = surface_.nearest(start_.invert(point));
    result.normal = start_.turn(result.normal);
    return result;
  } else {
    Nearest<3> nowhere{ std::numeric_limits<double>::infinity(), Vec<3>::Zero() };
    const Vec2 in_reference = start_.invert(in_section(point));
    if (free_side_ != 0.0) {
      const double distance = free_side_ * (point[0] - reference_lower_[0]);
      if (distance < -depth_ || !is_inside(surface_.line(), in_reference))
        return nowhere;
      return { distance, { free_side_, 0.0, 0.0 } };
    }
    if (point[0] < reference_lower_[0] || point[0] > reference_upper_[0])
      return nowhere;
    const Nearest<2> section = surface_.nearest(in_reference);
    return { section.distance, with_section(Vec<3>::Zero(), start_.turn(section.normal)) };
  }
}

// What is for one dimension is made for it only: not the whole class at once.
template BoundaryBody<2>::BoundaryBody(std::string, Surface, double);
template BoundaryBody<3>::BoundaryBody(std::string, Surface, double);
template void BoundaryBody<2>::line_up(double);
template void BoundaryBody<3>::extrude(const Along&, double);
template void BoundaryBody<3>::fill_outline(double, double, double);
template Nearest<2> BoundaryBody<2>::nearest(const Vec<2>&) const;
template Nearest<3> BoundaryBody<3>::nearest(const Vec<3>&) const;

}  // namespace geocontainer_mpm::contact
