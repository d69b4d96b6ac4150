#include "geocontainer_mpm/contact/sheet_contact.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "approach.h"
#include "geocontainer_mpm/mpm/reach.h"

namespace geocontainer_mpm::contact {
namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
/// Points whose gap is wider than this are not looked at, nor those as far on the wrong side, cells: no step moves
/// anything by more than half of it.
constexpr double search_cells = 0.5;
/// Segments shorter than this part of a cell have no direction worth the name; their neighbours stand in.
constexpr double least_segment = 1e-9;

std::array<int, 2> cell_of(const Vec2& x, const mpm::Grid<2>& grid)
{
  std::array<int, 2> cell;
  for (int d = 0; d < 2; ++d)
    cell[static_cast<std::size_t>(d)] =
        std::clamp(static_cast<int>(std::floor((x[d] - grid.origin()[d]) * grid.inverse_dx())), 0,
                   grid.counts()[static_cast<std::size_t>(d)] - 1);
  return cell;
}

Vec2 place(const mpm::Particles<2>& particles, std::size_t i)
{
  return { particles.position[0][i], particles.position[1][i] };
}

/// How often a closed sheet goes around a place, against the clock: crossings of a ray along +y (Sunday 2001).
int winding(const mpm::Particles<2>& nodes, const Vec2& around)
{
  int turns = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Vec2 a = place(nodes, i), b = place(nodes, i + 1 < nodes.size() ? i + 1 : 0);
    const bool rises = a[1] <= around[1] && b[1] > around[1], falls = a[1] > around[1] && b[1] <= around[1];
    if (!rises && !falls)
      continue;
    const double left = (b[0] - a[0]) * (around[1] - a[1]) - (around[0] - a[0]) * (b[1] - a[1]);
    turns += rises && left > 0.0 ? 1 : 0;
    turns -= falls && left < 0.0 ? 1 : 0;
  }
  return turns;
}

/// Whether a place on the wrong side of its nearest segment is where points do not belong, and not beyond a kink.
bool is_through(const mpm::Particles<2>& nodes, const Vec2& point, SheetSide side)
{
  return (winding(nodes, point) == 0) == (side == SheetSide::inside);
}

}  // namespace

template <std::size_t Most>
void SheetContact::Handle<Most>::add(std::uint32_t at, double share)
{
  for (std::size_t k = 0; k < count; ++k)
    if (node[k] == at) {
      weight[k] += share;
      return;
    }
  node[count] = at;
  weight[count++] = share;
}

template <std::size_t Most>
double SheetContact::Handle<Most>::weigh(const mpm::Grid<2>& grid)
{
  double compliance = 0.0;
  for (std::size_t k = 0; k < count; ++k) {
    const double mass = grid.nodes()[node[k]][mpm::Grid<2>::mass_slot];
    weight[k] = mass > 0.0 ? weight[k] : 0.0;
    mobility[k] = mass > 0.0 ? weight[k] / mass : 0.0;
    compliance += weight[k] * mobility[k];
  }
  return compliance;
}

template <std::size_t Most>
Vec2 SheetContact::Handle<Most>::velocity(const mpm::Grid<2>& grid) const
{
  mpm::Grid<2>::Node sum = mpm::Grid<2>::Node::Zero();
  for (std::size_t k = 0; k < count; ++k)
    sum += weight[k] * grid.nodes()[node[k]];
  return { sum[0], sum[1] };
}

template <std::size_t Most>
void SheetContact::Handle<Most>::push(const Vec2& impulse, mpm::Grid<2>& grid) const
{
  const mpm::Grid<2>::Node both{ impulse[0], impulse[1], 0.0, 0.0 };
  for (std::size_t k = 0; k < count; ++k)
    grid.nodes()[node[k]] += mobility[k] * both;
}

/// Segments, and lists of those that lie within `reach` (m) of each cell.
void SheetContact::lay_out(const ClosedSheet& sheet, double reach, const mpm::Grid<2>& grid)
{
  const std::size_t count = sheet.nodes->size();
  const double inwards = side_ == SheetSide::inside ? sheet.outwards : -sheet.outwards;
  segments_.resize(count);
  entries_.clear();
  cells_.clear();
  first_.resize(grid.size(), none);
  for (std::size_t s = 0; s < count; ++s) {
    const Vec2 a = place(*sheet.nodes, s), b = place(*sheet.nodes, s + 1 < count ? s + 1 : 0);
    Segment& segment = segments_[s];
    segment.start = a;
    segment.tangent = segment.normal = Vec2::Zero();
    segment.length = (b - a).norm();
    if (!(segment.length > least_segment * grid.dx()))
      continue;
    segment.tangent = (b - a) / segment.length;
    segment.normal = inwards * left_normal(segment.tangent);
    const Vec2 margin = Vec2::Constant(reach);
    const std::array<int, 2> low = cell_of(a.cwiseMin(b) - margin, grid), high = cell_of(a.cwiseMax(b) + margin, grid);
    std::array<int, 2> cell;
    for (cell[0] = low[0]; cell[0] <= high[0]; ++cell[0])
      for (cell[1] = low[1]; cell[1] <= high[1]; ++cell[1]) {
        std::uint32_t& first = first_[grid.index(cell)];
        if (first == none)
          cells_.push_back(grid.index(cell));
        entries_.push_back({ static_cast<std::uint32_t>(s), first });
        first = static_cast<std::uint32_t>(entries_.size() - 1);
      }
  }
}

/// Among the segments of a list.
SheetContact::Foot SheetContact::foot_of(const Vec2& point, std::uint32_t first) const
{
  Foot foot;
  foot.seen = { std::numeric_limits<double>::infinity(), Vec2::Zero() };
  double best = std::numeric_limits<double>::infinity();
  for (std::uint32_t e = first; e != none; e = entries_[e].next) {
    const std::size_t s = entries_[e].segment;
    const Segment& segment = segments_[s];
    const Vec2 from_start = point - segment.start;
    const double along = from_start.dot(segment.tangent);
    const double clamped = std::clamp(along, 0.0, segment.length);
    const Vec2 apart = from_start - clamped * segment.tangent;
    const double square = apart.squaredNorm();
    if (!(square < best))
      continue;
    best = square;
    foot.segment = s;
    foot.fraction = clamped / segment.length;
    if (along == clamped) {
      foot.seen = { from_start.dot(segment.normal), segment.normal };
      continue;
    }
    // Nearest to a node: the sign comes from the mean of the two normals that meet there (Baerentzen 2005).
    const std::size_t count = segments_.size();
    const std::size_t other = along < 0.0 ? (s + count - 1) % count : (s + 1) % count;
    const double distance = std::sqrt(square);
    const double sign = apart.dot(segment.normal + segments_[other].normal) >= 0.0 ? 1.0 : -1.0;
    foot.seen = { sign * distance, distance > 0.0 ? Vec2(sign / distance * apart) : segment.normal };
  }
  return foot;
}

void SheetContact::add(const Vec2& point, const Foot& foot, double gap, std::size_t id, const mpm::Grid<2>& point_grid,
                       const ClosedSheet& sheet, const mpm::Grid<2>& sheet_grid, double dt)
{
  Contact contact;
  const auto spread = [this](const Vec2& at, double share, const mpm::Grid<2>& grid, auto& handle) {
    const mpm::AnyReach<2> reach = mpm::reach_of<2>(shape_, at, grid);
    for (std::size_t k = 0; k < static_cast<std::size_t>(reach.count); ++k)
      handle.add(reach.node[k], share * reach.weight[k]);
  };
  const std::size_t next = foot.segment + 1 < segments_.size() ? foot.segment + 1 : 0;
  spread(point, 1.0, point_grid, contact.point);
  spread(place(*sheet.nodes, foot.segment), 1.0 - foot.fraction, sheet_grid, contact.sheet);
  spread(place(*sheet.nodes, next), foot.fraction, sheet_grid, contact.sheet);
  contact.compliance = contact.point.weigh(point_grid) + contact.sheet.weigh(sheet_grid);
  contact.normal = foot.seen.normal;
  contact.approach = least_velocity(gap, dt);
  contact.id = id;
  contact.pressed = memory_[id][0];
  contact.dragged = memory_[id][1];
  contacts_.push_back(contact);
}

void SheetContact::begin(const ContactPoints<2>& points, const mpm::Grid<2>& point_grid, const ClosedSheet& sheet,
                         const mpm::Grid<2>& sheet_grid, double dt)
{
  const mpm::Particles<2>& particles = *points.particles;
  contacts_.clear();
  memory_.resize(particles.size(), { 0.0, 0.0 });
  const auto width_of = [&](std::size_t p) {
    return points.has_width ? 0.5 * std::sqrt(particles.initial_volume[p]) : 0.0;
  };
  const double search = search_cells * sheet_grid.dx();
  double widest = 0.0;
  for (std::size_t p = 0; p < particles.size(); ++p)
    widest = std::max(widest, width_of(p));
  lay_out(sheet, search + widest, sheet_grid);
  for (std::size_t p = 0; p < particles.size(); ++p) {
    const Vec2 point = place(particles, p);
    const std::uint32_t first = first_[sheet_grid.index(cell_of(point, sheet_grid))];
    if (first == none)
      continue;
    Foot foot = foot_of(point, first);
    if (foot.seen.distance < 0.0 && !is_through(*sheet.nodes, point, side_))
      foot.seen = { -foot.seen.distance, -foot.seen.normal };
    const double gap = foot.seen.distance - width_of(p);
    if (gap < search && foot.seen.distance > -search)
      add(point, foot, gap, particles.id[p], point_grid, sheet, sheet_grid, dt);
  }
  for (const std::size_t cell : cells_)
    first_[cell] = none;
}

void SheetContact::add_nodes(std::vector<std::uint32_t>& of_points, std::vector<std::uint32_t>& of_sheet)
{
  seen_.resize(first_.size(), 0);
  const auto take = [this](auto Contact::*handle, std::vector<std::uint32_t>& nodes) {
    const std::size_t before = nodes.size();
    for (const Contact& contact : contacts_)
      for (std::size_t k = 0; k < (contact.*handle).count; ++k) {
        const std::uint32_t node = (contact.*handle).node[k];
        if (seen_[node] == 0)
          nodes.push_back(node);
        seen_[node] = 1;
      }
    for (std::size_t k = before; k < nodes.size(); ++k)
      seen_[nodes[k]] = 0;
  };
  take(&Contact::point, of_points);
  take(&Contact::sheet, of_sheet);
}

void SheetContact::guess(mpm::Grid<2>& point_grid, mpm::Grid<2>& sheet_grid) const
{
  for (const Contact& c : contacts_) {
    if (c.pressed == 0.0)
      continue;
    const Vec2 impulse = c.pressed * c.normal + c.dragged * left_normal(c.normal);
    c.point.push(impulse, point_grid);
    c.sheet.push(-impulse, sheet_grid);
  }
}

/// Makes one contact right given all others. Returns the change of the relative velocity, m/s.
double SheetContact::relax(Contact& contact, mpm::Grid<2>& point_grid, mpm::Grid<2>& sheet_grid) const
{
  const Vec2 slip = contact.point.velocity(point_grid) - contact.sheet.velocity(sheet_grid);
  const Vec2 tangent = left_normal(contact.normal);
  const double pressed =
      std::max(0.0, contact.pressed + (contact.approach - slip.dot(contact.normal)) / contact.compliance);
  const double limit = (held_ ? holding_friction : friction_) * pressed;
  const double dragged = std::clamp(contact.dragged - slip.dot(tangent) / contact.compliance, -limit, limit);
  const Vec2 impulse = (pressed - contact.pressed) * contact.normal + (dragged - contact.dragged) * tangent;
  contact.pressed = pressed;
  contact.dragged = dragged;
  if (impulse[0] == 0.0 && impulse[1] == 0.0)
    return 0.0;
  contact.point.push(impulse, point_grid);
  contact.sheet.push(-impulse, sheet_grid);
  return impulse.lpNorm<Eigen::Infinity>() * contact.compliance;
}

double SheetContact::sweep(int number, mpm::Grid<2>& point_grid, mpm::Grid<2>& sheet_grid)
{
  double change = 0.0;
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const std::size_t k = number % 2 == 0 ? i : contacts_.size() - 1 - i;
    change = std::max(change, relax(contacts_[k], point_grid, sheet_grid));
  }
  return change;
}

void SheetContact::end()
{
  std::fill(memory_.begin(), memory_.end(), std::array<double, 2>{ 0.0, 0.0 });
  for (const Contact& c : contacts_)
    memory_[c.id] = { c.pressed, c.dragged };
}

}  // namespace geocontainer_mpm::contact
