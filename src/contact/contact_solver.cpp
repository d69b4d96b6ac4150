#include "geocontainer_mpm/contact/contact_solver.h"

#include <algorithm>
#include <cmath>

#include "geocontainer_mpm/mpm/bspline.h"

namespace geocontainer_mpm::contact {
namespace {

constexpr int mass_slot = mpm::Grid<2>::mass_slot;

/// Points further from the surface than this are not looked at, cells: no step moves a point as far.
constexpr double search_cells = 0.5;
/// Penetration (curved walls, round-off) is worked off at this part a step, and no faster than `fastest_recovery`.
constexpr double recovery_per_step = 0.02;
constexpr double fastest_recovery = 0.05;  // m/s
/// Gauss-Seidel ends when no point's velocity changes by more than this in a sweep, or after so many sweeps.
constexpr double velocity_tolerance = 1e-6;  // m/s
constexpr int most_sweeps = 30;
/// Coulomb coefficient of a contact that is held.
constexpr double holding_friction = 1e6;

/// Corners of the window in space: contact needs material, and material is inside.
bool is_near(const BoundaryBody& body, const mpm::Grid<2>& grid)
{
  const mpm::Window<2>& window = grid.window();
  const Vec2 lower = grid.coordinate(window.begin), upper = grid.coordinate(window.end);
  for (std::size_t p = 0; p < body.size(); ++p) {
    const Vec2 x = body.position(p);
    if ((x.array() >= lower.array()).all() && (x.array() <= upper.array()).all())
      return true;
  }
  return false;
}

}  // namespace

void ContactSolver::add_contact(const Vec2& point, const Nearest& surface, double gap, double dt,
                                const mpm::Grid<2>& grid, Contact& contact) const
{
  const mpm::Stencil<2> s = mpm::make_stencil<2>({ point[0], point[1] }, grid.origin(), grid.dx(), grid.inverse_dx());
  contact.compliance = 0.0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const auto k = static_cast<std::size_t>(3 * i + j);
      contact.node[k] = static_cast<std::uint32_t>(grid.index({ s.base[0] + i, s.base[1] + j }));
      const double mass = grid.nodes()[contact.node[k]][mass_slot];
      contact.weight[k] =
          mass > 0.0 ? s.weight[0][static_cast<std::size_t>(i)] * s.weight[1][static_cast<std::size_t>(j)] : 0.0;
      if (mass > 0.0)
        contact.compliance += contact.weight[k] * contact.weight[k] / mass;
    }
  contact.normal = surface.normal;
  contact.approach = gap >= 0.0 ? -gap / dt : std::min(-gap * recovery_per_step / dt, fastest_recovery);
}

void ContactSolver::collect(std::uint32_t index, const BoundaryBody& body, const ContactPoints& points,
                            std::size_t memory, double dt, const mpm::Grid<2>& grid)
{
  const mpm::Particles<2>& particles = *points.particles;
  const double reach = search_cells * grid.dx();
  for (std::size_t p = 0; p < particles.size(); ++p) {
    const double width = points.has_width ? 0.5 * std::sqrt(particles.initial_volume[p]) : 0.0;
    const Vec2 point(particles.position[0][p], particles.position[1][p]);
    if (!body.may_touch(point, reach + width))
      continue;
    const Nearest surface = body.nearest(point);
    const double gap = surface.distance - width;
    if (!(gap < reach))
      continue;
    Contact contact;
    add_contact(point, surface, gap, dt, grid, contact);
    contact.body = index;
    contact.friction = held_ ? holding_friction : body.friction();
    contact.velocity = body.velocity_at(point);
    contact.memory = memory + particles.id[p];
    contact.pressed = memory_[contact.memory][0];
    contact.dragged = memory_[contact.memory][1];
    contacts_.push_back(contact);
  }
}

void ContactSolver::push(const Contact& contact, const Vec2& impulse, mpm::Grid<2>& grid) const
{
  const mpm::Grid<2>::Node both{ impulse[0], impulse[1], 0.0, 0.0 };
  for (std::size_t k = 0; k < 9; ++k)
    if (contact.weight[k] > 0.0) {
      auto& node = grid.nodes()[contact.node[k]];
      node += contact.weight[k] / node[mass_slot] * both;
    }
}

/// Makes one contact right given all others. Returns the change of the point's velocity, m/s.
double ContactSolver::relax(Contact& contact, mpm::Grid<2>& grid) const
{
  mpm::Grid<2>::Node sum = mpm::Grid<2>::Node::Zero();
  for (std::size_t k = 0; k < 9; ++k)
    sum += contact.weight[k] * grid.nodes()[contact.node[k]];
  const Vec2 slip = Vec2(sum[0], sum[1]) - contact.velocity;
  const Vec2 tangent = left_normal(contact.normal);
  const double pressed =
      std::max(0.0, contact.pressed + (contact.approach - slip.dot(contact.normal)) / contact.compliance);
  const double limit = contact.friction * pressed;
  const double dragged = std::clamp(contact.dragged - slip.dot(tangent) / contact.compliance, -limit, limit);
  const Vec2 impulse = (pressed - contact.pressed) * contact.normal + (dragged - contact.dragged) * tangent;
  contact.pressed = pressed;
  contact.dragged = dragged;
  if (impulse[0] == 0.0 && impulse[1] == 0.0)
    return 0.0;
  push(contact, impulse, grid);
  return impulse.lpNorm<Eigen::Infinity>() * contact.compliance;
}

ContactSums ContactSolver::solve(const std::vector<BoundaryBody>& bodies, const std::vector<ContactPoints>& points,
                                 double kick, double dt, mpm::Grid<2>& grid, std::vector<BoundaryImpulse>& boundary)
{
  ContactSums sums;
  boundary.assign(bodies.size(), {});
  contacts_.clear();
  std::size_t pairs = 0;
  for (const ContactPoints& set : points)
    pairs += set.particles->size() * bodies.size();
  memory_.resize(pairs);
  std::size_t memory = 0;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const bool near = is_near(bodies[b], grid);
    sums.skipped += near ? 0 : 1;
    for (const ContactPoints& set : points) {
      if (near)
        collect(static_cast<std::uint32_t>(b), bodies[b], set, memory, dt, grid);
      memory += set.particles->size();
    }
  }

  touched_.clear();
  for (const Contact& contact : contacts_)
    touched_.insert(touched_.end(), contact.node.begin(), contact.node.end());
  std::sort(touched_.begin(), touched_.end());
  touched_.erase(std::unique(touched_.begin(), touched_.end()), touched_.end());
  untouched_velocity_.clear();
  for (const std::uint32_t node : touched_)
    untouched_velocity_.emplace_back(grid.nodes()[node][0], grid.nodes()[node][1]);

  for (const Contact& c : contacts_)
    push(c, c.pressed * c.normal + c.dragged * left_normal(c.normal), grid);
  double change = contacts_.empty() ? 0.0 : 1.0;
  for (int sweep = 0; sweep < most_sweeps && change > velocity_tolerance; ++sweep) {
    // There and back in turn, so that neither end of the surface is favoured.
    change = 0.0;
    for (std::size_t k = 0; k < contacts_.size(); ++k)
      change = std::max(change, relax(contacts_[sweep % 2 == 0 ? k : contacts_.size() - 1 - k], grid));
  }

  next_memory_.assign(pairs, { 0.0, 0.0 });
  for (const Contact& c : contacts_) {
    next_memory_[c.memory] = { c.pressed, c.dragged };
    const Vec2 impulse = c.pressed * c.normal + c.dragged * left_normal(c.normal);
    boundary[c.body].impulse += impulse;
    boundary[c.body].work += impulse.dot(c.velocity);
    sums.impulse += impulse;
  }
  memory_.swap(next_memory_);

  // Energy node by node. Forces and contact act in the same instant, so that the impulse works on the mean of the
  // velocity before both and after both: a load that is only passed on to the wall dissipates nothing.
  for (std::size_t k = 0; k < touched_.size(); ++k) {
    const auto& node = grid.nodes()[touched_[k]];
    const double mass = node[mass_slot];
    if (!(mass > 0.0))
      continue;
    const auto& force = grid.forces()[touched_[k]];
    const Vec2 after(node[0], node[1]);
    const Vec2 impulse = mass * (after - untouched_velocity_[k]);
    const Vec2 before = untouched_velocity_[k] - kick / mass * Vec2(force[0], force[1]);
    sums.kinetic_change += 0.5 * impulse.dot(after + untouched_velocity_[k]);
    sums.dissipated -= 0.5 * impulse.dot(after + before);
  }
  for (const BoundaryImpulse& b : boundary)
    sums.dissipated += b.work;
  return sums;
}

}  // namespace geocontainer_mpm::contact
