#include <fmt/format.h>

#include "description_leaf.h"
#include "description_rules.h"
#include "description_shapes.h"
#include "geocontainer_mpm/scene/prescribed_motion.h"

namespace geocontainer_mpm::scene {

namespace {

using grammar::refuse;
using grammar::to_text;

void check_point(const std::string& key, const PointProbe& probe, const SceneDescription& scene)
{
  const BodyDescription& body = entry_of(scene.bodies, probe.body, key + ".body", "bodies");
  check_inside(key + ".at_m", { probe.at_m, probe.at_m }, scene.grid);
  const auto box = extent(body.shape);
  const Vec2 margin = Vec2::Constant(cell_tolerance * scene.grid.cell_size_m);
  if (box && !Eigen::AlignedBox2d(box->min() - margin, box->max() + margin).contains(probe.at_m))
    refuse(key + ".at_m", to_text(probe.at_m),
           fmt::format("must lie in {}, which spans {} to {}", probe.body, to_text(Vec2(box->min())),
                       to_text(Vec2(box->max()))));
}

void check_section(const std::string& key, const SectionProbe& probe, const GridDescription& grid)
{
  if (probe.from_m == probe.to_m)
    refuse(key + ".to_m", to_text(probe.to_m), "must differ from from_m: a cut has a length");
  Eigen::AlignedBox2d box(probe.from_m);
  box.extend(probe.to_m);
  if (!space_of(grid).intersects(box))
    refuse(key, fmt::format("{} to {}", to_text(probe.from_m), to_text(probe.to_m)),
           fmt::format("must cut the grid, {} to {}", to_text(grid.lower_m), to_text(grid.upper_m)));
}

void check_surface_name(const std::string& key, const std::string& name, const SceneDescription& scene)
{
  if (scene.surfaces.count(name) > 0)
    return;
  std::string parts;
  for (const HullPart& part : hull_parts(scene)) {
    if (part.name == name)
      return;
    parts += (parts.empty() ? "; or " : " or ") + part.name;
  }
  refuse(key, name, fmt::format("must be a name in surfaces: {}{}", names_in(scene.surfaces), parts));
}

void check_probe(const std::string& key, const ProbeDescription& probe, const SceneDescription& scene)
{
  check_choice(key,
               { { "point", probe.point.has_value() },
                 { "body", probe.body.has_value() },
                 { "section", probe.section.has_value() },
                 { "geotextile", probe.geotextile.has_value() },
                 { "surface", probe.surface.has_value() },
                 { "manufactured", probe.manufactured.has_value() } },
               1, 1);
  if (probe.point)
    check_point(key + ".point", *probe.point, scene);
  if (probe.body)
    entry_of(scene.bodies, *probe.body, key + ".body", "bodies");
  if (probe.section)
    check_section(key + ".section", *probe.section, scene.grid);
  if (probe.geotextile) {
    entry_of(scene.geotextiles, probe.geotextile->geotextile, key + ".geotextile.name", "geotextiles");
    if (const auto& point = probe.geotextile->at_m)
      check_inside(key + ".geotextile.at_m", { *point, *point }, scene.grid);
  }
  if (probe.surface)
    check_surface_name(key + ".surface", *probe.surface, scene);
  if (probe.manufactured && !entry_of(scene.bodies, *probe.manufactured, key + ".manufactured", "bodies").manufactured)
    refuse(key + ".manufactured", *probe.manufactured, "must be a body with the section manufactured");
}

}  // namespace

void check_probes(const SceneDescription& scene)
{
  for (const auto& [name, probe] : scene.probes)
    check_probe("probes." + name, probe, scene);
}

}  // namespace geocontainer_mpm::scene
