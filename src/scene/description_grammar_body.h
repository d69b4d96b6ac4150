#pragma once
/// The scene grammar: materials, bodies and their shapes.

#include "description_key.h"
#include "description_leaf.h"
#include "geocontainer_mpm/scene/description.h"

namespace geocontainer_mpm::scene::grammar {

template <class V>
void describe(V& v, material::Parameters& m)
{
  using material::LawName;
  v.value({ "law", required, "",
            "constitutive law. `linear_elastic`, `mohr_coulomb`: stress from increments of strain; `neo_hookean`, "
            "`hencky`: elastic at any strain; `newtonian`, `bingham`: weakly compressible fluids" },
          m.law);
  const bool fluid = material::is_fluid(m.law);
  const bool frictional = m.law == LawName::mohr_coulomb;
  const bool yielding = m.law == LawName::bingham;
  const char* when_solid = "a law that is not a fluid's";
  const char* when_frictional = "law `mohr_coulomb`";
  const char* when_fluid = "law `newtonian` or `bingham`";
  const char* when_yielding = "law `bingham`";
  v.value({ "density_kg_per_m3", required, "kg/m3", "bulk density; of a fluid that without pressure" },
          m.density_kg_per_m3, told("> 0"));
  v.value({ "young_modulus_pa", required, "Pa", "Young's modulus", !fluid, when_solid }, m.young_modulus_pa,
          told("> 0"));
  v.value({ "poisson_ratio", required, "", "Poisson's ratio", !fluid, when_solid }, m.poisson_ratio,
          told("in [0, 0.49]"));
  v.value({ "stiffness_damping_s", optional, "s",
            "Rayleigh's beta: a viscous stress of this times the elastic stiffness times the rate of strain", !fluid,
            when_solid },
          m.stiffness_damping_s, told(">= 0"));
  v.value({ "friction_angle_deg", required, "deg", "angle of internal friction", frictional, when_frictional },
          m.friction_angle_deg, told("in (0, 60)"));
  v.value({ "dilation_angle_deg", required, "deg", "angle of dilation", frictional, when_frictional },
          m.dilation_angle_deg, told("in [0, friction_angle_deg]"));
  v.value({ "cohesion_pa", required, "Pa", "cohesion", frictional, when_frictional }, m.cohesion_pa, told(">= 0"));
  v.value({ "tension_cutoff_pa", required, "Pa", "largest principal tension", frictional, when_frictional },
          m.tension_cutoff_pa, told("in [0, cohesion_pa / tan(friction_angle_deg)]"));
  v.value({ "bulk_modulus_pa", required, "Pa", "pressure over relative excess of density", fluid, when_fluid },
          m.bulk_modulus_pa, told("> 0"));
  v.value({ "viscosity_pa_s", required, "Pa s", "shear viscosity, of `bingham` that beyond yield", fluid, when_fluid },
          m.viscosity_pa_s, told(">= 0"));
  v.value(
      { "yield_stress_pa", required, "Pa", "shear stress below which the fluid hardly flows", yielding, when_yielding },
      m.yield_stress_pa, told(">= 0"));
  v.value({ "regularisation_rate_per_s", optional, "1/s",
            "shear rate over which the yield stress builds up; a tenth of the flow's own is sharp enough, and smaller "
            "ones cost small steps",
            yielding, when_yielding },
          m.regularisation_rate_per_s, told("> 0"));
  v.checked_by_itself(m);
}

template <class V>
void describe(V& v, Box& b)
{
  v.value({ "lower_m", required, "m", "lower corner before rotation" }, b.lower_m);
  v.value({ "upper_m", required, "m", "upper corner before rotation" }, b.upper_m);
  v.value({ "rotation_deg", optional, "deg", "rotation about `pivot_m`, counter-clockwise with y right and z up" },
          b.rotation_deg, closed(-360.0, 360.0));
  v.value({ "pivot_m", optional, "m", "centre of rotation" }, b.pivot_m);
}

template <class V>
void describe(V& v, Disc& d)
{
  v.value({ "center_m", required, "m", "centre" }, d.center_m);
  v.value({ "radius_m", required, "m", "radius" }, d.radius_m, positive());
}

template <class V>
void describe(V& v, Ring& r)
{
  v.value({ "center_m", required, "m", "centre" }, r.center_m);
  v.value({ "inner_radius_m", required, "m", "radius of the hole" }, r.inner_radius_m, positive());
  v.value({ "outer_radius_m", required, "m", "outer radius, above `inner_radius_m`" }, r.outer_radius_m, positive());
}

template <class V>
void describe(V& v, Polygon& p)
{
  v.value({ "vertices_m", required, "m", "corners in either sense; sides do not cross" }, p.vertices_m, at_least(3));
}

template <class V>
void describe(V& v, HopperFill& h)
{
  v.value({ "area_m2", required, "m2", "filled section of the closed hopper, measured up from its bottom" }, h.area_m2,
          positive());
}

template <class V>
void describe(V& v, ShapeDescription& s)
{
  v.section({ "box", optional, "", "rectangle, rotated or not" }, s.box);
  v.section({ "disc", optional, "", "circle" }, s.disc);
  v.section({ "ring", optional, "", "circle with a concentric hole" }, s.ring);
  v.section({ "polygon", optional, "", "any simple polygon" }, s.polygon);
  v.section({ "hopper_fill", optional, "", "the closed hopper, filled; needs `hull`" }, s.hopper_fill);
}

template <class V>
void describe(V& v, ManufacturedDescription& m)
{
  v.value({ "solution", required, "",
            "`axis_aligned`: u_i = A sin(pi X_i) sin(c pi t + f_i) in the unit square, f = (0, pi) (Wallstedt and "
            "Guilkey 2008); `vortex`: turning shear in the ring 0.75 m < R < 1.25 m (Kamojjala et al. 2015)" },
          m.solution);
  v.value({ "amplitude", optional, "m or rad", "A: m for `axis_aligned`, below 1/pi; rad for `vortex`" }, m.amplitude,
          positive());
  v.value({ "origin_m", optional, "m", "lower corner of the unit square, or centre of the ring" }, m.origin_m);
}

template <class V>
void describe(V& v, VelocityWave& w)
{
  v.value({ "amplitude_m_per_s", required, "m/s", "v = amplitude sin(wave_number . X + phase)" }, w.amplitude_m_per_s);
  v.value({ "wave_number_rad_per_m", required, "rad/m", "2 pi over the wave length, along y and z" },
          w.wave_number_rad_per_m);
  v.value({ "phase_rad", optional, "rad", "phase at the origin" }, w.phase_rad);
}

template <class V>
void describe(V& v, Region& r)
{
  v.value({ "lower_m", required, "m", "lower corner" }, r.lower_m);
  v.value({ "upper_m", required, "m", "upper corner" }, r.upper_m);
}

template <class V>
void describe(V& v, BodyDescription& b)
{
  v.value({ "material", required, "", "a name in `materials`" }, b.material, at_least(1));
  v.section({ "shape", required, "", "exactly one of the five below" }, b.shape);
  v.value({ "along_m", optional, "m",
            "[from, to]: in a scene with `space`, and there alone, the shape reaches so far along x, with flat ends" },
          b.along_m);
  v.value({ "particles_per_cell", optional, "", "particles in each direction of a cell" }, b.particles_per_cell,
          closed(1, 4));
  v.value({ "jitter", optional, "",
            "furthest that a particle lies off its lattice in each direction, over the "
            "spacing; random, and the same in every run" },
          b.jitter, closed(0.0, 0.5));
  v.value({ "velocity_field", optional, "",
            "bodies that name the same field stick together where they meet; fields touch by `contacts`. Absent: the "
            "field `common`" },
          b.velocity_field);
  v.value({ "initial_velocity_m_per_s", optional, "m/s", "velocity of the whole body at the start" },
          b.initial_velocity_m_per_s);
  v.value({ "initial_spin_rad_per_s", optional, "rad/s",
            "rotation about the middle of the body's mass at the start, from y towards z" },
          b.initial_spin_rad_per_s);
  v.section({ "initial_velocity_wave", optional, "", "a sine over space on top of both: a mode of vibration" },
            b.initial_velocity_wave);
  v.value({ "initial_stress", optional, "",
            "`none`: free of stress; `k0`: vertical stress from the depth below the body's top, horizontal by `k0`; "
            "`gravity`: k0, then settled under gravity with damping and hulls closed until it rests, before the clock "
            "starts; `hydrostatic`: the pressure of the depth in all directions, for fluids" },
          b.initial_stress);
  const bool sideways = b.initial_stress == InitialStress::k0 || b.initial_stress == InitialStress::gravity;
  v.value({ "k0", optional, "", "horizontal over vertical stress", sideways, "initial_stress `k0` or `gravity`" }, b.k0,
          closed(0.0, 2.0));
  v.section({ "manufactured", optional, "",
              "motion with a known body force, for verification: the body starts on the solution and is driven by its "
              "force. Needs law `neo_hookean`, the solution's own shape, and no gravity" },
            b.manufactured);
  v.value({ "held_until_s", optional, "s",
            "until then the body and the sheet around it stay in place and touch nothing; then they start with the "
            "initial velocity" },
          b.held_until_s, non_negative());
}

}  // namespace geocontainer_mpm::scene::grammar
