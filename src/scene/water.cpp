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
                          const mpm::Particles<2>& particles) const
{
  Drag drag;
  double volume = 0.0;
  for (std::size_t p = 0; p < particles.size(); ++p) {
    const double part = submerged(particles.position[1][p], height) * particles.initial_volume[p];
    volume += particles.initial_volume[p];
    drag.submerged_volume += part;
    drag.velocity += part * velocity(particles, p);
  }
  if (!(drag.submerged_volume > 0.0))
    return drag;
  drag.velocity /= drag.submerged_volume;
  const double speed = drag.velocity.norm();
  if (drag_ > 0.0 && speed > 0.0) {
    const double width = extent(surface, Vec2(-drag.velocity[1], drag.velocity[0]) / speed) + margin;
    drag.force = -0.5 * density_ * drag_ * width * (drag.submerged_volume / volume) * speed * drag.velocity;
  }
  return drag;
}

void Water::press(const Drag& drag, const mpm::Particles<2>& sheet, std::array<mpm::Column, 2>& forces) const
{
  const std::size_t n = sheet.size();
  for (mpm::Column& column : forces)
    column.assign(n, 0.0);
  if (drag.force == Vec2::Zero())
    return;
  const Vec2 ahead = drag.velocity.normalized();
  const auto side = [&](std::size_t i) {  // length times right normal of the segment after a node
    const std::size_t j = i + 1 < n ? i + 1 : 0;
    return Vec2(sheet.position[1][j] - sheet.position[1][i], sheet.position[0][i] - sheet.position[0][j]);
  };
  double twice_area = 0.0, width = 0.0;
  for (std::size_t i = 0; i < n; ++i)
    twice_area += sheet.position[0][i] * side(i)[0] + sheet.position[1][i] * side(i)[1];
  const double outwards = twice_area >= 0.0 ? 1.0 : -1.0;
  const auto facing = [&](std::size_t i) { return std::max(0.0, outwards * side(i).dot(ahead)); };
  for (std::size_t i = 0; i < n; ++i)
    width += facing(i);
  for (std::size_t i = 0; i < n; ++i) {
    const double share = 0.5 * (facing(i) + facing(i > 0 ? i - 1 : n - 1)) / width;
    forces[0][i] = share * drag.force[0];
    forces[1][i] = share * drag.force[1];
  }
}

void Water::spread(const Drag& drag, double height, mpm::Particles<2>& particles) const
{
  const Vec2 per_volume = drag.force == Vec2::Zero() ? drag.force : Vec2(drag.force / drag.submerged_volume);
  for (std::size_t p = 0; p < particles.size(); ++p) {
    const double part = submerged(particles.position[1][p], height) * particles.initial_volume[p];
    particles.force[0][p] = part * per_volume[0];
    particles.force[1][p] = part * per_volume[1];
  }
}

}  // namespace geocontainer_mpm::scene
