#include "geocontainer_mpm/mpm/grid_update.h"

#include <algorithm>
#include <cmath>

namespace geocontainer_mpm::mpm {
namespace {

/// Nodes lighter than this part of nothing at all are round-off of stencil ends: they take no part.
constexpr double massless = 1e-300;

/// Calls `visit(node on the mirror side, its image inside)` for every node of the window beyond face `side` of
/// direction `d`, and `on_face(node)` for every node on it.
template <int Dim, class Beyond, class OnFace>
void visit_face(const Grid<Dim>& grid, int d, int side, Beyond&& beyond, OnFace&& on_face)
{
  const Window<Dim>& window = grid.window();
  const int face = side == 0 ? grid.low_face(d) : grid.high_face(d);
  const int outwards = side == 0 ? -1 : 1;
  std::array<int, Dim> node;
  const auto visit_layer = [&](int layer, auto&& visit) {
    if (layer < window.begin[d] || layer >= window.end[d])
      return;
    // All combinations of the other directions.
    for (int a = 0; a < Dim; ++a)
      node[a] = window.begin[a];
    node[d] = layer;
    for (;;) {
      visit(grid.index(node));
      int a = 0;
      for (; a < Dim; ++a) {
        if (a == d)
          continue;
        if (++node[a] < window.end[a])
          break;
        node[a] = window.begin[a];
      }
      if (a == Dim)
        return;
    }
  };
  visit_layer(face, on_face);
  for (int depth = 1; depth <= Grid<Dim>::margin; ++depth) {
    std::array<int, Dim> from{}, to{};
    from[d] = face + outwards * depth;
    to[d] = face - outwards * depth;
    const auto shift = static_cast<std::ptrdiff_t>(grid.index(to)) - static_cast<std::ptrdiff_t>(grid.index(from));
    visit_layer(from[d],
                [&](std::size_t i) { beyond(i, static_cast<std::size_t>(static_cast<std::ptrdiff_t>(i) + shift)); });
  }
}

template <int Dim>
bool window_touches(const Grid<Dim>& grid, int d, int side)
{
  return side == 0 ? grid.window().begin[d] <= grid.low_face(d) : grid.window().end[d] > grid.high_face(d);
}

/// Sign with which component `c` is mirrored at a face normal to `d`.
double mirror_sign(FaceCondition condition, int c, int d)
{
  return condition == FaceCondition::fixed || c == d ? -1.0 : 1.0;
}

/// Calls `visit(d, side, condition)` for every face that constrains and that the window reaches.
template <int Dim, class Visitor>
void visit_conditions(const Grid<Dim>& grid, Visitor&& visit)
{
  for (int d = 0; d < Dim; ++d)
    for (int side = 0; side < 2; ++side) {
      const FaceCondition condition = grid.faces()[static_cast<std::size_t>(2 * d + side)];
      if (condition != FaceCondition::free && window_touches(grid, d, side))
        visit(d, side, condition);
    }
}

}  // namespace

template <int Dim>
MotionSums<Dim> GridUpdate<Dim>::apply_forces(Grid<Dim>& grid, double kick, double damping_per_s, ThreadTeam& team)
{
  constexpr int mass_slot = Grid<Dim>::mass_slot;
  MotionSums<Dim> total;
  visit_conditions(grid, [&](int d, int side, FaceCondition condition) {
    total.touches_faces = true;
    visit_face(
        grid, d, side,
        [&](std::size_t beyond, std::size_t inside) {
          auto& node = grid.nodes()[inside];
          auto& ghost = grid.nodes()[beyond];
          for (int c = 0; c < Dim; ++c) {
            node[c] += mirror_sign(condition, c, d) * ghost[c];
            grid.forces()[inside][c] += mirror_sign(condition, c, d) * grid.forces()[beyond][c];
          }
          node[mass_slot] += ghost[mass_slot];
          ghost.setZero();
        },
        [&](std::size_t on_face) {
          // The mirror image brings the opposite: nothing is left, and no force works on a velocity that cannot be.
          for (int c = 0; c < Dim; ++c)
            if (mirror_sign(condition, c, d) < 0.0) {
              grid.nodes()[on_face][c] = 0.0;
              grid.forces()[on_face][c] = 0.0;
            }
        });
  });

  const Window<Dim>& window = grid.window();
  const double keep = std::max(0.0, 1.0 - damping_per_s * kick);
  rows_.assign(static_cast<std::size_t>(std::max(0, window.end[0] - window.begin[0])), MotionSums<Dim>{});
  const auto update_row = [&](int slowest) {
    MotionSums<Dim> sums;
    grid.visit_rows(slowest, [&](std::size_t first, const std::array<int, Dim>&, int length) {
      for (std::size_t i = first; i < first + static_cast<std::size_t>(length); ++i) {
        auto& node = grid.nodes()[i];
        const double mass = node[mass_slot];
        if (!(mass > massless)) {
          node.setZero();
          continue;
        }
        const double inverse_mass = 1.0 / mass;
        double before = 0.0, after = 0.0;
        for (int c = 0; c < Dim; ++c) {
          const double momentum = node[c];
          const double forced = momentum + kick * grid.forces()[i][c];
          sums.momentum_before[c] += momentum;
          sums.momentum_after[c] += keep * forced;
          before += momentum * momentum;
          after += forced * forced;
          node[c] = keep * forced * inverse_mass;
        }
        sums.kinetic_before += 0.5 * inverse_mass * before;
        sums.kinetic_after += 0.5 * inverse_mass * after * keep * keep;
        sums.damped += 0.5 * inverse_mass * after * (1.0 - keep * keep);
      }
    });
    rows_[static_cast<std::size_t>(slowest - window.begin[0])] = sums;
  };
  team.for_each(grid.blocks_of_rows(window), [&](int block) { grid.visit_block(block, update_row); });
  for (const MotionSums<Dim>& row : rows_) {
    total.kinetic_before += row.kinetic_before;
    total.kinetic_after += row.kinetic_after;
    total.damped += row.damped;
    total.momentum_before += row.momentum_before;
    total.momentum_after += row.momentum_after;
  }
  return total;
}

template <int Dim>
double GridUpdate<Dim>::apply_faces(Grid<Dim>& grid) const
{
  double taken = 0.0;
  visit_conditions(grid, [&](int d, int side, FaceCondition condition) {
    visit_face(
        grid, d, side,
        [&](std::size_t beyond, std::size_t inside) {
          for (int c = 0; c < Dim; ++c)
            grid.nodes()[beyond][c] = mirror_sign(condition, c, d) * grid.nodes()[inside][c];
        },
        [&](std::size_t on_face) {
          auto& node = grid.nodes()[on_face];
          for (int c = 0; c < Dim; ++c)
            if (mirror_sign(condition, c, d) < 0.0) {
              taken += 0.5 * node[Grid<Dim>::mass_slot] * node[c] * node[c];
              node[c] = 0.0;
            }
        });
  });
  return taken;
}

template <int Dim>
double stable_step(double constrained_modulus, double shear_modulus, double volume_per_mass, double dx)
{
  const double spread = 6.0 / (dx * dx);
  const double lame = constrained_modulus - 2.0 * shear_modulus;
  const double volumetric = spread * (Dim * lame + 2.0 * shear_modulus);  // all directions strained alike
  const double shearing = 2.0 * spread * shear_modulus;
  return 2.0 / std::sqrt(volume_per_mass * std::max(volumetric, shearing));
}

template class GridUpdate<2>;
template class GridUpdate<3>;
template double stable_step<2>(double, double, double, double);
template double stable_step<3>(double, double, double, double);

}  // namespace geocontainer_mpm::mpm
