#pragma once
/// From described shapes to outlines and particles.

#include <vector>

#include "geocontainer_mpm/geotextile/sheet.h"
#include "geocontainer_mpm/scene/description.h"

namespace geocontainer_mpm::scene {

/// Points that stand for parts of a shape.
struct Sampling {
  std::vector<Vec2> points;     ///< m
  std::vector<double> volumes;  ///< of each, per unit width, m^2: their sum is the area of the shape
  std::optional<Vec2> tile;  ///< edges of a part along y and z where all are alike, m; of a rotated one, those of the
                             ///< upright box with the same moments of area
};

/// Closed outline, counter-clockwise (y to the right, z up), m; of a ring the outer one. A circle becomes a polygon
/// with sides of about `resolution` m. `hull` is needed by hopper_fill alone. Throws InputError when the hopper cannot
/// hold the wanted area.
std::vector<Vec2> outline(const ShapeDescription& shape, const std::optional<HullDescription>& hull, double resolution);

/// The port half of the closed hopper up to where its wall is highest: what an end bulkhead closes. Closed polygon, m.
std::vector<Vec2> half_of_hopper(const HullDescription& hull);

/// Where a counter-clockwise polygon that is its own mirror image lies at y >= 0: an open line from its lowest point on
/// the plane of symmetry to its highest.
std::vector<Vec2> port_arc(const std::vector<Vec2>& polygon);

/// Signed area of a closed polygon, counter-clockwise positive, m^2.
double polygon_area(const std::vector<Vec2>& polygon);

/// All closed lines that bound a shape, material on the left walking along each: the outline, and the hole of a ring.
std::vector<std::vector<Vec2>> boundary_lines(const ShapeDescription& shape, const std::optional<HullDescription>& hull,
                                              double resolution);

/// Particles about `spacing` m apart: a box is filled exactly, in its own axes; disc and ring by circles of particles,
/// so that their edge is round; other shapes on a square lattice.
Sampling sample(const ShapeDescription& shape, const std::vector<Vec2>& outline, double spacing);

/// Moves every point by up to `size` m in each direction, at random and the same on every machine.
template <int Dim>
void jitter(double size, std::vector<Vec<Dim>>& points);

/// Path of a sheet: around its body, along its line or its circle; with the cloth of its wrinkles.
geotextile::SheetLayout sheet_layout(const GeotextileDescription& sheet, const SceneDescription& scene);
/// Its length without tension, m, from whatever the description says of it.
double unstretched_length(const GeotextileDescription& sheet, const geotextile::SheetLayout& layout);

/// Highest z of the closed polygon at this y; -infinity beside it.
double top_at(const std::vector<Vec2>& polygon, double y);

}  // namespace geocontainer_mpm::scene
