#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "description_leaf.h"
#include "description_rules.h"
#include "description_shapes.h"

namespace geocontainer_mpm::scene {

namespace {

using grammar::number_text;
using grammar::refuse;
using grammar::to_text;

/// Whether some line of the grid's nodes lies in the range, in one direction.
bool holds_nodes(const SupportDescription& support, const GridDescription& grid, int direction)
{
  const double last = std::round((grid.upper_m[direction] - grid.lower_m[direction]) / grid.cell_size_m);
  const auto cells = [&](const Vec2& point) { return (point[direction] - grid.lower_m[direction]) / grid.cell_size_m; };
  const double from = std::max(0.0, std::ceil(cells(support.region.lower_m) - cell_tolerance));
  const double to = std::min(last, std::floor(cells(support.region.upper_m) + cell_tolerance));
  return from <= to;
}

void check_support(const std::string& key, const SupportDescription& support, const GridDescription& grid)
{
  const Region& region = support.region;
  if (!((region.upper_m - region.lower_m).minCoeff() >= 0.0))
    refuse(key + ".region.upper_m", to_text(region.upper_m), "must not lie below lower_m = " + to_text(region.lower_m));
  if (!support.holds_y && !support.holds_z)
    refuse(key, "holds_y and holds_z false", "must hold at least one direction");
  if (!holds_nodes(support, grid, 0) || !holds_nodes(support, grid, 1))
    refuse(key + ".region", fmt::format("{} to {}", to_text(region.lower_m), to_text(region.upper_m)),
           fmt::format("must hold nodes of the grid, which stand every {} m from {} to {}",
                       number_text(grid.cell_size_m), to_text(grid.lower_m), to_text(grid.upper_m)));
  for (std::size_t i = 0; i < support.velocity_table.size(); ++i) {
    const TableRow<2>& row = support.velocity_table[i];
    for (const auto& [held, value, name] :
         { std::tuple(support.holds_y, row.value[0], "y"), std::tuple(support.holds_z, row.value[1], "z") })
      if (!held && value != 0.0)
        refuse(fmt::format("{}.velocity_table[{}]", key, i), number_text(value),
               fmt::format("must be 0 in {}, which holds_{} leaves free", name, name));
  }
}

void check_traction(const std::string& key, const TractionDescription& traction, const SceneDescription& scene)
{
  const BodyDescription& body = entry_of(scene.bodies, traction.body, key + ".body", "bodies");
  if (traction.traction_pa == Vec2::Zero() && traction.pressure_pa == 0.0)
    refuse(key, "traction_pa and pressure_pa 0", "must give a traction_pa or a pressure_pa");
  if (!traction.region)
    return;
  const Region& region = *traction.region;
  if (!((region.upper_m - region.lower_m).minCoeff() > 0.0))
    refuse(key + ".region.upper_m", to_text(region.upper_m), "must lie above lower_m = " + to_text(region.lower_m));
  const auto box = extent(body.shape);
  if (box && !box->intersects(Eigen::AlignedBox2d(region.lower_m, region.upper_m)))
    refuse(key + ".region", fmt::format("{} to {}", to_text(region.lower_m), to_text(region.upper_m)),
           fmt::format("must meet {}, which spans {} to {}", traction.body, to_text(Vec2(box->min())),
                       to_text(Vec2(box->max()))));
}

}  // namespace

void check_loads(const SceneDescription& scene)
{
  for (const auto& [name, support] : scene.supports)
    check_support("supports." + name, support, scene.grid);
  for (const auto& [name, traction] : scene.tractions)
    check_traction("tractions." + name, traction, scene);
}

void check_contacts(const SceneDescription& scene)
{
  const std::vector<std::string> fields = scene.velocity_fields();
  std::string all;
  for (const std::string& field : fields)
    all += (all.empty() ? "" : ", ") + field;
  std::map<std::pair<std::string, std::string>, std::string> named;
  for (const auto& [name, contact] : scene.contacts) {
    const std::string key = "contacts." + name + ".between";
    if (fields.size() < 2)
      refuse("contacts." + name, "", "bodies and sheets move in one velocity field, " + all + ": it touches no other");
    for (const std::string& field : contact.between)
      if (std::find(fields.begin(), fields.end(), field) == fields.end())
        refuse(key, field, "must be velocity fields of bodies and sheets: " + all);
    if (contact.between[0] == contact.between[1])
      refuse(key, to_text(contact.between), "must be two different velocity fields of " + all);
    const auto [other, is_new] = named.emplace(std::minmax(contact.between[0], contact.between[1]), name);
    if (!is_new)
      refuse(key, to_text(contact.between), "is named by " + other->second + " already");
  }
  for (std::size_t i = 0; i < fields.size(); ++i)
    for (std::size_t j = i + 1; j < fields.size(); ++j)
      if (named.count({ fields[i], fields[j] }) == 0)
        refuse("contacts", fmt::format("nothing between {} and {}", fields[i], fields[j]),
               "must name each pair of the velocity fields " + all + " once");
}

}  // namespace geocontainer_mpm::scene
