#include "geocontainer_mpm/scene/water.h"

#include <algorithm>
#include <limits>

namespace geocontainer_mpm::scene {
namespace {

Vec2 velocity(const mpm::Particles<2>& particles, std::size_t p)
{
  return { particles.velocity[0][p], particles.velocity[1][p] };
}

/// Extent along a direction, m.
double extent(const mpm::Particles<2>& particles, const Vec2& along)
{
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t p = 0; p < particles.size(); ++p) {
    const double place = along[0] * particles.position[0][p] + along[1] * particles.position[1][p];
    low = std::min(low, place);
    high = std::max(high, place);
  }
  return high - low;
}

}  // namespace

Water::Water(const WaterDescription& description, double level_m, double gravity)
    : density_(description.density_kg_per_m3)
    , level_(level_m)
    , gravity_(gravity)
    , drag_(description.drag_coefficient)
    , added_(description.added_mass_coefficient)
{
}

double Water::submerged(double z, double height) const
{
  return std::clamp((level_ - z) / height + 0.5, 0.0, 1.0);
}

double Water::depth(double z, double height) const
{
  const double share = submerged(z, height);
  return share < 1.0 ? 0.5 * height * share * share : level_ - z;
}

double Water::overburden(double soil_density, double z, double top) const
{
  const double soil = std::max(0.0, top - z), water = std::max(0.0, std::min(top, level_) - z);
  return std::max(0.0, soil_density * soil - density_ * water);
}

double Water::potential(const mpm::Particles<2>& particles, double height) const
{
  double sum = 0.0;
  for (std::size_t p = 0; p < particles.size(); ++p)
    sum += particles.initial_volume[p] * depth(particles.position[1][p], height);
  return density_ * gravity_ * sum;
}

void Water::place(double soil_density, double height, mpm::Particles<2>& particles) const
{
  for (std::size_t p = 0; p < particles.size(); ++p) {
    const double displaced = density_ * submerged(particles.position[1][p], height),
                 volume = particles.initial_volume[p];
    particles.weight_mass[p] = (soil_density - displaced) * volume;
    particles.mass[p] = (soil_density + added_ * displaced) * volume;
  }
}

Water::Uptake Water::immerse(double soil_density, double height, mpm::Particles<2>& particles) const
{
  Uptake uptake;
  for (std::size_t p = 0; p < particles.size(); ++p) {
    const double displaced = density_ * submerged(particles.position[1][p], height),
                 volume = particles.initial_volume[p];
    const double before = particles.mass[p], after = (soil_density + added_ * displaced) * volume;
    particles.weight_mass[p] = (soil_density - displaced) * volume;
    if (after == before)
      continue;
    particles.mass[p] = after;
    const double energy = 0.5 * velocity(particles, p).squaredNorm();
    if (after < before) {
      uptake.left_behind += (before - after) * energy;
      continue;
    }
    const double keep = before / after;
    uptake.left_behind += before * (1.0 - keep) * energy;
    uptake.slowed += particles.weight_mass[p] * (1.0 - keep) * velocity(particles, p);
    for (mpm::Column& column : particles.velocity)
      column[p] *= keep;
    for (mpm::Column& column : particles.affine)
      column[p] *= keep;
  }
  return uptake;
}

Water::Drag Water::resist(const mpm::Particles<2>& surface, double margin, double height,
                          mpm::Particles<2>& particles) const
{
  Drag drag;
  double volume = 0.0, submerged_volume = 0.0;
  for (std::size_t p = 0; p < particles.size(); ++p) {
    const double part = submerged(particles.position[1][p], height) * particles.initial_volume[p];
    volume += particles.initial_volume[p];
    submerged_volume += part;
    drag.velocity += part * velocity(particles, p);
  }
  if (submerged_volume > 0.0) {
    drag.share = submerged_volume / volume;
    drag.velocity /= submerged_volume;
    const double speed = drag.velocity.norm();
    if (drag_ > 0.0 && speed > 0.0) {
      const double width = extent(surface, Vec2(-drag.velocity[1], drag.velocity[0]) / speed) + margin;
      drag.force = -0.5 * density_ * drag_ * width * drag.share * speed * drag.velocity;
    }
  }
  const Vec2 per_volume = submerged_volume > 0.0 ? Vec2(drag.force / submerged_volume) : Vec2(Vec2::Zero());
  for (std::size_t p = 0; p < particles.size(); ++p) {
    const double part = submerged(particles.position[1][p], height) * particles.initial_volume[p];
    particles.force[0][p] = part * per_volume[0];
    particles.force[1][p] = part * per_volume[1];
  }
  return drag;
}

}  // namespace geocontainer_mpm::scene
