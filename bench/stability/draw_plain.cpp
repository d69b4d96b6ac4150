#include "families.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "draw_parts.h"

namespace geocontainer_mpm::stability {

/// A column that falls apart between the faces of the grid.
std::string draw_column(Chance& c)
{
  const Space space{ 0.1, 30, 14 };
  Solid solid = any_solid(c, 1e5, 1e8);
  std::string text = "name: column\n" + time_text(std::min(1.5, 4000.0 * space.dx / solid.wave_speed()));
  const char* bottom = c.any_of({ "roller", "fixed" });
  const char* sides = c.any_of({ "roller", "fixed" });
  text += grid_text(space, sides, bottom);
  const std::string sand = solid_text(c, "sand", solid, true);
  text += numerics_text(c, c.one_in(2), Touching::no);
  text += "materials:\n" + sand;
  const bool k0 = c.any_of({ "none", "none", "k0" }) == std::string("k0");
  const std::string particles = particles_text(c, 4);
  const double height = c.between(3.0, 10.0) * space.dx, width = c.between(3.0, 7.0) * space.dx;
  return text + fmt::format(
                    "bodies:\n  column:\n    material: sand\n    shape: {{ box: {{ lower_m: [0, 0], upper_m: {} }} }}\n"
                    "    particles_per_cell: {}\n    initial_stress: {}\n",
                    point(width, height), particles, k0 ? "k0\n    k0: 1.0" : "none");
}

/// Bodies of unlike weight and stiffness in velocity fields of their own, on each other or against each other.
std::string draw_stack(Chance& c)
{
  const Space space{ 0.1, 20, 26 };
  double gravity = 0.0;
  const std::string gravity_line = gravity_text(c, 20.0, gravity);
  Solid low = any_solid(c, 1e5, 1e8), high = any_solid(c, 1e5, 1e8);
  high.density = low.density * c.over_decades(1e-3, 1e3);
  carry(high, high.density * gravity * 6.0 * space.dx);
  carry(low, (low.density + high.density) * gravity * 6.0 * space.dx);
  const double slowest = std::min(low.wave_speed(), high.wave_speed());
  const double fastest = std::max(low.wave_speed(), high.wave_speed());
  std::string text = "name: stack\n" + gravity_line +
                     time_text(std::min({ 1.0, 4000.0 * space.dx / fastest, 400.0 * space.dx / slowest }));
  text += grid_text(space, "roller", "free");
  text += numerics_text(c, false, Touching::yes);
  const std::string upper = solid_text(c, "upper", high, false), lower = solid_text(c, "lower", low, false);
  text += "materials:\n" + lower + upper;
  const bool apart = c.one_in(1.5);
  const double width = c.between(5.0, 9.0), height = c.between(3.0, 6.0), top = 4.0 + height;
  const double speed = std::min(0.05 * slowest, 5.0);
  const auto body = [&](const char* name, double z, double v) {
    const double aside = c.between(-0.3, 0.3) * v;
    const std::string particles = particles_text(c, 4);
    return fmt::format(
        "  {0}:\n    material: {0}\n    shape: {{ {1} }}\n    particles_per_cell: {2}\n"
        "    initial_velocity_m_per_s: {3}\n{4}",
        name, shape_text(c, space, 10.0 - 0.5 * width, z, width, height), particles, point(aside, v),
        apart ? fmt::format("    velocity_field: {}\n", name) : "");
  };
  const std::string on_top = body("upper", top + c.any_of({ 0.0, 0.0, 0.5, 1.3 }), -speed);
  text += "bodies:\n" + body("lower", 4.0, 0.0) + on_top;
  if (apart)
    text += fmt::format("contacts:\n  both:\n    between: [lower, upper]\n    friction: {}\n", any_friction(c));
  return text + "surfaces:\n" + floor_text(c, space, 4.0, 0.0);
}

/// A bar held at one end and pulled, pushed or shaken at the other.
std::string draw_bar(Chance& c)
{
  const Space space{ 0.1, 30, 14 };
  Solid solid = any_solid(c, 1e5, 1e9);
  const double end_s = 1500.0 * space.dx / solid.wave_speed();
  const double stress = c.over_decades(1e-6, 0.1) * solid.young;
  std::string text = "name: bar\ngravity_m_per_s2: [0, 0]\n" + time_text(end_s) + grid_text(space, "free", "free");
  const std::string steel = solid_text(c, "steel", solid, false);
  text += numerics_text(c, false, Touching::yes);
  text += "materials:\n" + steel;
  const std::string particles = particles_text(c, 4);
  const double end = 1.9 + c.between(0.0, 0.2), bottom = 0.5 + c.between(0.0, 0.1);
  text += fmt::format(
      "bodies:\n  bar:\n    material: steel\n    shape: {{ box: {{ lower_m: {}, upper_m: {} }} }}\n"
      "    particles_per_cell: {}\n",
      point(0.4, bottom), point(end, 0.85), particles);
  text += fmt::format("supports:\n  root:\n    region: {{ lower_m: [0, 0], upper_m: {} }}\n", point(0.5, 1.4));
  if (c.one_in(3)) {
    const double up = c.between(-1.0, 1.0), along = c.between(-1.0, 1.0);
    text += fmt::format("    velocity_table: [[0, 0, 0], [{:.9g}, {:.6g}, {:.6g}], [{:.9g}, 0, 0]]\n", 0.1 * end_s,
                        along * 0.3 / end_s, up * 0.3 / end_s, 0.3 * end_s);
  }
  const int last = c.any_of({ 1, 0, -1 });
  const double full_s = c.between(0.0, 0.3) * end_s + 1e-9, pressure = c.between(-1.0, 1.0) * stress;
  const double up = c.between(-0.05, 0.05) * stress, along = c.between(-1.0, 1.0) * stress;
  text += fmt::format(
      "tractions:\n  pull:\n    body: bar\n    region: {{ lower_m: [1.75, 0], upper_m: [2.5, 1.4] }}\n"
      "    traction_pa: {}\n    pressure_pa: {:.6g}\n    table: [[0, 0], [{:.9g}, 1], [{:.9g}, {}]]\n",
      point(along, up), pressure, full_s, 0.5 * end_s, last);
  return text;
}

/// A slurry at rest or breaking loose.
std::string draw_fluid(Chance& c)
{
  const Space space{ 0.1, 24, 12 };
  const double density = c.between(1000.0, 2000.0), bulk = c.over_decades(1e5, 1e8);
  const bool bingham = c.one_in(2);
  std::string text = "name: fluid\n" + time_text(std::min(1.0, 3000.0 * space.dx / std::sqrt(bulk / density)));
  const std::string numerics = numerics_text(c, false, Touching::no);
  const char* bottom = c.any_of({ "roller", "fixed" });
  const char* sides = c.any_of({ "roller", "fixed" });
  text += grid_text(space, sides, bottom) + numerics;
  text += fmt::format(
      "materials:\n  slurry:\n    law: {}\n    density_kg_per_m3: {:.6g}\n    bulk_modulus_pa: {:.6g}\n"
      "    viscosity_pa_s: {:.6g}\n",
      bingham ? "bingham" : "newtonian", density, bulk, c.one_in(4) ? 0.0 : c.over_decades(1e-3, 1e3));
  if (bingham) {
    const double regularisation = c.over_decades(0.1, 10.0), yield = c.over_decades(1.0, 1e4);
    text += fmt::format("    yield_stress_pa: {:.6g}\n    regularisation_rate_per_s: {:.6g}\n", yield, regularisation);
  }
  const bool full = c.one_in(3);  // from wall to wall: at rest
  const bool hydrostatic = c.one_in(2);
  const std::string particles = particles_text(c, 4);
  const double height = c.between(0.3, 0.9), width = full ? 2.4 : c.between(0.4, 1.2);
  return text +
         fmt::format(
             "bodies:\n  slurry:\n    material: slurry\n    shape: {{ box: {{ lower_m: [0, 0], upper_m: {} }} }}\n"
             "    particles_per_cell: {}\n    initial_stress: {}\n",
             point(width, height), particles, hydrostatic ? "hydrostatic" : "none");
}

/// A few particles that lie still, or should: as many steps as anyone takes.
std::string draw_rest(Chance& c, double steps)
{
  const Space space{ 0.1, 4, 4 };
  Solid solid = any_solid(c, 1e6, 1e7);
  std::string text = "name: rest\n" + time_text(steps * 0.3 * space.dx / solid.wave_speed());
  const std::string numerics = numerics_text(c, false, Touching::no);
  text += grid_text(space, "roller", c.any_of({ "roller", "fixed" })) + numerics;
  text += "materials:\n" + solid_text(c, "block", solid, false);
  const bool k0 = solid.frictional && c.one_in(2);
  const int particles = c.whole(1, 2);
  const double height = c.any_of({ 0.1, 0.2, 0.15 });
  return text +
         fmt::format(
             "bodies:\n  block:\n    material: block\n    shape: {{ box: {{ lower_m: [0, 0], upper_m: [0.4, {}] }} }}\n"
             "    particles_per_cell: {}\n    initial_stress: {}\n",
             height, particles, k0 ? "k0\n    k0: 1.0" : "none");
}

}  // namespace geocontainer_mpm::stability
