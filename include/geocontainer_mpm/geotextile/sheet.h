#pragma once
/// The geotextile as a FEM surface coupled to the grid (Hamad, Moormann, Vermeer 2012; Hamad et al. 2014): nodes are
/// material points that move with the grid's velocity, two-node segments between them carry tension only.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "geocontainer_mpm/mpm/grid.h"
#include "geocontainer_mpm/mpm/particles.h"

namespace geocontainer_mpm::geotextile {

struct SheetParameters {
  double circumference = 0.0;       ///< unstretched length all around, m
  double stiffness = 0.0;           ///< J, N/m
  double mass = 0.0;                ///< true mass per area, kg/m^2
  double computational_mass = 0.0;  ///< inertia per area under mass scaling, kg/m^2
  double segment_length = 0.0;      ///< wanted, m
  double gauge_length = 0.0;        ///< m
};

/// A closed sheet in plane strain. Node i and node (i + 1) % n bound segment i.
class Sheet {
public:
  /// Laid along the closed `outline`; the unstretched length is spread evenly, so that what exceeds the outline is
  /// slack everywhere (a shorter one is pre-tension).
  Sheet(const std::vector<Vec2>& outline, const SheetParameters& parameters);

  mpm::Particles<2>& nodes() { return nodes_; }
  const mpm::Particles<2>& nodes() const { return nodes_; }
  std::size_t segments() const { return rest_length_.size(); }
  Vec2 node(std::size_t i) const { return { nodes_.position[0][i], nodes_.position[1][i] }; }

  /// Tension of every segment from the nodes' positions, T = J max(0, l / l0 - 1), and the forces on the nodes.
  /// Returns whether any segment is taut; if none is, the forces are zero and need no second look.
  bool update_forces();

  const std::vector<double>& tension() const { return tension_; }  ///< per segment, N/m
  /// Mean tension over the gauge length around each segment's middle, N/m.
  void gauge_tension(std::vector<double>& result) const;
  double elastic_energy() const;  ///< J/m
  double largest_strain() const;  ///< >= 0
  double enclosed_area() const;   ///< m^2

  /// Bound on the square of the largest frequency that the sheet adds to the grid whose nodal masses stand in `grid`,
  /// 1/s^2: element by element, each segment taking the part of the nodal mass that its stiffness has there. Segments
  /// that are slack by more than a margin add nothing. Call after update_forces().
  double frequency_bound(const mpm::Grid<2>& grid);

private:
  SheetParameters parameters_;
  mpm::Particles<2> nodes_;
  std::vector<double> rest_length_, tension_, strain_;

  /// How the weights of one segment's ends differ over the grid nodes that either reaches.
  struct Difference {
    std::array<std::uint32_t, 36> node;
    std::array<double, 36> magnitude;  ///< |w_i(b) - w_i(a)|
    std::size_t count;
  };
  Difference difference(std::size_t segment, const mpm::Grid<2>& grid) const;
  std::vector<Difference> differences_;  ///< scratch of frequency_bound
  std::vector<double> nodal_stiffness_;  ///< scratch over grid nodes, zero between calls
};

}  // namespace geocontainer_mpm::geotextile
