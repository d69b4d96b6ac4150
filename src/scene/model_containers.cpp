/// Containers: how fill and geotextile touch when they may slip, how geotextiles touch each other, and bodies that
/// start late.

#include <algorithm>
#include <limits>
#include <vector>

#include "geocontainer_mpm/scene/model.h"

namespace geocontainer_mpm::scene {
namespace {

/// Instants closer than this are one, s.
constexpr double same_instant_s = 1e-9;

contact::ClosedSheet<2> closed_sheet(const ModelSheet<2>& sheet)
{
  return { &sheet.sheet.nodes(), sheet.sheet.outwards(), nullptr };
}
contact::ClosedSheet<3> closed_sheet(const ModelSheet<3>& sheet)
{
  return { &sheet.sheet.nodes(), 1.0, &sheet.sheet.triangles() };
}

}  // namespace

/// The sheet of a velocity field that is one container's; none for any other field.
template <int Dim>
std::optional<std::size_t> Model<Dim>::sheet_of_container(const SceneDescription& scene, const std::string& field) const
{
  const std::size_t index = field_index(field);
  if (scene.is_container(fields_[index].name))
    for (std::size_t s = 0; s < now_.sheets.size(); ++s)
      if (now_.sheets[s].inside && now_.bodies[*now_.sheets[s].inside].field == index)
        return s;
  return std::nullopt;
}

template <int Dim>
void Model<Dim>::add_sheet_pair(const SheetPair& pair, contact::SheetSide side, double friction)
{
  sheet_pairs_.push_back(pair);
  now_.sheet_contact.emplace_back(method_.shape, side, friction);
}

/// Containers touch by their sheets: the nodes of each on the outside of the other's segments. Whatever else has a
/// field of its own touches by the nodes of the grid.
template <int Dim>
void Model<Dim>::build_contacts(const SceneDescription& scene)
{
  for (std::size_t s = 0; s < now_.sheets.size(); ++s) {
    const GeotextileDescription& description = sheet_descriptions_[s];
    if (description.interface == SheetInterface::frictional)
      add_sheet_pair({ s, now_.sheets[s].inside, 0, now_.bodies[*now_.sheets[s].inside].field, now_.sheets[s].field },
                     contact::SheetSide::inside, description.interface_friction);
  }
  for (const auto& [name, touching] : scene.contacts) {
    const std::optional<std::size_t> one = sheet_of_container(scene, touching.between[0]);
    const std::optional<std::size_t> other = sheet_of_container(scene, touching.between[1]);
    if (one && other) {
      const std::size_t one_field = now_.sheets[*one].field, other_field = now_.sheets[*other].field;
      add_sheet_pair({ *one, std::nullopt, *other, other_field, one_field }, contact::SheetSide::outside,
                     touching.friction);
      add_sheet_pair({ *other, std::nullopt, *one, one_field, other_field }, contact::SheetSide::outside,
                     touching.friction);
      continue;
    }
    const auto outer_field = [&](const std::optional<std::size_t>& sheet, const std::string& field) {
      return sheet ? now_.sheets[*sheet].field : field_index(field);
    };
    pairs_.push_back({ outer_field(one, touching.between[0]), outer_field(other, touching.between[1]),
                       touching.friction, contact::FieldContact(method_.shape) });
  }
}

template <int Dim>
contact::ContactPoints<Dim> Model<Dim>::points_of(const SheetPair& pair) const
{
  return pair.body ? contact::ContactPoints<Dim>{ &now_.bodies[*pair.body].particles, true }
                   : contact::ContactPoints<Dim>{ &now_.sheets[pair.other_sheet].sheet.nodes(), false };
}

/// Nothing touches what has not started, and sheets whose boxes are apart.
template <int Dim>
bool Model<Dim>::takes_part(const SheetPair& pair) const
{
  if (now_.sheets[pair.sheet].held || (!pair.body && now_.sheets[pair.other_sheet].held))
    return false;
  const Field &a = fields_[pair.point_field], &b = fields_[pair.sheet_field];
  const double reach = a.grid.dx();
  return (a.extent_lower.array() <= b.extent_upper.array() + reach).all() &&
         (b.extent_lower.array() <= a.extent_upper.array() + reach).all();
}

/// What touches sheets from either side, and what hull, surfaces and anchors do, in one solution: a sheet between its
/// fill and the hull must satisfy both.
template <int Dim>
void Model<Dim>::solve_sheet_contact(const StepInput& input, double kick)
{
  std::vector<contact::ContactSums<Dim>> sums(fields_.size());
  for (std::size_t f = 0; f < fields_.size(); ++f)
    now_.contact[f].begin(boundaries_, fields_[f].points, fields_[f].anchors, input.dt_s, fields_[f].grid, sums[f]);
  std::vector<std::size_t> active;
  for (std::size_t k = 0; k < sheet_pairs_.size(); ++k) {
    const SheetPair& pair = sheet_pairs_[k];
    if (!takes_part(pair)) {
      ++now_.skipped.contact_searches;
      continue;
    }
    contact::SheetContact<Dim>& contact = now_.sheet_contact[k];
    contact.begin(points_of(pair), fields_[pair.point_field].grid, closed_sheet(now_.sheets[pair.sheet]),
                  fields_[pair.sheet_field].grid, input.dt_s);
    if (contact.empty())
      continue;
    active.push_back(k);
    std::vector<std::uint32_t> of_points, of_sheet;
    contact.add_nodes(of_points, of_sheet);
    now_.contact[pair.point_field].also_touches(of_points);
    now_.contact[pair.sheet_field].also_touches(of_sheet);
  }
  for (std::size_t f = 0; f < fields_.size(); ++f)
    now_.contact[f].guess(fields_[f].grid);
  for (const std::size_t k : active)
    now_.sheet_contact[k].guess(fields_[sheet_pairs_[k].point_field].grid, fields_[sheet_pairs_[k].sheet_field].grid);

  double change = 1.0;
  for (int number = 0; number < contact::most_sweeps && change > contact::velocity_tolerance; ++number) {
    change = 0.0;
    for (const std::size_t k : active)
      change = std::max(change, now_.sheet_contact[k].sweep(number, fields_[sheet_pairs_[k].point_field].grid,
                                                            fields_[sheet_pairs_[k].sheet_field].grid));
    for (std::size_t f = 0; f < fields_.size(); ++f)
      change = std::max(change, now_.contact[f].sweep(number, fields_[f].grid));
  }

  for (std::size_t k = 0; k < sheet_pairs_.size(); ++k)
    now_.sheet_contact[k].end();
  for (std::size_t f = 0; f < fields_.size(); ++f) {
    now_.contact[f].end(boundaries_, kick, fields_[f].grid, fields_[f].impulses, sums[f]);
    take(sums[f]);
    take_impulses(fields_[f]);
  }
}

/// Bodies that are held at first: what they start with is put aside, and they stand still.
template <int Dim>
void Model<Dim>::build_late_starts(const SceneDescription& scene)
{
  const auto stand = [](mpm::Particles<Dim>& particles) {
    for (mpm::Column& column : particles.velocity)
      std::fill(column.begin(), column.end(), 0.0);
    for (mpm::Column& column : particles.affine)
      std::fill(column.begin(), column.end(), 0.0);
  };
  for (std::size_t b = 0; b < now_.bodies.size(); ++b) {
    Body& body = now_.bodies[b];
    const double at_s = scene.bodies.at(body.name).held_until_s;
    if (!(at_s > 0.0))
      continue;
    LateStart start{ at_s, b, std::nullopt, body.particles, {}, 0.0, 0.0 };
    const auto weigh = [&start](const mpm::Particles<Dim>& particles) {
      for (std::size_t p = 0; p < particles.size(); ++p) {
        start.weight_mass += particles.weight_mass[p];
        start.inertia += particles.mass[p];
      }
    };
    weigh(body.particles);
    body.held = true;
    stand(body.particles);
    for (std::size_t s = 0; s < now_.sheets.size(); ++s) {
      ModelSheet& sheet = now_.sheets[s];
      if (sheet.inside != b)
        continue;
      start.sheet = s;
      start.sheet_start = sheet.sheet.nodes();
      weigh(sheet.sheet.nodes());
      sheet.held = true;
      stand(sheet.sheet.nodes());
    }
    late_starts_.push_back(std::move(start));
  }
}

template <int Dim>
double Model<Dim>::next_start_s() const
{
  double next = std::numeric_limits<double>::infinity();
  for (const LateStart& start : late_starts_)
    if (now_.bodies[start.body].held)
      next = std::min(next, start.at_s);
  return next;
}

/// Sum over bodies that are held.
template <int Dim>
double Model<Dim>::held(double LateStart::*what) const
{
  double sum = 0.0;
  for (const LateStart& start : late_starts_)
    sum += now_.bodies[start.body].held ? start.*what : 0.0;
  return sum;
}

/// Lets go of bodies whose time has come. Their kinetic energy counts as work done from outside.
template <int Dim>
void Model<Dim>::start_bodies(double time_s)
{
  const auto let_go = [this](const mpm::Particles<Dim>& start, mpm::Particles<Dim>& particles) {
    // Velocities live at mid-steps: the first kick is half of the last step too long.
    const Vec<Dim> early = 0.5 * now_.last_dt * now_.gravity;
    double kinetic = 0.0;
    particles.affine = start.affine;
    for (std::size_t p = 0; p < particles.size(); ++p) {
      Vec<Dim> v = start.velocity_of(p);
      now_.ledger.work_in += 0.5 * particles.mass[p] * v.squaredNorm();
      v -= particles.weight_mass[p] / particles.mass[p] * early;
      kinetic += 0.5 * particles.mass[p] * v.squaredNorm();
      for (std::size_t d = 0; d < Dim; ++d)
        particles.velocity[d][p] = v[static_cast<Eigen::Index>(d)];
    }
    now_.kinetic += kinetic;
  };
  bool any = false;
  for (const LateStart& start : late_starts_) {
    Body& body = now_.bodies[start.body];
    if (!body.held || time_s < start.at_s - same_instant_s)
      continue;
    any = true;
    body.held = false;
    let_go(start.body_start, body.particles);
    if (start.sheet) {
      now_.sheets[*start.sheet].held = false;
      let_go(start.sheet_start, now_.sheets[*start.sheet].sheet.nodes());
    }
  }
  if (!any)
    return;
  now_.sorted = false;
  now_.bound_known = false;
  survey();
}

template class Model<2>;
template class Model<3>;

}  // namespace geocontainer_mpm::scene
