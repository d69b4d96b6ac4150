#include "geocontainer_mpm/contact/contact_solver.h"

#include <algorithm>
#include <cmath>

#include "approach.h"
#include "impulse.h"
#include "mirror.h"

namespace geocontainer_mpm::contact {
namespace {

constexpr int mass_slot = mpm::Grid<2>::mass_slot;
static_assert(mpm::Grid<3>::mass_slot == mass_slot);

/// Points further from the surface than this are not looked at, cells: no step moves a point as far.
constexpr double search_cells = 0.5;

/// Corners of the window in space: contact needs material, and material is inside.
template <int Dim>
bool is_near(const BoundaryBody<Dim>& body, const mpm::Grid<Dim>& grid)
{
  const mpm::Window<Dim>& window = grid.window();
  const Vec<Dim> lower = grid.coordinate(window.begin), upper = grid.coordinate(window.end);
  for (std::size_t p = 0; p < body.size(); ++p) {
    const Vec<Dim> x = body.position(p);
    if ((x.array() >= lower.array()).all() && (x.array() <= upper.array()).all())
      return true;
  }
  return false;
}

template <int Dim>
Vec<Dim> vector_of(const typename mpm::Grid<Dim>::Node& node)
{
  return node.matrix().template head<Dim>();
}

}  // namespace

template <int Dim>
template <class Reach>
typename ContactSolver<Dim>::Handle ContactSolver<Dim>::make_handle(const Reach& reach, const Vec<Dim>& point,
                                                                    const mpm::Grid<Dim>& grid)
{
  Handle handle;
  handle.count = static_cast<std::size_t>(reach.count);
  handle.compliance = 0.0;
  for (std::size_t k = 0; k < handle.count; ++k) {
    handle.node[k] = reach.node[k];
    const double mass = grid.nodes()[reach.node[k]][mass_slot];
    handle.weight[k] = mass > 0.0 ? reach.weight[k] : 0.0;
    handle.mobility[k] = mass > 0.0 ? reach.weight[k] / mass : 0.0;
    if (mass > 0.0)
      handle.compliance += handle.weight[k] * handle.weight[k] / mass;
  }
  if (is_near_mirror(point, grid)) {
    std::copy(reach.weight.begin(), reach.weight.end(), handle.weight.begin());  // beyond a face there is no mass
    mirror(grid, handle);
  }
  return handle;
}

template <int Dim>
void ContactSolver<Dim>::mirror(const mpm::Grid<Dim>& grid, Handle& handle)
{
  Mirrored shares;
  std::size_t count = 0;
  for (std::size_t k = 0; k < handle.count; ++k) {
    const Image<Dim> image = image_of(handle.node[k], grid);
    const auto node = static_cast<std::uint32_t>(grid.index(image.node));
    std::size_t at = 0;
    while (at < count && handle.node[at] != node)
      ++at;
    if (at == count) {
      handle.node[count] = node;  // at most k: those before are done with
      shares.weight[count++] = Vec<Dim>::Zero();
    }
    shares.weight[at] += handle.weight[k] * image.sign;
  }
  handle.count = count;
  shares.compliance = Vec<Dim>::Zero();
  for (std::size_t k = 0; k < count; ++k) {
    const double mass = grid.nodes()[handle.node[k]][mass_slot];
    if (!(mass > 0.0))
      shares.weight[k].setZero();
    shares.mobility[k] = mass > 0.0 ? Vec<Dim>(shares.weight[k] / mass) : shares.weight[k];
    shares.compliance += shares.weight[k].cwiseProduct(shares.mobility[k]);
  }
  handle.compliance = shares.compliance.maxCoeff();
  handle.mirrored = static_cast<int>(mirrored_.size());
  mirrored_.push_back(shares);
}

template <int Dim>
Vec<Dim> ContactSolver<Dim>::velocity_of(const Handle& handle, const mpm::Grid<Dim>& grid) const
{
  if (handle.mirrored != Handle::none) {
    const Mirrored& shares = mirrored_[static_cast<std::size_t>(handle.mirrored)];
    Vec<Dim> sum = Vec<Dim>::Zero();
    for (std::size_t k = 0; k < handle.count; ++k)
      sum += shares.weight[k].cwiseProduct(vector_of<Dim>(grid.nodes()[handle.node[k]]));
    return sum;
  }
  typename mpm::Grid<Dim>::Node sum = mpm::Grid<Dim>::Node::Zero();
  for (std::size_t k = 0; k < handle.count; ++k)
    sum += handle.weight[k] * grid.nodes()[handle.node[k]];
  return vector_of<Dim>(sum);
}

template <int Dim>
void ContactSolver<Dim>::collect(std::uint32_t index, const BoundaryBody<Dim>& body, const ContactPoints<Dim>& points,
                                 double widest, std::size_t memory, double dt, const mpm::Grid<Dim>& grid)
{
  const mpm::Particles<Dim>& particles = *points.particles;
  const double reach = search_cells * grid.dx(), look = points.strays ? stray_cells * grid.dx() : reach + widest;
  for (std::size_t p = 0; p < particles.size(); ++p) {
    if (points.strays && (*points.strays)[particles.id[p]] == 0)
      continue;
    const Vec<Dim> point = particles.position_of(p);
    if (!body.may_touch(point, look))
      continue;
    const Nearest<Dim> surface = body.nearest(point);
    double gap = surface.distance - (points.has_width ? half_width<Dim>(particles.initial_volume[p]) : 0.0);
    if (!(gap < reach))
      continue;
    if (points.strays)
      gap = std::max(gap, 0.0);
    Contact contact;
    mpm::visit_reach_of<Dim>(shape_, particles, p, grid,
                             [&](const auto& near) { contact.handle = make_handle(near, point, grid); });
    contact.normal = surface.normal;
    contact.approach = least_velocity(gap, dt);
    contact.body = index;
    contact.friction = held_ ? holding_friction : body.friction();
    contact.velocity = body.velocity_at(point);
    contact.point = point;
    contact.memory = memory + particles.id[p];
    contact.load = memory_[contact.memory];
    if constexpr (Dim == 3)  // the surface may have turned since
      contact.load.dragged = along_surface<Dim>(contact.load.dragged, contact.normal);
    contacts_.push_back(contact);
  }
}

template <int Dim>
void ContactSolver<Dim>::begin(const std::vector<BoundaryBody<Dim>>& bodies,
                               const std::vector<ContactPoints<Dim>>& points, const std::vector<Anchor<Dim>>& anchors,
                               double dt, const mpm::Grid<Dim>& grid, ContactSums<Dim>& sums)
{
  contacts_.clear();
  mirrored_.clear();
  others_.clear();
  widest_.clear();
  std::size_t pairs = 0;
  for (const ContactPoints<Dim>& set : points) {
    pairs += set.particles->size() * bodies.size();
    double most = 0.0;
    if (set.has_width)
      for (const double volume : set.particles->initial_volume)
        most = std::max(most, volume);
    widest_.push_back(half_width<Dim>(most));
  }
  if (memory_.size() != pairs) {
    memory_.assign(pairs, {});
    remembered_.clear();
  }
  std::size_t memory = 0;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const bool near = is_near(bodies[b], grid);
    sums.skipped += near ? 0 : 1;
    for (std::size_t s = 0; s < points.size(); ++s) {
      if (near)
        collect(static_cast<std::uint32_t>(b), bodies[b], points[s], widest_[s], memory, dt, grid);
      memory += points[s].particles->size();
    }
  }
  anchor_memory_.resize(anchors.size(), Vec<Dim>::Zero());
  holds_.clear();
  for (std::size_t a = 0; a < anchors.size(); ++a)
    holds_.push_back({ make_handle(mpm::reach_of<Dim>(shape_, anchors[a].point, grid), anchors[a].point, grid),
                       (anchors[a].target - anchors[a].point) / dt, anchor_memory_[a] });
}

template <int Dim>
void ContactSolver<Dim>::remember_untouched(const mpm::Grid<Dim>& grid)
{
  seen_.resize(grid.size(), 0);
  touched_.clear();
  const auto add = [this](const auto& nodes, std::size_t count) {
    for (std::size_t k = 0; k < count; ++k) {
      if (seen_[nodes[k]] == 0)
        touched_.push_back(nodes[k]);
      seen_[nodes[k]] = 1;
    }
  };
  add(others_, others_.size());
  for (const Contact& contact : contacts_)
    add(contact.handle.node, contact.handle.count);
  for (const Hold& hold : holds_)
    add(hold.handle.node, hold.handle.count);
  std::sort(touched_.begin(), touched_.end());
  untouched_velocity_.clear();
  for (const std::uint32_t node : touched_) {
    seen_[node] = 0;
    untouched_velocity_.push_back(vector_of<Dim>(grid.nodes()[node]));
  }
}

template <int Dim>
void ContactSolver<Dim>::push(const Handle& handle, const Vec<Dim>& impulse, mpm::Grid<Dim>& grid) const
{
  if (handle.mirrored != Handle::none) {
    const Mirrored& shares = mirrored_[static_cast<std::size_t>(handle.mirrored)];
    for (std::size_t k = 0; k < handle.count; ++k)
      grid.nodes()[handle.node[k]].matrix().template head<Dim>() += shares.mobility[k].cwiseProduct(impulse);
    return;
  }
  typename mpm::Grid<Dim>::Node both = mpm::Grid<Dim>::Node::Zero();
  both.matrix().template head<Dim>() = impulse;
  for (std::size_t k = 0; k < handle.count; ++k)
    grid.nodes()[handle.node[k]] += handle.mobility[k] * both;
}

/// Normal velocity per normal impulse. Friction takes the largest of all directions: never too much of it at once.
template <int Dim>
double ContactSolver<Dim>::compliance_along(const Contact& contact) const
{
  if (contact.handle.mirrored == Handle::none)
    return contact.handle.compliance;
  const Vec<Dim>& by_direction = mirrored_[static_cast<std::size_t>(contact.handle.mirrored)].compliance;
  return std::max(1e-6 * contact.handle.compliance, by_direction.dot(contact.normal.cwiseAbs2()));
}

/// Makes one contact right given all others. Returns the change of the point's velocity, m/s.
template <int Dim>
double ContactSolver<Dim>::relax(Contact& contact, mpm::Grid<Dim>& grid) const
{
  const Vec<Dim> slip = velocity_of(contact.handle, grid) - contact.velocity;
  const double compliance = contact.handle.compliance, along_normal = compliance_along(contact);
  const Load before = contact.load;
  Load& load = contact.load;
  load.pressed = std::max(0.0, before.pressed + (contact.approach - slip.dot(contact.normal)) / along_normal);
  load.dragged = within<Dim>(before.dragged - along_surface<Dim>(slip, contact.normal) / compliance,
                             contact.friction * load.pressed);
  const Vec<Dim> impulse =
      impulse_of<Dim>(load.pressed - before.pressed, load.dragged - before.dragged, contact.normal);
  if ((impulse.array() == 0.0).all())
    return 0.0;
  push(contact.handle, impulse, grid);
  return impulse.template lpNorm<Eigen::Infinity>() * compliance;
}

/// The same for an anchor.
template <int Dim>
double ContactSolver<Dim>::relax(Hold& hold, mpm::Grid<Dim>& grid) const
{
  const Vec<Dim> missing = hold.velocity - velocity_of(hold.handle, grid);
  const Vec<Dim> impulse = missing / hold.handle.compliance;
  hold.impulse += impulse;
  push(hold.handle, impulse, grid);
  return missing.template lpNorm<Eigen::Infinity>();
}

template <int Dim>
void ContactSolver<Dim>::also_touches(const std::vector<std::uint32_t>& nodes)
{
  others_.insert(others_.end(), nodes.begin(), nodes.end());
}

template <int Dim>
void ContactSolver<Dim>::guess(mpm::Grid<Dim>& grid)
{
  remember_untouched(grid);
  for (const Contact& c : contacts_)
    if (c.load.pressed > 0.0)
      push(c.handle, impulse_of<Dim>(c.load.pressed, c.load.dragged, c.normal), grid);
  for (const Hold& hold : holds_)
    push(hold.handle, hold.impulse, grid);
}

template <int Dim>
double ContactSolver<Dim>::sweep(int number, mpm::Grid<Dim>& grid)
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

template <int Dim>
void ContactSolver<Dim>::report(const std::vector<BoundaryBody<Dim>>& bodies, ContactImpulses<Dim>& impulses,
                                ContactSums<Dim>& sums)
{
  for (const std::size_t pair : remembered_)
    memory_[pair] = {};
  remembered_.clear();
  for (const Contact& c : contacts_) {
    if (c.load.pressed == 0.0)
      continue;
    memory_[c.memory] = c.load;
    remembered_.push_back(c.memory);
    const Vec<Dim> impulse = impulse_of<Dim>(c.load.pressed, c.load.dragged, c.normal);
    const Vec2 arm = bodies[c.body].arm_at(c.point), across = in_section(impulse);
    BoundaryImpulse<Dim>& boundary = impulses.boundary[c.body];
    boundary.impulse += impulse;
    boundary.moment += arm[0] * across[1] - arm[1] * across[0];
    boundary.work += impulse.dot(c.velocity);
    sums.impulse += impulse;
  }
  for (std::size_t a = 0; a < holds_.size(); ++a) {
    anchor_memory_[a] = holds_[a].impulse;
    impulses.anchor[a] = { holds_[a].impulse, holds_[a].impulse.dot(holds_[a].velocity) };
    sums.impulse += holds_[a].impulse;
  }
}

template <int Dim>
ContactSums<Dim> ContactSolver<Dim>::solve(const std::vector<BoundaryBody<Dim>>& bodies,
                                           const std::vector<ContactPoints<Dim>>& points,
                                           const std::vector<Anchor<Dim>>& anchors, double kick, double dt,
                                           mpm::Grid<Dim>& grid, ContactImpulses<Dim>& impulses)
{
  ContactSums<Dim> sums;
  begin(bodies, points, anchors, dt, grid, sums);
  guess(grid);
  double change = contacts_.empty() && holds_.empty() ? 0.0 : 1.0;
  for (int number = 0; number < most_sweeps && change > velocity_tolerance; ++number)
    change = sweep(number, grid);
  end(bodies, kick, grid, impulses, sums);
  return sums;
}

template <int Dim>
void ContactSolver<Dim>::end(const std::vector<BoundaryBody<Dim>>& bodies, double kick, const mpm::Grid<Dim>& grid,
                             ContactImpulses<Dim>& impulses, ContactSums<Dim>& sums)
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
    const Vec<Dim> force = grid.forces()[touched_[k]].matrix().template head<Dim>();
    const Vec<Dim> after = vector_of<Dim>(node);
    const Vec<Dim> impulse = mass * (after - untouched_velocity_[k]);
    const Vec<Dim> before = untouched_velocity_[k] - kick / mass * force;
    sums.kinetic_change += 0.5 * impulse.dot(after + untouched_velocity_[k]);
    sums.dissipated -= 0.5 * impulse.dot(after + before);
  }
  for (const BoundaryImpulse<Dim>& b : impulses.boundary)
    sums.dissipated += b.work;
  for (const AnchorImpulse<Dim>& a : impulses.anchor)
    sums.dissipated += a.work;
}

template class ContactSolver<2>;
template class ContactSolver<3>;

}  // namespace geocontainer_mpm::contact
