/// Particles to the grids and back, and the loads that go with them.

#include <algorithm>

#include "geocontainer_mpm/scene/model.h"
#include "model_chunks.h"

namespace geocontainer_mpm::scene {
namespace {

using mpm::Gather;
using mpm::Part;
using mpm::UpdateOrder;

Vec2 force_at(const SheetEnd& end, double time_s)
{
  return end.force_table.empty() ? end.force_n_per_m
                                 : Vec2(value_at<1>(end.force_table, time_s)[0] * end.force_n_per_m);
}

/// What acts on a sheet.
template <int Dim>
auto load_at(const GeotextileDescription& sheet, double time_s)
{
  std::conditional_t<Dim == 2, geotextile::SheetLoad, geotextile::MembraneLoad> load;
  if (sheet.inside_pressure) {
    const InsidePressure& inside = *sheet.inside_pressure;
    const double factor = inside.table.empty() ? 1.0 : value_at<1>(inside.table, time_s)[0];
    load.pressure = factor * inside.pressure_pa;
    load.gradient = factor * inside.gradient_pa_per_m;
    load.level = inside.level_m;
  }
  if constexpr (Dim == 2) {
    load.start_force = force_at(sheet.start, time_s);
    load.end_force = force_at(sheet.end, time_s);
  }
  return load;
}

}  // namespace

/// Body forces of manufactured solutions, water, and loads of sheets, as forces of their particles.
template <int Dim>
void Model<Dim>::load_particles(double time_s)
{
  load_sum_ = Vec<Dim>::Zero();
  for (Body& body : now_.bodies) {
    if (!body.manufactured || body.held)
      continue;
    if constexpr (Dim == 2)
      for (std::size_t p = 0; p < body.particles.size(); ++p) {
        const Vec2 force =
            body.particles.mass[p] * body.manufactured->body_force((*body.start)[body.particles.id[p]], time_s);
        body.particles.force[0][p] = force[0];
        body.particles.force[1][p] = force[1];
        load_sum_ += force;
      }
  }
  bool taut = false;
  for (std::size_t s = 0; s < now_.sheets.size(); ++s) {
    SheetOf<Dim>& sheet = now_.sheets[s].sheet;
    if (now_.sheets[s].held || !sheet.update_forces(load_at<Dim>(sheet_descriptions_[s], time_s)))
      continue;
    taut = true;
    for (std::size_t i = 0; i < sheet.nodes().size(); ++i)  // tensions cancel
      load_sum_ += sheet.nodes().force_of(i);
  }
  now_.skipped.membrane_passes += taut ? 0 : 1;
  load_water();
}

/// All particles' share of the grids.
template <int Dim>
void Model<Dim>::scatter(Part part)
{
  for (const Body& body : now_.bodies)
    if (!body.held)
      mpm::body_to_grid(method_, body.particles, body.strips,
                        { part, body.manufactured || (water_ && !body.enclosed), body.damping }, now_.gravity,
                        fields_[body.field].grid, *team_);
  for (const ModelSheet& sheet : now_.sheets)
    if (!sheet.held)
      mpm::sheet_to_grid(method_, sheet.sheet.nodes(), part, now_.gravity, fields_[sheet.field].grid,
                         sheet.sheet.strains_with_grid());
}

template <int Dim>
void Model<Dim>::add_tractions(double time_s)
{
  if constexpr (Dim == 2)
    for (std::size_t t = 0; t < now_.tractions.size(); ++t) {
      const Body& body = now_.bodies[traction_body_[t]];
      if (body.held)
        continue;
      load_sum_ += now_.tractions[t].add_to(fields_[body.field].grid, method_.shape, body.particles, body.row, time_s);
    }
}

/// The consistent mass matrices, from the particles' places at the start of the step.
template <int Dim>
void Model<Dim>::assemble_mass()
{
  if (method_.mass != mpm::MassMatrix::consistent)
    return;
  for (std::size_t f = 0; f < fields_.size(); ++f) {
    Field& field = fields_[f];
    mpm::ConsistentMass<Dim>& mass = field.update.mass();
    mass.open(method_.shape, field.grid);
    for (const Body& body : now_.bodies)
      if (body.field == f && !body.held)
        mass.add(body.particles, body.strips, field.grid, *team_);
    for (const ModelSheet& sheet : now_.sheets)
      if (sheet.field == f && !sheet.held)
        mass.add(sheet.sheet.nodes(), field.grid);
  }
}

/// Power of all loads but constant gravity on the particles' present velocities, W/m.
template <int Dim>
double Model<Dim>::load_power(double time_s) const
{
  double power = 0.0;
  for (const Body& body : now_.bodies)
    if (body.manufactured)
      for (std::size_t p = 0; p < body.particles.size(); ++p)
        power += body.particles.force_of(p).dot(body.velocity(p));
  for (const Traction& traction : now_.tractions)
    power += traction.power(time_s);
  for (const ModelSheet& sheet : now_.sheets)
    power += sheet.sheet.external_power();
  if (!gravity_table_.empty())
    power += gravity_power(now_.gravity);
  return power;
}

/// Stress before the forces (USF): from the velocities that came from the particles.
template <int Dim>
void Model<Dim>::stress_first(double dt)
{
  for (Field& field : fields_)
    field.update.velocities(method_, field.grid, *team_);
  gather_bodies(Gather::gradient, dt);
  gather_sheets(Gather::gradient, dt);
  smooth_gradients();
  update_stress(dt);
  for (Field& field : fields_)
    field.update.momenta(method_, field.grid, *team_);
  scatter(Part::force);
}

/// Velocities and positions, and the velocity gradients that the stress update wants.
template <int Dim>
void Model<Dim>::move_particles(const StepInput& input)
{
  const double dt = input.dt_s;
  if (method_.update == UpdateOrder::usl && !mpm::smooths_gradients(method_)) {
    gather_bodies(Gather::all, dt);
    gather_sheets(Gather::all, dt);
  } else if (method_.update == UpdateOrder::musl) {
    gather_bodies(Gather::velocity, dt);
    gather_sheets(Gather::velocity, dt);
    map_back(input);
    gather_bodies(Gather::gradient, dt);
    gather_sheets(Gather::gradient, dt);
    smooth_gradients();
    gather_bodies(Gather::position, dt);
    gather_sheets(Gather::position, dt);
  } else {
    if (method_.update == UpdateOrder::usl) {
      gather_bodies(Gather::gradient, dt);
      smooth_gradients();
    }
    gather_bodies(Gather::motion, dt);
    gather_sheets(method_.update == UpdateOrder::usl ? Gather::all : Gather::motion, dt);
  }
  for (Body& body : now_.bodies)
    body.particles.stretch_boxes(dt);
  move_tracers(dt);
  if constexpr (Dim == 2)
    for (std::size_t t = 0; t < now_.tractions.size(); ++t) {
      const Body& body = now_.bodies[traction_body_[t]];
      now_.tractions[t].move(body.particles, body.row, dt);
    }
}

/// The grid's velocities anew from the moved particles' (MUSL), under the same conditions of faces and supports.
template <int Dim>
void Model<Dim>::map_back(const StepInput& input)
{
  for (Field& field : fields_) {
    field.grid.keep_velocities(*team_);
    field.grid.open(field.grid.window(), *team_);
  }
  scatter(Part::momentum);
  for (Field& field : fields_) {
    field.update.velocities(method_, field.grid, *team_);
    for (const SupportDescription& support : supports_)  // for strain alone: no force acts, so no sums
      apply_support(support, input.time_s + 0.5 * input.dt_s, 0.0, field.grid);
  }
}

template <int Dim>
void Model<Dim>::smooth_gradients()
{
  for (Body& body : now_.bodies)
    if (!body.held)
      mpm::smooth_gradients(method_, body.strips, body.particles, fields_[body.field].grid, *team_);
}

template <int Dim>
void Model<Dim>::gather_bodies(Gather what, double dt)
{
  for (Body& body : now_.bodies)
    for_chunks(body.held ? 0 : body.particles.size(), *team_, [&](std::size_t first, std::size_t last) {
      mpm::grid_to_particles(method_, fields_[body.field].grid, dt, what, body.particles, first, last);
    });
}

/// With aflip a sheet is affine alone: its nodes are light, and what the grid does not see of their motion strains the
/// segments between them.
template <int Dim>
void Model<Dim>::gather_sheets(Gather what, double dt)
{
  mpm::Discretisation method = method_;
  if (method.transfer == mpm::Transfer::aflip)
    method.transfer = mpm::Transfer::apic;
  for (ModelSheet& sheet : now_.sheets) {
    const bool strains = sheet.sheet.strains_with_grid();  // gradients are for who strains by them
    if (sheet.held || (what == Gather::gradient && !strains))
      continue;
    mpm::grid_to_particles(method, fields_[sheet.field].grid, dt,
                           what == Gather::all && !strains ? Gather::motion : what, sheet.sheet.nodes(), 0,
                           sheet.sheet.nodes().size());
  }
}

template <int Dim>
void Model<Dim>::move_tracers(double dt)
{
  for (Tracer<Dim>& tracer : now_.tracers) {
    const Body& body = now_.bodies[tracer.body];
    const std::size_t p = body.row[tracer.owner];
    tracer.offset += dt * (body.gradient(p) * tracer.offset);
    const Vec<Dim> moved = body.position(p) + tracer.offset;
    tracer.velocity = (moved - tracer.position) / dt;
    tracer.position = moved;
  }
}

template <int Dim>
void Model<Dim>::update_stress(double dt)
{
  for (Body& body : now_.bodies) {
    const material::Batch<Dim> batch = body.particles.batch();
    for_chunks(body.held ? 0 : body.particles.size(), *team_,
               [&](std::size_t first, std::size_t last) { body.law->update(batch, dt, first, last); });
  }
  for (ModelSheet& sheet : now_.sheets)
    if (!sheet.held)
      sheet.sheet.update_stress(dt);
}

template class Model<2>;
template class Model<3>;

}  // namespace geocontainer_mpm::scene
