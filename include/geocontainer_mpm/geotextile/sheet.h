#pragma once
/// The geotextile as a FEM surface coupled to the grid (Hamad, Moormann, Vermeer 2012; Hamad et al. 2014): nodes are
/// material points that move with the grid's velocity, two-node segments between them carry tension only.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "geocontainer_mpm/geotextile/layout.h"
#include "geocontainer_mpm/mpm/grid.h"
#include "geocontainer_mpm/mpm/particles.h"

namespace geocontainer_mpm::geotextile {

struct SheetParameters {
  double unstretched_length = 0.0;  ///< around, or from end to end, m
  double stiffness = 0.0;           ///< J, N/m
  double mass = 0.0;                ///< true mass per area, kg/m^2
  double computational_mass = 0.0;  ///< inertia per area under mass scaling, kg/m^2
  double segment_length = 0.0;      ///< wanted, m
  double gauge_length = 0.0;        ///< m
};

/// What acts on a sheet beside its own tension, for one step.
struct SheetLoad {
  /// On the inner side of a closed sheet, p(z) = pressure + gradient (z_ref - z), Pa; z_ref is `level`, or the highest
  /// node now. It follows the sheet, its level does not follow the sheet's volume.
  double pressure = 0.0;
  double gradient = 0.0;  ///< Pa/m
  std::optional<double> level;
  Vec2 start_force = Vec2::Zero(), end_force = Vec2::Zero();  ///< at the ends of an open sheet, N/m
};

/// One segment as a spring between two nodes, for whoever assembles stiffness.
struct SheetSegment {
  std::size_t start, end;  ///< nodes
  double stiffness;        ///< J / l0, N/m^2: force per width and lengthening
  bool active;             ///< taut, or so little slack that it may tighten within a step
};

/// A sheet in plane strain. Segment i goes from node i to the next one; of a closed sheet the last goes back to node 0,
/// an open one has a node more than segments.
class Sheet {
public:
  /// Laid along the line, segments of equal length of cloth: shorter ones where the layout is fuller. What the
  /// unstretched length exceeds the layout's cloth by is spread evenly, so that it is slack everywhere (a shorter one
  /// is pre-tension). All rest lengths are equal.
  Sheet(const SheetLayout& layout, const SheetParameters& parameters);

  mpm::Particles<2>& nodes() { return nodes_; }
  const mpm::Particles<2>& nodes() const { return nodes_; }
  bool closed() const { return nodes_.size() == segments(); }
  /// 1 if the right side of a closed sheet's segments looks outwards, -1 if their left side; open: 0.
  double outwards() const { return outwards_; }
  std::size_t segments() const { return rest_length_.size(); }
  Vec2 node(std::size_t i) const { return { nodes_.position[0][i], nodes_.position[1][i] }; }
  /// Node at the end of a segment; the one at its start has the segment's own number.
  std::size_t end_of(std::size_t segment) const { return segment + 1 < nodes_.size() ? segment + 1 : 0; }
  /// As of the last update_forces().
  SheetSegment segment(std::size_t i) const;

  /// Tension of every segment from the nodes' positions, T = J max(0, l / l0 - 1), and the forces on the nodes, loads
  /// included. Returns whether there are any; if not, the forces are zero and need no second look.
  bool update_forces(const SheetLoad& load = {});

  const std::vector<double>& tension() const { return tension_; }  ///< per segment, N/m
  /// Mean tension over the gauge length around each segment's middle, or what of it an open sheet has there, N/m.
  void gauge_tension(std::vector<double>& result) const;
  double elastic_energy() const;  ///< J/m
  double largest_strain() const;  ///< >= 0
  double length() const;          ///< along the nodes, m
  double enclosed_area() const;   ///< m^2; of an open sheet 0
  /// Loads of the last update_forces() times the nodes' present velocities, W/m. The work over a step that kicks for
  /// the time `kick` is kick times the mean of this before and after the step.
  double external_power() const;
  /// What the tensions of the last update_forces() store in a time at the nodes' present velocities, W/m.
  double tension_power() const;

  /// Bound on the square of the largest frequency that the sheet adds to the grid whose nodal masses stand in `grid`,
  /// 1/s^2: element by element, each segment taking the part of the nodal mass that its stiffness has there. Segments
  /// that are slack by more than a margin add nothing. Call after update_forces().
  double frequency_bound(const mpm::Grid<2>& grid);

private:
  void add_pressure(const SheetLoad& load);
  double twice_signed_area() const;  ///< positive against the clock

  SheetParameters parameters_;
  mpm::Particles<2> nodes_;
  double outwards_ = 0.0;  ///< 1 if the right side of a segment looks outwards, -1 if its left side; open: 0
  std::vector<double> rest_length_, tension_, strain_;
  std::array<mpm::Column, 2> external_;  ///< of it all, what loads add to the forces, N/m

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
