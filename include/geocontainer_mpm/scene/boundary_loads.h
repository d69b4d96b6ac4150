#pragma once
/// Tractions on the boundary of bodies, and grid nodes that are held.

#include <cstdint>
#include <optional>
#include <vector>

#include "geocontainer_mpm/mpm/discretisation.h"
#include "geocontainer_mpm/mpm/grid.h"
#include "geocontainer_mpm/mpm/particles.h"
#include "geocontainer_mpm/scene/description.h"
#include "geocontainer_mpm/state_access.h"

namespace geocontainer_mpm::scene {

/// A traction on part of one body's boundary.
///
/// The boundary is cut into pieces; each is carried by the particle nearest to it. The force t dA acts at the piece, at
/// x_p + r, and reaches only nodes that the particle and what is behind it reach (mpm::add_surface_force). The offset r
/// and the area vector follow the particle's deformation exactly (Nanson).
class Traction {
public:
  /// `lines`: the closed lines that bound the body, material on the left walking along each, m. Pieces are about
  /// `spacing` m long.
  Traction(const TractionDescription& description, const std::vector<std::vector<Vec2>>& lines, double spacing,
           const mpm::Particles<2>& particles);

  std::size_t pieces() const { return pieces_.size(); }
  /// Adds the forces at a time; `row[id]` is where a particle stands now. Returns their sum, N/m.
  Vec2 add_to(mpm::Grid<2>& grid, mpm::Shape shape, const mpm::Particles<2>& particles,
              const std::vector<std::uint32_t>& row, double time_s) const;
  /// Power of the forces at a time on the pieces' velocity in the last step, W/m. That is by the particles' way: with
  /// FLIP they have another velocity, which no force on the grid works on.
  double power(double time_s) const;
  /// Carries the pieces along with the last step of `dt`.
  void move(const mpm::Particles<2>& particles, const std::vector<std::uint32_t>& row, double dt);
  /// The particle at which the boundary is stretched so far that there is no surface to act on any more, if any.
  std::optional<std::uint32_t> torn() const;

private:
  friend struct geocontainer_mpm::StateAccess;

  struct Piece {
    std::uint32_t owner;  ///< id of the particle
    Vec2 offset;          ///< of the piece's middle from the particle, m
    Vec2 area;            ///< outward, m (per unit width)
    double length;        ///< at the start, m
    Vec2 place;           ///< of the particle, m
    Vec2 velocity;        ///< of the piece in the last step, m/s
  };
  Vec2 force(const Piece& piece, double factor) const;

  TractionDescription description_;
  std::vector<Piece> pieces_;
};

/// What holding some nodes did in a step, per unit width.
struct SupportSums {
  double kinetic_change = 0.0, dissipated = 0.0, work = 0.0;  ///< J/m
  bool acted = false;
};

/// Sets the velocity of the grid's nodes within the support's region, in space all along. `kick`: time over which the
/// forces that stand in the grid have acted, s.
template <int Dim>
SupportSums apply_support(const SupportDescription& support, double time_s, double kick, mpm::Grid<Dim>& grid);

}  // namespace geocontainer_mpm::scene
