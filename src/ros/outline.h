#pragma once
/// Lines that show a surface of triangles: the section of a container, the edges of a hull.

#include <array>
#include <cstdint>
#include <vector>

#include "geocontainer_mpm/scene/frame.h"

namespace geocontainer_mpm::ros_bridge {

/// What a polygon of the container shows. A line: the line itself. Triangles: the section nearest midships (x = 0), the
/// longest piece of it where folds give several. A polygon joins its ends, so that what is open goes there and back.
std::vector<Vec3> container_outline(const scene::GeotextileFrame& sheet);

/// Pairs of positions: where the surface ends, and where it turns by more than about 25 degrees. Of a rigid body always
/// the same.
std::vector<std::array<std::uint32_t, 2>> sharp_edges(const scene::BoundaryFrame& boundary);

}  // namespace geocontainer_mpm::ros_bridge
