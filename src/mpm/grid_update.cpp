#include "geocontainer_mpm/mpm/grid_update.h"

#include <algorithm>
#include <cmath>

#include "faces.h"

namespace geocontainer_mpm::mpm {
namespace {

/// Adds what was scattered beyond the constraining faces to its image inside. Returns whether there is such a face.
template <int Dim>
bool fold_faces(Grid<Dim>& grid)
{
  bool touches = false;
  visit_conditions(grid, [&](int d, int side, FaceCondition condition) {
    touches = true;
    visit_face(
        grid, d, side,
        [&](std::size_t beyond, std::size_t inside) {
          auto& node = grid.nodes()[inside];
          auto& ghost = grid.nodes()[beyond];
          for (int c = 0; c < Dim; ++c) {
            node[c] += mirror_sign(condition, c, d) * ghost[c];
            grid.forces()[inside][c] += mirror_sign(condition, c, d) * grid.forces()[beyond][c];
          }
          node[Grid<Dim>::mass_slot] += ghost[Grid<Dim>::mass_slot];
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
  return touches;
}

template <int Dim>
void add(const MotionSums<Dim>& part, MotionSums<Dim>& total)
{
  total.kinetic_before += part.kinetic_before;
  total.kinetic_after += part.kinetic_after;
  total.power_before += part.power_before;
  total.damped += part.damped;
  total.momentum_before += part.momentum_before;
  total.momentum_after += part.momentum_after;
}

/// Calls `visit(storage index)` for the nodes of the window, rows of one block by one thread.
template <int Dim, class Visitor>
void for_each_window_node(const Grid<Dim>& grid, ThreadTeam& team, Visitor&& visit)
{
  team.for_each(grid.blocks_of_rows(grid.window()), [&](int block) {
    grid.visit_block(block, [&](int slowest) {
      grid.visit_rows(slowest, [&](std::size_t first, const std::array<int, Dim>&, int length) {
        for (std::size_t i = first; i < first + static_cast<std::size_t>(length); ++i)
          visit(i);
      });
    });
  });
}

}  // namespace

template <int Dim>
MotionSums<Dim> GridUpdate<Dim>::apply_forces(const Discretisation& discretisation, Grid<Dim>& grid, double kick,
                                              double damping_per_s, ThreadTeam& team)
{
  const bool touches = fold_faces(grid);
  const double keep = std::max(0.0, 1.0 - damping_per_s * kick);
  const bool keeps_old = is_blended(discretisation.transfer);
  if (keeps_old)
    grid.ensure_kept();
  MotionSums<Dim> total = discretisation.mass == MassMatrix::consistent ? update_consistent(grid, kick, keep, team)
                          : keeps_old                                   ? update_lumped<true>(grid, kick, keep, team)
                                                                        : update_lumped<false>(grid, kick, keep, team);
  if (keeps_old)
    mirror_beyond_faces(
        grid, [&](std::size_t i) -> auto& { return grid.kept()[i]; });
  total.touches_faces = touches;
  return total;
}

template <int Dim>
template <bool keeps_old>
MotionSums<Dim> GridUpdate<Dim>::update_lumped(Grid<Dim>& grid, double kick, double keep, ThreadTeam& team)
{
  constexpr int mass_slot = Grid<Dim>::mass_slot;
  const Window<Dim>& window = grid.window();
  rows_.assign(static_cast<std::size_t>(std::max(0, window.end[0] - window.begin[0])), MotionSums<Dim>{});
  const auto update_row = [&](int slowest) {
    MotionSums<Dim> sums;
    grid.visit_rows(slowest, [&](std::size_t first, const std::array<int, Dim>&, int length) {
      for (std::size_t i = first; i < first + static_cast<std::size_t>(length); ++i) {
        auto& node = grid.nodes()[i];
        const double mass = node[mass_slot];
        if (!(mass > Grid<Dim>::massless)) {
          node.setZero();
          if constexpr (keeps_old)
            grid.kept()[i].setZero();
          continue;
        }
        const double inverse_mass = 1.0 / mass;
        double before = 0.0, after = 0.0, power = 0.0;
        for (int c = 0; c < Dim; ++c) {
          const double momentum = node[c];
          const double forced = momentum + kick * grid.forces()[i][c];
          sums.momentum_before[c] += momentum;
          sums.momentum_after[c] += keep * forced;
          before += momentum * momentum;
          power += momentum * grid.forces()[i][c];
          after += forced * forced;
          if constexpr (keeps_old)
            grid.kept()[i][c] = momentum * inverse_mass;
          node[c] = keep * forced * inverse_mass;
        }
        sums.kinetic_before += 0.5 * inverse_mass * before;
        sums.kinetic_after += 0.5 * inverse_mass * after * keep * keep;
        sums.power_before += inverse_mass * power;
        sums.damped += 0.5 * inverse_mass * after * (1.0 - keep * keep);
      }
    });
    rows_[static_cast<std::size_t>(slowest - window.begin[0])] = sums;
  };
  team.for_each(grid.blocks_of_rows(window), [&](int block) { grid.visit_block(block, update_row); });
  MotionSums<Dim> total;
  for (const MotionSums<Dim>& row : rows_)
    add(row, total);
  return total;
}

template <int Dim>
MotionSums<Dim> GridUpdate<Dim>::update_consistent(Grid<Dim>& grid, double kick, double keep, ThreadTeam& team)
{
  const std::vector<std::uint32_t>& active = mass_.active();
  old_.resize(active.size());
  change_.resize(active.size());
  for (std::size_t n = 0; n < active.size(); ++n) {
    old_[n] = grid.nodes()[active[n]].template head<Dim>();
    change_[n] = kick * grid.forces()[active[n]].template head<Dim>();
  }
  momentum_ = old_;
  impulse_ = change_;
  MotionSums<Dim> total;
  total.iterations = std::max(mass_.solve(old_, team), mass_.solve(change_, team));

  for_each_window_node(grid, team, [&](std::size_t i) {
    grid.nodes()[i].template head<Dim>().setZero();
    grid.kept()[i].setZero();
  });
  for (std::size_t n = 0; n < active.size(); ++n) {
    const auto forced = (momentum_[n] + impulse_[n]).eval();
    const auto velocity = (old_[n] + change_[n]).eval();
    grid.kept()[active[n]].template head<Dim>() = old_[n];
    grid.nodes()[active[n]].template head<Dim>() = keep * velocity;
    MotionSums<Dim> sums;
    sums.kinetic_before = 0.5 * (momentum_[n] * old_[n]).sum();
    sums.kinetic_after = 0.5 * (forced * velocity).sum() * keep * keep;
    sums.power_before = (grid.forces()[active[n]].template head<Dim>() * old_[n]).sum();
    sums.damped = 0.5 * (forced * velocity).sum() * (1.0 - keep * keep);
    sums.momentum_before = momentum_[n].matrix();
    sums.momentum_after = keep * forced.matrix();
    add(sums, total);
  }
  return total;
}

template <int Dim>
void GridUpdate<Dim>::velocities(const Discretisation& discretisation, Grid<Dim>& grid, ThreadTeam& team)
{
  fold_faces(grid);
  if (discretisation.mass == MassMatrix::consistent) {
    const std::vector<std::uint32_t>& active = mass_.active();
    old_.resize(active.size());
    for (std::size_t n = 0; n < active.size(); ++n)
      old_[n] = grid.nodes()[active[n]].template head<Dim>();
    mass_.solve(old_, team);
    for (std::size_t n = 0; n < active.size(); ++n)
      grid.nodes()[active[n]].template head<Dim>() = old_[n];
  } else {
    for_each_window_node(grid, team, [&](std::size_t i) {
      auto& node = grid.nodes()[i];
      const double mass = node[Grid<Dim>::mass_slot];
      if (mass > Grid<Dim>::massless)
        node.template head<Dim>() *= 1.0 / mass;
      else
        node.setZero();
    });
  }
  mirror_beyond_faces(
      grid, [&](std::size_t i) -> auto& { return grid.nodes()[i]; });
}

template <int Dim>
void GridUpdate<Dim>::momenta(const Discretisation& discretisation, Grid<Dim>& grid, ThreadTeam& team)
{
  if (discretisation.mass == MassMatrix::consistent) {
    const std::vector<std::uint32_t>& active = mass_.active();
    old_.resize(active.size());
    for (std::size_t n = 0; n < active.size(); ++n)
      old_[n] = grid.nodes()[active[n]].template head<Dim>();
    mass_.multiply(old_, team);
    for (std::size_t n = 0; n < active.size(); ++n)
      grid.nodes()[active[n]].template head<Dim>() = old_[n];
  } else {
    // Nodes beyond faces have given their mass away: no momentum is left there.
    for_each_window_node(grid, team, [&](std::size_t i) {
      grid.nodes()[i].template head<Dim>() *= grid.nodes()[i][Grid<Dim>::mass_slot];
    });
  }
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

template class GridUpdate<2>;
template class GridUpdate<3>;

}  // namespace geocontainer_mpm::mpm
