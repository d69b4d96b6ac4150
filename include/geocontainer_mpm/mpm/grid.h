#pragma once
/// The background grid: dense storage over the space of the scene, of which only the window around the material is
/// cleared, filled and updated.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "geocontainer_mpm/mpm/thread_team.h"
#include "geocontainer_mpm/mpm/types.h"

namespace geocontainer_mpm::mpm {

/// What a face of the grid does to material that reaches it. Free: nothing (material that leaves the grid ends the
/// run). Roller: no motion through the face, none hindered along it. Fixed: no motion at all.
enum class FaceCondition { free, roller, fixed };

/// Sign with which component `c` is mirrored at a face normal to `d`.
inline double mirror_sign(FaceCondition condition, int c, int d)
{
  return condition == FaceCondition::fixed || c == d ? -1.0 : 1.0;
}

/// Half-open box of node indices.
template <int Dim>
struct Window {
  std::array<int, Dim> begin{}, end{};
  std::size_t nodes() const
  {
    std::size_t n = 1;
    for (int d = 0; d < Dim; ++d)
      n *= static_cast<std::size_t>(end[d] > begin[d] ? end[d] - begin[d] : 0);
    return n;
  }
};

template <int Dim>
class Grid {
public:
  /// Momentum in the first Dim slots and mass in the last; after the update velocity takes momentum's place.
  using Node = Eigen::Array<double, 4, 1>;
  using Force = Eigen::Array<double, Dim == 2 ? 2 : 4, 1>;
  static constexpr int mass_slot = 3;
  /// Nodes with no more mass than this are round-off of stencil ends: they take no part.
  static constexpr double massless = 1e-300;
  /// Rows of nodes kept beyond each face, for stencils that reach over it.
  static constexpr int margin = 2;

  /// Space between `lower` and `upper` (m), a whole number of cells `dx` (m) in each direction.
  /// `faces`: low and high face of each direction in turn.
  Grid(const Vec<Dim>& lower, const Vec<Dim>& upper, double dx, const std::array<FaceCondition, 2 * Dim>& faces);

  double dx() const { return dx_; }
  double inverse_dx() const { return inverse_dx_; }
  /// Coordinate of node 0 (in the margin), m.
  const Vec<Dim>& origin() const { return origin_; }
  const std::array<int, Dim>& counts() const { return counts_; }
  const std::array<FaceCondition, 2 * Dim>& faces() const { return faces_; }
  /// Index of the first and last node on the faces of direction d.
  int low_face(int) const { return margin; }
  int high_face(int d) const { return counts_[d] - 1 - margin; }

  std::size_t index(const std::array<int, Dim>& node) const
  {
    std::size_t i = static_cast<std::size_t>(node[0]);
    for (int d = 1; d < Dim; ++d)
      i = i * static_cast<std::size_t>(counts_[d]) + static_cast<std::size_t>(node[d]);
    return i;
  }
  Vec<Dim> coordinate(const std::array<int, Dim>& node) const
  {
    Vec<Dim> x;
    for (int d = 0; d < Dim; ++d)
      x[d] = origin_[d] + node[d] * dx_;
    return x;
  }
  std::size_t size() const { return nodes_.size(); }

  const Window<Dim>& window() const { return window_; }
  /// Makes `window` the active one and zeroes its nodes and forces.
  void open(const Window<Dim>& window, ThreadTeam& team);

  Node* nodes() { return nodes_.data(); }
  const Node* nodes() const { return nodes_.data(); }
  Force* forces() { return forces_.data(); }
  const Force* forces() const { return forces_.data(); }

  /// A second velocity of every node (first Dim slots): that before the forces (FLIP), or that which moves the
  /// particles (MUSL). There is no storage for it before the first call of ensure_kept().
  void ensure_kept();
  Force* kept() { return kept_.data(); }
  const Force* kept() const { return kept_.data(); }
  /// Keeps the velocities that the nodes of the window have now, those beyond the faces with them.
  void keep_velocities(ThreadTeam& team);

  /// Room of `per_node` numbers a node for work on elements, grown on demand and never cleared. Which belong together
  /// is up to the user (src/mpm/elements.h).
  double* element_scratch(std::size_t per_node) { return room(element_scratch_, per_node); }
  double* node_scratch(std::size_t per_node) { return room(node_scratch_, per_node); }

  /// Work on the window is handed to threads in blocks of this many slowest indices.
  static constexpr int rows_per_block = 8;
  static int blocks_of_rows(const Window<Dim>& window)
  {
    return (window.end[0] - window.begin[0] + rows_per_block - 1) / rows_per_block;
  }
  /// Calls `visit(slowest index)` for the rows of one block.
  template <class Visitor>
  void visit_block(int block, Visitor&& visit) const
  {
    const int first = window_.begin[0] + block * rows_per_block;
    for (int slowest = first; slowest < std::min(first + rows_per_block, window_.end[0]); ++slowest)
      visit(slowest);
  }

  /// The window's rows: all nodes with the same indices but the last one lie side by side. `visit(first, node, length)`
  /// gets the storage index of the first node, its indices, and the number of nodes.
  template <class Visitor>
  void visit_rows(int slowest, Visitor&& visit) const
  {
    std::array<int, Dim> node = window_.begin;
    node[0] = slowest;
    const int length = window_.end[Dim - 1] - window_.begin[Dim - 1];
    if constexpr (Dim == 2) {
      visit(index(node), node, length);
    } else {
      for (node[1] = window_.begin[1]; node[1] < window_.end[1]; ++node[1])
        visit(index(node), node, length);
    }
  }

private:
  double* room(std::vector<double>& scratch, std::size_t per_node) const
  {
    if (scratch.size() < per_node * size())
      scratch.resize(per_node * size());
    return scratch.data();
  }

  double dx_, inverse_dx_;
  Vec<Dim> origin_;
  std::array<int, Dim> counts_{};
  std::array<FaceCondition, 2 * Dim> faces_;
  Window<Dim> window_{};
  std::vector<Node, Eigen::aligned_allocator<Node>> nodes_;
  std::vector<Force, Eigen::aligned_allocator<Force>> forces_;
  std::vector<Force, Eigen::aligned_allocator<Force>> kept_;
  std::vector<double> element_scratch_, node_scratch_;
};

}  // namespace geocontainer_mpm::mpm
