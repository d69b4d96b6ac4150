#include "families.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "draw_parts.h"

namespace geocontainer_mpm::stability {

/// A bag of something, or the something alone, dropped on a floor.
std::string draw_drop(Chance& c)
{
  const Space space{ c.any_of({ 0.05, 0.1, 0.2 }), 24, 20 };
  double gravity = 0.0;
  const std::string gravity_line = gravity_text(c, 30.0, gravity);
  Solid solid = any_solid(c, 1e5, 1e8);
  const double width = c.between(4.0, 10.0), height = c.between(4.0, 8.0), bottom = c.between(4.0, 8.0);
  carry(solid, solid.density * gravity * height * space.dx);
  const bool bagged = c.one_in(1.5);
  const double fall_s = std::sqrt(2.0 * 8.0 * space.dx / std::max(gravity, 1.0));
  const double end_s = std::min(3.0 * fall_s, 3000.0 * space.dx / solid.wave_speed());
  std::string text = "name: drop\n" + gravity_line + time_text(end_s) + grid_text(space, "roller", "free");
  const std::string stuff = solid_text(c, "stuff", solid, bagged && c.one_in(2));
  text += numerics_text(c, false, Touching::yes);
  text += "materials:\n" + stuff;
  const double floor = bottom - (c.one_in(2) ? c.between(0.5, 2.0) : 0.0);
  const double down = c.between(-3.0, 0.0), aside = c.between(-1.0, 1.0);
  const std::string particles = particles_text(c, 4);
  text += fmt::format(
      "bodies:\n  load:\n    material: stuff\n    shape: {{ {} }}\n    particles_per_cell: {}\n"
      "    initial_velocity_m_per_s: {}\n",
      shape_text(c, space, 0.5 * (space.width - width), bottom, width, height), particles, point(aside, down));
  if (bagged) {
    const double around = 2.0 * std::min(width, height) * space.dx;  // not longer than any outline
    text += "geotextiles:\n  bag:\n    encloses: load\n";
    text += fmt::format("    slack: {:.4g}\n", c.any_of({ 0.0, 0.0, 0.02, 0.3, 1.5 }));
    text += sheet_text(c, space, solid, around, 4);
  }
  return text + "surfaces:\n" + floor_text(c, space, floor, c.one_in(3) ? c.between(0.3, 1.0) * end_s : 0.0);
}

/// A sheet on its own: a ring under pressure, or a string between held ends, with or without a weight thrown into it.
std::string draw_sheet(Chance& c)
{
  const Space space{ 0.1, 24, 24 };
  double gravity = 0.0;
  const std::string gravity_line = gravity_text(c, 30.0, gravity);
  Solid solid = any_solid(c, 1e4, 1e7);
  carry(solid, solid.density * gravity * 5.0 * space.dx);
  const double end_s = std::min(1.0, 3000.0 * space.dx / solid.wave_speed());
  std::string text = "name: sheet\n" + gravity_line + time_text(end_s) + grid_text(space, "roller", "roller");
  const std::string stuff = solid_text(c, "stuff", solid, false);
  text += numerics_text(c, false, Touching::yes);
  text += "materials:\n" + stuff;
  const bool ring = c.one_in(2), weight = !ring && c.one_in(1.5), apart = weight && c.one_in(2);
  if (weight) {
    const double down = c.between(0.0, 2.0);
    const std::string particles = particles_text(c, 4);
    text += fmt::format(
        "bodies:\n  weight:\n    material: stuff\n    shape: {{ {} }}\n    particles_per_cell: {}\n"
        "    initial_velocity_m_per_s: [0, {:.4g}]\n{}",
        shape_text(c, space, 9.5, 12.6, 5.0, 5.0), particles, -down, apart ? "    velocity_field: weight\n" : "");
  }
  text += "geotextiles:\n  sheet:\n";
  if (ring) {
    const double radius = c.between(3.0, 6.0) * space.dx;
    text += fmt::format("    circle: {{ center_m: {}, radius_m: {:.9g} }}\n", point(1.2, 1.2), radius);
    text += sheet_text(c, space, solid, 2.0 * pi * radius, 3);
    const double gradient = c.one_in(2) ? 0.0 : c.over_decades(10.0, 1e4);
    const double pressure = c.over_decades(1e-6, 1e-2) * solid.constrained();
    text += fmt::format("    inside_pressure:\n      pressure_pa: {:.6g}\n      gradient_pa_per_m: {:.6g}\n", pressure,
                        gradient);
    if (c.one_in(2))
      text += fmt::format("      table: [[0, 0], [{:.9g}, 1], [{:.9g}, 0.3]]\n", 0.2 * end_s, 0.8 * end_s);
    return text;
  }
  text += fmt::format("    line: {{ points_m: [{}, {}] }}\n", point(0.4, 1.2), point(2.0, 1.2));
  text += fmt::format("    slack: {:.4g}\n", c.any_of({ 0.0, 0.0, 0.05, 0.5 }));
  text += sheet_text(c, space, solid, 1.6, 1);
  text += "    start: { held: true }\n";
  if (c.one_in(2)) {
    text += "    end: { held: true }\n";
  } else {
    const double up = c.between(-0.3, 0.3), aside = c.between(-0.3, 0.1);
    text += fmt::format("    end:\n      held: true\n      motion_table: [[0, 0, 0], [{:.9g}, {}, {}]]\n", end_s, aside,
                        up);
  }
  if (apart)
    text += fmt::format("contacts:\n  touch:\n    between: [weight, common]\n    friction: {}\n", any_friction(c));
  return text;
}

/// A container in a split hull, the default release in small and coarse, opened up to 50 times as fast.
std::string draw_release(Chance& c)
{
  const double dx = c.any_of({ 0.2, 0.25, 0.4 });
  Solid sand = any_solid(c, 3e5, 1e7);
  const double pace = c.over_decades(1.0, 50.0), opening_s = 25.0 / pace, end_s = 5.0 / pace + opening_s + 3.0;
  const double lip = -4.0 + (c.one_in(2) ? 0.0 : c.between(-0.5, 0.5) * dx);  // on a grid line, or off
  std::string text = "name: release\n";
  double gravity = 9.81;
  if (c.one_in(2))
    text += gravity_text(c, 15.0, gravity);
  text += time_text(end_s);
  text += fmt::format(
      "grid:\n  cell_size_m: {}\n  lower_m: [-8, -12]\n  upper_m: [8, 4]\n"
      "  faces: {{ y_min: free, y_max: free, z_min: free, z_max: free }}\n",
      dx);
  const std::string material = solid_text(c, "sand", sand, !c.one_in(4));
  text += numerics_text(c, c.one_in(2), Touching::yes);
  text += "materials:\n" + material;
  const double area = c.between(3.0, 10.8), outline = 1.25 * std::sqrt(4.0 * pi * area);
  text += fmt::format(
      "bodies:\n  fill:\n    material: sand\n    shape: {{ hopper_fill: {{ area_m2: {:.6g} }} }}\n"
      "    particles_per_cell: {}\n",
      area, particles_text(c, 3));
  const Space space{ dx, 0, 0 };
  text += fmt::format("geotextiles:\n  container:\n    encloses: fill\n    slack: {:.4g}\n",
                      c.any_of({ 0.0, 0.1, 0.3, 1.0 }));
  text += sheet_text(c, space, sand, outline, 4);
  const double friction = any_friction(c), lip_radius = c.any_of({ 0.0, 0.05, 0.1 });
  text += fmt::format(
      "hull:\n  hinge_m: [0, 0]\n  port_section_m: [[1.5, {0:.9g}], [0, {0:.9g}], [0, {1:.9g}], [2.5, -1.0], "
      "[2.5, 0.0]]\n  lip_radius_m: {2}\n  friction: {3}\n",
      lip - 0.4, lip, lip_radius, friction);
  const double starboard = c.between(0.05, 0.3), port = c.between(0.05, 0.3);
  text += fmt::format(
      "  signal: {{ max_rate_rad_per_s: 10 }}\n  opening_table: [[0, 0, 0], [{:.6g}, 0, 0], [{:.6g}, {:.4g}, "
      "{:.4g}], [{:.6g}, 0.365, 0.365]]\n",
      0.2 * opening_s, 0.6 * opening_s, port, starboard, 1.2 * opening_s);
  return text +
         fmt::format("surfaces:\n  bed:\n    line_m: [[-9, -11.3], [9, -11.3]]\n    friction: {}\n", any_friction(c));
}

}  // namespace geocontainer_mpm::stability
