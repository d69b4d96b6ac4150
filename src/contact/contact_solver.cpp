#include "geocontainer_mpm/contact/contact_solver.h"

#include <algorithm>
#include <cmath>

#include "approach.h"
#include "geocontainer_mpm/mpm/reach.h"

namespace geocontainer_mpm::contact {
namespace {

constexpr int mass_slot = mpm::Grid<2>::mass_slot;

/// Points further from the surface than this are not looked at, cells: no step moves a point as far.
constexpr double search_cells = 0.5;

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

template <class Handle>
Vec2 velocity_of(const Handle& handle, const mpm::Grid<2>& grid)
{
  mpm::Grid<2>::Node sum = mpm::Grid<2>::Node::Zero();
  for (std::size_t k = 0; k < handle.count; ++k)
    sum += handle.weight[k] * grid.nodes()[handle.node[k]];
  return { sum[0], sum[1] };
}

}  // namespace

template <class Reach>
ContactSolver::Handle ContactSolver::make_handle(const Reach& reach, const mpm::Grid<2>& grid)
{
  Handle handle;
  handle.count = static_cast<std::size_t>(reach.count);
  handle.compliance = 0.0;
  for (std::size_t k = 0; k < handle.count; ++k) {
    handle.node[k] = reach.node[k];
    const double mass = grid.nodes()[reach.node[k]][mass_slot];
    handle.weight[k] = mass > 0.0 ? reach.weight[k] : 0.0;
    if (mass > 0.0)
      handle.compliance += handle.weight[k] * handle.weight[k] / mass;
  }
  return handle;
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
    mpm::visit_reach_of<2>(shape_, particles, p, grid,
                           [&](const auto& near) { contact.handle = make_handle(near, grid); });
    contact.normal = surface.normal;
    contact.approach = least_velocity(gap, dt);
    contact.body = index;
    contact.friction = held_ ? holding_friction : body.friction();
    contact.velocity = body.velocity_at(point);
    contact.point = point;
    contact.memory = memory + particles.id[p];
    contact.pressed = memory_[contact.memory][0];
    contact.dragged = memory_[contact.memory][1];
    contacts_.push_back(contact);
  }
}

void ContactSolver::begin(const std::vector<BoundaryBody>& bodies, const std::vector<ContactPoints>& points,
                          const std::vector<Anchor>& anchors, double dt, const mpm::Grid<2>& grid, ContactSums& sums)
{
  contacts_.clear();
  touched_.clear();
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
  anchor_memory_.resize(anchors.size(), Vec2::Zero());
  holds_.clear();
  for (std::size_t a = 0; a < anchors.size(); ++a)
    holds_.push_back({ make_handle(mpm::reach_of<2>(shape_, anchors[a].point, grid), grid),
                       (anchors[a].target - anchors[a].point) / dt, anchor_memory_[a] });
}

void ContactSolver::remember_untouched(const mpm::Grid<2>& grid)
{
  const auto add = [this](const Handle& handle) {
    touched_.insert(touched_.end(), handle.node.begin(),
                    handle.node.begin() + static_cast<std::ptrdiff_t>(handle.count));
  };
  for (const Contact& contact : contacts_)
    add(contact.handle);
  for (const Hold& hold : holds_)
    add(hold.handle);
  std::sort(touched_.begin(), touched_.end());
  touched_.erase(std::unique(touched_.begin(), touched_.end()), touched_.end());
  untouched_velocity_.clear();
  for (const std::uint32_t node : touched_)
    untouched_velocity_.emplace_back(grid.nodes()[node][0], grid.nodes()[node][1]);
}

void ContactSolver::push(const Handle& handle, const Vec2& impulse, mpm::Grid<2>& grid) const
{
  const mpm::Grid<2>::Node both{ impulse[0], impulse[1], 0.0, 0.0 };
  for (std::size_t k = 0; k < handle.count; ++k)
    if (handle.weight[k] > 0.0) {
      auto& node = grid.nodes()[handle.node[k]];
      node += handle.weight[k] / node[mass_slot] * both;
    }
}

/// Makes one contact right given all others. Returns the change of the point's velocity, m/s.
double ContactSolver::relax(Contact& contact, mpm::Grid<2>& grid) const
{
  const Vec2 slip = velocity_of(contact.handle, grid) - contact.velocity;
  const Vec2 tangent = left_normal(contact.normal);
  const double compliance = contact.handle.compliance;
  const double pressed = std::max(0.0, contact.pressed + (contact.approach - slip.dot(contact.normal)) / compliance);
  const double limit = contact.friction * pressed;
  const double dragged = std::clamp(contact.dragged - slip.dot(tangent) / compliance, -limit, limit);
  const Vec2 impulse = (pressed - contact.pressed) * contact.normal + (dragged - contact.dragged) * tangent;
  contact.pressed = pressed;
  contact.dragged = dragged;
  if (impulse[0] == 0.0 && impulse[1] == 0.0)
    return 0.0;
  push(contact.handle, impulse, grid);
  return impulse.lpNorm<Eigen::Infinity>() * compliance;
}

/// The same for an anchor.
double ContactSolver::relax(Hold& hold, mpm::Grid<2>& grid) const
{
  const Vec2 missing = hold.velocity - velocity_of(hold.handle, grid);
  const Vec2 impulse = missing / hold.handle.compliance;
  hold.impulse += impulse;
  push(hold.handle, impulse, grid);
  return missing.lpNorm<Eigen::Infinity>();
}

void ContactSolver::also_touches(const std::vector<std::uint32_t>& nodes)
{
  touched_.insert(touched_.end(), nodes.begin(), nodes.end());
}

void ContactSolver::guess(mpm::Grid<2>& grid)
{
  remember_untouched(grid);
  for (const Contact& c : contacts_)
    push(c.handle, c.pressed * c.normal + c.dragged * left_normal(c.normal), grid);
  for (const Hold& hold : holds_)
    push(hold.handle, hold.impulse, grid);
}

double ContactSolver::sweep(int number, mpm::Grid<2>& grid)
{
  // There and back in turn, so that neither end of the surface is favoured.
  const std::size_t count = contacts_.size(), all = count + holds_.size();
  double change = 0.0;
  for (std::size_t i = 0; i < all; ++i) {
    const std::size_t k = number % 2 == 0 ? i : all - 1 - i;
    change = std::max(change, k < count ? relax(contacts_[k], grid) : relax(holds_[k - count], grid));
  }
  return change;
}

void ContactSolver::report(const std::vector<BoundaryBody>& bodies, ContactImpulses& impulses, ContactSums& sums)
{
  next_memory_.assign(memory_.size(), { 0.0, 0.0 });
  for (const Contact& c : contacts_) {
    next_memory_[c.memory] = { c.pressed, c.dragged };
    if (c.pressed == 0.0)
      continue;
    const Vec2 impulse = c.pressed * c.normal + c.dragged * left_normal(c.normal);
    const Vec2 arm = bodies[c.body].arm_at(c.point);
    BoundaryImpulse& boundary = impulses.boundary[c.body];
    boundary.impulse += impulse;
    boundary.moment += arm[0] * impulse[1] - arm[1] * impulse[0];
    boundary.work += impulse.dot(c.velocity);
    sums.impulse += impulse;
  }
  memory_.swap(next_memory_);
  for (std::size_t a = 0; a < holds_.size(); ++a) {
    anchor_memory_[a] = holds_[a].impulse;
    impulses.anchor[a] = { holds_[a].impulse, holds_[a].impulse.dot(holds_[a].velocity) };
    sums.impulse += holds_[a].impulse;
  }
}

ContactSums ContactSolver::solve(const std::vector<BoundaryBody>& bodies, const std::vector<ContactPoints>& points,
                                 const std::vector<Anchor>& anchors, double kick, double dt, mpm::Grid<2>& grid,
                                 ContactImpulses& impulses)
{
  ContactSums sums;
  begin(bodies, points, anchors, dt, grid, sums);
  guess(grid);
  double change = contacts_.empty() && holds_.empty() ? 0.0 : 1.0;
  for (int number = 0; number < most_sweeps && change > velocity_tolerance; ++number)
    change = sweep(number, grid);
  end(bodies, kick, grid, impulses, sums);
  return sums;
}

void ContactSolver::end(const std::vector<BoundaryBody>& bodies, double kick, const mpm::Grid<2>& grid,
                        ContactImpulses& impulses, ContactSums& sums)
{
  impulses.boundary.assign(bodies.size(), {});
  impulses.anchor.assign(holds_.size(), {});
  report(bodies, impulses, sums);

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
  for (const BoundaryImpulse& b : impulses.boundary)
    sums.dissipated += b.work;
  for (const AnchorImpulse& a : impulses.anchor)
    sums.dissipated += a.work;
}

}  // namespace geocontainer_mpm::contact
