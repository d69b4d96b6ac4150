/// A look at every particle after a step: where, how fast, whether all is well, and how long the next step may be.

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "../contact/impulse.h"
#include "geocontainer_mpm/scene/model.h"

namespace geocontainer_mpm::scene {
namespace {

/// The stability bound is assembled anew when particles have moved by this many cells, or after so many steps; for
/// linear simplices, whose nodes may be of any smallness, in every step (frequency_bound.h).
constexpr double bound_valid_cells = 0.1;
constexpr int bound_valid_steps = 50;

/// So far outside the grid a particle is still in it, cells: nodes of a sheet lie in planes of symmetry, but for
/// round-off.
constexpr double edge_cells = 1e-6;

/// By how much a consistent mass matrix raises the largest squared frequency and damping rate: its smallest eigenvalue
/// relative to the lumped one is at worst the lumped part of it.
template <int Dim>
double stiffening(const mpm::Discretisation& method)
{
  return method.mass == mpm::MassMatrix::consistent ? 1.0 / mpm::ConsistentMass<Dim>::lumped_part : 1.0;
}

/// A particle with less of its volume at the start than this is no soil and no slurry any more.
constexpr double least_volume = 0.05;

/// The same of a body as a whole, and the other way: sand that flies apart takes up more.
constexpr double least_body_volume = 0.35, most_body_volume = 15.0;

template <int Dim>
bool squeezed(const mpm::Particles<Dim>& particles, std::size_t p)
{
  return !(particles.volume[p] > least_volume * particles.initial_volume[p]);
}

template <int Dim>
struct Look {
  Vec<Dim> lower = Vec<Dim>::Constant(std::numeric_limits<double>::infinity()), upper = -lower;
  double fastest_square = 0.0;
  bool sound = true;  ///< all finite, with volume, inside the grid
};

template <int Dim>
Look<Dim> look_at(const mpm::Particles<Dim>& particles, bool has_volume, const Vec<Dim>& grid_lower,
                  const Vec<Dim>& grid_upper)
{
  Look<Dim> look;
  double doubt = 0.0;  // stays zero, unless something is not finite: then NaN
  for (std::size_t p = 0; p < particles.size(); ++p) {
    const Vec<Dim> x = particles.position_of(p);
    look.lower = look.lower.cwiseMin(x);
    look.upper = look.upper.cwiseMax(x);
    const double square = particles.velocity_of(p).squaredNorm();
    look.fastest_square = std::max(look.fastest_square, square);
    doubt += 0.0 * (x.sum() + square);
  }
  if (has_volume)
    for (std::size_t p = 0; p < particles.size(); ++p)
      doubt += squeezed(particles, p) ? std::numeric_limits<double>::quiet_NaN() : 0.0 * particles.volume[p];
  const bool outside =
      (look.lower.array() < grid_lower.array()).any() || (look.upper.array() > grid_upper.array()).any();
  look.sound = doubt == 0.0 && !outside;
  return look;
}

/// The first particle that is not well.
template <int Dim>
Failure find_culprit(const std::string& name, const mpm::Particles<Dim>& particles, bool has_volume,
                     const Vec<Dim>& grid_lower, const Vec<Dim>& grid_upper)
{
  for (std::size_t p = 0; p < particles.size(); ++p) {
    const Vec<Dim> x = particles.position_of(p), v = particles.velocity_of(p);
    const char* cause = !x.allFinite() || !v.allFinite()       ? "is not finite any more"
                        : has_volume && squeezed(particles, p) ? "has lost its volume"
                        : (x.array() < grid_lower.array()).any() || (x.array() > grid_upper.array()).any()
                            ? "left the grid"
                            : nullptr;
    if (cause)
      return { fmt::format("particle {} of {} {}", particles.id[p], name, cause),
               x.allFinite() ? in_barge_frame(x) : Vec3(Vec3::Zero()), 0.0 };
  }
  return {};
}

}  // namespace

template <int Dim>
void Model<Dim>::survey()
{
  double fastest_square = 0.0;
  for (Field& field : fields_) {
    field.extent_lower = Vec<Dim>::Constant(std::numeric_limits<double>::infinity());
    field.extent_upper = -field.extent_lower;
  }
  const double edge = edge_cells * fields_.front().grid.dx();
  const Vec<Dim> lower = lower_.array() - edge, upper = upper_.array() + edge;
  const auto take = [&](const std::string& name, std::size_t f, const mpm::Particles<Dim>& particles, bool has_volume) {
    const Look<Dim> look = look_at<Dim>(particles, has_volume, lower, upper);
    fields_[f].extent_lower = fields_[f].extent_lower.cwiseMin(look.lower);
    fields_[f].extent_upper = fields_[f].extent_upper.cwiseMax(look.upper);
    fastest_square = std::max(fastest_square, look.fastest_square);
    if (look.sound || !now_.health.ok)
      return;
    now_.health.ok = false;
    now_.health.failure = find_culprit(name, particles, has_volume, lower, upper);
  };
  for (const Body& body : now_.bodies)
    take(body.name, body.field, body.particles, true);
  now_.fastest_of_bodies = std::sqrt(fastest_square);
  for (const ModelSheet& sheet : now_.sheets)
    take(sheet.name, sheet.field, sheet.sheet.nodes(), false);
  now_.fastest = std::sqrt(fastest_square);
}

/// Nothing has moved far or tightened since the bound was assembled. With linear shapes the mass of a node can all but
/// vanish within a step, and the frequencies there grow with it.
template <int Dim>
bool Model<Dim>::bound_holds() const
{
  const bool lasts = method_.shape != mpm::Shape::linear_simplex || mpm::feels_what_particles_hold(method_);
  return lasts && now_.bound_known && now_.steps_since_bound < bound_valid_steps &&
         now_.travel_since_bound <= bound_valid_cells * fields_.front().grid.dx() &&
         active_segments() <= now_.bound_active_segments;
}

template <int Dim>
std::size_t Model<Dim>::active_segments() const
{
  std::size_t active = 0;
  for (const ModelSheet& sheet : now_.sheets)
    active += sheet.held ? 0 : sheet.sheet.active_pieces();
  return active;
}

/// The largest frequency and damping rate that the state of one field allows.
template <int Dim>
void Model<Dim>::assemble_bound(std::size_t f)
{
  Field& field = fields_[f];
  field.bound.begin(field.grid, method_);
  for (Body& body : now_.bodies) {
    if (body.field != f || body.held)
      continue;
    // The law bounds its acoustic tensor; the ratio of its moduli is taken to stay.
    const material::Stiffness now = body.law->stiffness(body.particles.batch(), 0, body.particles.size());
    const double growth = now.constrained_modulus / body.elastic.constrained();
    const double viscous = body.viscous.constrained() > 0.0 ? now.viscosity / body.viscous.constrained() : 0.0;
    field.bound.add_body(body.particles, { growth * body.elastic.lame, growth * body.elastic.shear },
                         { viscous * body.viscous.lame, viscous * body.viscous.shear });
  }
  for (std::size_t s = 0; s < now_.sheets.size(); ++s) {
    const SheetOf<Dim>& sheet = now_.sheets[s].sheet;
    if (now_.sheets[s].field != f || now_.sheets[s].held)
      continue;
    field.bound.add_mass(sheet.nodes());
    sheet.add_stiffness(field.bound);
  }
}

/// How long the next step may be: what the scheme can bear, and no particle further than is allowed.
template <int Dim>
void Model<Dim>::bound_time_step()
{
  if (!bound_holds()) {
    now_.bound_dt = std::numeric_limits<double>::infinity();
    for (std::size_t f = 0; f < fields_.size(); ++f) {
      assemble_bound(f);
      const typename mpm::FrequencyBound<Dim>::Result bound = fields_[f].bound.bound();
      const double stiffer = stiffening<Dim>(method_);
      now_.bound_dt = std::min(
          now_.bound_dt, mpm::stable_step(stiffer * bound.frequency_square, stiffer * bound.damping_rate, method_));
    }
    now_.bound_known = true;
    now_.steps_since_bound = 0;
    now_.travel_since_bound = 0.0;
    now_.bound_active_segments = active_segments();
  }
  stable_dt_ = std::min(max_step_, time_step_factor_ * now_.bound_dt);
  if (now_.fastest > 0.0)
    stable_dt_ = std::min(stable_dt_, max_travel_ / now_.fastest);
}

template <int Dim>
Failure Model<Dim>::fastest(bool sheets_too) const
{
  Failure failure;
  double fastest = -1.0;
  const auto look = [&](const std::string& name, const mpm::Particles<Dim>& particles) {
    for (std::size_t p = 0; p < particles.size(); ++p) {
      const double speed = particles.velocity_of(p).norm();
      if (!(speed > fastest))
        continue;
      fastest = speed;
      failure.position_m = in_barge_frame(particles.position_of(p));
      failure.reason = fmt::format("particle {} of {} is fastest, at {:.3g} m/s", particles.id[p], name, speed);
    }
  };
  for (const Body& body : now_.bodies)
    look(body.name, body.particles);
  if (sheets_too)
    for (const ModelSheet& sheet : now_.sheets)
      look(sheet.name, sheet.sheet.nodes());
  return failure;
}

/// What has lost its shape so far that its law and its loads mean nothing any more.
template <int Dim>
void Model<Dim>::find_strays()
{
  const double look = contact::stray_cells * fields_.front().grid.dx();
  const auto behind = [&](const Vec<Dim>& point, double half_width) {
    return std::any_of(boundaries_.begin(), boundaries_.end(), [&](const contact::BoundaryBody<Dim>& boundary) {
      return boundary.may_touch(point, look) && boundary.nearest(point).distance < -half_width;
    });
  };
  for (Body& body : now_.bodies) {
    if (!body.enclosed || body.held)
      continue;
    body.strays.clear();
    for (std::size_t p = 0; p < body.particles.size(); ++p) {
      if (!behind(body.position(p), contact::half_width<Dim>(body.particles.initial_volume[p])))
        continue;
      body.strays.resize(body.particles.size(), 0);
      body.strays[body.particles.id[p]] = 1;
    }
  }
}

template <int Dim>
Failure Model<Dim>::distortion() const
{
  for (const Body& body : now_.bodies) {
    double volume = 0.0, start = 0.0;
    std::size_t worst = 0;
    const auto ratio = [&](std::size_t p) { return body.particles.volume[p] / body.particles.initial_volume[p]; };
    for (std::size_t p = 0; p < body.particles.size(); ++p) {
      volume += body.particles.volume[p];
      start += body.particles.initial_volume[p];
      worst = std::abs(std::log(ratio(p))) > std::abs(std::log(ratio(worst))) ? p : worst;
    }
    if (volume < least_body_volume * start)
      return { fmt::format("{} is squeezed to {:.2g} of its volume: it is too soft for what is on it", body.name,
                           volume / start),
               in_barge_frame(body.position(worst)), 0.0 };
    if (volume > most_body_volume * start)
      return { fmt::format("{} has swollen to {:.3g} times its volume", body.name, volume / start),
               in_barge_frame(body.position(worst)), 0.0 };
  }
  for (std::size_t t = 0; t < now_.tractions.size(); ++t)
    if (const std::optional<std::uint32_t> owner = now_.tractions[t].torn()) {
      const Body& body = now_.bodies[traction_body_[t]];
      return { fmt::format("the boundary of {} is torn at particle {}, and a traction with it", body.name, *owner),
               in_barge_frame(body.position(body.row[*owner])), 0.0 };
    }
  return {};
}

template class Model<2>;
template class Model<3>;

}  // namespace geocontainer_mpm::scene
