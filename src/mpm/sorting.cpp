#include "geocontainer_mpm/mpm/sorting.h"

#include <cmath>

namespace geocontainer_mpm::mpm {

template <int Dim>
void Sorter<Dim>::sort(const Grid<Dim>& grid, Particles<Dim>& particles, Strips& strips)
{
  // Counting sort by the storage index of the stencil's lowest node: its slowest direction varies slowest.
  const std::size_t n = particles.size();
  cell_.resize(n);
  order_.resize(n);
  counter_.assign(grid.size() + 1, 0);
  for (std::size_t p = 0; p < n; ++p) {
    std::array<int, Dim> base;
    for (int d = 0; d < Dim; ++d)
      base[d] = static_cast<int>(std::floor((particles.position[d][p] - grid.origin()[d]) * grid.inverse_dx() - 0.5));
    cell_[p] = static_cast<std::uint32_t>(grid.index(base));
    ++counter_[cell_[p] + 1];
  }
  for (std::size_t c = 1; c < counter_.size(); ++c)
    counter_[c] += counter_[c - 1];

  const std::size_t strip_nodes =
      static_cast<std::size_t>(strip_width) * (grid.size() / static_cast<std::size_t>(grid.counts()[0]));
  strips.begin.clear();
  for (std::size_t c = 0; c < grid.size(); c += strip_nodes)
    strips.begin.push_back(counter_[c]);
  strips.begin.push_back(static_cast<std::uint32_t>(n));

  for (std::size_t p = 0; p < n; ++p)
    order_[counter_[cell_[p]]++] = static_cast<std::uint32_t>(p);
  particles.permute(order_);
}

template class Sorter<2>;
template class Sorter<3>;

}  // namespace geocontainer_mpm::mpm
