#include "geocontainer_mpm/mpm/transfer.h"

#include "geocontainer_mpm/mpm/bspline.h"

namespace geocontainer_mpm::mpm {
namespace {

template <int Dim>
std::array<double, Dim> position_of(const Particles<Dim>& particles, std::size_t p)
{
  std::array<double, Dim> x;
  for (int d = 0; d < Dim; ++d)
    x[d] = particles.position[d][p];
  return x;
}

/// Column j of a symmetric stress, padded to the width of a grid force, times `factor`.
template <int Dim>
typename Grid<Dim>::Force stress_column(const Particles<Dim>& particles, std::size_t p, int j, double factor)
{
  using Force = typename Grid<Dim>::Force;
  const auto s = [&](int k) { return factor * particles.stress[k][p]; };
  if constexpr (Dim == 2)
    return j == 0 ? Force{ s(0), s(2) } : Force{ s(2), s(1) };
  else
    return j == 0   ? Force{ s(0), s(3), s(4), 0.0 }
           : j == 1 ? Force{ s(3), s(1), s(5), 0.0 }
                    : Force{ s(4), s(5), s(2), 0.0 };
}

/// Scatters one particle. `Source` says at compile time what pushes: the body's stress or the sheet's external force.
enum class Source { stress, external };

template <int Dim, Source source>
inline void scatter(const Particles<Dim>& particles, std::size_t p, const Vec<Dim>& gravity, Grid<Dim>& grid)
{
  using Node = typename Grid<Dim>::Node;
  using Force = typename Grid<Dim>::Force;
  const Stencil<Dim> s = make_stencil<Dim>(position_of(particles, p), grid.origin(), grid.dx(), grid.inverse_dx());
  const double mass = particles.mass[p];

  Node momentum = Node::Zero();
  std::array<Node, Dim> affine;
  Force body = Force::Zero();
  std::array<Force, Dim> stress;
  momentum[Grid<Dim>::mass_slot] = mass;
  for (int d = 0; d < Dim; ++d) {
    momentum[d] = mass * particles.velocity[d][p];
    affine[d] = Node::Zero();
    for (int i = 0; i < Dim; ++i)
      affine[d][i] = mass * particles.affine[i * Dim + d][p];
    body[d] = particles.weight_mass[p] * gravity[d];
    if constexpr (source == Source::external)
      body[d] += particles.force[d][p];
    else
      stress[d] = stress_column<Dim>(particles, p, d, -particles.volume[p]);
  }

  // One row of three nodes along the fastest direction, given the product of the slower directions' factors.
  const auto add_row = [&](std::size_t first, const Node& m0, const Node& m1, const Force& f0, const Force& f1) {
    constexpr int last = Dim - 1;
    Node* nodes = grid.nodes() + first;
    Force* forces = grid.forces() + first;
    for (int k = 0; k < 3; ++k) {
      nodes[k] += s.weight[last][k] * (m0 + s.offset[last][k] * m1);
      forces[k] += s.weight[last][k] * f0 + s.gradient[last][k] * f1;
    }
  };

  if constexpr (Dim == 2) {
    std::size_t first = grid.index(s.base);
    for (int i = 0; i < 3; ++i, first += static_cast<std::size_t>(grid.counts()[1])) {
      const double w = s.weight[0][i];
      const Node m0 = w * (momentum + s.offset[0][i] * affine[0]);
      const Node m1 = w * affine[1];
      Force f0 = w * body;
      Force f1 = Force::Zero();
      if constexpr (source == Source::stress) {
        f0 += s.gradient[0][i] * stress[0];
        f1 = w * stress[1];
      }
      add_row(first, m0, m1, f0, f1);
    }
  } else {
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const double w = s.weight[0][i] * s.weight[1][j];
        const Node m0 = w * (momentum + s.offset[0][i] * affine[0] + s.offset[1][j] * affine[1]);
        const Node m1 = w * affine[2];
        Force f0 = w * body;
        Force f1 = Force::Zero();
        if constexpr (source == Source::stress) {
          f0 += s.gradient[0][i] * s.weight[1][j] * stress[0] + s.weight[0][i] * s.gradient[1][j] * stress[1];
          f1 = w * stress[2];
        }
        add_row(grid.index({ s.base[0] + i, s.base[1] + j, s.base[2] }), m0, m1, f0, f1);
      }
  }
}

/// Gathers one particle. The sums are separable: along the fastest direction first.
template <int Dim>
inline void gather(const Grid<Dim>& grid, double dt, bool want_gradient, Particles<Dim>& particles, std::size_t p)
{
  using Node = typename Grid<Dim>::Node;
  const Stencil<Dim> s = make_stencil<Dim>(position_of(particles, p), grid.origin(), grid.dx(), grid.inverse_dx());
  constexpr int last = Dim - 1;

  Node velocity = Node::Zero();
  std::array<Node, Dim> moment, gradient;
  moment.fill(Node::Zero());
  gradient.fill(Node::Zero());
  const auto sum_row = [&](std::size_t first, Node& value, Node& value_moment, Node& value_gradient) {
    const Node* nodes = grid.nodes() + first;
    value = s.weight[last][0] * nodes[0] + s.weight[last][1] * nodes[1] + s.weight[last][2] * nodes[2];
    value_moment = s.weight[last][0] * s.offset[last][0] * nodes[0] + s.weight[last][1] * s.offset[last][1] * nodes[1] +
                   s.weight[last][2] * s.offset[last][2] * nodes[2];
    value_gradient = s.gradient[last][0] * nodes[0] + s.gradient[last][1] * nodes[1] + s.gradient[last][2] * nodes[2];
  };

  Node value, value_moment, value_gradient;
  if constexpr (Dim == 2) {
    std::size_t first = grid.index(s.base);
    for (int i = 0; i < 3; ++i, first += static_cast<std::size_t>(grid.counts()[1])) {
      sum_row(first, value, value_moment, value_gradient);
      const double w = s.weight[0][i];
      velocity += w * value;
      moment[0] += w * s.offset[0][i] * value;
      moment[1] += w * value_moment;
      gradient[0] += s.gradient[0][i] * value;
      gradient[1] += w * value_gradient;
    }
  } else {
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        sum_row(grid.index({ s.base[0] + i, s.base[1] + j, s.base[2] }), value, value_moment, value_gradient);
        const double w = s.weight[0][i] * s.weight[1][j];
        velocity += w * value;
        moment[0] += w * s.offset[0][i] * value;
        moment[1] += w * s.offset[1][j] * value;
        moment[2] += w * value_moment;
        gradient[0] += s.gradient[0][i] * s.weight[1][j] * value;
        gradient[1] += s.weight[0][i] * s.gradient[1][j] * value;
        gradient[2] += w * value_gradient;
      }
  }

  const double inverse_inertia = 1.0 / bspline_inertia(grid.dx());
  for (int i = 0; i < Dim; ++i) {
    particles.velocity[i][p] = velocity[i];
    particles.position[i][p] += dt * velocity[i];
    for (int j = 0; j < Dim; ++j) {
      particles.affine[i * Dim + j][p] = inverse_inertia * moment[j][i];
      if (want_gradient)
        particles.gradient[i * Dim + j][p] = gradient[j][i];
    }
  }
}

}  // namespace

template <int Dim>
void body_to_grid(const Particles<Dim>& particles, const Strips& strips, const Vec<Dim>& gravity, Grid<Dim>& grid,
                  ThreadTeam& team)
{
  const int count = static_cast<int>(strips.count());
  for (int color = 0; color < 2; ++color)
    team.for_each((count - color + 1) / 2, [&](int i) {
      const auto s = static_cast<std::size_t>(2 * i + color);
      for (std::size_t p = strips.begin[s]; p < strips.begin[s + 1]; ++p)
        scatter<Dim, Source::stress>(particles, p, gravity, grid);
    });
}

template <int Dim>
void sheet_to_grid(const Particles<Dim>& nodes, const Vec<Dim>& gravity, Grid<Dim>& grid)
{
  for (std::size_t p = 0; p < nodes.size(); ++p)
    scatter<Dim, Source::external>(nodes, p, gravity, grid);
}

template <int Dim>
void grid_to_particles(const Grid<Dim>& grid, double dt, bool want_gradient, Particles<Dim>& particles,
                       std::size_t begin, std::size_t end)
{
  for (std::size_t p = begin; p < end; ++p)
    gather(grid, dt, want_gradient, particles, p);
}

template void body_to_grid(const Particles<2>&, const Strips&, const Vec<2>&, Grid<2>&, ThreadTeam&);
template void body_to_grid(const Particles<3>&, const Strips&, const Vec<3>&, Grid<3>&, ThreadTeam&);
template void sheet_to_grid(const Particles<2>&, const Vec<2>&, Grid<2>&);
template void sheet_to_grid(const Particles<3>&, const Vec<3>&, Grid<3>&);
template void grid_to_particles(const Grid<2>&, double, bool, Particles<2>&, std::size_t, std::size_t);
template void grid_to_particles(const Grid<3>&, double, bool, Particles<3>&, std::size_t, std::size_t);

}  // namespace geocontainer_mpm::mpm
