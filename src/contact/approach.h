#pragma once
/// What a gap allows: shared by contact with boundary bodies and between fields.

#include <algorithm>

namespace geocontainer_mpm::contact {

/// Penetration (curved surfaces, round-off) is worked off at this part a step, and no faster than `fastest_recovery`.
constexpr double recovery_per_step = 0.02;
constexpr double fastest_recovery = 0.05;  // m/s

/// Coulomb coefficient of a contact that is held.
constexpr double holding_friction = 1e6;

/// Least relative normal velocity over a step of `dt` (s), m/s: what closes the `gap` (m), or opens it again.
inline double least_velocity(double gap, double dt)
{
  return gap >= 0.0 ? -gap / dt : std::min(-gap * recovery_per_step / dt, fastest_recovery);
}

}  // namespace geocontainer_mpm::contact
