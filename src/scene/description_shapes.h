#pragma once
/// Plane geometry that checking a scene needs.

#include <Eigen/Geometry>
#include <utility>
#include <vector>

#include "geocontainer_mpm/scene/description.h"

namespace geocontainer_mpm::scene {

/// Indices of the first two sides of a line (closed: of a polygon) that meet where they are not neighbours, or of a
/// side without length (both the same); nothing for a simple line.
std::optional<std::pair<std::size_t, std::size_t>> crossing_sides(const std::vector<Vec2>& vertices, bool closed);

/// Length of an open line or, closed, of a polygon's outline, m.
double line_length(const std::vector<Vec2>& vertices, bool closed);

/// The four corners of a box in counter-clockwise order.
std::vector<Vec2> corners(const Box& box);

/// How much of each side the fillets of radius `radius_m` at the inner vertices take, over the side's length: above 1
/// they do not fit.
std::vector<double> fillet_share(const std::vector<Vec2>& line, double radius_m);

/// Unset for a hopper filling, which needs the hull.
std::optional<Eigen::AlignedBox2d> extent(const ShapeDescription& shape);
/// Length of the outer outline, m; unset for a hopper filling.
std::optional<double> outline_length(const ShapeDescription& shape);

}  // namespace geocontainer_mpm::scene
