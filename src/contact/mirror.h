#pragma once
/// Faces of the grid that mirror, seen from a point that pushes on nodes near them.

#include <array>
#include <cstddef>
#include <cstdint>

#include "geocontainer_mpm/mpm/grid.h"

namespace geocontainer_mpm::contact {

/// Whether a point reaches nodes on or beyond a face that mirrors.
template <int Dim>
bool is_near_mirror(const Vec<Dim>& point, const mpm::Grid<Dim>& grid)
{
  constexpr double reach_cells = 1.5;
  for (int d = 0; d < Dim; ++d) {
    const double at = (point[d] - grid.origin()[d]) * grid.inverse_dx();
    const auto mirrors = [&](int side) {
      return grid.faces()[static_cast<std::size_t>(2 * d + side)] != mpm::FaceCondition::free;
    };
    if ((mirrors(0) && at < grid.low_face(d) + reach_cells) || (mirrors(1) && at > grid.high_face(d) - reach_cells))
      return true;
  }
  return false;
}

/// A node, and what of a vector there each direction keeps.
template <int Dim>
struct Image {
  std::array<int, Dim> node;
  Vec<Dim> sign = Vec<Dim>::Ones();
};

/// Where a node stands whose image may be inside.
template <int Dim>
Image<Dim> image_of(std::uint32_t storage_index, const mpm::Grid<Dim>& grid)
{
  Image<Dim> image;
  std::size_t rest = storage_index;
  for (int d = Dim - 1; d >= 0; --d) {
    const auto slot = static_cast<std::size_t>(d), count = static_cast<std::size_t>(grid.counts()[slot]);
    image.node[slot] = static_cast<int>(rest % count);
    rest /= count;
  }
  for (int d = 0; d < Dim; ++d)
    for (int side = 0; side < 2; ++side) {
      const mpm::FaceCondition condition = grid.faces()[static_cast<std::size_t>(2 * d + side)];
      if (condition == mpm::FaceCondition::free)
        continue;
      const int face = side == 0 ? grid.low_face(d) : grid.high_face(d), outwards = side == 0 ? -1 : 1;
      int& at = image.node[static_cast<std::size_t>(d)];
      const int beyond = outwards * (at - face);
      at = beyond > 0 ? 2 * face - at : at;
      for (int c = 0; c < Dim; ++c) {
        if (mpm::mirror_sign(condition, c, d) < 0.0 && beyond >= 0)
          image.sign[c] *= beyond > 0 ? -1.0 : 0.0;
      }
    }
  return image;
}

}  // namespace geocontainer_mpm::contact
