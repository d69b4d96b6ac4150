#include "geocontainer_mpm/mpm/transfer.h"

#include <array>
#include <type_traits>

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

// Grid nodes as the compiler's own vectors: built in registers from scalars, where a fixed-size array is written to
// memory slot by slot and read back whole, which stalls every particle.
using Quad [[gnu::vector_size(32)]] = double;
using Pair [[gnu::vector_size(16)]] = double;
template <int Dim>
struct ForceVectorOf {
  using Type = Quad;
};
template <>
struct ForceVectorOf<2> {
  using Type = Pair;
};
template <int Dim>
using ForceVector = typename ForceVectorOf<Dim>::Type;
// The same where they overlie the grid's storage.
using StoredQuad [[gnu::may_alias]] = Quad;
using StoredPair [[gnu::may_alias]] = Pair;

StoredQuad* stored(Eigen::Array<double, 4, 1>* node)
{
  return reinterpret_cast<StoredQuad*>(node);
}
const StoredQuad* stored(const Eigen::Array<double, 4, 1>* node)
{
  return reinterpret_cast<const StoredQuad*>(node);
}
StoredPair* stored(Eigen::Array<double, 2, 1>* force)
{
  return reinterpret_cast<StoredPair*>(force);
}

/// Value of row p in column i of some columns.
template <class Columns>
double entry(const Columns& columns, int i, std::size_t p)
{
  return columns[static_cast<std::size_t>(i)][p];
}

/// Column j of a symmetric stress times `factor`.
template <int Dim>
ForceVector<Dim> stress_column(const Particles<Dim>& particles, std::size_t p, int j, double factor)
{
  const auto s = [&](int k) { return factor * entry(particles.stress, k, p); };
  if constexpr (Dim == 2)
    return j == 0 ? Pair{ s(0), s(2) } : Pair{ s(2), s(1) };
  else
    return j == 0   ? Quad{ s(0), s(3), s(4), 0.0 }
           : j == 1 ? Quad{ s(3), s(1), s(5), 0.0 }
                    : Quad{ s(4), s(5), s(2), 0.0 };
}

/// What a particle brings to the grid, before weights.
template <int Dim>
struct Load {
  Quad momentum;                             ///< and mass
  std::array<Quad, Dim> affine;              ///< momentum per offset
  ForceVector<Dim> body;                     ///< per weight
  std::array<ForceVector<Dim>, Dim> stress;  ///< per gradient
};

/// Says at compile time what pushes: the body's stress or the sheet's external force.
enum class Source { stress, external };

template <int Dim, Source source>
Load<Dim> load_of(const Particles<Dim>& particles, std::size_t p, const Vec<Dim>& gravity)
{
  const double mass = particles.mass[p];
  const auto v = [&](int i) { return mass * entry(particles.velocity, i, p); };
  const auto c = [&](int i, int d) { return mass * entry(particles.affine, i * Dim + d, p); };
  const auto f = [&](int i) {
    const double weight = particles.weight_mass[p] * gravity[i];
    return source == Source::external ? weight + entry(particles.force, i, p) : weight;
  };
  Load<Dim> load;
  if constexpr (Dim == 2) {
    load.momentum = Quad{ v(0), v(1), 0.0, mass };
    load.body = Pair{ f(0), f(1) };
    for (int d = 0; d < 2; ++d)
      load.affine[static_cast<std::size_t>(d)] = Quad{ c(0, d), c(1, d), 0.0, 0.0 };
  } else {
    load.momentum = Quad{ v(0), v(1), v(2), mass };
    load.body = Quad{ f(0), f(1), f(2), 0.0 };
    for (int d = 0; d < 3; ++d)
      load.affine[static_cast<std::size_t>(d)] = Quad{ c(0, d), c(1, d), c(2, d), 0.0 };
  }
  if constexpr (source == Source::stress)
    for (int d = 0; d < Dim; ++d)
      load.stress[static_cast<std::size_t>(d)] = stress_column<Dim>(particles, p, d, -particles.volume[p]);
  return load;
}

/// Scatters one particle.
template <int Dim, Source source>
inline void scatter(const Particles<Dim>& particles, std::size_t p, const Vec<Dim>& gravity, Grid<Dim>& grid)
{
  const Stencil<Dim> s = make_stencil<Dim>(position_of(particles, p), grid.origin(), grid.dx(), grid.inverse_dx());
  const Load<Dim> load = load_of<Dim, source>(particles, p, gravity);

  // One row of three nodes along the fastest direction, given the product of the slower directions' factors.
  const auto add_row = [&](std::size_t first, Quad m0, Quad m1, ForceVector<Dim> f0, ForceVector<Dim> f1) {
    constexpr int last = Dim - 1;
    StoredQuad* nodes = stored(grid.nodes() + first);
    auto* forces = stored(grid.forces() + first);
    for (std::size_t k = 0; k < 3; ++k) {
      nodes[k] += s.weight[last][k] * (m0 + s.offset[last][k] * m1);
      if constexpr (source == Source::stress)
        forces[k] += s.weight[last][k] * f0 + s.gradient[last][k] * f1;
      else
        forces[k] += s.weight[last][k] * f0;
    }
  };

  if constexpr (Dim == 2) {
    std::size_t first = grid.index(s.base);
    for (std::size_t i = 0; i < 3; ++i, first += static_cast<std::size_t>(grid.counts()[1])) {
      const double w = s.weight[0][i];
      ForceVector<Dim> f0 = w * load.body, f1{};
      if constexpr (source == Source::stress) {
        f0 += s.gradient[0][i] * load.stress[0];
        f1 = w * load.stress[1];
      }
      add_row(first, w * (load.momentum + s.offset[0][i] * load.affine[0]), w * load.affine[1], f0, f1);
    }
  } else {
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) {
        const double w = s.weight[0][i] * s.weight[1][j];
        ForceVector<Dim> f0 = w * load.body, f1{};
        if constexpr (source == Source::stress) {
          f0 += s.gradient[0][i] * s.weight[1][j] * load.stress[0] + s.weight[0][i] * s.gradient[1][j] * load.stress[1];
          f1 = w * load.stress[2];
        }
        add_row(grid.index({ s.base[0] + static_cast<int>(i), s.base[1] + static_cast<int>(j), s.base[2] }),
                w * (load.momentum + s.offset[0][i] * load.affine[0] + s.offset[1][j] * load.affine[1]),
                w * load.affine[2], f0, f1);
      }
  }
}

/// Gathers one particle. The sums are separable: along the fastest direction first.
template <int Dim>
inline void gather(const Grid<Dim>& grid, double dt, bool want_gradient, Particles<Dim>& particles, std::size_t p)
{
  const Stencil<Dim> s = make_stencil<Dim>(position_of(particles, p), grid.origin(), grid.dx(), grid.inverse_dx());
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

  const double inverse_inertia = 1.0 / bspline_inertia(grid.dx());
  for (std::size_t i = 0; i < Dim; ++i) {
    particles.velocity[i][p] = velocity[i];
    particles.position[i][p] += dt * velocity[i];
    for (std::size_t j = 0; j < Dim; ++j) {
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
