#include <fmt/format.h>

#include "description_leaf.h"
#include "description_rules.h"

namespace geocontainer_mpm::scene {

namespace {

using grammar::number_text;
using grammar::refuse;
using grammar::to_text;

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
  check_rounding("hull.lip_radius_m", hull.lip_radius_m, hull.port_section_m, "port_section_m");
  check_opening_table(hull);
  if (hull.full_opening() > hull.signal.max_angle_rad)
    refuse("hull.full_opening_rad", number_text(hull.full_opening()),
           fmt::format("must not exceed hull.signal.max_angle_rad = {}", number_text(hull.signal.max_angle_rad)));
}

void check_surface(const std::string& key, const SurfaceDescription& surface)
{
  if (surface.closed && surface.line_m.size() < 3)
    refuse(key + ".line_m", fmt::format("{} given", surface.line_m.size()), "a closed line has at least 3 points");
  check_simple(key + ".line_m", surface.line_m, surface.closed);
  if (!surface.closed)
    check_rounding(key + ".corner_radius_m", surface.corner_radius_m, surface.line_m, "line_m");
}

}  // namespace

void check_boundaries(const SceneDescription& scene)
{
  if (scene.hull)
    check_hull(*scene.hull);
  for (const auto& [name, surface] : scene.surfaces) {
    if (name.compare(0, 5, "hull_") == 0)
      refuse("surfaces." + name, "", "names that begin with hull_ are kept for parts of the hull");
    check_surface("surfaces." + name, surface);
  }
}

}  // namespace geocontainer_mpm::scene
