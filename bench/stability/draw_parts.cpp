#include "draw_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace geocontainer_mpm::stability {

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

std::string numerics_text(Chance& c, bool skip_resting, Touching touching)
{
  const bool simplex = c.one_in(2.5), flip = simplex || c.one_in(2.5);
  std::string text = "numerics:\n";
  text += fmt::format("  shape: {}\n", simplex ? "linear_simplex" : "bspline2");
  const bool remembers = !flip && c.one_in(2.5);
  text += fmt::format("  transfer: {}\n", flip ? "flip" : remembers ? "aflip" : "apic");
  if (remembers)
    text += fmt::format("  transfer_memory_s: {:.4g}\n", c.over_decades(1e-4, 0.1));
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

std::string particles_text(Chance& c, int most)
{
  const int number = c.whole(1, most);
  return c.one_in(3) ? fmt::format("{}\n    jitter: {:.3g}", number, c.between(0.0, 0.5)) : fmt::format("{}", number);
}

Solid any_solid(Chance& c, double softest, double stiffest)
{
  return { c.between(800.0, 2500.0), c.over_decades(softest, stiffest), c.any_of({ 0.0, 0.2, 0.3, 0.45 }), false };
}

void carry(Solid& solid, double weight)
{
  solid.young = std::max(solid.young, 20.0 * weight);
}

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
    const double cutoff = c.one_in(2) ? 0.0 : c.between(0.0, 0.99) * cohesion / std::tan(friction * pi / 180.0);
    const double dilation = c.one_in(2) ? 0.0 : c.between(0.0, friction);
    text += fmt::format(
        "    friction_angle_deg: {:.4g}\n    dilation_angle_deg: {:.4g}\n    cohesion_pa: {:.4g}\n"
        "    tension_cutoff_pa: {:.4g}\n",
        friction, dilation, cohesion, cutoff);
  }
  return text;
}

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
      const double left = c.between(0.4, 0.8) * h, right = c.between(0.3, 0.7) * h;
      return fmt::format("polygon: {{ vertices_m: [{}, {}, {}, {}, {}] }}", point(y0 + 0.2 * w, z0),
                         point(y0 + 0.8 * w, z0), point(y0 + w, z0 + right), point(y0 + 0.6 * w, z0 + h),
                         point(y0, z0 + left));
    }
    default:
      return fmt::format("box: {{ lower_m: {}, upper_m: {} }}", point(y * dx, z * dx),
                         point((y + width) * dx, (z + height) * dx));
  }
}

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

std::string floor_text(Chance& c, const Space& space, double level, double moving_s)
{
  std::string text =
      fmt::format("  floor:\n    line_m: [{}, {}]\n    friction: {}\n", point(-space.dx, level * space.dx),
                  point((space.width + 1) * space.dx, level * space.dx), any_friction(c));
  if (moving_s > 0.0) {
    const double turn = c.between(-0.1, 0.1), up = c.between(-1.0, 1.5) * space.dx,
                 aside = c.between(-1.0, 1.0) * space.dx;
    text += fmt::format(
        "    motion:\n      pivot_m: {}\n      table:\n        - [0, 0, 0, 0]\n        - [{:.9g}, {:.9g}, {:.9g}, "
        "{:.9g}]\n"
        "        - [{:.9g}, 0, 0, 0]\n",
        point(0.5 * space.width * space.dx, level * space.dx), 0.5 * moving_s, aside, up, turn, moving_s);
  }
  return text;
}

}  // namespace geocontainer_mpm::stability
