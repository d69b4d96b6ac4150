#include <algorithm>

#include <fmt/format.h>

#include "description_leaf.h"
#include "description_rules.h"

namespace geocontainer_mpm::scene {

using grammar::number_text;
using grammar::refuse;
using grammar::to_text;

void check_water(const SceneDescription& scene)
{
  if (!scene.water)
    return;
  const WaterDescription& water = *scene.water;
  if (scene.bodies.empty())
    refuse("water", "", "must not be given in a scene without bodies: it acts on nothing else");
  if (!scene.gravity_table.empty())
    refuse("gravity_table", "", "must not be given in a scene with water, whose gravity is constant");
  const Vec2& gravity = scene.gravity_m_per_s2;
  if (gravity[0] != 0.0 || !(gravity[1] < 0.0))
    refuse("gravity_m_per_s2", to_text(gravity), "must point along -z in a scene with water");
  const char *wanted = scene.hull ? "draught_m" : "level_m", *other = scene.hull ? "level_m" : "draught_m";
  const std::optional<double>&given = scene.hull ? water.draught_m : water.level_m,
        &refused = scene.hull ? water.level_m : water.draught_m;
  if (refused)
    refuse(
        std::string("water.") + other, number_text(*refused),
        fmt::format("must not be given in a scene {} hull: give water.{}", scene.hull ? "with a" : "without", wanted));
  if (!given)
    refuse(std::string("water.") + wanted, "nothing",
           fmt::format("must be given in a scene {} hull", scene.hull ? "with a" : "without"));
  if (!scene.hull)
    return;
  double deck = scene.hull->port_section_m.front()[1];
  for (const Vec2& corner : scene.hull->port_section_m)
    deck = std::max(deck, corner[1]);
  if (scene.water_level_m() > deck)
    refuse("water.draught_m", number_text(*water.draught_m),
           fmt::format("must be at most the hull's height of {} m",
                       number_text(deck - scene.water_level_m() + *water.draught_m)));
}

}  // namespace geocontainer_mpm::scene
