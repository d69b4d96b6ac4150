#pragma once
/// From described shapes to outlines and particles.

#include <vector>

#include "geocontainer_mpm/scene/description.h"

namespace geocontainer_mpm::scene {

/// Points that stand for equal parts of a shape.
struct Sampling {
  std::vector<Vec2> points;  ///< m
  double volume = 0.0;       ///< of each, per unit width, m^2: points x volume is the area of the shape
};

/// Closed outline, counter-clockwise (y to the right, z up), m. A disc becomes a polygon with sides of about
/// `resolution` m. `hull` is needed by hopper_fill alone. Throws InputError when the hopper cannot hold the wanted
/// area.
std::vector<Vec2> outline(const ShapeDescription& shape, const std::optional<HullDescription>& hull, double resolution);

/// Signed area of a closed polygon, counter-clockwise positive, m^2.
double polygon_area(const std::vector<Vec2>& polygon);

/// Particles on a square lattice, about `spacing` m apart. A box is filled exactly, in its own axes.
Sampling sample(const ShapeDescription& shape, const std::vector<Vec2>& outline, double spacing);

/// Highest z of the closed polygon at this y; -infinity beside it.
double top_at(const std::vector<Vec2>& polygon, double y);

}  // namespace geocontainer_mpm::scene
