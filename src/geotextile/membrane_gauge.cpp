/// Tension of a membrane over its gauge length: which triangles are near which, and their mean.

#include <algorithm>
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

}  // namespace

/// From each triangle on over common sides, as far as the gauge reaches: layers that lie on each other are not near.
void Membrane::find_neighbours(const TriangleMesh& mesh)
{
  const std::vector<std::vector<std::uint32_t>> beside = side_neighbours(mesh);
  const double reach = 0.5 * parameters_.gauge_length, reach_square = reach * reach;
  std::vector<std::size_t> seen(triangles_.size(), triangles_.size());  // by which triangle last
  begin_.assign(1, 0);
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    const Vec3 from = middle(t);
    near_.push_back(static_cast<std::uint32_t>(t));
    seen[t] = t;
    for (std::size_t at = begin_.back(); at < near_.size(); ++at)
      for (const std::uint32_t other : beside[near_[at]])
        if (seen[other] != t && (middle(other) - from).squaredNorm() <= reach_square) {
          seen[other] = t;
          near_.push_back(other);
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
      cloth += cloth_[other];
      warp_sum += cloth_[other] * family_[0].tension[other];
      weft_sum += cloth_[other] * family_[1].tension[other];
    }
    warp[t] = warp_sum / cloth;
    weft[t] = weft_sum / cloth;
  }
}

}  // namespace geocontainer_mpm::geotextile
