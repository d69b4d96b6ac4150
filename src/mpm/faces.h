#pragma once
/// Roller and fixed faces as planes of (anti)symmetry: which nodes are mirror images of which.

#include <array>
#include <cstddef>

#include "geocontainer_mpm/mpm/grid.h"

namespace geocontainer_mpm::mpm {

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

/// Sets what lies beyond the constraining faces to the mirror image of what is inside; `at(index)` is the velocity (Dim
/// components or more) of a node.
template <int Dim, class At>
void mirror_beyond_faces(const Grid<Dim>& grid, At&& at)
{
  visit_conditions(grid, [&](int d, int side, FaceCondition condition) {
    visit_face(
        grid, d, side,
        [&](std::size_t beyond, std::size_t inside) {
          for (int c = 0; c < Dim; ++c)
            at(beyond)[c] = mirror_sign(condition, c, d) * at(inside)[c];
        },
        [](std::size_t) {});
  });
}

}  // namespace geocontainer_mpm::mpm
