#pragma once
/// Motions that solve the momentum equation of a neo-Hookean solid for a known body force.

#include "geocontainer_mpm/material/parameters.h"
#include "geocontainer_mpm/scene/description.h"

namespace geocontainer_mpm::scene {

class Manufactured {
public:
  /// `material`: neo_hookean, whose moduli and density the body force needs.
  Manufactured(const ManufacturedDescription& description, const material::Parameters& material);

  /// Where the particle that starts at X is at time t, m.
  Vec2 position(const Vec2& start, double time_s) const;
  Vec2 velocity(const Vec2& start, double time_s) const;  ///< m/s
  /// Force per mass on that particle, m/s^2.
  Vec2 body_force(const Vec2& start, double time_s) const;

private:
  Vec2 axis_aligned_force(const Vec2& x, double time_s) const;
  Vec2 vortex_force(const Vec2& x, double time_s) const;

  ManufacturedDescription description_;
  double lambda_, mu_, density_, speed_;  ///< Pa, Pa, kg/m^3, c = sqrt(E / rho), m/s
};

}  // namespace geocontainer_mpm::scene
