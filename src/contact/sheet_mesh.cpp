#include "geocontainer_mpm/contact/sheet_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace geocontainer_mpm::contact {
namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
/// Triangles of less than this part of a cell's face have no direction; their neighbours stand in.
constexpr double least_area = 1e-12;
/// A rim is in a plane of symmetry but for round-off, cells.
constexpr double rim_cells = 1e-6;

/// Directions across the mirroring faces on which a place lies, as bits.
std::uint8_t mirrors_at(const Vec3& x, const mpm::Grid<3>& grid)
{
  std::uint8_t bits = 0;
  for (int d = 0; d < 3; ++d)
    for (int side = 0; side < 2; ++side) {
      const double face = side == 0 ? grid.low_face(d) : grid.high_face(d);
      if (grid.faces()[static_cast<std::size_t>(2 * d + side)] != mpm::FaceCondition::free &&
          std::abs((x[d] - grid.origin()[d]) * grid.inverse_dx() - face) < rim_cells)
        bits = static_cast<std::uint8_t>(bits | (1U << d));
    }
  return bits;
}

/// A normal together with its images'.
Vec3 with_images(Vec3 normal, std::uint8_t mirrors)
{
  for (int d = 0; d < 3; ++d)
    if ((mirrors >> d & 1U) != 0)
      normal[d] = 0.0;
  return normal;
}

}  // namespace

/// Which triangles share a side.
void SheetMesh::join(const std::vector<Corners>& triangles, std::size_t nodes)
{
  struct Side {
    std::uint32_t low, high, triangle, number;
    bool operator<(const Side& other) const { return low != other.low ? low < other.low : high < other.high; }
  };
  std::vector<Side> sides;
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    for (std::uint32_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(triangles[t][k], triangles[t][(k + 1) % 3]);
      sides.push_back({ low, high, t, k });
    }
  std::stable_sort(sides.begin(), sides.end());
  neighbour_.assign(triangles.size(), { none, none, none });
  on_rim_.assign(nodes, 0);
  for (std::size_t s = 0; s < sides.size(); ++s) {
    const Side& one = sides[s];
    if (s + 1 < sides.size() && !(one < sides[s + 1])) {
      const Side& other = sides[++s];
      neighbour_[one.triangle][one.number] = other.triangle;
      neighbour_[other.triangle][other.number] = one.triangle;
    } else {
      on_rim_[one.low] = on_rim_[one.high] = 1;
    }
  }
}

void SheetMesh::lay(const ClosedSheet<3>& sheet, SheetSide side, const mpm::Grid<3>& grid)
{
  const std::vector<Corners>& triangles = *sheet.triangles;
  if (neighbour_.size() != triangles.size())
    join(triangles, sheet.nodes->size());
  inwards_ = side == SheetSide::inside ? -1.0 : 1.0;
  facets_.resize(triangles.size());
  for (std::size_t t = 0; t < size(); ++t) {
    Facet& facet = facets_[t];
    facet.node = triangles[t];
    for (std::size_t k = 0; k < 3; ++k)
      facet.corner[k] = sheet.nodes->position_of(facet.node[k]);
    const Vec3 across = (facet.corner[1] - facet.corner[0]).cross(facet.corner[2] - facet.corner[0]);
    const double twice_area = across.norm();
    facet.normal = Vec3::Zero();
    if (twice_area > least_area * grid.dx() * grid.dx())
      facet.normal = inwards_ / twice_area * across;
  }
  add_normals(grid);
}

/// Normals at the nodes, weighted by the triangles' angles there.
void SheetMesh::add_normals(const mpm::Grid<3>& grid)
{
  node_normal_.assign(on_rim_.size(), Vec3::Zero());
  rim_mirror_.assign(on_rim_.size(), 0);
  for (const Facet& facet : facets_)
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 one = facet.corner[(k + 1) % 3] - facet.corner[k], other = facet.corner[(k + 2) % 3] - facet.corner[k];
      node_normal_[facet.node[k]] += std::atan2(one.cross(other).norm(), one.dot(other)) * facet.normal;
      if (on_rim_[facet.node[k]] != 0)
        rim_mirror_[facet.node[k]] = mirrors_at(facet.corner[k], grid);
    }
  for (std::size_t i = 0; i < node_normal_.size(); ++i)
    node_normal_[i] = with_images(node_normal_[i], rim_mirror_[i]);
}

Vec3 SheetMesh::lower(std::size_t triangle) const
{
  const std::array<Vec3, 3>& x = facets_[triangle].corner;
  return x[0].cwiseMin(x[1]).cwiseMin(x[2]);
}

Vec3 SheetMesh::upper(std::size_t triangle) const
{
  const std::array<Vec3, 3>& x = facets_[triangle].corner;
  return x[0].cwiseMax(x[1]).cwiseMax(x[2]);
}

bool SheetMesh::may_reach(std::size_t triangle, const Vec3& middle, double half) const
{
  const Facet& facet = facets_[triangle];
  return std::abs((middle - facet.corner[0]).dot(facet.normal)) <= half * facet.normal.lpNorm<1>();
}

/// By the regions around a triangle (Ericson 2005, Real-Time Collision Detection, 5.1.5).
SheetMesh::Place SheetMesh::nearest_place(const Facet& facet, const Vec3& point)
{
  const auto& [a, b, c] = facet.corner;
  const Vec3 ab = b - a, ac = c - a, ap = point - a, bp = point - b, cp = point - c;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap), d3 = ab.dot(bp), d4 = ac.dot(bp), d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d1 <= 0.0 && d2 <= 0.0)
    return { { 1.0, 0.0, 0.0 }, 1 };
  if (d3 >= 0.0 && d4 <= d3)
    return { { 0.0, 1.0, 0.0 }, 1 };
  if (d6 >= 0.0 && d5 <= d6)
    return { { 0.0, 0.0, 1.0 }, 1 };
  const double of_c = d1 * d4 - d3 * d2, of_b = d5 * d2 - d1 * d6, of_a = d3 * d6 - d5 * d4;
  if (of_c <= 0.0 && d1 >= 0.0 && d3 <= 0.0) {
    const double v = d1 / (d1 - d3);
    return { { 1.0 - v, v, 0.0 }, 2 };
  }
  if (of_b <= 0.0 && d2 >= 0.0 && d6 <= 0.0) {
    const double w = d2 / (d2 - d6);
    return { { 1.0 - w, 0.0, w }, 2 };
  }
  if (of_a <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) {
    const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return { { 0.0, 1.0 - w, w }, 2 };
  }
  const double all = of_a + of_b + of_c, v = of_b / all, w = of_c / all;
  return { { 1.0 - v - w, v, w }, 3 };
}

Vec3 SheetMesh::pseudo_normal(std::size_t triangle, const Place& place) const
{
  const Facet& facet = facets_[triangle];
  std::size_t k = 0;
  if (place.corners == 1) {
    while (place.share[k] == 0.0)
      ++k;
    return node_normal_[facet.node[k]];
  }
  while (place.share[(k + 2) % 3] != 0.0)  // the side from k to the next, across from the third
    ++k;
  const std::uint32_t other = neighbour_[triangle][k];
  if (other != none)
    return facet.normal + facets_[other].normal;
  const auto both = static_cast<std::uint8_t>(rim_mirror_[facet.node[k]] & rim_mirror_[facet.node[(k + 1) % 3]]);
  return with_images(facet.normal, both);
}

void SheetMesh::look(std::size_t triangle, const Vec3& point, double& best, SheetFoot<3>& foot) const
{
  const Facet& facet = facets_[triangle];
  const double height = (point - facet.corner[0]).dot(facet.normal);
  if (!(height * height < best))
    return;
  const Place place = nearest_place(facet, point);
  if (place.corners == 3) {
    best = height * height;
    foot = { facet.node, place.share, { height, facet.normal } };
    return;
  }
  Vec3 apart = point;
  for (std::size_t k = 0; k < 3; ++k)
    apart -= place.share[k] * facet.corner[k];
  const double square = apart.squaredNorm();
  if (!(square < best))
    return;
  best = square;
  const Vec3 pseudo = pseudo_normal(triangle, place);
  const double distance = std::sqrt(square), sign = apart.dot(pseudo) >= 0.0 ? 1.0 : -1.0;
  foot = { facet.node,
           place.share,
           { sign * distance, distance > 0.0 ? Vec3(sign / distance * apart) : facet.normal } };
}

int SheetMesh::winding(const Vec3& around) const
{
  int turns = 0;
  for (const Facet& facet : facets_) {
    // How often the triangle goes around the place seen from above, as SheetLine::winding. Sides are looked at from
    // their lower end, so that both triangles there say the same to the last bit.
    int seen = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 &a = facet.corner[k], &b = facet.corner[(k + 1) % 3];
      const bool rises = a[1] <= around[1] && b[1] > around[1], falls = a[1] > around[1] && b[1] <= around[1];
      if (!rises && !falls)
        continue;
      const Vec3 &low = rises ? a : b, &high = rises ? b : a;
      const double left = (high[0] - low[0]) * (around[1] - low[1]) - (around[0] - low[0]) * (high[1] - low[1]);
      seen += left > 0.0 ? (rises ? 1 : -1) : 0;
    }
    // It is above where its plane is.
    if (seen != 0 && seen * inwards_ * (around - facet.corner[0]).dot(facet.normal) < 0.0)
      turns += seen;
  }
  return turns;
}

}  // namespace geocontainer_mpm::contact
