#include "draw.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "chance.h"

namespace geocontainer_mpm::stability {
namespace {

constexpr double pi = 3.14159265358979323846;
/// Particles times steps, an extra of 60 particles a step for what does not grow with them: about a second of CPU.
constexpr double usual_budget = 4e6;

/// Cells of the space and their size; what a family writes below is in cells.
struct Space {
  double dx;
  int width, height;
};

std::string point(double y, double z)
{
  return fmt::format("[{:.12g}, {:.12g}]", y, z);
}

std::string grid_text(const Space& space, const char* sides, const char* bottom)
{
  return fmt::format(
      "grid:\n  cell_size_m: {:.12g}\n  lower_m: [0, 0]\n  upper_m: {}\n"
      "  faces: {{ y_min: {}, y_max: {}, z_min: {}, z_max: free }}\n",
      space.dx, point(space.width * space.dx, space.height * space.dx), sides, sides, bottom);
}

std::string time_text(double end_s)
{
  return fmt::format("time:\n  end_s: {:.9g}\n  output_interval_s: {:.9g}\n", end_s, end_s / 40.0);
}

enum class Touching { no, yes };

/// Any method that a scene may have, any part of the stability bound.
std::string numerics_text(Chance& c, bool skip_resting, Touching touching)
{
  const bool simplex = c.one_in(2.5), flip = simplex || c.one_in(2.5);
  std::string text = "numerics:\n";
  text += fmt::format("  shape: {}\n", simplex ? "linear_simplex" : "bspline2");
  text += fmt::format("  transfer: {}\n", flip ? "flip" : "apic");
  if (flip)
    text += fmt::format("  flip_fraction: {}\n", c.any_of({ 1.0, 0.99, 0.9, 0.0 }));
  if (flip && c.one_in(5) && touching == Touching::no)
    text += "  mass: consistent\n";
  text += fmt::format("  update: {}\n", c.any_of({ "usl", "usl", "usf", "musl" }));
  text += fmt::format("  smoothing: {}\n", c.any_of({ "none", "none", "cell_average", "nodal_mixed" }));
  text += fmt::format("  time_step_factor: {:.4g}\n", c.one_in(4) ? 1.0 : c.over_decades(0.1, 1.0));
  text += fmt::format("  skip_resting: {}\n", skip_resting);
  return text;
}

/// Value of `particles_per_cell`, and a `jitter` with it or not.
std::string particles_text(Chance& c, int most)
{
  const int number = c.whole(1, most);
  return c.one_in(3) ? fmt::format("{}\n    jitter: {:.3g}", number, c.between(0.0, 0.5)) : fmt::format("{}", number);
}

struct Solid {
  double density, young, poisson;
  bool frictional;
  double constrained() const { return young * (1.0 - poisson) / (1.0 + poisson) / (1.0 - 2.0 * poisson); }
  double wave_speed() const { return std::sqrt(constrained() / density); }
};

Solid any_solid(Chance& c, double softest, double stiffest)
{
  return { c.between(800.0, 2500.0), c.over_decades(softest, stiffest), c.any_of({ 0.0, 0.2, 0.3, 0.45 }), false };
}

/// Stiff enough for a weight on it, Pa: small strain is what most laws are for, and what is crushed has no answer.
void carry(Solid& solid, double weight)
{
  solid.young = std::max(solid.young, 20.0 * weight);
}

/// A solid of some law. Sand cannot stand on its own in the air, but may be given a cohesion.
std::string solid_text(Chance& c, const char* name, Solid& solid, bool sand)
{
  const char* law = sand ? "mohr_coulomb" : c.any_of({ "linear_elastic", "mohr_coulomb", "neo_hookean", "hencky" });
  solid.frictional = law == std::string("mohr_coulomb");
  std::string text = fmt::format(
      "  {}:\n    law: {}\n    density_kg_per_m3: {:.6g}\n    young_modulus_pa: {:.6g}\n    poisson_ratio: {}\n", name,
      law, solid.density, solid.young, solid.poisson);
  if (c.one_in(5))  // beta of a damping ratio up to 1 at the frequency of a cell of 0.1 m
    text += fmt::format("    stiffness_damping_s: {:.4g}\n", c.between(0.0, 1.0) * 0.1 / solid.wave_speed());
  if (solid.frictional) {
    const double friction = c.between(5.0, 45.0), cohesion = c.one_in(2) ? 0.0 : c.over_decades(10.0, 1e5);
    text += fmt::format(
        "    friction_angle_deg: {:.4g}\n    dilation_angle_deg: {:.4g}\n    cohesion_pa: {:.4g}\n"
        "    tension_cutoff_pa: {:.4g}\n",
        friction, c.one_in(2) ? 0.0 : c.between(0.0, friction), cohesion,
        c.one_in(2) ? 0.0 : c.between(0.0, 0.99) * cohesion / std::tan(friction * pi / 180.0));
  }
  return text;
}

/// A box, turned or not, a disc, or a polygon of about `size` cells in both directions; lower corner in cells.
std::string shape_text(Chance& c, const Space& space, double y, double z, double width, double height)
{
  const double dx = space.dx;
  switch (c.whole(0, 3)) {
    case 0: {
      const double radius = 0.5 * std::min(width, height) * dx;
      return fmt::format("disc: {{ center_m: {}, radius_m: {:.12g} }}", point((y + 0.5 * width) * dx, z * dx + radius),
                         radius);
    }
    case 1: {  // stays inside its box
      const double w = width * dx, h = height * dx, y0 = y * dx, z0 = z * dx;
      return fmt::format("polygon: {{ vertices_m: [{}, {}, {}, {}, {}] }}", point(y0 + 0.2 * w, z0),
                         point(y0 + 0.8 * w, z0), point(y0 + w, z0 + c.between(0.3, 0.7) * h),
                         point(y0 + 0.6 * w, z0 + h), point(y0, z0 + c.between(0.4, 0.8) * h));
    }
    default:
      return fmt::format("box: {{ lower_m: {}, upper_m: {} }}", point(y * dx, z * dx),
                         point((y + width) * dx, (z + height) * dx));
  }
}

/// A gravity of any strength, leaning up to `lean_deg` to a side.
std::string gravity_text(Chance& c, double lean_deg, double& size)
{
  size = c.one_in(8) ? 0.0 : c.any_of({ 1.62, 9.81, 9.81, 9.81, 98.1 });
  const double lean = c.one_in(2) ? 0.0 : c.between(-lean_deg, lean_deg) * pi / 180.0;
  return fmt::format("gravity_m_per_s2: {}\n", point(size * std::sin(lean), -size * std::cos(lean)));
}

double any_friction(Chance& c)
{
  return c.any_of({ 0.0, 0.1, 0.3, 0.6, 1.0, 2.0 });
}

/// Stiffness, mass and segments of a sheet on soil of modulus M: J from 1 to 1e5 times M dx, segments of 0.2 to 4
/// cells. `length` is its unstretched length, m.
std::string sheet_text(Chance& c, const Space& space, const Solid& soil, double length, int least_segments)
{
  const double stiffness = c.over_decades(1.0, 1e5) * soil.constrained() * space.dx;
  const double mass = soil.density * space.dx * c.over_decades(0.003, 1.0);
  const double segment = std::min(c.over_decades(0.2, 4.0) * space.dx, 0.99 * length / least_segments);
  return fmt::format(
      "    stiffness_n_per_m: {:.6g}\n    mass_kg_per_m2: {:.6g}\n    computational_mass_kg_per_m2: {:.6g}\n"
      "    strength_n_per_m: {:.6g}\n    segment_length_m: {:.9g}\n    gauge_length_m: {:.9g}\n",
      stiffness, mass * c.between(0.05, 1.0), mass, 0.1 * stiffness, segment, std::min(2.0 * segment, length));
}

/// A floor over the whole width, in cells; it may move: up and down, to and fro, or turn a little.
std::string floor_text(Chance& c, const Space& space, double level, double moving_s)
{
  std::string text =
      fmt::format("  floor:\n    line_m: [{}, {}]\n    friction: {}\n", point(-space.dx, level * space.dx),
                  point((space.width + 1) * space.dx, level * space.dx), any_friction(c));
  if (moving_s > 0.0)
    text += fmt::format(
        "    motion:\n      pivot_m: {}\n      table:\n        - [0, 0, 0, 0]\n        - [{:.9g}, {:.9g}, {:.9g}, "
        "{:.9g}]\n"
        "        - [{:.9g}, 0, 0, 0]\n",
        point(0.5 * space.width * space.dx, level * space.dx), 0.5 * moving_s, c.between(-1.0, 1.0) * space.dx,
        c.between(-1.0, 1.5) * space.dx, c.between(-0.1, 0.1), moving_s);
  return text;
}

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
  text +=
      numerics_text(c, false, Touching::yes) + "materials:\n" + solid_text(c, "stuff", solid, bagged && c.one_in(2));
  const double floor = bottom - (c.one_in(2) ? c.between(0.5, 2.0) : 0.0);
  text += fmt::format(
      "bodies:\n  load:\n    material: stuff\n    shape: {{ {} }}\n    particles_per_cell: {}\n"
      "    initial_velocity_m_per_s: {}\n",
      shape_text(c, space, 0.5 * (space.width - width), bottom, width, height), particles_text(c, 4),
      point(c.between(-1.0, 1.0), c.between(-3.0, 0.0)));
  if (bagged) {
    const double around = 2.0 * std::min(width, height) * space.dx;  // not longer than any outline
    text += "geotextiles:\n  bag:\n    encloses: load\n";
    text += fmt::format("    slack: {:.4g}\n", c.any_of({ 0.0, 0.0, 0.02, 0.3, 1.5 }));
    text += sheet_text(c, space, solid, around, 4);
  }
  return text + "surfaces:\n" + floor_text(c, space, floor, c.one_in(3) ? c.between(0.3, 1.0) * end_s : 0.0);
}

/// A column that falls apart between the faces of the grid.
std::string draw_column(Chance& c)
{
  const Space space{ 0.1, 30, 14 };
  Solid solid = any_solid(c, 1e5, 1e8);
  std::string text = "name: column\n" + time_text(std::min(1.5, 4000.0 * space.dx / solid.wave_speed()));
  text += grid_text(space, c.any_of({ "roller", "fixed" }), c.any_of({ "roller", "fixed" }));
  text += numerics_text(c, c.one_in(2), Touching::no) + "materials:\n" + solid_text(c, "sand", solid, true);
  return text + fmt::format(
                    "bodies:\n  column:\n    material: sand\n    shape: {{ box: {{ lower_m: [0, 0], upper_m: {} }} }}\n"
                    "    particles_per_cell: {}\n    initial_stress: {}\n",
                    point(c.between(3.0, 7.0) * space.dx, c.between(3.0, 10.0) * space.dx), particles_text(c, 4),
                    c.any_of({ "none", "none", "k0" }) == std::string("k0") ? "k0\n    k0: 1.0" : "none");
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
  text += grid_text(space, "roller", "free") + numerics_text(c, false, Touching::yes);
  text += "materials:\n" + solid_text(c, "lower", low, false) + solid_text(c, "upper", high, false);
  const bool apart = c.one_in(1.5);
  const double width = c.between(5.0, 9.0), height = c.between(3.0, 6.0), top = 4.0 + height;
  const double speed = std::min(0.05 * slowest, 5.0);
  const auto body = [&](const char* name, double z, double v) {
    return fmt::format(
        "  {0}:\n    material: {0}\n    shape: {{ {1} }}\n    particles_per_cell: {2}\n"
        "    initial_velocity_m_per_s: {3}\n{4}",
        name, shape_text(c, space, 10.0 - 0.5 * width, z, width, height), particles_text(c, 4),
        point(c.between(-0.3, 0.3) * v, v), apart ? fmt::format("    velocity_field: {}\n", name) : "");
  };
  text += "bodies:\n" + body("lower", 4.0, 0.0) + body("upper", top + c.any_of({ 0.0, 0.0, 0.5, 1.3 }), -speed);
  if (apart)
    text += fmt::format("contacts:\n  both:\n    between: [lower, upper]\n    friction: {}\n", any_friction(c));
  return text + "surfaces:\n" + floor_text(c, space, 4.0, 0.0);
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
  text += numerics_text(c, false, Touching::yes) + "materials:\n" + solid_text(c, "stuff", solid, false);
  const bool ring = c.one_in(2), weight = !ring && c.one_in(1.5), apart = weight && c.one_in(2);
  if (weight)
    text += fmt::format(
        "bodies:\n  weight:\n    material: stuff\n    shape: {{ {} }}\n    particles_per_cell: {}\n"
        "    initial_velocity_m_per_s: [0, {:.4g}]\n{}",
        shape_text(c, space, 9.5, 12.6, 5.0, 5.0), particles_text(c, 4), -c.between(0.0, 2.0),
        apart ? "    velocity_field: weight\n" : "");
  text += "geotextiles:\n  sheet:\n";
  if (ring) {
    const double radius = c.between(3.0, 6.0) * space.dx;
    text += fmt::format("    circle: {{ center_m: {}, radius_m: {:.9g} }}\n", point(1.2, 1.2), radius);
    text += sheet_text(c, space, solid, 2.0 * pi * radius, 3);
    text +=
        fmt::format("    inside_pressure:\n      pressure_pa: {:.6g}\n      gradient_pa_per_m: {:.6g}\n",
                    c.over_decades(1e-6, 1e-2) * solid.constrained(), c.one_in(2) ? 0.0 : c.over_decades(10.0, 1e4));
    if (c.one_in(2))
      text += fmt::format("      table: [[0, 0], [{:.9g}, 1], [{:.9g}, 0.3]]\n", 0.2 * end_s, 0.8 * end_s);
    return text;
  }
  text += fmt::format("    line: {{ points_m: [{}, {}] }}\n", point(0.4, 1.2), point(2.0, 1.2));
  text += fmt::format("    slack: {:.4g}\n", c.any_of({ 0.0, 0.0, 0.05, 0.5 }));
  text += sheet_text(c, space, solid, 1.6, 1);
  text += "    start: { held: true }\n";
  text += c.one_in(2) ? "    end: { held: true }\n"
                      : fmt::format("    end:\n      held: true\n      motion_table: [[0, 0, 0], [{:.9g}, {}, {}]]\n",
                                    end_s, c.between(-0.3, 0.1), c.between(-0.3, 0.3));
  if (apart)
    text += fmt::format("contacts:\n  touch:\n    between: [weight, common]\n    friction: {}\n", any_friction(c));
  return text;
}

/// A bar held at one end and pulled, pushed or shaken at the other.
std::string draw_bar(Chance& c)
{
  const Space space{ 0.1, 30, 14 };
  Solid solid = any_solid(c, 1e5, 1e9);
  const double end_s = 1500.0 * space.dx / solid.wave_speed();
  const double stress = c.over_decades(1e-6, 0.1) * solid.young;
  std::string text = "name: bar\ngravity_m_per_s2: [0, 0]\n" + time_text(end_s) + grid_text(space, "free", "free");
  text += numerics_text(c, false, Touching::yes) + "materials:\n" + solid_text(c, "steel", solid, false);
  text += fmt::format(
      "bodies:\n  bar:\n    material: steel\n    shape: {{ box: {{ lower_m: {}, upper_m: {} }} }}\n"
      "    particles_per_cell: {}\n",
      point(0.4, 0.5 + c.between(0.0, 0.1)), point(1.9 + c.between(0.0, 0.2), 0.85), particles_text(c, 4));
  text += fmt::format("supports:\n  root:\n    region: {{ lower_m: [0, 0], upper_m: {} }}\n", point(0.5, 1.4));
  if (c.one_in(3))
    text += fmt::format("    velocity_table: [[0, 0, 0], [{:.9g}, {:.6g}, {:.6g}], [{:.9g}, 0, 0]]\n", 0.1 * end_s,
                        c.between(-1.0, 1.0) * 0.3 / end_s, c.between(-1.0, 1.0) * 0.3 / end_s, 0.3 * end_s);
  text += fmt::format(
      "tractions:\n  pull:\n    body: bar\n    region: {{ lower_m: [1.75, 0], upper_m: [2.5, 1.4] }}\n"
      "    traction_pa: {}\n    pressure_pa: {:.6g}\n    table: [[0, 0], [{:.9g}, 1], [{:.9g}, {}]]\n",
      point(c.between(-1.0, 1.0) * stress, c.between(-0.05, 0.05) * stress), c.between(-1.0, 1.0) * stress,
      c.between(0.0, 0.3) * end_s + 1e-9, 0.5 * end_s, c.any_of({ 1, 0, -1 }));
  return text;
}

/// A slurry at rest or breaking loose.
std::string draw_fluid(Chance& c)
{
  const Space space{ 0.1, 24, 12 };
  const double density = c.between(1000.0, 2000.0), bulk = c.over_decades(1e5, 1e8);
  const bool bingham = c.one_in(2);
  std::string text = "name: fluid\n" + time_text(std::min(1.0, 3000.0 * space.dx / std::sqrt(bulk / density)));
  text += grid_text(space, c.any_of({ "roller", "fixed" }), c.any_of({ "roller", "fixed" })) +
          numerics_text(c, false, Touching::no);
  text += fmt::format(
      "materials:\n  slurry:\n    law: {}\n    density_kg_per_m3: {:.6g}\n    bulk_modulus_pa: {:.6g}\n"
      "    viscosity_pa_s: {:.6g}\n",
      bingham ? "bingham" : "newtonian", density, bulk, c.one_in(4) ? 0.0 : c.over_decades(1e-3, 1e3));
  if (bingham)
    text += fmt::format("    yield_stress_pa: {:.6g}\n    regularisation_rate_per_s: {:.6g}\n",
                        c.over_decades(1.0, 1e4), c.over_decades(0.1, 10.0));
  const bool full = c.one_in(3);  // from wall to wall: at rest
  return text +
         fmt::format(
             "bodies:\n  slurry:\n    material: slurry\n    shape: {{ box: {{ lower_m: [0, 0], upper_m: {} }} }}\n"
             "    particles_per_cell: {}\n    initial_stress: {}\n",
             point(full ? 2.4 : c.between(0.4, 1.2), c.between(0.3, 0.9)), particles_text(c, 4),
             c.one_in(2) ? "hydrostatic" : "none");
}

/// A few particles that lie still, or should: as many steps as anyone takes.
std::string draw_rest(Chance& c, double steps)
{
  const Space space{ 0.1, 4, 4 };
  Solid solid = any_solid(c, 1e6, 1e7);
  std::string text = "name: rest\n" + time_text(steps * 0.3 * space.dx / solid.wave_speed());
  text += grid_text(space, "roller", c.any_of({ "roller", "fixed" })) + numerics_text(c, false, Touching::no);
  text += "materials:\n" + solid_text(c, "block", solid, false);
  return text +
         fmt::format(
             "bodies:\n  block:\n    material: block\n    shape: {{ box: {{ lower_m: [0, 0], upper_m: [0.4, {}] }} }}\n"
             "    particles_per_cell: {}\n    initial_stress: {}\n",
             c.any_of({ 0.1, 0.2, 0.15 }), c.whole(1, 2), solid.frictional && c.one_in(2) ? "k0\n    k0: 1.0" : "none");
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
  text += numerics_text(c, c.one_in(2), Touching::yes) + "materials:\n" + solid_text(c, "sand", sand, !c.one_in(4));
  const double area = c.between(3.0, 10.8), outline = 1.25 * std::sqrt(4.0 * pi * area);
  text += fmt::format(
      "bodies:\n  fill:\n    material: sand\n    shape: {{ hopper_fill: {{ area_m2: {:.6g} }} }}\n"
      "    particles_per_cell: {}\n",
      area, particles_text(c, 3));
  const Space space{ dx, 0, 0 };
  text += fmt::format("geotextiles:\n  container:\n    encloses: fill\n    slack: {:.4g}\n",
                      c.any_of({ 0.0, 0.1, 0.3, 1.0 }));
  text += sheet_text(c, space, sand, outline, 4);
  text += fmt::format(
      "hull:\n  hinge_m: [0, 0]\n  port_section_m: [[1.5, {0:.9g}], [0, {0:.9g}], [0, {1:.9g}], [2.5, -1.0], "
      "[2.5, 0.0]]\n  lip_radius_m: {2}\n  friction: {3}\n",
      lip - 0.4, lip, c.any_of({ 0.0, 0.05, 0.1 }), any_friction(c));
  text += fmt::format(
      "  signal: {{ max_rate_rad_per_s: 10 }}\n  opening_table: [[0, 0, 0], [{:.6g}, 0, 0], [{:.6g}, {:.4g}, "
      "{:.4g}], [{:.6g}, 0.365, 0.365]]\n",
      0.2 * opening_s, 0.6 * opening_s, c.between(0.05, 0.3), c.between(0.05, 0.3), 1.2 * opening_s);
  return text +
         fmt::format("surfaces:\n  bed:\n    line_m: [[-9, -11.3], [9, -11.3]]\n    friction: {}\n", any_friction(c));
}

}  // namespace

Drawing draw(std::uint64_t seed)
{
  Chance c(seed);
  Drawing drawing;
  drawing.budget = usual_budget;
  const double kind = c.between(0.0, 1.0);
  drawing.twice = c.one_in(8);
  const auto is = [&](const char* family, double up_to) {
    if (!drawing.family.empty() || kind >= up_to)
      return false;
    drawing.family = family;
    return true;
  };
  if (is("drop", 0.3))
    drawing.yaml = draw_drop(c);
  else if (is("release", 0.42))
    drawing.yaml = draw_release(c);
  else if (is("stack", 0.58))
    drawing.yaml = draw_stack(c);
  else if (is("sheet", 0.7))
    drawing.yaml = draw_sheet(c);
  else if (is("column", 0.8))
    drawing.yaml = draw_column(c);
  else if (is("bar", 0.89))
    drawing.yaml = draw_bar(c);
  else if (is("fluid", 0.97))
    drawing.yaml = draw_fluid(c);
  else if (is("rest", 1.0)) {
    const double steps = c.one_in(10) ? 1e6 : 4e4;
    drawing.yaml = draw_rest(c, steps);
    drawing.budget = std::max(usual_budget, 100.0 * steps);
    drawing.twice = false;
  }
  drawing.yaml = fmt::format("# stability {} (family {})\n", seed, drawing.family) + drawing.yaml;
  return drawing;
}

}  // namespace geocontainer_mpm::stability
