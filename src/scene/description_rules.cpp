#include "description_rules.h"

#include <fmt/format.h>

#include <cmath>

#include "description_leaf.h"
#include "description_shapes.h"

namespace geocontainer_mpm::scene {

namespace {

using grammar::number_text;
using grammar::refuse;
using grammar::to_text;

constexpr double pi = 3.14159265358979323846;
/// Beyond this a scene is a slip of the pen (a cell size in millimetres) and would end in a crash for lack of memory.
constexpr double max_cells = 5e7;
constexpr double whole_cell_tolerance = 1e-6;
constexpr double relative_tolerance = 1e-9;
constexpr std::size_t min_segments = 8;

template <class Map>
std::string names(const Map& map)
{
  std::string text;
  for (const auto& entry : map)
    text += (text.empty() ? "" : ", ") + entry.first;
  return text.empty() ? "none" : text;
}

void check_grid(const GridDescription& grid)
{
  const Vec2 cells = (grid.upper_m - grid.lower_m) / grid.cell_size_m;
  for (int i = 0; i < 2; ++i) {
    if (!(cells[i] > 0.0))
      refuse("grid.upper_m", to_text(grid.upper_m), "must lie above grid.lower_m = " + to_text(grid.lower_m));
    if (std::round(cells[i]) < 1.0 || std::abs(cells[i] - std::round(cells[i])) > whole_cell_tolerance)
      refuse("grid.upper_m", to_text(grid.upper_m),
             fmt::format("the extent in {} must be a whole number of cells, is {} cells of {} m", i == 0 ? "y" : "z",
                         number_text(cells[i]), number_text(grid.cell_size_m)));
  }
  if (cells[0] * cells[1] > max_cells)
    refuse("grid.cell_size_m", number_text(grid.cell_size_m),
           fmt::format("gives {:.3g} cells; a grid may have at most {:.0e}", cells[0] * cells[1], max_cells));
}

void check_simple(const std::string& key, const std::vector<Vec2>& vertices, bool closed)
{
  const auto sides = crossing_sides(vertices, closed);
  if (!sides)
    return;
  if (sides->first == sides->second)
    refuse(key, to_text(vertices[sides->first]),
           fmt::format("points {} and {} are the same; a side needs a length", sides->first,
                       (sides->first + 1) % vertices.size()));
  refuse(key, fmt::format("sides {} and {} meet", sides->first, sides->second),
         "sides may meet only at the corner that neighbours share");
}

void check_shape(const std::string& key, const ShapeDescription& shape, const SceneDescription& scene)
{
  std::string given;
  const auto count = [&given](bool set, const char* name) {
    if (set)
      given += (given.empty() ? "" : ", ") + std::string(name);
    return set ? 1 : 0;
  };
  const int shapes = count(shape.box.has_value(), "box") + count(shape.disc.has_value(), "disc") +
                     count(shape.polygon.has_value(), "polygon") + count(shape.hopper_fill.has_value(), "hopper_fill");
  if (shapes != 1)
    refuse(key, given.empty() ? "nothing" : given, "must be exactly one of box, disc, polygon, hopper_fill");
  if (shape.box && !((shape.box->upper_m - shape.box->lower_m).minCoeff() > 0.0))
    refuse(key + ".box.upper_m", to_text(shape.box->upper_m),
           "must lie above lower_m = " + to_text(shape.box->lower_m));
  if (shape.polygon)
    check_simple(key + ".polygon.vertices_m", shape.polygon->vertices_m, true);
  if (shape.hopper_fill && !scene.hull)
    refuse(key + ".hopper_fill", "", "fills the hopper of a hull: the scene needs the section hull");
  const auto box = extent(shape);
  if (!box)
    return;
  const Vec2 margin = Vec2::Constant(whole_cell_tolerance * scene.grid.cell_size_m);
  if (!Eigen::AlignedBox2d(scene.grid.lower_m - margin, scene.grid.upper_m + margin).contains(*box))
    refuse(key, fmt::format("{} to {}", to_text(Vec2(box->min())), to_text(Vec2(box->max()))),
           fmt::format("must lie within the grid, {} to {}", to_text(scene.grid.lower_m), to_text(scene.grid.upper_m)));
}

/// A K0 beyond the passive or below the active state lies outside the Mohr-Coulomb cone (Rankine).
void check_k0(const std::string& key, const BodyDescription& body, const material::Parameters& material,
              const Vec2& gravity)
{
  if (body.initial_stress == InitialStress::none)
    return;
  if (gravity[0] != 0.0 || gravity[1] > 0.0)
    refuse(key + ".initial_stress", to_text(body.initial_stress),
           "needs gravity_m_per_s2 along -z, is " + to_text(gravity));
  if (body.initial_stress != InitialStress::k0 || material.law != material::LawName::mohr_coulomb ||
      material.cohesion_pa > 0.0)
    return;
  const double sine = std::sin(material.friction_angle_deg * pi / 180.0);
  const double active = (1.0 - sine) / (1.0 + sine);
  if (body.k0 < active * (1.0 - relative_tolerance) || body.k0 > (1.0 + relative_tolerance) / active)
    refuse(key + ".k0", number_text(body.k0),
           fmt::format("must lie between the active and passive states of {}, in [{:.4g}, {:.4g}]", body.material,
                       active, 1.0 / active));
}

void check_bodies(const SceneDescription& scene)
{
  if (scene.bodies.empty())
    refuse("bodies", "none", "must name at least one body");
  std::string in_hopper;
  for (const auto& [name, body] : scene.bodies) {
    const std::string key = "bodies." + name;
    const auto material = scene.materials.find(body.material);
    if (material == scene.materials.end())
      refuse(key + ".material", body.material, "must be a name in materials: " + names(scene.materials));
    check_shape(key + ".shape", body.shape, scene);
    check_k0(key, body, material->second, scene.gravity_m_per_s2);
    if (body.shape.hopper_fill && !in_hopper.empty())
      refuse(key + ".shape.hopper_fill", name, "the hopper is filled by " + in_hopper + " already");
    if (body.shape.hopper_fill)
      in_hopper = name;
  }
}

void check_geotextile(const std::string& key, const GeotextileDescription& sheet, const BodyDescription& body)
{
  if (sheet.computational_mass_kg_per_m2 < sheet.mass_kg_per_m2)
    refuse(key + ".computational_mass_kg_per_m2", number_text(sheet.computational_mass_kg_per_m2),
           "must be >= mass_kg_per_m2 = " + number_text(sheet.mass_kg_per_m2));
  if (sheet.segment_length_m > sheet.circumference_m / static_cast<double>(min_segments))
    refuse(key + ".segment_length_m", number_text(sheet.segment_length_m),
           fmt::format("must be at most circumference_m / {} = {}", min_segments,
                       number_text(sheet.circumference_m / static_cast<double>(min_segments))));
  if (sheet.gauge_length_m < sheet.segment_length_m || sheet.gauge_length_m > sheet.circumference_m)
    refuse(key + ".gauge_length_m", number_text(sheet.gauge_length_m),
           fmt::format("must lie between segment_length_m = {} and circumference_m = {}",
                       number_text(sheet.segment_length_m), number_text(sheet.circumference_m)));
  const auto outline = outline_length(body.shape);
  if (outline && sheet.circumference_m < *outline * (1.0 - relative_tolerance))
    refuse(key + ".circumference_m", number_text(sheet.circumference_m),
           fmt::format("must be at least the outline of {}, {:.6g} m", sheet.encloses, *outline));
}

void check_geotextiles(const SceneDescription& scene)
{
  std::map<std::string, std::string> sheet_around;
  for (const auto& [name, sheet] : scene.geotextiles) {
    const std::string key = "geotextiles." + name;
    const auto body = scene.bodies.find(sheet.encloses);
    if (body == scene.bodies.end())
      refuse(key + ".encloses", sheet.encloses, "must be a name in bodies: " + names(scene.bodies));
    const auto [other, is_new] = sheet_around.emplace(sheet.encloses, name);
    if (!is_new)
      refuse(key + ".encloses", sheet.encloses, "is enclosed by " + other->second + " already");
    check_geotextile(key, sheet, body->second);
  }
}

void check_opening_table(const HullDescription& hull)
{
  for (std::size_t i = 0; i < hull.opening_table.size(); ++i) {
    const OpeningRow& row = hull.opening_table[i];
    for (const double angle : { row.port_rad, row.starboard_rad })
      if (angle < hull.signal.min_angle_rad || angle > hull.signal.max_angle_rad)
        refuse(fmt::format("hull.opening_table[{}]", i), number_text(angle),
               fmt::format("angles must lie in [hull.signal.min_angle_rad, max_angle_rad] = [{}, {}]",
                           number_text(hull.signal.min_angle_rad), number_text(hull.signal.max_angle_rad)));
  }
}

void check_hull(const HullDescription& hull)
{
  const std::string key = "hull.port_section_m";
  for (std::size_t i = 0; i < hull.port_section_m.size(); ++i)
    if (hull.port_section_m[i][0] < 0.0)
      refuse(fmt::format("{}[{}]", key, i), to_text(hull.port_section_m[i]), "the port half has y >= 0");
  check_simple(key, hull.port_section_m, false);
  const Vec2& bottom = hull.port_section_m.front();
  const Vec2& deck = hull.port_section_m.back();
  if (!(deck[1] > bottom[1]))
    refuse(key, fmt::format("{} to {}", to_text(bottom), to_text(deck)),
           "must run from the bottom up to the deck, so that the free side is on the left");
  const std::vector<double> share = fillet_share(hull.port_section_m, hull.lip_radius_m);
  for (std::size_t i = 0; i < share.size(); ++i)
    if (share[i] > 1.0 + relative_tolerance)
      refuse("hull.lip_radius_m", number_text(hull.lip_radius_m),
             fmt::format("must fit side {} of port_section_m: at most {:.4g}", i, hull.lip_radius_m / share[i]));
  check_opening_table(hull);
}

void check_surfaces(const SceneDescription& scene)
{
  for (const auto& [name, surface] : scene.surfaces) {
    if (name == "hull_port" || name == "hull_starboard")
      refuse("surfaces." + name, "", "this name is kept for a half of the hull");
    check_simple("surfaces." + name + ".line_m", surface.line_m, false);
  }
}

}  // namespace

void check_rules(const SceneDescription& scene)
{
  check_grid(scene.grid);
  check_bodies(scene);
  check_geotextiles(scene);
  if (scene.hull)
    check_hull(*scene.hull);
  check_surfaces(scene);
}

}  // namespace geocontainer_mpm::scene
