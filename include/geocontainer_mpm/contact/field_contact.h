#pragma once
/// Unilateral Coulomb contact between two velocity fields on grids of one lattice.
///
/// As Bardenhagen, Guilkey, Roessig, Brackbill, Witzel and Foster (2001, CMES 2:509), impulses act between the fields
/// at the nodes that both have mass at, so that momentum is conserved exactly. But the condition there is on the gap
/// between the surfaces, (v_b - v_a) . n >= -gap / dt, so that nothing acts across the reach of the shape functions
/// before the surfaces meet. Normal and gap of a node come from the particles that reach it, as Nairn, Hammerquist and
/// Smith (2020, CMAME 362:112859) do, whose logistic regression looks for the plane between the two clouds: here it is
/// the plane with the widest margin, that is, across the shortest way between the clouds' hulls. It is exact for
/// straight faces and at corners on a face, where mass gradients mislead.
///
/// Limits: a hollow that is narrower than the reach of a node is bridged by its hull, and so touches early. Fields that
/// interpenetrate by a particle's width fall back on the gradients of their volumes.

#include <array>
#include <cstdint>
#include <vector>

#include "geocontainer_mpm/contact/contact_solver.h"

namespace geocontainer_mpm::contact {

/// One side of a contact.
struct ContactField {
  mpm::Grid<2>* grid;                           ///< updated by the forces of this step
  const std::vector<ContactPoints<2>>* points;  ///< all that moves with it: bodies, also those in a sheet, and sheets
};

class FieldContact {
public:
  explicit FieldContact(mpm::Shape shape = mpm::Shape::bspline2) : shape_(shape) {}

  /// Corrects the velocities of both grids, which have the same origin, counts and cell. `kick`: time over which this
  /// step's forces acted, s; `dt`: time until the next positions, s. In the sums `impulse` is that on `b` (`a` feels
  /// the opposite), the energies are those of both, and `skipped` is 1 when they share no node. The material of more
  /// than two fields: every pair in turn, in a fixed order.
  ContactSums<2> solve(const ContactField& a, const ContactField& b, double friction, double kick, double dt);

private:
  /// A node at which both fields have mass.
  struct Node {
    std::size_t index;                                         ///< in both grids
    Vec2 position;                                             ///< m
    Vec2 volume_gradient = Vec2::Zero();                       ///< of b less that of a, m: from a to b
    std::array<Vec2, 2> middle{ Vec2::Zero(), Vec2::Zero() };  ///< weighted sum of what reaches it, relative to it, m
    std::array<double, 2> weight{};
    std::array<std::uint32_t, 2> first;  ///< heads of two lists in entries_
  };
  struct Entry {
    Vec2 position;      ///< relative to the node, m
    double half_width;  ///< m
    std::uint32_t next;
  };
  /// The particles of one side around one node.
  struct Cloud {
    std::vector<Vec2> position;
    std::vector<double> half_width;
  };

  void find_nodes(const mpm::Grid<2>& a, const mpm::Grid<2>& b);
  template <class Reach>
  void add(std::size_t side, const ContactPoints<2>& set, std::size_t p, const Vec2& x, const Reach& reach);
  void gather(std::size_t side, const ContactField& field);
  Nearest<2> separation(const Node& node, double reach, double tiny);
  void fill_cloud(std::uint32_t first, Cloud& cloud) const;

  mpm::Shape shape_;
  std::vector<Node> nodes_;
  std::vector<Entry> entries_;
  std::array<Cloud, 2> cloud_;
  std::vector<std::uint32_t> number_;                 ///< per grid node its place in nodes_; `none` between calls
  Vec2 lower_ = Vec2::Zero(), upper_ = Vec2::Zero();  ///< box of the nodes, m
};

}  // namespace geocontainer_mpm::contact
