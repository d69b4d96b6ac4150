#include <fmt/format.h>

#include <cmath>

#include "description_leaf.h"
#include "description_rules.h"
#include "description_shapes.h"

namespace geocontainer_mpm::scene {

namespace {

using grammar::number_text;
using grammar::refuse;
using grammar::to_text;

constexpr double pi = 3.14159265358979323846;

geotextile::ForceStrain law_of(const GeotextileDescription& sheet)
{
  return geotextile::ForceStrain(sheet.stiffness_n_per_m, sheet.force_strain_table);
}

bool is_open(const GeotextileDescription& sheet)
{
  return sheet.line && !sheet.line->closed;
}

void check_line(const std::string& key, const SheetLine& line, const GridDescription& grid)
{
  if (line.closed && line.points_m.size() < 3)
    refuse(key + ".points_m", fmt::format("{} given", line.points_m.size()), "a closed line has at least 3 points");
  check_simple(key + ".points_m", line.points_m, line.closed);
  Eigen::AlignedBox2d box;
  for (const Vec2& point : line.points_m)
    box.extend(point);
  check_inside(key + ".points_m", box, grid);
}

/// Length of the path along which the sheet is laid, m; unset where the hull decides.
std::optional<double> path_length(const GeotextileDescription& sheet, const SceneDescription& scene)
{
  if (sheet.line)
    return line_length(sheet.line->points_m, sheet.line->closed);
  if (sheet.circle)
    return 2.0 * pi * sheet.circle->radius_m;
  return outline_length(scene.bodies.at(sheet.encloses).shape);
}

std::optional<double> unstretched_length(const GeotextileDescription& sheet, std::optional<double> path)
{
  if (sheet.circumference_m)
    return sheet.circumference_m;
  if (path && sheet.slack)
    return *path * (1.0 + *sheet.slack);
  if (path && sheet.pretension_n_per_m)
    return *path / (1.0 + law_of(sheet).strain(*sheet.pretension_n_per_m));
  return path;
}

void check_lengths(const std::string& key, const GeotextileDescription& sheet, const SceneDescription& scene)
{
  const std::optional<double> path = path_length(sheet, scene);
  if (sheet.circumference_m && path && *sheet.circumference_m < *path * (1.0 - relative_tolerance))
    refuse(key + ".circumference_m", number_text(*sheet.circumference_m),
           fmt::format("must be at least {}, {:.6g} m; a tighter sheet is given by pretension_n_per_m",
                       sheet.encloses.empty() ? "the length of the path" : "the outline of " + sheet.encloses, *path));
  const std::optional<double> length = unstretched_length(sheet, path);
  const int segments = is_open(sheet) ? 1 : 3;
  if (length && sheet.segment_length_m > *length / segments * (1.0 + relative_tolerance))
    refuse(key + ".segment_length_m", number_text(sheet.segment_length_m),
           fmt::format("must be at most {:.6g}: the unstretched length of {:.6g} m makes {} segment{} or more",
                       *length / segments, *length, segments, segments > 1 ? "s" : ""));
  if (sheet.gauge_length_m < sheet.segment_length_m)
    refuse(key + ".gauge_length_m", number_text(sheet.gauge_length_m),
           "must be at least segment_length_m = " + number_text(sheet.segment_length_m));
  if (length && sheet.gauge_length_m > *length * (1.0 + relative_tolerance))
    refuse(key + ".gauge_length_m", number_text(sheet.gauge_length_m),
           fmt::format("must be at most the unstretched length, {:.6g} m", *length));
}

void check_region(const std::string& key, const Region& region)
{
  if (!((region.upper_m - region.lower_m).minCoeff() >= 0.0))
    refuse(key + ".upper_m", to_text(region.upper_m), "must not lie below lower_m = " + to_text(region.lower_m));
}

/// The sheet is laid where its ends are at time 0.
void check_end(const std::string& key, const SheetEnd& end)
{
  if (!end.held || end.motion_table.empty())
    return;
  const std::array<double, 2> start = value_at(end.motion_table, 0.0);
  if (start[0] != 0.0 || start[1] != 0.0)
    refuse(key + ".motion_table", fmt::format("[{}, {}] at time 0", number_text(start[0]), number_text(start[1])),
           "must be [0, 0] at time 0, where the sheet is laid");
}

/// With one membrane point a cell there are motions of the grid that stretch the sheet and that no point feels: in
/// every case of docs/study/membranes.md the sheet then ran away.
void check_spacing(const std::string& key, const GeotextileDescription& sheet, const GridDescription& grid)
{
  const double most = 0.5 * grid.cell_size_m;
  if (sheet.formulation == geotextile::Formulation::membrane_points &&
      sheet.segment_length_m > most * (1.0 + relative_tolerance))
    refuse(key + ".segment_length_m", number_text(sheet.segment_length_m),
           "must be at most " + number_text(most) + ", half a cell, for membrane_points");
}

void check_strength(const std::string& key, const GeotextileDescription& sheet, const GridDescription& grid)
{
  if (sheet.rupture_strain && sheet.pretension_n_per_m) {
    const double strain = law_of(sheet).strain(*sheet.pretension_n_per_m);
    if (strain >= *sheet.rupture_strain)
      refuse(key + ".rupture_strain", number_text(*sheet.rupture_strain),
             fmt::format("must be more than the strain of pretension_n_per_m, {:.6g}", strain));
  }
  for (const auto& [name, seam] : sheet.seams) {
    const std::string seam_key = fmt::format("{}.seams.{}", key, name);
    check_choice(seam_key, { { "at_m", seam.at_m.has_value() }, { "along", seam.along.has_value() } }, 1, 1);
    if (seam.at_m)
      check_inside(seam_key + ".at_m", { *seam.at_m, *seam.at_m }, grid);
    const double strength = seam.efficiency.value_or(sheet.seam_efficiency) * sheet.strength_n_per_m;
    if (seam.tears && sheet.pretension_n_per_m.value_or(0.0) >= strength)
      refuse(seam_key + ".tears", "true",
             fmt::format("its strength, {:.6g} N/m, must be more than pretension_n_per_m", strength));
  }
}

void check_geotextile(const std::string& key, const GeotextileDescription& sheet, const SceneDescription& scene)
{
  check_choice(key,
               { { "encloses", !sheet.encloses.empty() },
                 { "line", sheet.line.has_value() },
                 { "circle", sheet.circle.has_value() } },
               1, 1);
  check_choice(key,
               { { "circumference_m", sheet.circumference_m.has_value() },
                 { "slack", sheet.slack.has_value() },
                 { "pretension_n_per_m", sheet.pretension_n_per_m.has_value() } },
               0, 1);
  if (!sheet.encloses.empty())
    entry_of(scene.bodies, sheet.encloses, key + ".encloses", "bodies");
  if (sheet.line)
    check_line(key + ".line", *sheet.line, scene.grid);
  if (sheet.circle) {
    const Vec2 radius = Vec2::Constant(sheet.circle->radius_m);
    check_inside(key + ".circle", { sheet.circle->center_m - radius, sheet.circle->center_m + radius }, scene.grid);
  }
  if (!sheet.velocity_field.empty())
    check_name(sheet.velocity_field, key + ".velocity_field", sheet.velocity_field);
  if (sheet.computational_mass_kg_per_m2 < sheet.mass_kg_per_m2)
    refuse(key + ".computational_mass_kg_per_m2", number_text(sheet.computational_mass_kg_per_m2),
           "must be >= mass_kg_per_m2 = " + number_text(sheet.mass_kg_per_m2));
  check_lengths(key, sheet, scene);
  check_spacing(key, sheet, scene.grid);
  check_strength(key, sheet, scene.grid);
  if (sheet.wrinkles)
    check_region(key + ".wrinkles.region", sheet.wrinkles->region);
  if (is_open(sheet)) {
    check_end(key + ".start", sheet.start);
    check_end(key + ".end", sheet.end);
  }
}

}  // namespace

void check_geotextiles(const SceneDescription& scene)
{
  std::map<std::string, std::string> sheet_around;
  for (const auto& [name, sheet] : scene.geotextiles) {
    const std::string key = "geotextiles." + name;
    check_geotextile(key, sheet, scene);
    if (sheet.encloses.empty())
      continue;
    const auto [other, is_new] = sheet_around.emplace(sheet.encloses, name);
    if (!is_new)
      refuse(key + ".encloses", sheet.encloses, "is enclosed by " + other->second + " already");
  }
  for (const auto& [name, sheet] : scene.geotextiles) {
    if (sheet.interface != SheetInterface::frictional)
      continue;
    const std::string& named = scene.bodies.at(sheet.encloses).velocity_field;
    const std::string field = named.empty() ? common_field : named;
    if (!scene.is_container(field))
      refuse("geotextiles." + name + ".interface", to_text(sheet.interface),
             fmt::format("needs the velocity field {} for {} and this sheet alone", field, sheet.encloses));
  }
}

}  // namespace geocontainer_mpm::scene
