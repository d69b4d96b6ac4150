#pragma once
/// What of a body is seen from ahead, in space.

#include <array>

#include "geocontainer_mpm/mpm/particles.h"
#include "geocontainer_mpm/scene/description.h"

namespace geocontainer_mpm::scene {

/// Area of the shadow that points throw along a unit direction, m^2: of the convex hull of their projections, as in the
/// section the extent across is that of the outermost points. Every point is a square of side `margin` (m). Of a part
/// of a scene with planes of symmetry, along which `ahead` must lie, the part's share of the whole shadow.
double shadow_area(const std::array<mpm::Column, 3>& points, double margin, const Vec3& ahead, Symmetry symmetry);

}  // namespace geocontainer_mpm::scene
