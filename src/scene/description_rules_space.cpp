#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "description_leaf.h"
#include "description_rules.h"
#include "geocontainer_mpm/scene/shapes.h"

namespace geocontainer_mpm::scene {

namespace {

using grammar::number_text;
using grammar::refuse;
using grammar::to_text;

/// Refuses a stretch along x that is not within another.
void check_stretch(const std::string& key, const Vec2& stretch, const Vec2& within, const char* within_key, double cell)
{
  if (!(stretch[1] > stretch[0]))
    refuse(key, to_text(stretch), "must be [from, to] with from below to");
  if (stretch[0] < within[0] - cell_tolerance * cell || stretch[1] > within[1] + cell_tolerance * cell)
    refuse(key, to_text(stretch), fmt::format("must lie within {}, {}", within_key, to_text(within)));
}

/// Keys that mean something in space alone.
void check_plane(const SceneDescription& scene)
{
  const char* allowed = "must not be given in plane strain: the scene has no section `space`";
  for (const auto& [name, body] : scene.bodies)
    if (body.along_m)
      refuse("bodies." + name + ".along_m", to_text(*body.along_m), allowed);
  if (scene.hull && scene.hull->along_m)
    refuse("hull.along_m", to_text(*scene.hull->along_m), allowed);
  for (const auto& [name, sheet] : scene.geotextiles) {
    const std::string key = "geotextiles." + name;
    if (sheet.stiffness_weft_n_per_m)
      refuse(key + ".stiffness_weft_n_per_m", number_text(*sheet.stiffness_weft_n_per_m), allowed);
    if (sheet.strength_weft_n_per_m)
      refuse(key + ".strength_weft_n_per_m", number_text(*sheet.strength_weft_n_per_m), allowed);
    if (sheet.end_slack)
      refuse(key + ".end_slack", number_text(*sheet.end_slack), allowed);
    if (!sheet.force_strain_weft_table.empty())
      refuse(key + ".force_strain_weft_table", "", allowed);
  }
}

/// What works in plane strain alone.
void check_left_out(const SceneDescription& scene)
{
  const char* allowed = "must not be given in a scene with `space`: it works in plane strain alone";
  const auto refuse_any = [&](const auto& map, const char* section) {
    if (!map.empty())
      refuse(section, names_in(map), allowed);
  };
  refuse_any(scene.tractions, "tractions");
  refuse_any(scene.contacts, "contacts");
  if (scene.numerics.method.shape == mpm::Shape::gimp)
    refuse("numerics.shape", "gimp", "must be bspline2 or linear_simplex in a scene with `space`");
  if (scene.velocity_fields().size() > 1)
    refuse("bodies", names_in(scene.bodies), "must share one velocity_field in a scene with `space`");
  for (const auto& [name, body] : scene.bodies) {
    const std::string key = "bodies." + name;
    if (body.manufactured)
      refuse(key + ".manufactured", "", allowed);
    if (body.initial_velocity_wave)
      refuse(key + ".initial_velocity_wave", "", allowed);
  }
  for (const auto& [name, sheet] : scene.geotextiles) {
    const std::string key = "geotextiles." + name;
    if (sheet.encloses.empty())
      refuse(key, "", "must enclose a body in a scene with `space`");
    if (sheet.formulation != geotextile::Formulation::segments)
      refuse(key + ".formulation", to_text(sheet.formulation), "must be segments in a scene with `space`");
    if (sheet.wrinkles)
      refuse(key + ".wrinkles", "", allowed);
  }
  for (const auto& [name, probe] : scene.probes)
    if (probe.section || probe.geotextile)
      refuse("probes." + name, probe.section ? "section" : "geotextile", allowed);
}

/// A body is its own mirror image where every corner of its outline has one.
bool mirrored(const std::vector<Vec2>& outline, double tolerance)
{
  return std::all_of(outline.begin(), outline.end(), [&](const Vec2& corner) {
    return std::any_of(outline.begin(), outline.end(),
                       [&](const Vec2& other) { return (Vec2(-corner[0], corner[1]) - other).norm() <= tolerance; });
  });
}

void check_symmetry(const SceneDescription& scene)
{
  const GridDescription& grid = scene.grid;
  const double tolerance = cell_tolerance * grid.cell_size_m;
  const std::string symmetry = to_text(scene.space->symmetry);
  const auto no = [&](const std::string& key, const std::string& value, const char* wanted) {
    refuse(key, value, fmt::format("must be {} with space.symmetry {}", wanted, symmetry));
  };
  if (std::abs(grid.lower_m[0] + grid.upper_m[0]) > tolerance)
    no("grid.lower_m", to_text(grid.lower_m), "as far from y = 0 as grid.upper_m");
  if (scene.gravity_m_per_s2[0] != 0.0)
    no("gravity_m_per_s2", to_text(scene.gravity_m_per_s2), "without a part along y");
  for (const TableRow<2>& row : scene.gravity_table)
    if (row.value[0] != 0.0)
      no("gravity_table", number_text(row.value[0]), "without a part along y");
  const bool along = scene.space->symmetry == Symmetry::quarter;
  const auto check_ends = [&](const std::string& key, const Vec2& stretch) {
    if (along && std::abs(stretch[0] + stretch[1]) > tolerance)
      no(key, to_text(stretch), "from -x to x");
  };
  check_ends("space.along_m", scene.space->along_m);
  for (const auto& [name, body] : scene.bodies) {
    const std::string key = "bodies." + name;
    if (!mirrored(outline(body.shape, scene.hull, grid.cell_size_m), tolerance))
      no(key + ".shape", "", "its own mirror image at y = 0");
    if (body.initial_velocity_m_per_s[0] != 0.0)
      no(key + ".initial_velocity_m_per_s", to_text(body.initial_velocity_m_per_s), "without a part along y");
    if (body.initial_spin_rad_per_s != 0.0)
      no(key + ".initial_spin_rad_per_s", number_text(body.initial_spin_rad_per_s), "zero");
    if (body.jitter != 0.0)
      no(key + ".jitter", number_text(body.jitter), "zero");
    check_ends(key + ".along_m", *body.along_m);
  }
  for (const auto& [name, surface] : scene.surfaces) {
    if (!mirrored(surface.line_m, tolerance))
      no("surfaces." + name + ".line_m", "", "its own mirror image at y = 0");
    if (surface.motion)
      no("surfaces." + name + ".motion", "", "left out");
  }
  if (!scene.hull)
    return;
  if (scene.hull->along_m)
    check_ends("hull.along_m", *scene.hull->along_m);
  for (const OpeningRow& row : scene.hull->opening_table)
    if (row.port_rad != row.starboard_rad)
      no("hull.opening_table", fmt::format("{}, {}", row.port_rad, row.starboard_rad), "the same on both sides");
}

}  // namespace

void check_space(const SceneDescription& scene)
{
  if (!scene.space) {
    check_plane(scene);
    return;
  }
  const Vec2& along = scene.space->along_m;
  const double cell = scene.grid.cell_size_m, cells = (along[1] - along[0]) / cell;
  if (!(along[1] > along[0]))
    refuse("space.along_m", to_text(along), "must be [from, to] with from below to");
  if (std::round(cells) < 1.0 || std::abs(cells - std::round(cells)) > cell_tolerance)
    refuse("space.along_m", to_text(along),
           fmt::format("must be a whole number of cells of grid.cell_size_m = {}, is {}", number_text(cell),
                       number_text(cells)));
  const Vec2 section = (scene.grid.upper_m - scene.grid.lower_m) / cell;
  if (cells * section[0] * section[1] > max_cells)
    refuse(
        "grid.cell_size_m", number_text(cell),
        fmt::format("gives {:.3g} cells; a grid may have at most {:.0e}", cells * section[0] * section[1], max_cells));
  for (const auto& [name, body] : scene.bodies) {
    const std::string key = "bodies." + name + ".along_m";
    if (!body.along_m)
      refuse(key, "nothing", "must be given in a scene with `space`");
    check_stretch(key, *body.along_m, along, "space.along_m", cell);
  }
  if (scene.hull && scene.hull->along_m)
    check_stretch("hull.along_m", *scene.hull->along_m, along, "space.along_m", cell);
  check_left_out(scene);
  if (scene.space->symmetry != Symmetry::none)
    check_symmetry(scene);
}

}  // namespace geocontainer_mpm::scene
