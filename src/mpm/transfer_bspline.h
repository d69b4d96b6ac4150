#pragma once
/// Scatter and gather of one particle with quadratic B-splines, or with gimp, which has the same nodes. The sums are
/// separable: along the fastest direction first.

#include "geocontainer_mpm/mpm/reach.h"
#include "transfer_load.h"

namespace geocontainer_mpm::mpm {

template <int Dim, Shape shape, Part part, bool affine, Push push>
GEOCONTAINER_MPM_INLINE void scatter_bspline(const Particles<Dim>& particles, std::size_t p, const Vec<Dim>& gravity,
                                             const Extra& extra, Grid<Dim>& grid)
{
  constexpr bool has_momentum = part != Part::force, has_force = part != Part::momentum;
  constexpr bool has_stress = has_force && (push == Push::stress || push == Push::extra);
  const Stencil<Dim> s = stencil_of<Dim, shape>(particles, p, grid);
  const Load<Dim> load = load_of<Dim, shape, part, affine, push>(particles, p, gravity, extra, grid);

  // One row of three nodes along the fastest direction, given the product of the slower directions' factors.
  const auto add_row = [&](std::size_t first, Quad m0, Quad m1, ForceVector<Dim> f0, ForceVector<Dim> f1) {
    constexpr int last = Dim - 1;
    StoredQuad* nodes = stored(grid.nodes() + first);
    auto* forces = stored(grid.forces() + first);
    for (std::size_t k = 0; k < 3; ++k) {
      if constexpr (has_momentum && affine)
        nodes[k] += s.weight[last][k] * (m0 + s.offset[last][k] * m1);
      else if constexpr (has_momentum)
        nodes[k] += s.weight[last][k] * m0;
      if constexpr (has_stress)
        forces[k] += s.weight[last][k] * f0 + s.gradient[last][k] * f1;
      else if constexpr (has_force)
        forces[k] += s.weight[last][k] * f0;
    }
  };

  if constexpr (Dim == 2) {
    std::size_t first = grid.index(s.base);
    for (std::size_t i = 0; i < 3; ++i, first += static_cast<std::size_t>(grid.counts()[1])) {
      const double w = s.weight[0][i];
      Quad m0{}, m1{};
      if constexpr (has_momentum && affine) {
        m0 = w * (load.momentum + s.offset[0][i] * load.affine[0]);
        m1 = w * load.affine[1];
      } else if constexpr (has_momentum) {
        m0 = w * load.momentum;
      }
      ForceVector<Dim> f0{}, f1{};
      if constexpr (has_force)
        f0 = w * load.body;
      if constexpr (has_stress) {
        f0 += s.gradient[0][i] * load.stress[0];
        f1 = w * load.stress[1];
      }
      add_row(first, m0, m1, f0, f1);
    }
  } else {
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) {
        const double w = s.weight[0][i] * s.weight[1][j];
        Quad m0{}, m1{};
        if constexpr (has_momentum && affine) {
          m0 = w * (load.momentum + s.offset[0][i] * load.affine[0] + s.offset[1][j] * load.affine[1]);
          m1 = w * load.affine[2];
        } else if constexpr (has_momentum) {
          m0 = w * load.momentum;
        }
        ForceVector<Dim> f0{}, f1{};
        if constexpr (has_force)
          f0 = w * load.body;
        if constexpr (has_stress) {
          f0 += s.gradient[0][i] * s.weight[1][j] * load.stress[0] + s.weight[0][i] * s.gradient[1][j] * load.stress[1];
          f1 = w * load.stress[2];
        }
        add_row(grid.index({ s.base[0] + static_cast<int>(i), s.base[1] + static_cast<int>(j), s.base[2] }), m0, m1, f0,
                f1);
      }
  }
}

/// The kept velocity at the point of a stencil.
template <int Dim>
GEOCONTAINER_MPM_INLINE ForceVector<Dim> kept_at(const Stencil<Dim>& s, const Grid<Dim>& grid)
{
  constexpr int last = Dim - 1;
  ForceVector<Dim> velocity{};
  const auto add_row = [&](std::size_t first, double w) {
    const auto* kept = stored(grid.kept() + first);
    velocity += w * (s.weight[last][0] * kept[0] + s.weight[last][1] * kept[1] + s.weight[last][2] * kept[2]);
  };
  for (std::size_t i = 0; i < 3; ++i) {
    const int slowest = s.base[0] + static_cast<int>(i);
    if constexpr (Dim == 2)
      add_row(grid.index({ slowest, s.base[1] }), s.weight[0][i]);
    else
      for (std::size_t j = 0; j < 3; ++j)
        add_row(grid.index({ slowest, s.base[1] + static_cast<int>(j), s.base[2] }), s.weight[0][i] * s.weight[1][j]);
  }
  return velocity;
}

template <int Dim, Shape shape, Gather what, Transfer transfer>
GEOCONTAINER_MPM_INLINE void gather_bspline(const Grid<Dim>& grid, double dt, double flip_fraction,
                                            Particles<Dim>& particles, std::size_t p)
{
  constexpr bool wants_velocity = what == Gather::all || what == Gather::motion || what == Gather::velocity;
  constexpr bool wants_moment = wants_velocity && is_affine(transfer);
  constexpr bool wants_gradient = what == Gather::all || what == Gather::gradient;
  const Stencil<Dim> s = stencil_of<Dim, shape>(particles, p, grid);
  if constexpr (what == Gather::position) {
    move<Dim, what>(kept_at(s, grid), dt, particles, p);
    return;
  }
  constexpr int last = Dim - 1;
  const auto& w_last = s.weight[last];
  const auto& g_last = s.gradient[last];
  const std::array<double, 3> moment_weight{ w_last[0] * s.offset[last][0], w_last[1] * s.offset[last][1],
                                             w_last[2] * s.offset[last][2] };
  struct Row {
    Quad value, moment, gradient;
  };
  const auto sum_row = [&](std::size_t first) {
    const StoredQuad* nodes = stored(grid.nodes() + first);
    return Row{ w_last[0] * nodes[0] + w_last[1] * nodes[1] + w_last[2] * nodes[2],
                moment_weight[0] * nodes[0] + moment_weight[1] * nodes[1] + moment_weight[2] * nodes[2],
                g_last[0] * nodes[0] + g_last[1] * nodes[1] + g_last[2] * nodes[2] };
  };

  // What is not wanted is not stored below, and the compiler drops its sums.
  Quad velocity{};
  std::array<Quad, Dim> moment{}, gradient{};
  if constexpr (Dim == 2) {
    std::size_t first = grid.index(s.base);
    for (std::size_t i = 0; i < 3; ++i, first += static_cast<std::size_t>(grid.counts()[1])) {
      const Row row = sum_row(first);
      const double w = s.weight[0][i];
      velocity += w * row.value;
      moment[0] += w * s.offset[0][i] * row.value;
      moment[1] += w * row.moment;
      gradient[0] += s.gradient[0][i] * row.value;
      gradient[1] += w * row.gradient;
    }
  } else {
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) {
        const Row row =
            sum_row(grid.index({ s.base[0] + static_cast<int>(i), s.base[1] + static_cast<int>(j), s.base[2] }));
        const double w = s.weight[0][i] * s.weight[1][j];
        velocity += w * row.value;
        moment[0] += w * s.offset[0][i] * row.value;
        moment[1] += w * s.offset[1][j] * row.value;
        moment[2] += w * row.moment;
        gradient[0] += s.gradient[0][i] * s.weight[1][j] * row.value;
        gradient[1] += s.weight[0][i] * s.gradient[1][j] * row.value;
        gradient[2] += w * row.gradient;
      }
  }

  if constexpr (wants_velocity && is_blended(transfer))
    blend<Dim>(velocity, kept_at(s, grid), flip_fraction, particles, p);
  else if constexpr (wants_velocity)
    for (std::size_t i = 0; i < Dim; ++i)
      particles.velocity[i][p] = velocity[i];
  move<Dim, what>(velocity, dt, particles, p);
  std::array<double, Dim> inverse_inertia;
  for (std::size_t d = 0; d < Dim; ++d)
    inverse_inertia[d] = 1.0 / (shape == Shape::bspline2 ? bspline_inertia(grid.dx()) : box_inertia<Dim>(s, d));
  for (std::size_t i = 0; i < Dim; ++i)
    for (std::size_t j = 0; j < Dim; ++j) {
      if constexpr (wants_moment)
        particles.affine[i * Dim + j][p] = inverse_inertia[j] * moment[j][i];
      if constexpr (wants_gradient)
        particles.gradient[i * Dim + j][p] = gradient[j][i];
    }
}

}  // namespace geocontainer_mpm::mpm
