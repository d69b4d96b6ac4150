#include "geocontainer_mpm/scene/water.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "geocontainer_mpm/scene/shadow.h"

namespace geocontainer_mpm::scene {
namespace {

/// Extent along a direction, m.
double extent_along(const mpm::Particles<2>& particles, const Vec2& along)
{
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t p = 0; p < particles.size(); ++p) {
    const double place = along[0] * particles.position[0][p] + along[1] * particles.position[1][p];
    low = std::min(low, place);
    high = std::max(high, place);
  }
  return high - low;
}

/// What is seen of a surface from ahead: width, m, or area, m^2. `margin`: how much wider it is than its points.
double seen(const mpm::Particles<2>& surface, double margin, const Vec2& ahead, Symmetry)
{
  return extent_along(surface, Vec2(-ahead[1], ahead[0])) + margin;
}
double seen(const mpm::Particles<3>& surface, double margin, const Vec3& ahead, Symmetry symmetry)
{
  return shadow_area(surface.position, margin, ahead, symmetry);
}

}  // namespace

Water::Water(const WaterDescription& description, double level_m, double gravity, Symmetry symmetry)
    : density_(description.density_kg_per_m3)
    , level_(level_m)
    , gravity_(gravity)
    , drag_(description.drag_coefficient)
    , added_(description.added_mass_coefficient)
    , symmetry_(symmetry)
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

template <int Dim>
double Water::potential(const mpm::Particles<Dim>& particles, double height) const
{
  double sum = 0.0;
  for (std::size_t p = 0; p < particles.size(); ++p)
    sum += particles.initial_volume[p] * depth(particles.position[z_axis<Dim>][p], height);
  return density_ * gravity_ * sum;
}

template <int Dim>
void Water::place(double soil_density, double height, mpm::Particles<Dim>& particles) const
{
  for (std::size_t p = 0; p < particles.size(); ++p) {
    const double displaced = density_ * submerged(particles.position[z_axis<Dim>][p], height),
                 volume = particles.initial_volume[p];
    particles.weight_mass[p] = (soil_density - displaced) * volume;
    particles.mass[p] = (soil_density + added_ * displaced) * volume;
  }
}

template <int Dim>
Water::Uptake<Dim> Water::immerse(double soil_density, double height, mpm::Particles<Dim>& particles) const
{
  Uptake<Dim> uptake;
  for (std::size_t p = 0; p < particles.size(); ++p) {
    const double displaced = density_ * submerged(particles.position[z_axis<Dim>][p], height),
                 volume = particles.initial_volume[p];
    const double before = particles.mass[p], after = (soil_density + added_ * displaced) * volume;
    particles.weight_mass[p] = (soil_density - displaced) * volume;
    if (after == before)
      continue;
    particles.mass[p] = after;
    const double energy = 0.5 * particles.velocity_of(p).squaredNorm();
    if (after < before) {
      uptake.left_behind += (before - after) * energy;
      continue;
    }
    const double keep = before / after;
    uptake.left_behind += before * (1.0 - keep) * energy;
    uptake.slowed += particles.weight_mass[p] * (1.0 - keep) * particles.velocity_of(p);
    for (mpm::Column& column : particles.velocity)
      column[p] *= keep;
    for (mpm::Column& column : particles.affine)
      column[p] *= keep;
  }
  return uptake;
}

template <int Dim>
Water::Drag<Dim> Water::resist(const mpm::Particles<Dim>& surface, double margin, double height,
                               const mpm::Particles<Dim>& particles) const
{
  Drag<Dim> drag;
  double volume = 0.0;
  for (std::size_t p = 0; p < particles.size(); ++p) {
    const double part = submerged(particles.position[z_axis<Dim>][p], height) * particles.initial_volume[p];
    volume += particles.initial_volume[p];
    drag.submerged_volume += part;
    drag.velocity += part * particles.velocity_of(p);
  }
  if (!(drag.submerged_volume > 0.0))
    return drag;
  drag.velocity /= drag.submerged_volume;
  if constexpr (Dim == 3) {  // the other parts move the other way
    if (symmetry_ != Symmetry::none)
      drag.velocity[y_axis<3>] = 0.0;
    if (symmetry_ == Symmetry::quarter)
      drag.velocity[0] = 0.0;
  }
  const double speed = drag.velocity.norm();
  if (drag_ > 0.0 && speed > 0.0) {
    const double width = seen(surface, margin, drag.velocity / speed, symmetry_);
    drag.force = -0.5 * density_ * drag_ * width * (drag.submerged_volume / volume) * speed * drag.velocity;
  }
  return drag;
}

void Water::press(const Drag<2>& drag, const mpm::Particles<2>& sheet, std::array<mpm::Column, 2>& forces) const
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

void Water::press(const Drag<3>& drag, const mpm::Particles<3>& sheet,
                  const std::vector<geotextile::Triangle>& triangles, std::array<mpm::Column, 3>& forces) const
{
  for (mpm::Column& column : forces)
    column.assign(sheet.size(), 0.0);
  if (drag.force == Vec3::Zero())
    return;
  const auto facing = [&](const geotextile::Triangle& t) {  // twice its area seen from ahead
    const Vec3 a = sheet.position_of(t[0]), b = sheet.position_of(t[1]), c = sheet.position_of(t[2]);
    return std::max(0.0, (b - a).cross(c - a).dot(drag.velocity));
  };
  double all = 0.0;
  for (const geotextile::Triangle& t : triangles)
    all += facing(t);
  for (const geotextile::Triangle& t : triangles) {
    const double share = facing(t) / (3.0 * all);
    for (const std::uint32_t node : t)
      for (std::size_t d = 0; d < 3; ++d)
        forces[d][node] += share * drag.force[static_cast<Eigen::Index>(d)];
  }
}

template <int Dim>
void Water::spread(const Drag<Dim>& drag, double height, mpm::Particles<Dim>& particles) const
{
  const Vec<Dim> per_volume =
      drag.force == Vec<Dim>::Zero() ? drag.force : Vec<Dim>(drag.force / drag.submerged_volume);
  for (std::size_t p = 0; p < particles.size(); ++p) {
    const double part = submerged(particles.position[z_axis<Dim>][p], height) * particles.initial_volume[p];
    for (std::size_t d = 0; d < Dim; ++d)
      particles.force[d][p] = part * per_volume[static_cast<Eigen::Index>(d)];
  }
}

template double Water::potential(const mpm::Particles<2>&, double) const;
template double Water::potential(const mpm::Particles<3>&, double) const;
template Water::Uptake<2> Water::immerse(double, double, mpm::Particles<2>&) const;
template Water::Uptake<3> Water::immerse(double, double, mpm::Particles<3>&) const;
template void Water::place(double, double, mpm::Particles<2>&) const;
template void Water::place(double, double, mpm::Particles<3>&) const;
template Water::Drag<2> Water::resist(const mpm::Particles<2>&, double, double, const mpm::Particles<2>&) const;
template Water::Drag<3> Water::resist(const mpm::Particles<3>&, double, double, const mpm::Particles<3>&) const;
template void Water::spread(const Drag<2>&, double, mpm::Particles<2>&) const;
template void Water::spread(const Drag<3>&, double, mpm::Particles<3>&) const;

}  // namespace geocontainer_mpm::scene
