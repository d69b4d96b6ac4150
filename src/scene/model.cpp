/// One step of the model.

#include "geocontainer_mpm/scene/model.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

namespace geocontainer_mpm::scene {
namespace {

using mpm::UpdateOrder;

/// Adds the time since the last mark to a stage.
class StageClock {
public:
  void mark(double& stage_s)
  {
    const auto now = std::chrono::steady_clock::now();
    stage_s += std::chrono::duration<double>(now - last_).count();
    last_ = now;
  }

private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace

template <int Dim>
void Model<Dim>::sort_particles()
{
  if (now_.sorted && now_.travel_since_sort <= 0.9 * fields_.front().grid.dx())
    return;
  for (Body& body : now_.bodies) {
    if (body.held)
      continue;
    sorter_.sort(fields_[body.field].grid, body.particles, body.strips);
    for (std::size_t p = 0; p < body.row.size(); ++p)
      body.row[body.particles.id[p]] = static_cast<std::uint32_t>(p);
  }
  now_.sorted = true;
  now_.travel_since_sort = 0.0;
}

template <int Dim>
void Model<Dim>::open_grids()
{
  for (Field& field : fields_) {
    mpm::Window<Dim> window;
    for (int d = 0; d < Dim; ++d) {
      const auto base = [&](double x) {
        return static_cast<int>(std::floor((x - field.grid.origin()[d]) * field.grid.inverse_dx() - 0.5));
      };
      window.begin[static_cast<std::size_t>(d)] = base(field.extent_lower[d]);
      window.end[static_cast<std::size_t>(d)] = base(field.extent_upper[d]) + 3;
    }
    field.grid.open(window, *team_);
    now_.skipped.grid_nodes += field.grid.size() - window.nodes();
  }
}

template <int Dim>
Vec<Dim> Model<Dim>::gravity_at(double time_s) const
{
  if (gravity_table_.empty())
    return constant_gravity_;
  const auto [y, z] = value_at<2>(gravity_table_, time_s);
  return in_space<Dim>(Vec2(y, z));
}

template <int Dim>
void Model<Dim>::transfer_to_grid(double time_s)
{
  StageClock clock;
  now_.gravity = gravity_at(time_s);
  start_bodies(time_s);
  sort_particles();
  open_grids();
  clock.mark(stages_.p2g_s);
  load_particles(time_s);
  clock.mark(stages_.membrane_s);
  scatter(method_.update == UpdateOrder::usf ? mpm::Part::momentum : mpm::Part::all);
  add_tractions(time_s);
  assemble_mass();
  load_power_before_ = load_power(time_s);
  drag_power_before_ = drag_power();
  if (books_transferred_work())
    power_before_ = load_power_before_ + drag_power_before_ + slowed_power_ +
                    (gravity_table_.empty() ? gravity_power(now_.gravity) : 0.0) - stress_power() - damping_power() -
                    tension_power();
  clock.mark(stages_.p2g_s);
  bound_time_step();
  clock.mark(stages_.bound_s);
  on_grid_ = true;
}

template <int Dim>
double Model<Dim>::stable_dt(double time_s)
{
  if (!on_grid_)
    transfer_to_grid(time_s);
  return stable_dt_;
}

template <int Dim>
StepStatus Model<Dim>::step(const StepInput& input)
{
  if (!now_.health.ok)
    return now_.health;
  stable_dt(input.time_s);
  StageClock clock;

  // Leapfrog: velocities live at mid-steps.
  const double kick = 0.5 * (now_.last_dt + input.dt_s), damping_before = damping_power();
  if (method_.transfer == mpm::Transfer::aflip)
    method_.flip_fraction = std::exp(-kick / transfer_memory_s_);
  if (method_.update == UpdateOrder::usf)
    stress_first(input.dt_s);
  apply_forces(input, kick);
  clock.mark(stages_.forces_s);
  solve_contact(input, kick);
  hold_nodes(input, kick);
  clock.mark(stages_.contact_s);
  move_particles(input);
  clock.mark(stages_.g2p_s);
  if (method_.update != UpdateOrder::usf)
    update_stress(input.dt_s);
  clock.mark(stages_.material_s);

  now_.last_dt = input.dt_s;
  on_grid_ = false;
  ++now_.steps_since_bound;
  // Loads act over the kick on the mean of the velocities before and after it.
  now_.ledger.work_in += 0.5 * kick * (load_power_before_ + load_power(input.time_s));
  if (water_) {
    now_.ledger.water -= 0.5 * kick * (drag_power_before_ + drag_power());
    now_.water.drag_impulse += kick * now_.water.drag;
  }
  now_.ledger.material_damping += 0.5 * kick * (damping_before + damping_power());
  survey();
  now_.travel_since_sort += now_.fastest * input.dt_s;
  now_.travel_since_bound += now_.fastest * input.dt_s;
  clock.mark(stages_.g2p_s);
  return now_.health;
}

/// usf and musl strain by what came through the transfer. On linear simplices nodes with next to no mass strain their
/// element by so much in a step that power times time says nothing about work.
template <int Dim>
bool Model<Dim>::books_transferred_work() const
{
  return method_.update == UpdateOrder::usl && method_.shape != mpm::Shape::linear_simplex;
}

template <int Dim>
void Model<Dim>::apply_forces(const StepInput& input, double kick)
{
  double before = 0.0, after = 0.0, power_before = 0.0;
  Vec<Dim> change = Vec<Dim>::Zero();
  bool away_from_faces = true;
  for (Field& field : fields_) {
    const mpm::MotionSums<Dim> sums = field.update.apply_forces(method_, field.grid, kick, input.damping_per_s, *team_);
    before += sums.kinetic_before;
    after += sums.kinetic_after;
    power_before += sums.power_before;
    now_.ledger.damped += sums.damped;
    change += sums.momentum_after - sums.momentum_before;
    away_from_faces = away_from_faces && !sums.touches_faces;
  }
  if (now_.kinetic_known) {
    now_.ledger.transfer += now_.kinetic - before;
    // Over the kick's first half, the end of the last step, forces act on the motion that came through the transfer,
    // while stress, height and loads go by the motion before it.
    if (books_transferred_work())
      now_.ledger.transfer += 0.5 * now_.last_dt * (power_before_ - power_before);
  } else {
    now_.ledger.kinetic_at_start = before;
  }
  now_.kinetic = after;
  now_.kinetic_known = true;
  if (away_from_faces && input.damping_per_s == 0.0) {
    const Vec<Dim> pull = kick * ((weight_mass_ - held(&LateStart::weight_mass)) * now_.gravity + load_sum_);
    now_.ledger.momentum_error += (change - pull).norm();
    now_.ledger.momentum_exchanged += pull.norm();
  }
}

/// What may touch in each field: a body in a sheet touches rigid surfaces by its sheet, but for strays.
template <int Dim>
void Model<Dim>::collect_points()
{
  for (Field& field : fields_) {
    field.points.clear();
    field.all_points.clear();
  }
  for (const Body& body : now_.bodies) {
    if (body.held)
      continue;
    fields_[body.field].all_points.push_back({ &body.particles, true });
    if (!body.enclosed)
      fields_[body.field].points.push_back({ &body.particles, true });
    else if (!body.strays.empty())
      fields_[body.field].points.push_back({ &body.particles, true, &body.strays });
  }
  for (const ModelSheet& sheet : now_.sheets) {
    if (sheet.held)
      continue;
    fields_[sheet.field].all_points.push_back({ &sheet.sheet.nodes(), false });
    fields_[sheet.field].points.push_back({ &sheet.sheet.nodes(), false });
  }
}

template <int Dim>
void Model<Dim>::solve_contact(const StepInput& input, double kick)
{
  for (std::size_t b = 0; b < boundaries_.size(); ++b)
    boundaries_[b].set_motion(input.start[b], input.end[b], input.dt_s);
  collect_points();

  if constexpr (Dim == 2)
    for (FieldPair& pair : pairs_)
      take(pair.contact.solve({ &fields_[pair.a].grid, &fields_[pair.a].all_points },
                              { &fields_[pair.b].grid, &fields_[pair.b].all_points }, pair.friction, kick, input.dt_s));
  for (std::size_t f = 0; f < fields_.size(); ++f)
    collect_anchors(input, f);
  if (!sheet_pairs_.empty()) {
    solve_sheet_contact(input, kick);
    return;
  }
  for (std::size_t f = 0; f < fields_.size(); ++f) {
    Field& field = fields_[f];
    take(now_.contact[f].solve(boundaries_, field.points, field.anchors, kick, input.dt_s, field.grid, field.impulses));
    take_impulses(field);
  }
}

template <int Dim>
void Model<Dim>::take(const contact::ContactSums<Dim>& sums)
{
  now_.kinetic += sums.kinetic_change;
  now_.ledger.contact += sums.dissipated;
  now_.ledger.momentum_exchanged += sums.impulse.norm();
  now_.skipped.contact_searches += sums.skipped;
}

/// What boundaries and anchors did to a field.
template <int Dim>
void Model<Dim>::take_impulses(const Field& field)
{
  for (std::size_t b = 0; b < boundaries_.size(); ++b) {
    const contact::BoundaryImpulse<Dim>& done = field.impulses.boundary[b];
    BoundaryTotal<Dim>& total = now_.boundary_totals[b];
    total.impulse += done.impulse;
    total.moment += done.moment;
    total.work += done.work;
    now_.ledger.work_in += done.work;
  }
  for (const contact::AnchorImpulse<Dim>& anchor : field.impulses.anchor)
    now_.ledger.work_in += anchor.work;
}

/// Where held ends of sheets are to be at the end of the step.
template <int Dim>
void Model<Dim>::collect_anchors(const StepInput& input, std::size_t field)
{
  std::vector<contact::Anchor<Dim>>& anchors = fields_[field].anchors;
  anchors.clear();
  for (const HeldEnd& held : held_ends_) {
    const ModelSheet& sheet = now_.sheets[held.sheet];
    if (sheet.field != field)
      continue;
    Vec<Dim> target = held.place;
    if (!held.motion.empty()) {
      const auto [y, z] = value_at<2>(held.motion, input.time_s + input.dt_s);
      target += in_space<Dim>(Vec2(y, z));
    }
    anchors.push_back({ sheet.sheet.nodes().position_of(held.node), target });
  }
}

/// Supports, then the faces of the grid, which have the last word.
template <int Dim>
void Model<Dim>::hold_nodes(const StepInput& input, double kick)
{
  for (Field& field : fields_) {
    for (const SupportDescription& support : supports_) {
      const SupportSums sums = apply_support(support, input.time_s + 0.5 * input.dt_s, kick, field.grid);
      now_.kinetic += sums.kinetic_change;
      now_.ledger.contact += sums.dissipated;
      now_.ledger.work_in += sums.work;
    }
    const double taken = field.update.apply_faces(field.grid);
    now_.ledger.faces += taken;
    now_.kinetic -= taken;
  }
}

template <int Dim>
void Model<Dim>::restore(const ModelState& state)
{
  now_ = state;
  on_grid_ = false;
  survey();  // the fields' extents, from which the grids' windows follow
}

template <int Dim>
void Model<Dim>::hold(bool held)
{
  for (contact::ContactSolver<Dim>& contact : now_.contact)
    contact.hold(held);
  for (contact::SheetContact<Dim>& contact : now_.sheet_contact)
    contact.hold(held);
}

template <int Dim>
void Model<Dim>::stop_motion()
{
  const auto still = [](mpm::Particles<Dim>& particles) {
    for (mpm::Column& column : particles.velocity)
      std::fill(column.begin(), column.end(), 0.0);
    for (auto* matrix : { &particles.affine, &particles.gradient })
      for (mpm::Column& column : *matrix)
        std::fill(column.begin(), column.end(), 0.0);
  };
  for (Body& body : now_.bodies)
    still(body.particles);
  for (ModelSheet& sheet : now_.sheets)
    still(sheet.sheet.nodes());
  now_.ledger.transfer += now_.kinetic;
  now_.kinetic = 0.0;
  now_.last_dt = 0.0;
  now_.fastest = 0.0;
  on_grid_ = false;
}

template class Model<2>;
template class Model<3>;

}  // namespace geocontainer_mpm::scene
