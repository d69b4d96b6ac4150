#include "model_surfaces.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "geocontainer_mpm/error.h"
#include "geocontainer_mpm/scene/shapes.h"

namespace geocontainer_mpm::scene {
namespace {

/// The segment whose middle is nearest to a place.
std::size_t nearest_segment(const geotextile::Sheet& sheet, const Vec2& at)
{
  const auto distance = [&](std::size_t i) {
    return (0.5 * (sheet.node(i) + sheet.node(sheet.end_of(i))) - at).norm();
  };
  std::size_t nearest = 0;
  for (std::size_t i = 1; i < sheet.segments(); ++i)
    if (distance(i) < distance(nearest))
      nearest = i;
  return nearest;
}

geotextile::Strength strength_of(const GeotextileDescription& description, std::vector<geotextile::Seam> seams)
{
  return geotextile::Strength(description.strength_n_per_m, description.seam_efficiency, std::move(seams));
}

/// Makes the seams that tear do so.
template <class SheetOrMembrane>
void weaken(SheetOrMembrane& sheet, const GeotextileDescription& description,
            const std::vector<geotextile::Seam>& seams)
{
  for (const geotextile::Seam& seam : seams)
    if (description.seams.at(seam.name).tears)
      sheet.tear_at(seam.segment, seam.efficiency * description.strength_n_per_m);
}

/// The seams where they are in the sheet as it is laid.
std::vector<geotextile::Seam> seams_of(const GeotextileDescription& description, const geotextile::Sheet& sheet)
{
  std::vector<geotextile::Seam> seams;
  for (const auto& [name, seam] : description.seams) {
    const std::size_t n = sheet.segments();
    const std::size_t place = seam.along
                                  ? std::min(n - 1, static_cast<std::size_t>(*seam.along * static_cast<double>(n)))
                                  : nearest_segment(sheet, *seam.at_m);
    seams.push_back({ name, place, seam.efficiency.value_or(description.seam_efficiency) });
  }
  return seams;
}

/// A place on a closed line, by the part of its length that lies before it.
Vec2 place_along(const std::vector<Vec2>& line, double part)
{
  const auto side = [&line](std::size_t i) { return Vec2(line[(i + 1) % line.size()] - line[i]); };
  double left = 0.0;
  for (std::size_t i = 0; i < line.size(); ++i)
    left += part * side(i).norm();
  std::size_t i = 0;
  for (; i + 1 < line.size() && left > side(i).norm(); ++i)
    left -= side(i).norm();
  return line[i] + std::min(1.0, left / side(i).norm()) * side(i);
}

/// Middle of the side of the section from which a triangle of the wall is extruded.
Vec2 side_of(const geotextile::TriangleMesh& mesh, const geotextile::Triangle& t)
{
  const Vec2 a = in_section(mesh.points[t[0]]), b = in_section(mesh.points[t[1]]), c = in_section(mesh.points[t[2]]);
  return 0.5 * (a + ((b - a).squaredNorm() > (c - a).squaredNorm() ? b : c));
}

/// Seams along the barge: of each all pieces of the wall that are extruded from one side of the section.
/// `outline`: of all of it.
std::vector<geotextile::Seam> seams_of(const GeotextileDescription& description, const std::vector<Vec2>& outline,
                                       const geotextile::TriangleMesh& mesh, Symmetry symmetry)
{
  std::vector<geotextile::Seam> seams;
  for (const auto& [name, seam] : description.seams) {
    Vec2 at = seam.along ? place_along(outline, *seam.along) : *seam.at_m;
    if (symmetry != Symmetry::none)
      at[0] = std::abs(at[0]);  // its image is as tense
    const auto distance = [&](std::size_t t) {
      return mesh.panel[t] == geotextile::Panel::wall ? (side_of(mesh, mesh.triangles[t]) - at).norm()
                                                      : std::numeric_limits<double>::infinity();
    };
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      nearest = std::min(nearest, distance(t));
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      if (distance(t) <= nearest * (1.0 + 1e-9))
        seams.push_back({ name, t, seam.efficiency.value_or(description.seam_efficiency) });
  }
  return seams;
}

}  // namespace

template <>
ModelSheet<2> lay_sheet(const std::string& name, const GeotextileDescription& description,
                        const SceneDescription& scene)
{
  geotextile::SheetParameters parameters;
  parameters.stiffness = description.stiffness_n_per_m;
  parameters.mass = description.mass_kg_per_m2;
  parameters.computational_mass = description.computational_mass_kg_per_m2;
  parameters.segment_length = description.segment_length_m;
  parameters.gauge_length = description.gauge_length_m;
  parameters.formulation = description.formulation;
  parameters.force_strain = description.force_strain_table;
  parameters.rupture_strain = description.rupture_strain;
  const geotextile::SheetLayout layout = sheet_layout(description, scene);
  if (description.wrinkles && layout.fullness.empty())
    throw InputError(scene.source, "geotextiles." + name + ".wrinkles.region", "",
                     "must hold part of the path along which the sheet is laid");
  parameters.unstretched_length = unstretched_length(description, layout);
  if (description.circumference_m && description.wrinkles &&
      *description.circumference_m < layout.cloth_length() * (1.0 - 1e-9))
    throw InputError(
        scene.source, "geotextiles." + name + ".circumference_m", fmt::format("{}", *description.circumference_m),
        fmt::format("must be at least {:.6g} m, what the path with its wrinkles takes", layout.cloth_length()));
  geotextile::Sheet laid(layout, parameters);
  const std::vector<geotextile::Seam> seams = seams_of(description, laid);
  weaken(laid, description, seams);
  const geotextile::Strength strength = strength_of(description, seams);
  return { name, 0, std::move(laid), strength, strength };
}

/// What of a body's surface is not on a plane of symmetry.
template <>
ModelSheet<3> lay_sheet(const std::string& name, const GeotextileDescription& description,
                        const SceneDescription& scene)
{
  geotextile::SheetLayout section = sheet_layout(description, scene);
  geotextile::Fullness fullness;
  fullness.around = unstretched_length(description, section) / section.cloth_length();
  fullness.ends = description.end_slack ? 1.0 + *description.end_slack : fullness.around;
  const std::vector<Vec2> outline = section.points;
  if (scene.symmetry() != Symmetry::none)
    section = { port_arc(section.points), false, {} };
  const Vec2& along = *scene.bodies.at(description.encloses).along_m;
  const bool quarter = scene.symmetry() == Symmetry::quarter;
  const Vec2& space = scene.space->along_m;
  // An end that lies in the end of the space is held by its roller, and open.
  const geotextile::ClosedEnds closed{ !quarter && along[0] > space[0], along[1] < space[1] };
  geotextile::MembraneParameters parameters;
  parameters.warp_stiffness = description.stiffness_n_per_m;
  parameters.warp_force_strain = description.force_strain_table;
  parameters.weft_stiffness = description.stiffness_weft_n_per_m.value_or(description.stiffness_n_per_m);
  parameters.weft_force_strain = description.force_strain_weft_table.empty() && !description.stiffness_weft_n_per_m
                                     ? description.force_strain_table
                                     : description.force_strain_weft_table;
  parameters.mass = description.mass_kg_per_m2;
  parameters.computational_mass = description.computational_mass_kg_per_m2;
  parameters.gauge_length = description.gauge_length_m;
  parameters.rupture_strain = description.rupture_strain;
  const auto wrapped = [&] {
    try {
      return geotextile::wrap(section, { quarter ? 0.0 : along[0], along[1] }, closed, description.segment_length_m,
                              fullness);
    } catch (const InputError& error) {  // which knows of no scene
      throw InputError(scene.source, "geotextiles." + name, error.value(),
                       fmt::format("its {} {}", error.key(), error.allowed()));
    }
  };
  const geotextile::TriangleMesh mesh = wrapped();
  geotextile::Membrane laid(mesh, parameters);
  const std::vector<geotextile::Seam> seams = seams_of(description, outline, mesh, scene.symmetry());
  weaken(laid, description, seams);
  const double weft = description.strength_weft_n_per_m.value_or(description.strength_n_per_m);
  return { name, 0, std::move(laid), strength_of(description, seams),
           geotextile::Strength(weft, description.seam_efficiency) };
}

template <>
contact::BoundaryBody<2> rigid_surface(const std::string& name, contact::Surface section, double friction,
                                       double spacing, const SceneDescription&)
{
  return { name, std::move(section), friction, spacing };
}

template <>
contact::BoundaryBody<3> rigid_surface(const std::string& name, contact::Surface section, double friction,
                                       double spacing, const SceneDescription& scene)
{
  // A cell further than the space: what lies in its ends, to round-off, touches as well.
  const double margin = scene.grid.cell_size_m,
               from = scene.symmetry() == Symmetry::quarter ? 0.0 : scene.space->along_m[0];
  return { name, std::move(section), Along{ from - margin, scene.space->along_m[1] + margin }, friction, spacing };
}

contact::BoundaryBody<3> bulkhead(const HullPart& part, double spacing, const HullDescription& hull)
{
  std::vector<Vec2> half = half_of_hopper(hull);
  // What is pressed a little into the wall must not lose sight of the bulkhead, nor what lies in the plane of symmetry.
  for (Vec2& point : half)
    point[0] += point[0] > 0.0 ? spacing : -1e-6 * spacing;
  if (part.half == barge::HullHalf::starboard)
    for (Vec2& point : half)
      point[0] = -point[0];
  const bool aft = part.what == HullPart::What::aft_bulkhead;
  return contact::BoundaryBody<3>::plate(part.name, contact::Surface(std::move(half), true),
                                         (*hull.along_m)[aft ? 0 : 1], aft ? 1.0 : -1.0, hull.friction, spacing);
}

}  // namespace geocontainer_mpm::scene
