#pragma once
/// The geotextile, in two formulations behind one interface. Both are rows of material points that move with the grid's
/// velocity and carry the sheet's mass, its contact and the loads on it; they differ in how tension arises and acts:
///
/// segments (default; Hamad, Moormann, Vermeer 2012; Hamad et al. 2014): a FEM surface coupled to the grid. Two-node
/// segments between the points are strained by the points' positions and pull at the points.
///
/// membrane_points (York, Sulsky and Schreyer 1999, IJNME 44:1429; 2000, 48:901): each point is a piece of membrane of
/// length l and no bending stiffness. The grid's velocity gradient L at the point stretches it along its tangent t,
/// d(ln l)/dt = t.L.t, and its stress, tension times t (x) t with nothing normal to the sheet and no shear, acts as
/// that of a soil particle, f_i = - T l t (t . grad w_i). The tangent is that of the chord between the point's
/// neighbours in the layer (York's way): it follows from where the layer is, while one pushed forward with F follows
/// from all that the grid ever said about one point and leaves the layer for good where points part or fold below a
/// cell. Power T l t.L.t is conjugate to the stretch whatever the tangent, so energy is kept, and a rigid rotation,
/// t.L.t = 0, changes no tension. The stretch is a memory of its own: nothing pulls it back to the distance of the
/// points.

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "geocontainer_mpm/geotextile/force_strain.h"
#include "geocontainer_mpm/geotextile/layout.h"
#include "geocontainer_mpm/mpm/frequency_bound.h"
#include "geocontainer_mpm/mpm/grid.h"
#include "geocontainer_mpm/mpm/particles.h"
#include "geocontainer_mpm/state_access.h"

namespace geocontainer_mpm::geotextile {

enum class Formulation { segments, membrane_points };

struct SheetParameters {
  double unstretched_length = 0.0;  ///< around, or from end to end, m
  double stiffness = 0.0;           ///< J, N/m; of no account where there is a table
  double mass = 0.0;                ///< true mass per area, kg/m^2
  double computational_mass = 0.0;  ///< inertia per area under mass scaling, kg/m^2
  double segment_length = 0.0;      ///< wanted, m
  double gauge_length = 0.0;        ///< m
  Formulation formulation = Formulation::segments;
  std::vector<ForceStrainRow> force_strain;  ///< see ForceStrain; empty: linear
  std::optional<double> rupture_strain;      ///< from this strain on a piece carries nothing
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
  /// A seam in this segment: it breaks at this tension, N/m > 0, if the sheet does not before. Of membrane points the
  /// pieces at both of its ends do.
  void tear_at(std::size_t segment, double tension);
  bool closed() const { return nodes_.size() == segments(); }
  /// 1 if the right side of a closed sheet's segments looks outwards, -1 if their left side; open: 0.
  double outwards() const { return outwards_; }
  std::size_t segments() const { return rest_length_.size(); }
  Vec2 node(std::size_t i) const { return { nodes_.position[0][i], nodes_.position[1][i] }; }
  /// Node at the end of a segment; the one at its start has the segment's own number.
  std::size_t end_of(std::size_t segment) const { return segment + 1 < nodes_.size() ? segment + 1 : 0; }

  /// Before a transfer: forces on the nodes from loads and, of segments, from the tension that the nodes' positions
  /// give; of membrane points the stress. Returns whether anything acts; if not, forces and stress are zero.
  bool update_forces(const SheetLoad& load = {});
  /// Membrane points, which strain with the grid: their gather is to bring the velocity gradient too, and their scatter
  /// takes the stress in nodes() to the grid.
  bool strains_with_grid() const { return parameters_.formulation == Formulation::membrane_points; }
  /// After a gather of velocity gradients, where a body updates its stress: stretch and stress of membrane points.
  /// Segments do nothing.
  void update_stress(double dt);

  /// Per segment, N/m. Of membrane points the mean of the two at its ends.
  const std::vector<double>& tension() const { return tension_; }
  /// Mean tension over the gauge length around each segment's middle, or what of it an open sheet has there, N/m.
  void gauge_tension(std::vector<double>& result) const;
  double elastic_energy() const;  ///< J/m
  double largest_strain() const;  ///< of what has a tension, >= 0
  double length() const;          ///< along the nodes, m
  double enclosed_area() const;   ///< m^2; of an open sheet 0
  /// Loads of the last update_forces() times the nodes' present velocities, W/m. The work over a step that kicks for
  /// the time `kick` is kick times the mean of this before and after the step.
  double external_power() const;
  /// What the tensions of segments, as of the last update_forces(), store in a time at the nodes' present velocities,
  /// W/m. Of membrane points 0.
  double tension_power() const;
  /// What the present tensions of membrane points store in a time at the velocity gradients of the last gather, W/m: as
  /// the stress power of a body. Of segments 0.
  double stress_power() const;

  /// Pieces, segments or membrane points, that have reached their rupture strain; where the first did, m; and the
  /// energy that was stored in them, J/m. A broken piece carries nothing from then on; the line of nodes stays, for
  /// contact and pressure.
  std::size_t ruptures() const { return ruptures_; }
  const Vec2& rupture_place() const { return rupture_place_; }
  double rupture_energy() const;

  /// Pieces that are taut, or so little slack that they may tighten within a step; as of the last update_forces().
  std::size_t active_pieces() const;
  /// Their stiffness, with the steepest tangent of the force-strain curve. Rigorous for the elastic stiffness alone:
  /// that of tension across the sheet is below it for segments and, T being a few per cent of J, small for points.
  void add_stiffness(mpm::FrequencyBound<2>& bound) const;

private:
  friend struct geocontainer_mpm::StateAccess;

  double carried(std::size_t piece, double strain, const Vec2& place);
  bool is_active(std::size_t piece) const;
  bool pull_with_segments();
  void add_pressure(const SheetLoad& load);
  double twice_signed_area() const;  ///< positive against the clock

  // membrane_points.cpp
  void lay_points();
  void find_tangents();
  bool stress_points();

  SheetParameters parameters_;
  ForceStrain law_;
  mpm::Particles<2> nodes_;  ///< of membrane points with stress (tension over a thickness of 1 m) and volume (length)
  double outwards_ = 0.0;    ///< 1 if the right side of a segment looks outwards, -1 if its left side; open: 0
  std::vector<double> rest_length_, tension_;  ///< per segment
  std::vector<double> piece_length_, strain_;  ///< unstretched, m; per piece: segment or membrane point
  std::vector<double> rupture_strain_;         ///< per piece; infinite: never
  std::vector<char> broken_;                   ///< per piece
  std::size_t ruptures_ = 0;
  Vec2 rupture_place_ = Vec2::Zero();
  std::array<mpm::Column, 2> external_;  ///< of it all, what loads add to the forces, N/m
  // Of membrane points alone.
  mpm::Column stretch_;                 ///< length over unstretched length
  std::array<mpm::Column, 2> tangent_;  ///< unit, of the chord of the neighbours
  mpm::Column point_tension_;           ///< N/m
};

}  // namespace geocontainer_mpm::geotextile
