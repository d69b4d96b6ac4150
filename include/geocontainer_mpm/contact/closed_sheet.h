#pragma once
/// A closed sheet as contact sees it, and the place on it that is nearest to a point.

#include <array>
#include <cstdint>
#include <vector>

#include "geocontainer_mpm/contact/surface.h"
#include "geocontainer_mpm/mpm/particles.h"

namespace geocontainer_mpm::contact {

/// In the plane a segment goes from each node to the next, the last to the first. In space triangles, against the clock
/// seen from outside; where the sheet has a rim it lies in a plane of symmetry, on a face of the grid that mirrors.
template <int Dim>
struct ClosedSheet {
  const mpm::Particles<Dim>* nodes;
  double outwards = 1.0;  ///< of a line, 1: the right side of the segments looks outwards; -1: the left
  const std::vector<std::array<std::uint32_t, 3>>* triangles = nullptr;
};

/// On which side of a sheet points belong.
enum class SheetSide { inside, outside };

/// The place on a sheet that is nearest to a point: on the facet between these nodes, by these shares, which sum to 1.
template <int Dim>
struct SheetFoot {
  std::array<std::uint32_t, Dim> node{};
  std::array<double, Dim> share{};
  Nearest<Dim> seen;  ///< distance positive, and normal into, where points belong
};

}  // namespace geocontainer_mpm::contact
