#pragma once
/// Order of the particles in memory: by strips of cells, so that strips two apart never write the same node and threads
/// may work on them at once, with the same order of summation whatever the number of threads.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "geocontainer_mpm/mpm/grid.h"
#include "geocontainer_mpm/mpm/particles.h"

namespace geocontainer_mpm::mpm {

/// Cells of a strip in the slowest direction. A particle that has drifted up to a cell since the sort writes nodes
/// [a - 1, a + width + 3) of the strip starting at a; the strip two further on begins at a + 2 width - 1.
inline constexpr int strip_width = 4;

/// Strips of one set of particles: strip s holds rows [begin[s], begin[s + 1]).
struct Strips {
  std::vector<std::uint32_t> begin;
  std::size_t count() const { return begin.empty() ? 0 : begin.size() - 1; }
};

/// Sorts by strip and cell and says where each strip begins. Scratch space is kept by the object.
template <int Dim>
class Sorter {
public:
  void sort(const Grid<Dim>& grid, Particles<Dim>& particles, Strips& strips);

private:
  std::vector<std::uint32_t> cell_, order_, counter_;
};

}  // namespace geocontainer_mpm::mpm
