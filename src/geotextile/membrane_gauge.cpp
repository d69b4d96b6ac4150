/// Tension of a membrane over its gauge length: which triangles are near which, and their mean.

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "geocontainer_mpm/geotextile/membrane.h"

namespace geocontainer_mpm::geotextile {
namespace {

/// What is beside a triangle across its side k, from corner k to the next.
struct Beside {
  std::vector<std::uint32_t> others;  ///< of the same panel
  bool open = false;                  ///< nothing at all: the edge of the cloth, or a plane of symmetry
};

std::vector<std::array<Beside, 3>> find_sides(const TriangleMesh& mesh)
{
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> at_side;
  const auto side = [&](std::size_t t, std::size_t k) {
    return std::minmax({ mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3] });
  };
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      at_side[side(t, k)].push_back(static_cast<std::uint32_t>(t));
  std::vector<std::array<Beside, 3>> beside(mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::vector<std::uint32_t>& there = at_side[side(t, k)];
      beside[t][k].open = there.size() == 1;
      for (const std::uint32_t other : there)
        if (other != t && (mesh.panel.empty() || mesh.panel[other] == mesh.panel[t]))
          beside[t][k].others.push_back(other);
    }
  return beside;
}

/// Corners of a triangle in the plane of the cloth: lengths of cloth along warp and weft, m.
using CornersInCloth = std::array<Vec2, 3>;

/// A triangle, or its image, in the plane of the cloth.
struct Placed {
  std::uint32_t triangle;
  Vec2 sense;  ///< -1 along a direction in which it is an image, else 1
  CornersInCloth corners;
  std::size_t image() const { return (sense[0] < 0.0 ? 1U : 0U) + (sense[1] < 0.0 ? 2U : 0U); }
};

/// A triangle laid out in the cloth with one of its corners at a place.
Placed lay_out(const TriangleMesh& mesh, std::uint32_t triangle, const Vec2& sense, std::size_t corner,
               const Vec2& place)
{
  const Triangle& t = mesh.triangles[triangle];
  const std::array<double, 2> full =
      mesh.fullness.empty() ? std::array<double, 2>{ 1.0, 1.0 } : mesh.fullness[triangle];
  CornersInCloth corners;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 apart = mesh.points[t[k]] - mesh.points[t[corner]];
    corners[k] = place + sense.cwiseProduct(
                             Vec2(full[0] * apart.dot(mesh.warp[triangle]), full[1] * apart.dot(mesh.weft[triangle])));
  }
  return { triangle, sense, corners };
}

/// The image behind side k, which is a plane of symmetry and so crosses one family of yarns at right angles.
Placed image_behind(const TriangleMesh& mesh, const Placed& known, std::size_t k)
{
  const Vec2 side = known.corners[(k + 1) % 3] - known.corners[k];
  Vec2 sense = known.sense;
  sense[std::abs(side[0]) < std::abs(side[1]) ? 0 : 1] *= -1.0;
  return lay_out(mesh, known.triangle, sense, k, known.corners[k]);
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
/// each other are not near. What is behind a plane of symmetry is the image of what is before it. A triangle counts by
/// the part of its box along the yarns that is in the window.
void Membrane::find_neighbours(const TriangleMesh& mesh)
{
  const std::vector<std::array<Beside, 3>> sides = find_sides(mesh);
  std::vector<std::size_t> seen(4 * triangles_.size(), triangles_.size());  // by which triangle last, per image
  std::vector<Placed> placed;
  begin_.assign(1, 0);
  for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
    placed.assign(1, lay_out(mesh, t, Vec2::Ones(), 0, Vec2::Zero()));
    const Window window = window_around(box_of(placed[0].corners), parameters_.gauge_length);
    seen[4 * t] = t;
    near_.push_back(t);
    share_.push_back(1.0);
    const auto look_at = [&](const Placed& next) {
      const std::size_t image = 4 * next.triangle + next.image();
      if (seen[image] == t)
        return;
      seen[image] = t;
      const double share = part_within(box_of(next.corners), window);
      if (!(share > 0.0))
        return;
      placed.push_back(next);
      near_.push_back(next.triangle);
      share_.push_back(share);
    };
    for (std::size_t at = 0; at < placed.size(); ++at) {
      const Placed known = placed[at];
      for (std::size_t k = 0; k < 3; ++k) {
        const Beside& beside = sides[known.triangle][k];
        if (beside.open && mesh.closed)
          look_at(image_behind(mesh, known, k));
        for (const std::uint32_t other : beside.others) {
          const auto [mine, its] = common_corner(mesh.triangles[known.triangle], mesh.triangles[other]);
          look_at(lay_out(mesh, other, known.sense, its, known.corners[mine]));
        }
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
