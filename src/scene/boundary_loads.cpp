#include "geocontainer_mpm/scene/boundary_loads.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geocontainer_mpm/mpm/reach.h"
#include "geocontainer_mpm/mpm/transfer.h"

namespace geocontainer_mpm::scene {
namespace {

/// What counts as on the edge of a region, cells or pieces: positions come from decimal text.
constexpr double edge_tolerance = 1e-6;
/// A piece as many times longer than at the start is no boundary any more: what pulls on it would grow without end.
constexpr double most_stretch = 10.0;

bool within(const Region& region, const Vec2& point, double tolerance)
{
  return (point.array() >= region.lower_m.array() - tolerance).all() &&
         (point.array() <= region.upper_m.array() + tolerance).all();
}

std::uint32_t nearest_particle(const mpm::Particles<2>& particles, const Vec2& point)
{
  std::size_t best = 0;
  double best_square = std::numeric_limits<double>::infinity();
  for (std::size_t p = 0; p < particles.size(); ++p) {
    const double square = (Vec2(particles.position[0][p], particles.position[1][p]) - point).squaredNorm();
    if (square < best_square) {
      best = p;
      best_square = square;
    }
  }
  return particles.id[best];
}

double factor_at(const TimeTable<1>& table, double time_s)
{
  return table.empty() ? 1.0 : value_at<1>(table, time_s)[0];
}

Mat2 gradient_of(const mpm::Particles<2>& particles, std::size_t p)
{
  Mat2 gradient;
  gradient << particles.gradient[0][p], particles.gradient[1][p], particles.gradient[2][p], particles.gradient[3][p];
  return gradient;
}

}  // namespace

Traction::Traction(const TractionDescription& description, const std::vector<std::vector<Vec2>>& lines, double spacing,
                   const mpm::Particles<2>& particles)
    : description_(description)
{
  for (const std::vector<Vec2>& line : lines)
    for (std::size_t k = 0; k < line.size(); ++k) {
      const Vec2& from = line[k];
      const Vec2 along = line[(k + 1) % line.size()] - from;
      const int count = std::max(1, static_cast<int>(std::lround(along.norm() / spacing)));
      for (int i = 0; i < count; ++i) {
        const Vec2 middle = from + (i + 0.5) / count * along;
        if (description.region && !within(*description.region, middle, edge_tolerance * spacing))
          continue;
        const std::uint32_t owner = nearest_particle(particles, middle);
        const Vec2 at(particles.position[0][owner], particles.position[1][owner]);  // not sorted yet: row = id
        const Vec2 area = Vec2(along[1], -along[0]) / count;
        pieces_.push_back({ owner, middle - at, area, area.norm(), at,
                            Vec2(particles.velocity[0][owner], particles.velocity[1][owner]) });
      }
    }
}

Vec2 Traction::force(const Piece& piece, double factor) const
{
  return factor * (piece.area.norm() * description_.traction_pa - description_.pressure_pa * piece.area);
}

Vec2 Traction::add_to(mpm::Grid<2>& grid, mpm::Shape shape, const mpm::Particles<2>& particles,
                      const std::vector<std::uint32_t>& row, double time_s) const
{
  const double factor = factor_at(description_.table, time_s);
  Vec2 sum = Vec2::Zero();
  for (const Piece& piece : pieces_) {
    const std::size_t p = row[piece.owner];
    const Vec2 f = force(piece, factor);
    // A piece that a deformation gone wild has carried far acts a cell away: the grid's storage ends two cells outside.
    const double far = piece.offset.norm() / grid.dx();
    mpm::add_surface_force<2>(shape, particles, p, piece.offset / std::max(1.0, far), f, grid);
    sum += f;
  }
  return sum;
}

double Traction::power(double time_s) const
{
  const double factor = factor_at(description_.table, time_s);
  double power = 0.0;
  for (const Piece& piece : pieces_)
    power += force(piece, factor).dot(piece.velocity);
  return power;
}

void Traction::move(const mpm::Particles<2>& particles, const std::vector<std::uint32_t>& row, double dt)
{
  for (Piece& piece : pieces_) {
    const std::size_t p = row[piece.owner];
    const Vec2 place(particles.position[0][p], particles.position[1][p]);
    const Mat2 gradient = gradient_of(particles, p), step = Mat2::Identity() + dt * gradient;
    piece.velocity = (place - piece.place) / dt + gradient * piece.offset;
    piece.place = place;
    piece.offset = step * piece.offset;
    // det(F) F^-T, written out.
    const Vec2 area = piece.area;
    piece.area = { step(1, 1) * area[0] - step(1, 0) * area[1], step(0, 0) * area[1] - step(0, 1) * area[0] };
  }
}

std::optional<std::uint32_t> Traction::torn() const
{
  for (const Piece& piece : pieces_)
    if (!(piece.area.norm() <= most_stretch * piece.length))
      return piece.owner;
  return std::nullopt;
}

template <int Dim>
SupportSums apply_support(const SupportDescription& support, double time_s, double kick, mpm::Grid<Dim>& grid)
{
  constexpr int mass_slot = mpm::Grid<Dim>::mass_slot;
  Vec2 held = Vec2::Zero();
  if (!support.velocity_table.empty()) {
    const auto [held_y, held_z] = value_at<2>(support.velocity_table, time_s);
    held = { held_y, held_z };
  }
  const std::array<bool, 2> holds{ support.holds_y, support.holds_z };
  const mpm::Window<Dim>& window = grid.window();
  std::array<int, Dim> begin = window.begin, end = window.end;  // in space: all along
  for (int d = 0; d < 2; ++d) {
    const int axis = y_axis<Dim> + d;
    const auto slot = static_cast<std::size_t>(axis);
    const double low = (support.region.lower_m[d] - grid.origin()[axis]) * grid.inverse_dx();
    const double high = (support.region.upper_m[d] - grid.origin()[axis]) * grid.inverse_dx();
    begin[slot] = std::max(begin[slot], static_cast<int>(std::ceil(low - edge_tolerance)));
    end[slot] = std::min(end[slot], static_cast<int>(std::floor(high + edge_tolerance)) + 1);
  }
  SupportSums sums;
  const auto hold = [&](std::size_t n) {
    auto& node = grid.nodes()[n];
    const double mass = node[mass_slot];
    if (!(mass > 0.0))
      return;
    sums.acted = true;
    for (int d = 0; d < 2; ++d) {
      if (!holds[static_cast<std::size_t>(d)])
        continue;
      // Forces and support act in the same instant; see ContactSolver::solve.
      const int c = y_axis<Dim> + d;
      const double after = node[c], before = after - kick / mass * grid.forces()[n][c];
      const double impulse = mass * (held[d] - after);
      sums.kinetic_change += 0.5 * impulse * (held[d] + after);
      sums.work += impulse * held[d];
      sums.dissipated += impulse * held[d] - 0.5 * impulse * (held[d] + before);
      node[c] = held[d];
    }
  };
  if constexpr (Dim == 2) {
    for (int i = begin[0]; i < end[0]; ++i)
      for (int j = begin[1]; j < end[1]; ++j)
        hold(grid.index({ i, j }));
  } else {
    for (int i = begin[0]; i < end[0]; ++i)
      for (int j = begin[1]; j < end[1]; ++j)
        for (int k = begin[2]; k < end[2]; ++k)
          hold(grid.index({ i, j, k }));
  }
  return sums;
}

template SupportSums apply_support(const SupportDescription&, double, double, mpm::Grid<2>&);
template SupportSums apply_support(const SupportDescription&, double, double, mpm::Grid<3>&);

}  // namespace geocontainer_mpm::scene
