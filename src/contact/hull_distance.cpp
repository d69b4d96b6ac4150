#include "hull_distance.h"

#include <cstddef>

namespace geocontainer_mpm::contact {
namespace {

/// A direction is final when no point lies nearer along it by more than this part of the distance.
constexpr double tolerance = 1e-13;
/// Each pass takes a vertex of the difference of two small clouds; a handful do.
constexpr int most_passes = 32;

Vec2 furthest(const std::vector<Vec2>& cloud, const Vec2& direction)
{
  std::size_t best = 0;
  double most = cloud[0].dot(direction);
  for (std::size_t i = 1; i < cloud.size(); ++i) {
    const double along = cloud[i].dot(direction);
    if (along > most) {
      most = along;
      best = i;
    }
  }
  return cloud[best];
}

double cross(const Vec2& a, const Vec2& b)
{
  return a[0] * b[1] - a[1] * b[0];
}

bool origin_inside(const Vec2& a, const Vec2& b, const Vec2& c)
{
  const double ab = cross(a, b), bc = cross(b, c), ca = cross(c, a);
  return (ab >= 0.0 && bc >= 0.0 && ca >= 0.0) || (ab <= 0.0 && bc <= 0.0 && ca <= 0.0);
}

/// The part of the simplex that is nearest to the origin: a point (both ends alike) or an edge.
struct Edge {
  Vec2 from, to, nearest;
};

Edge edge_of(const Vec2& a, const Vec2& b)
{
  const Vec2 along = b - a;
  const double square = along.squaredNorm();
  const double t = square > 0.0 ? -a.dot(along) / square : 0.0;
  if (t <= 0.0)
    return { a, a, a };
  if (t >= 1.0)
    return { b, b, b };
  return { a, b, a + t * along };
}

}  // namespace

Vec2 hull_distance(const std::vector<Vec2>& a, const std::vector<Vec2>& b, const Vec2& towards)
{
  const auto nearest_along = [&](const Vec2& direction) -> Vec2 {
    return furthest(b, -direction) - furthest(a, direction);
  };
  const Vec2 first = nearest_along(towards);
  Edge edge{ first, first, first };
  for (int pass = 0; pass < most_passes; ++pass) {
    const Vec2& v = edge.nearest;
    const double square = v.squaredNorm();
    if (!(square > 0.0))
      return Vec2::Zero();
    const Vec2 w = nearest_along(v);
    if (square - v.dot(w) <= tolerance * square)
      return v;
    if (edge.from != edge.to && origin_inside(edge.from, edge.to, w))
      return Vec2::Zero();
    const Edge one = edge_of(edge.from, w), other = edge_of(edge.to, w);
    const Edge better = one.nearest.squaredNorm() <= other.nearest.squaredNorm() ? one : other;
    if (!(better.nearest.squaredNorm() < square))
      return v;
    edge = better;
  }
  return edge.nearest;
}

}  // namespace geocontainer_mpm::contact
