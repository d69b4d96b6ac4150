#include "geocontainer_mpm/scene/manufactured.h"

#include <cmath>

namespace geocontainer_mpm::scene {
namespace {

constexpr double pi = 3.14159265358979323846;

/// Phases of the two components: the body starts undeformed.
constexpr double phase[2] = { 0.0, pi };

/// Radial profile of the vortex and its derivatives: 1 in the middle of the ring; value and slope 0 at its edges.
struct Profile {
  double value, slope, curvature;
};
Profile profile(double radius)
{
  const double s = radius - 1.0;
  return { 1.0 - 32.0 * s * s + 256.0 * s * s * s * s, -64.0 * s + 1024.0 * s * s * s, -64.0 + 3072.0 * s * s };
}

Vec2 turned(const Vec2& x, double angle)
{
  return { std::cos(angle) * x[0] - std::sin(angle) * x[1], std::sin(angle) * x[0] + std::cos(angle) * x[1] };
}

}  // namespace

Manufactured::Manufactured(const ManufacturedDescription& description, const material::Parameters& material)
    : description_(description), density_(material.density_kg_per_m3)
{
  const double young = material.young_modulus_pa, poisson = material.poisson_ratio;
  lambda_ = young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson));
  mu_ = young / (2.0 * (1.0 + poisson));
  speed_ = std::sqrt(young / density_);
}

Vec2 Manufactured::position(const Vec2& start, double time_s) const
{
  const Vec2 x = start - description_.origin_m;
  const double a = description_.amplitude, rate = speed_ * pi;
  if (description_.solution == ManufacturedSolution::vortex)
    return description_.origin_m + turned(x, a * std::sin(rate * time_s) * profile(x.norm()).value);
  Vec2 moved = start;
  for (int i = 0; i < 2; ++i)
    moved[i] += a * std::sin(pi * x[i]) * std::sin(rate * time_s + phase[i]);
  return moved;
}

Vec2 Manufactured::velocity(const Vec2& start, double time_s) const
{
  const Vec2 x = start - description_.origin_m;
  const double a = description_.amplitude, rate = speed_ * pi;
  if (description_.solution == ManufacturedSolution::vortex) {
    const Vec2 arm = position(start, time_s) - description_.origin_m;
    return a * rate * std::cos(rate * time_s) * profile(x.norm()).value * Vec2(-arm[1], arm[0]);
  }
  Vec2 velocity;
  for (int i = 0; i < 2; ++i)
    velocity[i] = a * rate * std::sin(pi * x[i]) * std::cos(rate * time_s + phase[i]);
  return velocity;
}

Vec2 Manufactured::body_force(const Vec2& start, double time_s) const
{
  const Vec2 x = start - description_.origin_m;
  return description_.solution == ManufacturedSolution::vortex ? vortex_force(x, time_s)
                                                               : axis_aligned_force(x, time_s);
}

/// Wallstedt and Guilkey 2008, J. Comput. Phys. 227:9628, for sigma = (lambda ln J I + mu (B - I)) / J.
Vec2 Manufactured::axis_aligned_force(const Vec2& x, double time_s) const
{
  Vec2 displacement, stretch;
  for (int i = 0; i < 2; ++i) {
    const double swing = description_.amplitude * std::sin(speed_ * pi * time_s + phase[i]);
    displacement[i] = swing * std::sin(pi * x[i]);
    stretch[i] = 1.0 + swing * pi * std::cos(pi * x[i]);
  }
  const double log_volume = std::log(stretch[0] * stretch[1]);
  Vec2 force;
  for (int i = 0; i < 2; ++i)
    force[i] = pi * pi * displacement[i] *
               (mu_ / density_ - speed_ * speed_ +
                (lambda_ * (1.0 - log_volume) + mu_) / (density_ * stretch[i] * stretch[i]));
  return force;
}

/// Kamojjala, Brannon, Sadeghirad and Guilkey 2015, Eng. Comput. 31:213 (generalized vortex).
Vec2 Manufactured::vortex_force(const Vec2& x, double time_s) const
{
  const double radius = x.norm(), rate = speed_ * pi;
  const double swing = description_.amplitude * std::sin(rate * time_s);
  const double swing_rate = description_.amplitude * rate * std::cos(rate * time_s);
  const Profile h = profile(radius);
  const double slope = swing * h.slope, spin = swing_rate * h.value;
  const double radial = radius * (mu_ / density_ * slope * slope - spin * spin);
  const double around =
      -radius * rate * rate * swing * h.value - mu_ / density_ * (3.0 * slope + radius * swing * h.curvature);
  const Vec2 out = turned(x / radius, swing * h.value);
  return radial * out + around * Vec2(-out[1], out[0]);
}

}  // namespace geocontainer_mpm::scene
