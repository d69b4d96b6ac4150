/// What water does to the bodies of the model.

#include <algorithm>

#include "geocontainer_mpm/scene/model.h"

namespace geocontainer_mpm::scene {

/// Weight and inertia in all.
template <int Dim>
void Model<Dim>::weigh()
{
  inertia_ = weight_mass_ = 0.0;
  const auto add = [this](const mpm::Particles<Dim>& particles) {
    for (std::size_t p = 0; p < particles.size(); ++p) {
      inertia_ += particles.mass[p];
      weight_mass_ += particles.weight_mass[p];
    }
  };
  for (const Body& body : now_.bodies)
    add(body.particles);
  for (const ModelSheet& sheet : now_.sheets)
    add(sheet.sheet.nodes());
}

/// Weight, inertia and drag of every body where it is now. After the sheets' own forces.
template <int Dim>
void Model<Dim>::load_water()
{
  if (!water_)
    return;
  now_.water.drag = Vec<Dim>::Zero();
  slowed_power_ = 0.0;
  for (std::size_t b = 0; b < now_.bodies.size(); ++b) {
    Body& body = now_.bodies[b];
    const Water::Uptake<Dim> uptake = water_->immerse(body.density, body.particle_height, body.particles);
    now_.ledger.water += uptake.left_behind;
    now_.kinetic -= uptake.left_behind;
    slowed_power_ += now_.gravity.dot(uptake.slowed);
    const std::size_t sheet = sheet_around(b);
    Water::Drag<Dim> drag;
    if (sheet < now_.sheets.size()) {
      mpm::Particles<Dim>& nodes = now_.sheets[sheet].sheet.nodes();
      drag = water_->resist(nodes, 0.0, body.particle_height, body.particles);
      now_.water.on_sheets.resize(now_.sheets.size());
      if constexpr (Dim == 2)
        water_->press(drag, nodes, now_.water.on_sheets[sheet]);
      else
        water_->press(drag, nodes, now_.sheets[sheet].sheet.triangles(), now_.water.on_sheets[sheet]);
      for (std::size_t d = 0; d < Dim; ++d)
        for (std::size_t i = 0; i < nodes.size(); ++i)
          nodes.force[d][i] += now_.water.on_sheets[sheet][d][i];
    } else {
      drag = water_->resist(body.particles, body.particle_height, body.particle_height, body.particles);
      water_->spread(drag, body.particle_height, body.particles);
    }
    now_.water.drag += drag.force;
    now_.water.fastest_fall = std::max(now_.water.fastest_fall, -drag.velocity[z_axis<Dim>]);
  }
  load_sum_ += now_.water.drag;
  weigh();
}

/// Index of the sheet around a body; of a bare one the number of sheets.
template <int Dim>
std::size_t Model<Dim>::sheet_around(std::size_t body) const
{
  std::size_t s = 0;
  while (s < now_.sheets.size() && sheet_descriptions_[s].encloses != now_.bodies[body].name)
    ++s;
  return s;
}

/// Power of the drag that sheets take, on their nodes' present velocities, W/m.
template <int Dim>
double Model<Dim>::sheet_drag_power() const
{
  double power = 0.0;
  for (std::size_t s = 0; s < now_.water.on_sheets.size(); ++s)
    for (std::size_t d = 0; d < Dim; ++d)
      for (std::size_t i = 0; i < now_.water.on_sheets[s][d].size(); ++i)
        power += now_.water.on_sheets[s][d][i] * now_.sheets[s].sheet.nodes().velocity[d][i];
  return power;
}

/// Power of all drag on the present velocities, W/m.
template <int Dim>
double Model<Dim>::drag_power() const
{
  double power = sheet_drag_power();
  if (water_)
    for (const Body& body : now_.bodies)
      if (!body.enclosed)
        for (std::size_t p = 0; p < body.particles.size(); ++p)
          power += body.particles.force_of(p).dot(body.velocity(p));
  return power;
}

template <int Dim>
std::optional<WaterFrame> Model<Dim>::water() const
{
  if (!water_)
    return std::nullopt;
  WaterFrame frame;
  frame.level_m = water_->level();
  double displaced = 0.0, volume = 0.0, weight = 0.0;
  for (const Body& body : now_.bodies)
    for (std::size_t p = 0; p < body.particles.size(); ++p) {
      const double v = body.particles.initial_volume[p];
      displaced += v * water_->submerged(body.particles.position[z_axis<Dim>][p], body.particle_height);
      volume += v;
      weight += body.density * v;
    }
  for (const ModelSheet& sheet : now_.sheets)
    for (const double mass : sheet.sheet.nodes().weight_mass)
      weight += mass;
  const double gravity = -constant_gravity_[z_axis<Dim>];
  frame.submerged_share = displaced / volume;
  frame.buoyancy = gravity * water_->density() * displaced;
  frame.submerged_weight = gravity * weight - frame.buoyancy;
  frame.fastest_fall_m_per_s = now_.water.fastest_fall;
  frame.drag_impulse = in_barge_frame(now_.water.drag_impulse);
  frame.dissipated = now_.ledger.water;
  return frame;
}

template class Model<2>;
template class Model<3>;

}  // namespace geocontainer_mpm::scene
