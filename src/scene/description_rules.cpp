#include "description_rules.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string>

#include "description_leaf.h"
#include "description_shapes.h"

namespace geocontainer_mpm::scene {

namespace {

using grammar::number_text;
using grammar::refuse;
using grammar::to_text;

void check_grid(const GridDescription& grid)
{
  const Vec2 cells = (grid.upper_m - grid.lower_m) / grid.cell_size_m;
  for (int i = 0; i < 2; ++i) {
    if (!(cells[i] > 0.0))
      refuse("grid.upper_m", to_text(grid.upper_m), "must lie above grid.lower_m = " + to_text(grid.lower_m));
    if (std::round(cells[i]) < 1.0 || std::abs(cells[i] - std::round(cells[i])) > cell_tolerance)
      refuse("grid.upper_m", to_text(grid.upper_m),
             fmt::format("the extent in {} must be a whole number of cells, is {} cells of {} m", i == 0 ? "y" : "z",
                         number_text(cells[i]), number_text(grid.cell_size_m)));
  }
  if (cells[0] * cells[1] > max_cells)
    refuse("grid.cell_size_m", number_text(grid.cell_size_m),
           fmt::format("gives {:.3g} cells; a grid may have at most {:.0e}", cells[0] * cells[1], max_cells));
}

void check_method(const mpm::Discretisation& method)
{
  if (method.shape == mpm::Shape::linear_simplex && method.transfer != mpm::Transfer::flip)
    refuse("numerics.transfer", to_text(method.transfer),
           "must be flip with numerics.shape linear_simplex: apic keeps what nodes of next to no mass do, and gains "
           "energy");
  if (method.mass == mpm::MassMatrix::consistent && method.transfer != mpm::Transfer::flip)
    refuse("numerics.mass", to_text(method.mass), "needs numerics.transfer flip, is " + to_text(method.transfer));
}

}  // namespace

void check_name(const std::string& name, const std::string& key, const std::string& value)
{
  bool good = !name.empty() && std::isalpha(static_cast<unsigned char>(name.front()));
  for (const char c : name)
    good = good && (std::isalnum(static_cast<unsigned char>(c)) || c == '_');
  if (!good)
    refuse(key, value, "a name is a letter, then letters, digits and _");
}

void check_choice(const std::string& key, std::initializer_list<Choice> choices, int least, int most)
{
  std::string set, all;
  int count = 0;
  for (const auto& [name, is_set] : choices) {
    all += (all.empty() ? "" : ", ") + std::string(name);
    if (is_set)
      set += (count++ > 0 ? ", " : "") + std::string(name);
  }
  if (count < least || count > most)
    refuse(key, count > 0 ? set : "nothing",
           fmt::format("must have {} one of {}", least == most ? "exactly" : "at most", all));
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

void check_rounding(const std::string& key, double radius_m, const std::vector<Vec2>& line, const char* line_name)
{
  const std::vector<double> share = fillet_share(line, radius_m);
  for (std::size_t i = 0; i < share.size(); ++i)
    if (share[i] > 1.0 + relative_tolerance)
      refuse(key, number_text(radius_m),
             fmt::format("must fit side {} of {}: at most {:.4g}", i, line_name, radius_m / share[i]));
}

Eigen::AlignedBox2d space_of(const GridDescription& grid)
{
  const Vec2 margin = Vec2::Constant(cell_tolerance * grid.cell_size_m);
  return { grid.lower_m - margin, grid.upper_m + margin };
}

void check_inside(const std::string& key, const Eigen::AlignedBox2d& box, const GridDescription& grid)
{
  if (space_of(grid).contains(box))
    return;
  const bool is_point = box.min() == box.max();
  refuse(
      key,
      is_point ? to_text(Vec2(box.min())) : fmt::format("{} to {}", to_text(Vec2(box.min())), to_text(Vec2(box.max()))),
      fmt::format("must lie within the grid, {} to {}", to_text(grid.lower_m), to_text(grid.upper_m)));
}

/// Contact, supports and held ends act with lumped masses: beside a consistent one their impulses would make energy.
void check_consistent_mass(const SceneDescription& scene)
{
  if (scene.numerics.method.mass != mpm::MassMatrix::consistent)
    return;
  const bool held = std::any_of(scene.geotextiles.begin(), scene.geotextiles.end(),
                                [](const auto& sheet) { return sheet.second.start.held || sheet.second.end.held; });
  const bool slipping = std::any_of(scene.geotextiles.begin(), scene.geotextiles.end(), [](const auto& sheet) {
    return sheet.second.interface == SheetInterface::frictional;
  });
  const char* touching = scene.hull                ? "a hull"
                         : !scene.surfaces.empty() ? "surfaces"
                         : !scene.contacts.empty() ? "contacts"
                         : !scene.supports.empty() ? "supports"
                         : slipping                ? "a frictional interface of a geotextile"
                         : held                    ? "a held end of a geotextile"
                                                   : nullptr;
  if (touching)
    refuse("numerics.mass", to_text(scene.numerics.method.mass),
           std::string("must be lumped in a scene with ") + touching + ": they act with lumped masses");
}

void check_rules(const SceneDescription& scene)
{
  check_grid(scene.grid);
  check_method(scene.numerics.method);
  check_consistent_mass(scene);
  if (scene.bodies.empty() && scene.geotextiles.empty())
    refuse("bodies", "none", "must name at least one body, or geotextiles at least one sheet");
  check_bodies(scene);
  check_geotextiles(scene);
  check_boundaries(scene);
  check_loads(scene);
  check_contacts(scene);
  check_probes(scene);
  check_water(scene);
  check_space(scene);
}

}  // namespace geocontainer_mpm::scene
