#include "geocontainer_mpm/mpm/grid.h"

#include <algorithm>
#include <cmath>

namespace geocontainer_mpm::mpm {

template <int Dim>
Grid<Dim>::Grid(const Vec<Dim>& lower, const Vec<Dim>& upper, double dx,
                const std::array<FaceCondition, 2 * Dim>& faces)
    : dx_(dx), inverse_dx_(1.0 / dx), origin_(lower - Vec<Dim>::Constant(margin * dx)), faces_(faces)
{
  std::size_t total = 1;
  for (int d = 0; d < Dim; ++d) {
    counts_[d] = static_cast<int>(std::lround((upper[d] - lower[d]) / dx)) + 1 + 2 * margin;
    total *= static_cast<std::size_t>(counts_[d]);
  }
  nodes_.assign(total, Node::Zero());
  forces_.assign(total, Force::Zero());
}

template <int Dim>
void Grid<Dim>::open(const Window<Dim>& window, ThreadTeam& team)
{
  window_ = window;
  team.for_each(blocks_of_rows(window_), [this](int block) {
    visit_block(block, [this](int slowest) {
      visit_rows(slowest, [this](std::size_t first, const std::array<int, Dim>&, int length) {
        std::fill_n(nodes_.begin() + static_cast<std::ptrdiff_t>(first), length, Node::Zero());
        std::fill_n(forces_.begin() + static_cast<std::ptrdiff_t>(first), length, Force::Zero());
      });
    });
  });
}

template <int Dim>
void Grid<Dim>::ensure_kept()
{
  if (kept_.empty())
    kept_.assign(size(), Force::Zero());
}

template <int Dim>
void Grid<Dim>::keep_velocities(ThreadTeam& team)
{
  ensure_kept();
  team.for_each(blocks_of_rows(window_), [this](int block) {
    visit_block(block, [this](int slowest) {
      visit_rows(slowest, [this](std::size_t first, const std::array<int, Dim>&, int length) {
        for (std::size_t i = first; i < first + static_cast<std::size_t>(length); ++i)
          kept_[i].template head<Dim>() = nodes_[i].template head<Dim>();
      });
    });
  });
}

template class Grid<2>;
template class Grid<3>;

}  // namespace geocontainer_mpm::mpm
