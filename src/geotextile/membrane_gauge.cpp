/// Tension of a membrane over its gauge length: which triangles are near which, and their mean.

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "geocontainer_mpm/geotextile/membrane.h"

namespace geocontainer_mpm::geotextile {
namespace {

/// Triangles of the same panel that share a side, for each triangle.
std::vector<std::vector<std::uint32_t>> side_neighbours(const TriangleMesh& mesh)
{
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> at_side;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3]);
      at_side[{ low, high }].push_back(static_cast<std::uint32_t>(t));
    }
  std::vector<std::vector<std::uint32_t>> beside(mesh.triangles.size());
  for (const auto& [side, triangles] : at_side)
    for (const std::uint32_t t : triangles)
      for (const std::uint32_t other : triangles)
        if (other != t && (mesh.panel.empty() || mesh.panel[other] == mesh.panel[t]))
          beside[t].push_back(other);
  return beside;
}

/// Corners of a triangle in the plane of the cloth: lengths of cloth along warp and weft, m.
using CornersInCloth = std::array<Vec2, 3>;

/// A triangle laid out in the cloth with one of its corners at a place.
CornersInCloth lay_out(const TriangleMesh& mesh, std::size_t triangle, std::size_t corner, const Vec2& place)
{
  const Triangle& t = mesh.triangles[triangle];
  const std::array<double, 2> full =
      mesh.fullness.empty() ? std::array<double, 2>{ 1.0, 1.0 } : mesh.fullness[triangle];
  CornersInCloth corners;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 apart = mesh.points[t[k]] - mesh.points[t[corner]];
    corners[k] = place + Vec2(full[0] * apart.dot(mesh.warp[triangle]), full[1] * apart.dot(mesh.weft[triangle]));
  }
  return corners;
}

/// Where two triangles that share a side have a corner in common: which it is of each.
std::pair<std::size_t, std::size_t> common_corner(const Triangle& a, const Triangle& b)
{
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      if (a[i] == b[j])
        return { i, j };
  return { 0, 0 };
}

struct Window {
  Vec2 lower, upper;
};

Window box_of(const CornersInCloth& c)
{
  return { c[0].cwiseMin(c[1]).cwiseMin(c[2]), c[0].cwiseMax(c[1]).cwiseMax(c[2]) };
}

/// A square of cloth in the middle of a box, and not smaller than that.
Window window_around(const Window& box, double length)
{
  const Vec2 middle = 0.5 * (box.lower + box.upper), half = (0.5 * (box.upper - box.lower)).cwiseMax(0.5 * length);
  return { middle - half, middle + half };
}

double part_within(const Window& box, const Window& window)
{
  const Vec2 overlap = box.upper.cwiseMin(window.upper) - box.lower.cwiseMax(window.lower);
  // Neighbours that only touch, to round-off, are not in it.
  const Vec2 part = overlap.cwiseQuotient(box.upper - box.lower);
  return (part.array() > 1e-9).all() ? part[0] * part[1] : 0.0;
}

}  // namespace

/// From each triangle on over common sides, in the plane of the cloth, as far as the gauge reaches: layers that lie on
/// each other are not near. A triangle counts by the part of its box along the yarns that is in the window.
void Membrane::find_neighbours(const TriangleMesh& mesh)
{
  const std::vector<std::vector<std::uint32_t>> beside = side_neighbours(mesh);
  std::vector<std::size_t> seen(triangles_.size(), triangles_.size());  // by which triangle last
  std::vector<CornersInCloth> corners;                                  // of near_ from begin_.back() on
  begin_.assign(1, 0);
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    corners.assign(1, lay_out(mesh, t, 0, Vec2::Zero()));
    const Window window = window_around(box_of(corners[0]), parameters_.gauge_length);
    near_.push_back(static_cast<std::uint32_t>(t));
    share_.push_back(1.0);
    seen[t] = t;
    for (std::size_t at = begin_.back(); at < near_.size(); ++at) {
      const std::uint32_t from = near_[at];
      const CornersInCloth known = corners[at - begin_.back()];
      for (const std::uint32_t other : beside[from]) {
        if (seen[other] == t)
          continue;
        seen[other] = t;
        const auto [mine, its] = common_corner(mesh.triangles[from], mesh.triangles[other]);
        const CornersInCloth placed = lay_out(mesh, other, its, known[mine]);
        const double share = part_within(box_of(placed), window);
        if (!(share > 0.0))
          continue;
        near_.push_back(other);
        share_.push_back(share);
        corners.push_back(placed);
      }
    }
    begin_.push_back(static_cast<std::uint32_t>(near_.size()));
  }
}

void Membrane::gauge_tension(std::vector<double>& warp, std::vector<double>& weft) const
{
  warp.resize(triangles_.size());
  weft.resize(triangles_.size());
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    double cloth = 0.0, warp_sum = 0.0, weft_sum = 0.0;
    for (std::uint32_t k = begin_[t]; k < begin_[t + 1]; ++k) {
      const std::uint32_t other = near_[k];
      const double part = share_[k] * cloth_[other];
      cloth += part;
      warp_sum += part * family_[0].tension[other];
      weft_sum += part * family_[1].tension[other];
    }
    warp[t] = warp_sum / cloth;
    weft[t] = weft_sum / cloth;
  }
}

}  // namespace geocontainer_mpm::geotextile
