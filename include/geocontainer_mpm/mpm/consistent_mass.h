#pragma once
/// The mass matrix of the particles, M_ij = sum_p m_p w_i w_j (Burgess, Sulsky and Brackbill 1992, JCP 103:1), and its
/// solution by conjugate gradients.
///
/// Alone it is singular where particles are few (its rank is at most their number) and has next to no inertia at nodes
/// that are barely reached (m w^2 beside m w). Forces there, -V sigma grad w, are not small. So a hundredth of the
/// lumped matrix stands in for a hundredth of it: rows still add up to the lumped mass, momentum is conserved, every
/// node with mass has inertia, and no frequency is more than 10 times that of the lumped matrix. In a filled grid of
/// linear simplices, whose smallest eigenvalue relative to the lumped mass is 1 / (Dim + 2), that hundredth is hardly
/// seen; of B-splines (0.13^Dim) it damps the roughest modes.

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "geocontainer_mpm/mpm/discretisation.h"
#include "geocontainer_mpm/mpm/grid.h"
#include "geocontainer_mpm/mpm/particles.h"
#include "geocontainer_mpm/mpm/sorting.h"

namespace geocontainer_mpm::mpm {

template <int Dim>
class ConsistentMass {
public:
  using Value = Eigen::Array<double, Dim, 1>;

  static constexpr double lumped_part = 0.01;
  /// Of the residual, in the norm of the inverse diagonal, for each component on its own.
  static constexpr double tolerance = 1e-12;
  /// The preconditioned matrix has a condition number of a few hundred: never reached, short of a NaN.
  static constexpr int most_iterations = 1000;

  /// Begins a matrix for the nodes that have mass now: after the first scatter of a step, before GridUpdate.
  void open(Shape shape, const Grid<Dim>& grid);
  /// Adds a sorted body.
  void add(const Particles<Dim>& particles, const Strips& strips, const Grid<Dim>& grid, ThreadTeam& team);
  /// Adds the nodes of a sheet, on one thread.
  void add(const Particles<Dim>& nodes, const Grid<Dim>& grid);

  /// Storage indices of the nodes with mass, ascending: the order of the vectors below.
  const std::vector<std::uint32_t>& active() const { return active_; }

  /// The matrix under the face conditions: velocities beyond a face mirror those inside, components held on it are
  /// zero. v <- M v; entries of nodes beyond faces are not read and become zero.
  void multiply(std::vector<Value>& v, ThreadTeam& team);
  /// v <- M^-1 v for momenta that are mirrored back inside; zero beyond faces. Returns the iterations.
  int solve(std::vector<Value>& v, ThreadTeam& team);

private:
  struct Mirror {
    std::uint32_t beyond, inside;
    Value sign;
  };
  struct Held {
    std::uint32_t node;
    Value keep;  ///< 0 for the components that are held, else 1
  };

  void find_faces(const Grid<Dim>& grid);
  void add_particle(const Particles<Dim>& particles, std::size_t p, const Grid<Dim>& grid);
  void spread(std::vector<Value>& v) const;
  void fold(std::vector<Value>& v) const;
  void apply(ThreadTeam& team);
  template <class Work>
  Value sum_blocks(ThreadTeam& team, Work&& work);

  Shape shape_ = Shape::bspline2;
  std::size_t width_ = 0;               ///< neighbours of a node, itself included: 5^Dim or 3^Dim
  std::vector<std::uint32_t> active_;   ///< storage index by number
  std::vector<std::uint32_t> number_;   ///< by storage index + padding_; active_.size() for a node without mass
  std::size_t padding_ = 0;             ///< so that neighbours of the grid's outermost nodes have an entry
  std::vector<std::ptrdiff_t> offset_;  ///< of a neighbour's storage index
  std::vector<double> entries_;         ///< width_ a node
  std::vector<double> diagonal_;        ///< of the matrix under the face conditions, for conditioning
  std::vector<Mirror> mirrors_;
  std::vector<Held> held_;
  std::vector<Value> solution_, residual_, direction_, image_;  ///< one more entry, zero, than active nodes
  std::vector<Value> block_sums_;
};

}  // namespace geocontainer_mpm::mpm
