#pragma once
/// Scatter and gather of one particle with linear simplices. Along the path start, start + step e_order[0], ... of the
/// nodes, the gradient of a node is that of the step to it less that of the step from it.

#include "transfer_load.h"

namespace geocontainer_mpm::mpm {

/// Calls `visit(k, storage index, weight)` for the nodes k = 0 ... Dim of the path.
template <int Dim, class Visitor>
GEOCONTAINER_MPM_INLINE void visit_path(const Simplex<Dim>& s, const Grid<Dim>& grid, Visitor&& visit)
{
  std::array<int, Dim> node = s.start;
  for (std::size_t k = 0; k <= Dim; ++k) {
    if (k > 0)
      node[s.order[k - 1]] += s.step[s.order[k - 1]];
    const double high = k == 0 ? 1.0 : s.fraction[s.order[k - 1]], low = k == Dim ? 0.0 : s.fraction[s.order[k]];
    visit(k, grid.index(node), high - low);
  }
}

template <int Dim, Part part, bool affine, Push push>
GEOCONTAINER_MPM_INLINE void scatter_simplex(const Particles<Dim>& particles, std::size_t p, const Vec<Dim>& gravity,
                                             const Extra& extra, Grid<Dim>& grid)
{
  constexpr bool has_momentum = part != Part::force, has_force = part != Part::momentum;
  constexpr bool has_stress = has_force && (push == Push::stress || push == Push::extra);
  const Simplex<Dim> s = simplex_around<Dim>(position_of(particles, p), grid);
  const Load<Dim> load = load_of<Dim, Shape::linear_simplex, part, affine, push>(particles, p, gravity, extra, grid);

  Quad momentum{};  // of the material's velocity at the node
  if constexpr (has_momentum) {
    momentum = load.momentum;
    if constexpr (affine)
      for (std::size_t d = 0; d < Dim; ++d)
        momentum -= s.step[d] * s.fraction[d] * grid.dx() * load.affine[d];
  }
  visit_path<Dim>(s, grid, [&](std::size_t k, std::size_t node, double weight) {
    const std::size_t to = s.order[k == 0 ? 0 : k - 1], from = s.order[k == Dim ? Dim - 1 : k];
    if constexpr (has_momentum) {
      if constexpr (affine)
        if (k > 0)
          momentum += s.step[to] * grid.dx() * load.affine[to];
      *stored(grid.nodes() + node) += weight * momentum;
    }
    if constexpr (has_force) {
      ForceVector<Dim> force = weight * load.body;
      if constexpr (has_stress) {
        if (k > 0)
          force += s.step[to] * grid.inverse_dx() * load.stress[to];
        if (k < Dim)
          force -= s.step[from] * grid.inverse_dx() * load.stress[from];
      }
      *stored(grid.forces() + node) += force;
    }
  });
}

template <int Dim, Gather what, Transfer transfer>
GEOCONTAINER_MPM_INLINE void gather_simplex(const Grid<Dim>& grid, double dt, double flip_fraction,
                                            Particles<Dim>& particles, std::size_t p)
{
  constexpr bool wants_velocity = what == Gather::all || what == Gather::motion || what == Gather::velocity;
  constexpr bool wants_affine = wants_velocity && is_affine(transfer);
  constexpr bool wants_gradient = what == Gather::all || what == Gather::gradient;
  constexpr bool wants_kept = what == Gather::position || (wants_velocity && is_blended(transfer));
  const Simplex<Dim> s = simplex_around<Dim>(position_of(particles, p), grid);
  Quad velocity{};
  ForceVector<Dim> kept{};
  std::array<Quad, Dim + 1> node_velocity;
  visit_path<Dim>(s, grid, [&](std::size_t k, std::size_t node, double weight) {
    if constexpr (what != Gather::position) {
      node_velocity[k] = *stored(grid.nodes() + node);
      velocity += weight * node_velocity[k];
    }
    if constexpr (wants_kept)
      kept += weight * *stored(grid.kept() + node);
  });

  if constexpr (what == Gather::position) {
    move<Dim, what>(kept, dt, particles, p);
    return;
  }
  if constexpr (wants_velocity && is_blended(transfer))
    blend<Dim>(velocity, kept, flip_fraction, particles, p);
  else if constexpr (wants_velocity)
    for (std::size_t i = 0; i < Dim; ++i)
      particles.velocity[i][p] = velocity[i];
  move<Dim, what>(velocity, dt, particles, p);
  if constexpr (wants_affine || wants_gradient)
    for (std::size_t k = 0; k < Dim; ++k) {
      const std::size_t j = s.order[k];
      const Quad slope = s.step[j] * grid.inverse_dx() * (node_velocity[k + 1] - node_velocity[k]);
      for (std::size_t i = 0; i < Dim; ++i) {
        if constexpr (wants_affine)
          particles.affine[i * Dim + j][p] = slope[i];
        if constexpr (wants_gradient)
          particles.gradient[i * Dim + j][p] = slope[i];
      }
    }
}

}  // namespace geocontainer_mpm::mpm
