#include "geocontainer_mpm/contact/sheet_line.h"

#include <algorithm>
#include <cmath>

namespace geocontainer_mpm::contact {
namespace {

/// Segments shorter than this part of a cell have no direction.
constexpr double least_segment = 1e-9;

}  // namespace

void SheetLine::lay(const ClosedSheet<2>& sheet, SheetSide side, const mpm::Grid<2>& grid)
{
  const double inwards = side == SheetSide::inside ? sheet.outwards : -sheet.outwards;
  segments_.resize(sheet.nodes->size());
  for (std::size_t s = 0; s < size(); ++s) {
    const Vec2 a = sheet.nodes->position_of(s), b = sheet.nodes->position_of(next(s));
    Segment& segment = segments_[s];
    segment.start = a;
    segment.tangent = segment.normal = Vec2::Zero();
    segment.length = (b - a).norm();
    if (!(segment.length > least_segment * grid.dx()))
      continue;
    segment.tangent = (b - a) / segment.length;
    segment.normal = inwards * left_normal(segment.tangent);
  }
}

void SheetLine::look(std::size_t s, const Vec2& point, double& best, SheetFoot<2>& foot) const
{
  const Segment& segment = segments_[s];
  const Vec2 from_start = point - segment.start;
  const double along = from_start.dot(segment.tangent);
  const double clamped = std::clamp(along, 0.0, segment.length);
  const Vec2 apart = from_start - clamped * segment.tangent;
  const double square = apart.squaredNorm();
  if (!(square < best))
    return;
  best = square;
  const double fraction = clamped / segment.length;
  foot.node = { static_cast<std::uint32_t>(s), static_cast<std::uint32_t>(next(s)) };
  foot.share = { 1.0 - fraction, fraction };
  if (along == clamped) {
    foot.seen = { from_start.dot(segment.normal), segment.normal };
    return;
  }
  // Nearest to a node: the sign comes from the mean of the two normals that meet there (Baerentzen 2005).
  const std::size_t other = along < 0.0 ? (s + size() - 1) % size() : next(s);
  const double distance = std::sqrt(square);
  const double sign = apart.dot(segment.normal + segments_[other].normal) >= 0.0 ? 1.0 : -1.0;
  foot.seen = { sign * distance, distance > 0.0 ? Vec2(sign / distance * apart) : segment.normal };
}

/// Against the clock: crossings of a ray along +y (Sunday 2001).
int SheetLine::winding(const Vec2& around) const
{
  int turns = 0;
  for (std::size_t i = 0; i < size(); ++i) {
    const Vec2 a = place(i), b = place(next(i));
    const bool rises = a[1] <= around[1] && b[1] > around[1], falls = a[1] > around[1] && b[1] <= around[1];
    if (!rises && !falls)
      continue;
    const double left = (b[0] - a[0]) * (around[1] - a[1]) - (around[0] - a[0]) * (b[1] - a[1]);
    turns += rises && left > 0.0 ? 1 : 0;
    turns -= falls && left < 0.0 ? 1 : 0;
  }
  return turns;
}

}  // namespace geocontainer_mpm::contact
