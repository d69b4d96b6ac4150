#include "geocontainer_mpm/scene/design_rules.h"

#include <algorithm>
#include <cmath>

#include "geocontainer_mpm/scene/shapes.h"

namespace geocontainer_mpm::scene {
namespace {

constexpr double rectangle_factor = 2.0;
constexpr double cur_factor = 2.5;
constexpr double cur_tension_factor = 0.45;
const char* const cur = "Bezuijen & Vastenburg, Geosystems (CUR 217), formula ";

using Input = DesignRule::Input;

Input fill_area(const ContainerData& c)
{
  return { "A", c.fill_area_m2, "m2" };
}

Input slot_width(const ContainerData& c)
{
  return { "b0", c.slot_width_m, "m" };
}

Input circumference(const ContainerData& c)
{
  return { "S", c.circumference_m, "m" };
}

Input density(const ContainerData& c)
{
  return { "rho", c.density_kg_per_m3, "kg/m3" };
}

Input water_density(const ContainerData& c)
{
  return { "rho_w", c.water.density_kg_per_m3, "kg/m3", c.water.assumed };
}

Input gravity(const ContainerData& c)
{
  return { "g", c.gravity_m_per_s2, "m/s2" };
}

/// No slot, no answer.
std::optional<double> needed_circumference(double factor, const ContainerData& c)
{
  if (c.slot_width_m <= 0.0)
    return std::nullopt;
  return circumference_for_slot_m(factor, c.fill_area_m2, c.slot_width_m);
}

void add_geometry(const ContainerData& c, std::vector<DesignRule>& rules)
{
  rules.push_back({ "circumference_needed",
                    needed_circumference(cur_factor, c),
                    "m",
                    "2.5 (b + A / b), b = min(b0, sqrt A)",
                    std::string(cur) + "(6.2)",
                    { fill_area(c), slot_width(c) } });
  rules.push_back({ "circumference_of_rectangle",
                    needed_circumference(rectangle_factor, c),
                    "m",
                    "2 (b + A / b), b = min(b0, sqrt A)",
                    "perimeter of a rectangle of area A that fills the slot",
                    { fill_area(c), slot_width(c) } });
  rules.push_back({ "slot_needed",
                    slot_for_circumference_m(cur_factor, c.fill_area_m2, c.circumference_m),
                    "m",
                    "b with 2.5 (b + A / b) = S",
                    std::string(cur) + "(6.2), solved for the slot",
                    { fill_area(c), circumference(c) } });
}

void add_tension(const ContainerData& c, std::vector<DesignRule>& rules)
{
  const double submerged_pa = (c.density_kg_per_m3 - c.water.density_kg_per_m3) * c.gravity_m_per_s2;
  rules.push_back({ "tension_opening",
                    cur_tension_factor * submerged_pa * c.fill_area_m2,
                    "N/m",
                    "0.45 (rho - rho_w) g A",
                    std::string(cur) + "(6.3): the fill weighs as under water",
                    { density(c), water_density(c), gravity(c), fill_area(c) } });

  // The whole container hangs on the sheet's two legs in the slot, friction on the hull takes nothing.
  const double sheet_n_per_m = c.sheet_mass_kg_per_m2 * c.circumference_m * c.gravity_m_per_s2;
  const double fill_n_per_m =
      c.water.assumed ? c.density_kg_per_m3 * c.gravity_m_per_s2 * c.fill_area_m2 : submerged_pa * c.fill_area_m2;
  std::vector<Input> inputs{
    density(c), gravity(c), fill_area(c), { "m", c.sheet_mass_kg_per_m2, "kg/m2" }, circumference(c)
  };
  if (!c.water.assumed)
    inputs.push_back(water_density(c));
  rules.push_back({ "tension_hanging", 0.5 * (fill_n_per_m + sheet_n_per_m), "N/m",
                    c.water.assumed ? "(rho A + m S) g / 2" : "((rho - rho_w) A + m S) g / 2",
                    std::string("equilibrium: all of the weight hangs still on two vertical legs; ") +
                        (c.water.assumed ? "in air, as the scene has no water" : "submerged"),
                    std::move(inputs) });
}

void add_fall(const ContainerData& c, std::vector<DesignRule>& rules)
{
  const bool sinks = c.density_kg_per_m3 > c.water.density_kg_per_m3 && c.water.drag_coefficient > 0.0;
  const double width_m = std::sqrt(c.fill_area_m2);
  std::optional<double> velocity;
  if (sinks)
    velocity = terminal_velocity_m_per_s(c.fill_area_m2 / width_m, c.density_kg_per_m3, c.gravity_m_per_s2, c.water);
  rules.push_back(
      { "terminal_velocity",
        velocity,
        "m/s",
        "sqrt(2 (rho - rho_w) / rho_w g A / (b Cd)), b = sqrt A",
        std::string(cur) + "(6.9): submerged weight = drag; width taken as that of a square of the fill's area",
        { density(c),
          water_density(c),
          gravity(c),
          fill_area(c),
          { "Cd", c.water.drag_coefficient, "1", c.water.assumed } } });
}

double fill_area_m2(const BodyDescription& body, const SceneDescription& scene)
{
  double area_m2 = 0.0;
  for (const std::vector<Vec2>& line : boundary_lines(body.shape, scene.hull, scene.grid.cell_size_m))
    area_m2 += polygon_area(line);
  return area_m2;
}

}  // namespace

double circumference_for_slot_m(double factor, double fill_area_m2, double slot_width_m)
{
  const double width_m = std::min(slot_width_m, std::sqrt(fill_area_m2));
  return factor * (width_m + fill_area_m2 / width_m);
}

std::optional<double> slot_for_circumference_m(double factor, double fill_area_m2, double circumference_m)
{
  // b^2 - (S / factor) b + A = 0, the smaller root.
  const double half_m = 0.5 * circumference_m / factor;
  const double under_root_m2 = half_m * half_m - fill_area_m2;
  if (under_root_m2 < 0.0)
    return std::nullopt;
  return half_m - std::sqrt(under_root_m2);
}

double terminal_velocity_m_per_s(double volume_over_area_m, double density_kg_per_m3, double gravity_m_per_s2,
                                 const DesignWater& water)
{
  const double relative_density = (density_kg_per_m3 - water.density_kg_per_m3) / water.density_kg_per_m3;
  return std::sqrt(2.0 * relative_density * gravity_m_per_s2 * volume_over_area_m / water.drag_coefficient);
}

std::vector<ContainerData> container_data(const SceneDescription& scene, double slot_width_m)
{
  std::vector<ContainerData> all;
  if (!scene.hull)
    return all;
  for (const auto& [name, sheet] : scene.geotextiles) {
    if (sheet.encloses.empty())
      continue;
    const BodyDescription& body = scene.bodies.at(sheet.encloses);
    ContainerData container;
    container.name = name;
    container.fill_area_m2 = fill_area_m2(body, scene);
    container.circumference_m = unstretched_length(sheet, sheet_layout(sheet, scene));
    container.density_kg_per_m3 = scene.materials.at(body.material).density_kg_per_m3;
    container.sheet_mass_kg_per_m2 = sheet.mass_kg_per_m2;
    container.slot_width_m = slot_width_m;
    container.gravity_m_per_s2 = scene.gravity_at(scene.time.end_s).norm();
    if (scene.water)
      container.water = { scene.water->density_kg_per_m3, scene.water->drag_coefficient, false };
    all.push_back(container);
  }
  return all;
}

std::vector<DesignRule> design_rules(const ContainerData& container)
{
  std::vector<DesignRule> rules;
  add_geometry(container, rules);
  add_tension(container, rules);
  add_fall(container, rules);
  return rules;
}

}  // namespace geocontainer_mpm::scene
