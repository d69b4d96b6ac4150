#pragma once
/// Shortest way between the convex hulls of two clouds of points.

#include <vector>

#include "geocontainer_mpm/mpm/types.h"

namespace geocontainer_mpm::contact {

/// The shortest vector from the hull of `a` to the hull of `b`, zero where they overlap (Gilbert, Johnson and Keerthi
/// 1988, in the plane). `towards`: a first guess of its direction. No cloud is empty.
Vec2 hull_distance(const std::vector<Vec2>& a, const std::vector<Vec2>& b, const Vec2& towards);

}  // namespace geocontainer_mpm::contact
