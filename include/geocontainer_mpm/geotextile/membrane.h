#pragma once
/// The geotextile in space: a surface of three-node triangles coupled to the grid, the counterpart of a Sheet of
/// segments (Hamad, Moormann, Vermeer 2012; Hamad et al. 2014). Its nodes are material points that move with the grid's
/// velocity and carry the sheet's mass, its contact and the loads on it; triangles between them are strained by the
/// nodes' positions and pull at the nodes.
///
/// Law: a woven fabric as an elastic net, two families of yarns that cross without slipping and carry tension alone
/// (Rivlin 1955, J. Rational Mech. Anal. 4:951; Steigmann and Pipkin 1991, Phil. Trans. R. Soc. A 335:419). Along the
/// unit direction a of a family in the unstretched cloth the stretch is lambda = |F a|, with F the gradient of the
/// position, constant in a triangle; the energy per unstretched area is
///
///     W = w_warp(lambda_warp - 1) + w_weft(lambda_weft - 1)
///
/// each the area below its force-strain curve, zero in compression. With F a = g = sum_k b_k x_k, sum_k b_k = 0, and
/// unstretched area A a family pulls at node k by
///
///     f_k = -A T b_k g / |g|
///
/// Tension T is force per unstretched width of cloth, as in a tensile test (ISO 10319), N/m. There is no shear and no
/// bending stiffness: where both families are short the cloth is slack, where one is it is wrinkled, the tension field
/// of Wagner (1929) with the yarns as its only directions. A triangle with sides along its yarns is a segment in each
/// of them, so that a cylindrical sheet without strain along its axis pulls as the Sheet of its section does.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "geocontainer_mpm/geotextile/force_strain.h"
#include "geocontainer_mpm/geotextile/mesh.h"
#include "geocontainer_mpm/mpm/frequency_bound.h"
#include "geocontainer_mpm/mpm/particles.h"
#include "geocontainer_mpm/state_access.h"

namespace geocontainer_mpm::geotextile {

struct MembraneParameters {
  double warp_stiffness = 0.0, weft_stiffness = 0.0;                 ///< J, N/m; of no account where there is a table
  std::vector<ForceStrainRow> warp_force_strain, weft_force_strain;  ///< see ForceStrain; empty: linear
  double mass = 0.0;                                                 ///< true mass per unstretched area, kg/m^2
  double computational_mass = 0.0;       ///< inertia per unstretched area under mass scaling, kg/m^2
  double gauge_length = 0.0;             ///< m
  std::optional<double> rupture_strain;  ///< from this strain on yarns carry nothing
};

/// What acts on a closed membrane beside its own tension, for one step: p(z) = pressure + gradient (z_ref - z), Pa, on
/// its inner side; z_ref is `level`, or the highest node now. It follows the sheet, its level does not follow the
/// sheet's volume.
struct MembraneLoad {
  double pressure = 0.0;
  double gradient = 0.0;  ///< Pa/m
  std::optional<double> level;
};

/// A sheet in space. A piece is one family of yarns in one triangle.
class Membrane {
public:
  /// As laid by the mesh, node i at its point i. A node has the mass of the cloth that is nearest to it, so that the
  /// masses of a regular mesh are equal whichever way its diagonals run.
  Membrane(const TriangleMesh& mesh, const MembraneParameters& parameters);

  mpm::Particles<3>& nodes() { return nodes_; }
  const mpm::Particles<3>& nodes() const { return nodes_; }
  const std::vector<Triangle>& triangles() const { return triangles_; }
  /// A seam across the warp of this triangle: its warp breaks at this tension, N/m > 0, if it does not before.
  void tear_at(std::size_t triangle, double tension);
  bool closed() const { return closed_; }
  Vec3 node(std::size_t i) const { return { nodes_.position[0][i], nodes_.position[1][i], nodes_.position[2][i] }; }

  /// Before a transfer: forces on the nodes from loads and from the tension that the nodes' positions give. Returns
  /// whether anything acts; if not, forces are zero.
  bool update_forces(const MembraneLoad& load = {});
  /// As a Sheet of segments: strained by the nodes' positions, not by the grid's velocity gradients.
  bool strains_with_grid() const { return false; }
  void update_stress(double) {}
  double stress_power() const { return 0.0; }

  /// Per triangle, N/m: the larger one of warp and weft.
  const std::vector<double>& tension() const { return tension_; }
  const std::vector<double>& warp_tension() const { return family_[0].tension; }
  const std::vector<double>& weft_tension() const { return family_[1].tension; }
  /// Per triangle, N/m: mean over a square of cloth around it, of its panel, its sides along the yarns and as long as
  /// the gauge.
  void gauge_tension(std::vector<double>& warp, std::vector<double>& weft) const;
  double elastic_energy() const;   ///< J
  double largest_strain() const;   ///< of what has a tension, >= 0
  double area() const;             ///< of the triangles now, m^2
  double enclosed_volume() const;  ///< m^3, up to planes of symmetry (see TriangleMesh::closed); of an open sheet 0
  /// Loads of the last update_forces() times the nodes' present velocities, W. The work over a step that kicks for
  /// the time `kick` is kick times the mean of this before and after the step.
  double external_power() const;
  /// What the tensions of the last update_forces() store in a time at the nodes' present velocities, W.
  double tension_power() const;

  /// Pieces that have reached their rupture strain; where the first did, m; and the energy that was stored in them, J.
  /// A broken piece carries nothing from then on; its triangle stays, for contact, pressure and its other yarns.
  std::size_t ruptures() const { return ruptures_; }
  const Vec3& rupture_place() const { return rupture_place_; }
  double rupture_energy() const;

  /// Pieces that are taut, or so little slack that they may tighten within a step; as of the last update_forces().
  std::size_t active_pieces() const;
  /// Their stiffness, with the steepest tangent of the force-strain curve. Rigorous, that of tension across the yarns
  /// included: T over lambda is below the steepest tangent.
  void add_stiffness(mpm::FrequencyBound<3>& bound) const;

private:
  friend struct geocontainer_mpm::StateAccess;

  /// All that belongs to one direction of yarns; columns per triangle.
  struct Family {
    ForceStrain law;
    mpm::Column b1, b2;  ///< coefficients of nodes 1 and 2, 1/m; that of node 0 is minus their sum
    mpm::Column strain;
    std::vector<double> rupture_strain;  ///< infinite: never
    std::vector<double> tension;         ///< N/m
    std::vector<char> broken;
  };

  void lay(const TriangleMesh& mesh, std::size_t triangle);
  void find_neighbours(const TriangleMesh& mesh);
  double carried(Family& family, std::size_t triangle, double strain);
  bool pull();
  void add_pressure(const MembraneLoad& load);
  Vec3 middle(std::size_t triangle) const;

  MembraneParameters parameters_;
  mpm::Particles<3> nodes_;
  std::vector<Triangle> triangles_;
  bool closed_;
  mpm::Column cloth_;             ///< unstretched area, m^2
  std::array<Family, 2> family_;  ///< warp, weft
  std::vector<double> tension_;   ///< N/m
  std::size_t ruptures_ = 0;
  Vec3 rupture_place_ = Vec3::Zero();
  std::array<mpm::Column, 3> external_;      ///< of all forces, what loads add, N
  std::vector<std::uint32_t> near_, begin_;  ///< gauge: triangles near triangle t are near_[begin_[t]] to begin_[t + 1]
  std::vector<double> share_;                ///< of each of near_, the part in the gauge's window
};

}  // namespace geocontainer_mpm::geotextile
