#include "geocontainer_mpm/contact/sheet_contact.h"

#include <algorithm>
#include <limits>

#include "approach.h"
#include "geocontainer_mpm/mpm/reach.h"
#include "impulse.h"
#include "mirror.h"

namespace geocontainer_mpm::contact {
namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
/// Points whose gap is wider than this are not looked at, nor those as far on the wrong side, cells: no step moves
/// anything by more than half of it.
constexpr double search_cells = 0.5;
/// A contact across which nothing may move is as stiff as this part of the softest direction allows.
constexpr double least_compliance = 1e-6;

}  // namespace

/// Adds what a place, with its images, has of the nodes around it.
template <int Dim>
void SheetContact<Dim>::gather(const Vec<Dim>& at, double share, const mpm::Grid<Dim>& grid)
{
  const mpm::AnyReach<Dim> reach = mpm::reach_of<Dim>(shape_, at, grid);
  const bool near = is_near_mirror(at, grid);
  near_mirror_ = near_mirror_ || near;
  for (std::size_t k = 0; k < static_cast<std::size_t>(reach.count); ++k) {
    std::uint32_t node = reach.node[k];
    Vec<Dim> weight = Vec<Dim>::Constant(share * reach.weight[k]);
    if (near) {
      const Image<Dim> image = image_of(node, grid);
      node = static_cast<std::uint32_t>(grid.index(image.node));
      weight = weight.cwiseProduct(image.sign);
    }
    std::uint32_t& slot = slot_[node];
    if (slot == none) {
      slot = static_cast<std::uint32_t>(gathered_.size());
      gathered_.push_back({ node, weight });
    } else {
      gathered_[slot].weight += weight;
    }
  }
}

/// Of what has been gathered, where there is mass.
template <int Dim>
typename SheetContact<Dim>::Handle SheetContact<Dim>::make_handle(const mpm::Grid<Dim>& grid, Compliance& compliance)
{
  compliance = { 0.0, Vec<Dim>::Zero(), near_mirror_ };
  const std::size_t begin = near_mirror_ ? mirrored_.size() : shares_.size();
  for (const Gathered& one : gathered_) {
    slot_[one.node] = none;
    const double mass = grid.nodes()[one.node][mpm::Grid<Dim>::mass_slot];
    if (!(mass > 0.0))
      continue;
    if (near_mirror_) {
      mirrored_.push_back({ one.node, one.weight, one.weight / mass });
      compliance.by_direction += one.weight.cwiseProduct(mirrored_.back().mobility);
    } else {
      shares_.push_back({ one.node, one.weight[0], one.weight[0] / mass });
      compliance.all += shares_.back().weight * shares_.back().mobility;
    }
  }
  if (near_mirror_)
    compliance.all = compliance.by_direction.maxCoeff();
  else
    compliance.by_direction.setConstant(compliance.all);
  const std::size_t end = near_mirror_ ? mirrored_.size() : shares_.size();
  const Handle handle{ static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end), near_mirror_ };
  gathered_.clear();
  near_mirror_ = false;
  return handle;
}

// Inlined by force, as are the impulses below: called, they cost a tenth of a release with slip.
template <int Dim>
[[gnu::always_inline]] inline Vec<Dim> SheetContact<Dim>::velocity(const Handle& handle,
                                                                   const mpm::Grid<Dim>& grid) const
{
  if (handle.mirrored) {
    Vec<Dim> sum = Vec<Dim>::Zero();
    for (std::uint32_t k = handle.begin; k < handle.end; ++k)
      sum += mirrored_[k].weight.cwiseProduct(grid.nodes()[mirrored_[k].node].matrix().template head<Dim>());
    return sum;
  }
  typename mpm::Grid<Dim>::Node sum = mpm::Grid<Dim>::Node::Zero();
  for (std::uint32_t k = handle.begin; k < handle.end; ++k)
    sum += shares_[k].weight * grid.nodes()[shares_[k].node];
  return sum.matrix().template head<Dim>();
}

template <int Dim>
[[gnu::always_inline]] inline void SheetContact<Dim>::push(const Handle& handle, const Vec<Dim>& impulse,
                                                           mpm::Grid<Dim>& grid) const
{
  if (handle.mirrored) {
    for (std::uint32_t k = handle.begin; k < handle.end; ++k)
      grid.nodes()[mirrored_[k].node].matrix().template head<Dim>() += mirrored_[k].mobility.cwiseProduct(impulse);
    return;
  }
  typename mpm::Grid<Dim>::Node both = mpm::Grid<Dim>::Node::Zero();
  both.matrix().template head<Dim>() = impulse;
  for (std::uint32_t k = handle.begin; k < handle.end; ++k)
    grid.nodes()[shares_[k].node] += shares_[k].mobility * both;
}

template <int Dim>
void SheetContact<Dim>::add(const Vec<Dim>& point, const SheetFoot<Dim>& foot, double gap, std::size_t id,
                            const mpm::Grid<Dim>& point_grid, const ClosedSheet<Dim>& sheet,
                            const mpm::Grid<Dim>& sheet_grid, double dt)
{
  Contact contact;
  Compliance of_point, of_sheet;
  gather(point, 1.0, point_grid);
  contact.point = make_handle(point_grid, of_point);
  for (std::size_t k = 0; k < Dim; ++k)
    gather(sheet.nodes->position_of(foot.node[k]), foot.share[k], sheet_grid);
  contact.sheet = make_handle(sheet_grid, of_sheet);
  contact.normal = foot.seen.normal;
  contact.compliance = contact.along = of_point.all + of_sheet.all;
  if (of_point.mirrored || of_sheet.mirrored)
    contact.along = std::max(least_compliance * contact.compliance,
                             (of_point.by_direction + of_sheet.by_direction).dot(contact.normal.cwiseAbs2()));
  contact.approach = least_velocity(gap, dt);
  contact.id = id;
  contact.load = memory_[id];
  if constexpr (Dim == 3)  // the sheet may have turned since
    contact.load.dragged = along_surface<Dim>(contact.load.dragged, contact.normal);
  contacts_.push_back(contact);
}

template <int Dim>
void SheetContact<Dim>::begin(const ContactPoints<Dim>& points, const mpm::Grid<Dim>& point_grid,
                              const ClosedSheet<Dim>& sheet, const mpm::Grid<Dim>& sheet_grid, double dt)
{
  const mpm::Particles<Dim>& particles = *points.particles;
  contacts_.clear();
  shares_.clear();
  mirrored_.clear();
  memory_.resize(particles.size());
  slot_.resize(sheet_grid.size(), none);
  const auto width_of = [&](std::size_t p) {
    return points.has_width ? half_width<Dim>(particles.initial_volume[p]) : 0.0;
  };
  const double search = search_cells * sheet_grid.dx();
  double widest = 0.0;
  for (std::size_t p = 0; p < particles.size(); ++p)
    widest = std::max(widest, width_of(p));
  surface_.lay_out(sheet, search + widest, sheet_grid);
  for (std::size_t p = 0; p < particles.size(); ++p) {
    const Vec<Dim> point = particles.position_of(p);
    const std::optional<SheetFoot<Dim>> foot = surface_.nearest(point, sheet_grid);
    if (!foot)
      continue;
    const double gap = foot->seen.distance - width_of(p);
    if (gap < search && foot->seen.distance > -search)
      add(point, *foot, gap, particles.id[p], point_grid, sheet, sheet_grid, dt);
  }
}

template <int Dim>
void SheetContact<Dim>::add_nodes(std::vector<std::uint32_t>& of_points, std::vector<std::uint32_t>& of_sheet)
{
  const auto take = [this](Handle Contact::*handle, std::vector<std::uint32_t>& nodes) {
    const std::size_t before = nodes.size();
    for (const Contact& contact : contacts_) {
      const Handle& one = contact.*handle;
      for (std::uint32_t k = one.begin; k < one.end; ++k) {
        const std::uint32_t node = one.mirrored ? mirrored_[k].node : shares_[k].node;
        if (slot_[node] == none)
          nodes.push_back(node);
        slot_[node] = 0;
      }
    }
    for (std::size_t k = before; k < nodes.size(); ++k)
      slot_[nodes[k]] = none;
  };
  take(&Contact::point, of_points);
  take(&Contact::sheet, of_sheet);
}

template <int Dim>
void SheetContact<Dim>::guess(mpm::Grid<Dim>& point_grid, mpm::Grid<Dim>& sheet_grid) const
{
  for (const Contact& c : contacts_) {
    if (c.load.pressed == 0.0)
      continue;
    const Vec<Dim> impulse = impulse_of<Dim>(c.load.pressed, c.load.dragged, c.normal);
    push(c.point, impulse, point_grid);
    push(c.sheet, -impulse, sheet_grid);
  }
}

/// Makes one contact right given all others. Returns the change of the relative velocity, m/s.
template <int Dim>
double SheetContact<Dim>::relax(Contact& contact, mpm::Grid<Dim>& point_grid, mpm::Grid<Dim>& sheet_grid) const
{
  const Vec<Dim> slip = velocity(contact.point, point_grid) - velocity(contact.sheet, sheet_grid);
  const Load before = contact.load;
  Load& load = contact.load;
  load.pressed = std::max(0.0, before.pressed + (contact.approach - slip.dot(contact.normal)) / contact.along);
  load.dragged = within<Dim>(before.dragged - along_surface<Dim>(slip, contact.normal) / contact.compliance,
                             (held_ ? holding_friction : friction_) * load.pressed);
  const Vec<Dim> impulse =
      impulse_of<Dim>(load.pressed - before.pressed, load.dragged - before.dragged, contact.normal);
  if ((impulse.array() == 0.0).all())
    return 0.0;
  push(contact.point, impulse, point_grid);
  push(contact.sheet, -impulse, sheet_grid);
  return impulse.template lpNorm<Eigen::Infinity>() * contact.compliance;
}

template <int Dim>
double SheetContact<Dim>::sweep(int number, mpm::Grid<Dim>& point_grid, mpm::Grid<Dim>& sheet_grid)
{
  double change = 0.0;
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const std::size_t k = number % 2 == 0 ? i : contacts_.size() - 1 - i;
    change = std::max(change, relax(contacts_[k], point_grid, sheet_grid));
  }
  return change;
}

template <int Dim>
void SheetContact<Dim>::end()
{
  std::fill(memory_.begin(), memory_.end(), Load{});
  for (const Contact& c : contacts_)
    memory_[c.id] = c.load;
}

template class SheetContact<2>;
template class SheetContact<3>;

}  // namespace geocontainer_mpm::contact
