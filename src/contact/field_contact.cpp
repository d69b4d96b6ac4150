#include "geocontainer_mpm/contact/field_contact.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "approach.h"
#include "geocontainer_mpm/mpm/reach.h"
#include "hull_distance.h"

namespace geocontainer_mpm::contact {
namespace {

constexpr int mass_slot = mpm::Grid<2>::mass_slot;
constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
/// Furthest that a particle is from a node that it reaches, cells, in each direction.
constexpr double reach_cells = 1.5;
/// Clouds whose centres are nearer than this have no direction between them worth the name, cells.
constexpr double least_apart_cells = 0.02;

/// Way along `normal` from the surface of one cloud to that of the other, m.
double gap_along(const std::vector<Vec2>& from, const std::vector<double>& from_width, const std::vector<Vec2>& to,
                 const std::vector<double>& to_width, const Vec2& normal)
{
  double top = -std::numeric_limits<double>::infinity(), bottom = -top;
  for (std::size_t i = 0; i < from.size(); ++i)
    top = std::max(top, from[i].dot(normal) + from_width[i]);
  for (std::size_t i = 0; i < to.size(); ++i)
    bottom = std::min(bottom, to[i].dot(normal) - to_width[i]);
  return bottom - top;
}

}  // namespace

void FieldContact::find_nodes(const mpm::Grid<2>& a, const mpm::Grid<2>& b)
{
  nodes_.clear();
  number_.resize(a.size(), none);
  lower_ = Vec2::Constant(std::numeric_limits<double>::infinity());
  upper_ = -lower_;
  mpm::Window<2> both;
  for (std::size_t d = 0; d < 2; ++d) {
    both.begin[d] = std::max(a.window().begin[d], b.window().begin[d]);
    both.end[d] = std::min(a.window().end[d], b.window().end[d]);
  }
  std::array<int, 2> at;
  for (at[0] = both.begin[0]; at[0] < both.end[0]; ++at[0])
    for (at[1] = both.begin[1]; at[1] < both.end[1]; ++at[1]) {
      const std::size_t index = a.index(at);
      if (!(a.nodes()[index][mass_slot] > 0.0 && b.nodes()[index][mass_slot] > 0.0))
        continue;
      number_[index] = static_cast<std::uint32_t>(nodes_.size());
      Node node;
      node.index = index;
      node.position = a.coordinate(at);
      node.first = { none, none };
      nodes_.push_back(node);
      lower_ = lower_.cwiseMin(node.position);
      upper_ = upper_.cwiseMax(node.position);
    }
  lower_ -= Vec2::Constant(reach_cells * a.dx());
  upper_ += Vec2::Constant(reach_cells * a.dx());
}

template <class Reach>
void FieldContact::add(std::size_t side, const ContactPoints<2>& set, std::size_t p, const Vec2& x, const Reach& reach)
{
  const double volume = set.particles->initial_volume[p];
  const double half_width = set.has_width ? 0.5 * std::sqrt(volume) : 0.0;
  for (std::size_t k = 0; k < static_cast<std::size_t>(reach.count); ++k) {
    const std::uint32_t number = number_[reach.node[k]];
    if (number == none || !(reach.weight[k] > 0.0))
      continue;
    Node& node = nodes_[number];
    const Vec2 from_node = x - node.position;
    node.volume_gradient += (side == 0 ? -volume : volume) * reach.gradient[k];
    node.middle[side] += reach.weight[k] * from_node;
    node.weight[side] += reach.weight[k];
    entries_.push_back({ from_node, half_width, node.first[side] });
    node.first[side] = static_cast<std::uint32_t>(entries_.size() - 1);
  }
}

void FieldContact::gather(std::size_t side, const ContactField& field)
{
  for (const ContactPoints<2>& set : *field.points) {
    const mpm::Particles<2>& particles = *set.particles;
    for (std::size_t p = 0; p < particles.size(); ++p) {
      const Vec2 x(particles.position[0][p], particles.position[1][p]);
      if ((x.array() < lower_.array()).any() || (x.array() > upper_.array()).any())
        continue;
      mpm::visit_reach_of<2>(shape_, particles, p, *field.grid,
                             [&](const auto& reach) { add(side, set, p, x, reach); });
    }
  }
}

void FieldContact::fill_cloud(std::uint32_t first, Cloud& cloud) const
{
  cloud.position.clear();
  cloud.half_width.clear();
  for (std::uint32_t e = first; e != none; e = entries_[e].next) {
    cloud.position.push_back(entries_[e].position);
    cloud.half_width.push_back(entries_[e].half_width);
  }
}

/// Gap and normal, from a to b, of a node. `reach`: a gap as wide as this along any direction is open, m.
Nearest<2> FieldContact::separation(const Node& node, double reach, double tiny)
{
  for (std::size_t side = 0; side < 2; ++side)
    fill_cloud(node.first[side], cloud_[side]);
  const Cloud &a = cloud_[0], &b = cloud_[1];
  if (a.position.empty() || b.position.empty())
    return { std::numeric_limits<double>::infinity(), Vec2::Zero() };
  const auto gap = [&](const Vec2& normal) {
    return gap_along(a.position, a.half_width, b.position, b.half_width, normal);
  };
  // Two sheets have no volume: then from the middle of one to the middle of the other.
  Vec2 guess = node.volume_gradient;
  if (!(guess.squaredNorm() > 0.0))
    guess = node.middle[1] / node.weight[1] - node.middle[0] / node.weight[0];
  if (!(guess.squaredNorm() > 0.0))
    return { std::numeric_limits<double>::infinity(), Vec2::Zero() };
  guess.normalize();
  const double guessed = gap(guess);
  if (guessed >= reach)
    return { guessed, guess };
  const Vec2 way = hull_distance(a.position, b.position, guess);
  const double apart = way.norm();
  if (apart < tiny)
    return { guessed, guess };
  const Vec2 normal = way / apart;
  return { gap(normal), normal };
}

ContactSums<2> FieldContact::solve(const ContactField& a, const ContactField& b, double friction, double kick,
                                   double dt)
{
  ContactSums<2> sums;
  find_nodes(*a.grid, *b.grid);
  if (nodes_.empty()) {
    sums.skipped = 1;
    return sums;
  }
  entries_.clear();
  gather(0, a);
  gather(1, b);
  const double tiny = least_apart_cells * a.grid->dx();
  for (const Node& node : nodes_) {
    number_[node.index] = none;
    auto &node_a = a.grid->nodes()[node.index], &node_b = b.grid->nodes()[node.index];
    const double mass_a = node_a[mass_slot], mass_b = node_b[mass_slot];
    const Vec2 before_a(node_a[0], node_a[1]), before_b(node_b[0], node_b[1]);
    const Vec2 slip = before_b - before_a;
    const Nearest<2> surface = separation(node, slip.norm() * dt, tiny);
    const double missing = least_velocity(surface.distance, dt) - slip.dot(surface.normal);
    if (!(missing > 0.0))
      continue;

    // Lumped masses: every node stands alone, and its impulses follow at once.
    const double mass = mass_a * mass_b / (mass_a + mass_b);
    const Vec2 tangent = left_normal(surface.normal);
    const double pressed = mass * missing;
    const double dragged = std::clamp(-mass * slip.dot(tangent), -friction * pressed, friction * pressed);
    const Vec2 impulse = pressed * surface.normal + dragged * tangent;
    const mpm::Grid<2>::Node both{ impulse[0], impulse[1], 0.0, 0.0 };
    node_a -= both / mass_a;
    node_b += both / mass_b;
    sums.impulse += impulse;

    // Forces and contact act in the same instant: see ContactSolver::solve.
    const Vec2 after = Vec2(node_b[0], node_b[1]) - Vec2(node_a[0], node_a[1]);
    const auto &force_a = a.grid->forces()[node.index], &force_b = b.grid->forces()[node.index];
    const Vec2 pulled = kick / mass_b * Vec2(force_b[0], force_b[1]) - kick / mass_a * Vec2(force_a[0], force_a[1]);
    sums.kinetic_change += 0.5 * impulse.dot(after + slip);
    sums.dissipated -= 0.5 * impulse.dot(after + slip - pulled);
  }
  return sums;
}

}  // namespace geocontainer_mpm::contact
