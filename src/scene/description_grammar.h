#pragma once
/// The scene grammar: one `describe` for each struct, one line for each key. Reading, checking, writing, overriding and
/// documenting a scene are visitors of these functions, so that a key, its type, unit, range and meaning stand once.
///
/// A visitor offers: value(key, member, limits), section(key, member or std::optional member),
/// map(key, std::map by name), checked_by_itself(struct with a validate() of its own).

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "description_leaf.h"
#include "geocontainer_mpm/scene/description.h"

namespace geocontainer_mpm::scene::grammar {

enum class Need { required, optional };

struct Key {
  const char* name;
  Need need;
  const char* unit;       ///< empty for a key without dimension
  const char* text;       ///< meaning, for the reference page
  bool applies = true;    ///< false: means nothing with what was said before it, so it must not be given
  const char* when = "";  ///< in words: when it applies
};

inline std::string joined(const std::string& path, const std::string& name)
{
  return path.empty() ? name : path + "." + name;
}

inline constexpr Need required = Need::required;
inline constexpr Need optional = Need::optional;

template <class V>
void describe(V& v, TimeDescription& t)
{
  v.value({ "end_s", required, "s", "simulated time at which the run is complete" }, t.end_s, positive());
  v.value({ "output_interval_s", optional, "s", "spacing of frames in record and topics" }, t.output_interval_s,
          positive());
}

using Faces = std::array<FaceCondition, 4>;

template <class V>
void describe(V& v, Faces& f)
{
  v.value({ "y_min", required, "", "face towards starboard" }, f[0]);
  v.value({ "y_max", required, "", "face towards port" }, f[1]);
  v.value({ "z_min", required, "", "lower face" }, f[2]);
  v.value({ "z_max", required, "", "upper face" }, f[3]);
}

template <class V>
void describe(V& v, GridDescription& g)
{
  v.value({ "cell_size_m", required, "m", "edge of a cell" }, g.cell_size_m, positive());
  v.value({ "lower_m", required, "m", "lower corner of the space that material may occupy" }, g.lower_m);
  v.value({ "upper_m", required, "m", "upper corner; the extent is a whole number of cells" }, g.upper_m);
  v.section({ "faces", required, "",
              "what a face does to material that reaches it. `free`: material that leaves ends the run with a reason; "
              "`roller`: no motion through the face, none hindered along it; `fixed`: no motion at all" },
            g.faces);
}

template <class V>
void describe(V& v, NumericsDescription& n)
{
  v.value({ "time_step_factor", optional, "", "fraction of the stability bound that a step may use" },
          n.time_step_factor, open_closed(0.0, 1.0));
  v.value({ "max_step_s", optional, "s", "upper bound of a step" }, n.max_step_s, positive());
  v.value({ "max_travel_cells", optional, "cells", "furthest that a particle may move in a step" }, n.max_travel_cells,
          open_closed(0.0, 0.5));
  v.value({ "damping_per_s", optional, "1/s", "mass-proportional damping of the live run; 0 for physics" },
          n.damping_per_s, non_negative());
  v.value({ "skip_resting", optional, "", "take no steps while nothing moves" }, n.skip_resting);
  v.value(
      { "rest_velocity_m_per_s", optional, "m/s", "root-mean-square velocity below which a body counts as resting" },
      n.rest_velocity_m_per_s, positive());
  v.value({ "rest_time_s", optional, "s", "how long it must stay below" }, n.rest_time_s, positive());
}

template <class V>
void describe(V& v, material::Parameters& m)
{
  v.value({ "law", required, "", "constitutive law" }, m.law);
  const bool frictional = m.law == material::LawName::mohr_coulomb;
  const char* when = "law `mohr_coulomb`";
  v.value({ "density_kg_per_m3", required, "kg/m3", "bulk density" }, m.density_kg_per_m3, told("> 0"));
  v.value({ "young_modulus_pa", required, "Pa", "Young's modulus" }, m.young_modulus_pa, told("> 0"));
  v.value({ "poisson_ratio", required, "", "Poisson's ratio" }, m.poisson_ratio, told("in [0, 0.49]"));
  v.value({ "friction_angle_deg", required, "deg", "angle of internal friction", frictional, when },
          m.friction_angle_deg, told("in (0, 60)"));
  v.value({ "dilation_angle_deg", required, "deg", "angle of dilation", frictional, when }, m.dilation_angle_deg,
          told("in [0, friction_angle_deg]"));
  v.value({ "cohesion_pa", required, "Pa", "cohesion", frictional, when }, m.cohesion_pa, told(">= 0"));
  v.value({ "tension_cutoff_pa", required, "Pa", "largest principal tension", frictional, when }, m.tension_cutoff_pa,
          told("in [0, cohesion_pa / tan(friction_angle_deg)]"));
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
  v.section({ "polygon", optional, "", "any simple polygon" }, s.polygon);
  v.section({ "hopper_fill", optional, "", "the closed hopper, filled; needs `hull`" }, s.hopper_fill);
}

template <class V>
void describe(V& v, BodyDescription& b)
{
  v.value({ "material", required, "", "a name in `materials`" }, b.material, at_least(1));
  v.section({ "shape", required, "", "exactly one of the four below" }, b.shape);
  v.value({ "particles_per_cell", optional, "", "particles in each direction of a cell" }, b.particles_per_cell,
          closed(1, 4));
  v.value({ "initial_velocity_m_per_s", optional, "m/s", "velocity of the whole body at the start" },
          b.initial_velocity_m_per_s);
  v.value({ "initial_stress", optional, "",
            "`none`: free of stress; `k0`: vertical stress from the depth below the body's top, horizontal by `k0`; "
            "`gravity`: k0, then settled under gravity with damping and hulls closed until it rests, before the clock "
            "starts" },
          b.initial_stress);
  v.value({ "k0", optional, "", "horizontal over vertical stress, for `k0` and `gravity`" }, b.k0, closed(0.0, 2.0));
}

template <class V>
void describe(V& v, GeotextileDescription& g)
{
  v.value({ "encloses", required, "", "the body in `bodies` around whose outline the closed sheet is laid" },
          g.encloses, at_least(1));
  v.value({ "circumference_m", required, "m",
            "unstretched length around; the excess over the outline is slack, laid in evenly" },
          g.circumference_m, positive());
  v.value({ "stiffness_n_per_m", required, "N/m", "J (warp): force per width and unit strain" }, g.stiffness_n_per_m,
          positive());
  v.value({ "mass_kg_per_m2", required, "kg/m2", "true mass: what gravity pulls" }, g.mass_kg_per_m2, positive());
  v.value(
      { "computational_mass_kg_per_m2", required, "kg/m2", "inertia used (mass scaling), not below `mass_kg_per_m2`" },
      g.computational_mass_kg_per_m2, positive());
  v.value({ "strength_n_per_m", required, "N/m", "tensile strength of the sheet (warp)" }, g.strength_n_per_m,
          positive());
  v.value({ "seam_efficiency", optional, "", "strength of a seam over the sheet's" }, g.seam_efficiency,
          open_closed(0.0, 1.0));
  v.value({ "segment_length_m", required, "m", "wanted length of a membrane segment; about a cell" },
          g.segment_length_m, positive());
  v.value({ "gauge_length_m", optional, "m", "reported tension is the mean over this; not below `segment_length_m`" },
          g.gauge_length_m, positive());
}

template <class V>
void describe(V& v, barge::OpeningSignalParameters& s)
{
  v.value({ "min_angle_rad", optional, "rad", "lower end of believable angles" }, s.min_angle_rad,
          told("in [-1.57, 0]"));
  v.value({ "max_angle_rad", optional, "rad", "upper end of believable angles" }, s.max_angle_rad,
          told("in (0, 1.57]"));
  v.value({ "max_rate_rad_per_s", optional, "rad/s", "fastest believable opening rate" }, s.max_rate_rad_per_s,
          told("in (0, 100]"));
  v.value({ "noise_rad", optional, "rad", "jump between neighbouring samples that noise alone may cause" }, s.noise_rad,
          told("in [0, 1.57]"));
  v.value({ "max_gap_s", optional, "s", "a longer silence holds the last angle and is reported" }, s.max_gap_s,
          told("in (0, 3600]"));
  v.value({ "smoothing_time_s", optional, "s", "width of the centred moving average; 0: none" }, s.smoothing_time_s,
          told("in [0, 60]"));
  v.value({ "backlash_rad", optional, "rad", "play that the angle must leave before the hull moves; 0: none" },
          s.backlash_rad, told("in [0, 0.1]"));
  v.checked_by_itself(s);
}

template <class V>
void describe(V& v, HullDescription& h)
{
  v.value({ "hinge_m", required, "m", "hinge axis" }, h.hinge_m);
  v.value({ "port_section_m", required, "m",
            "port half (y >= 0) of the closed hull as an open line: from the bottom inwards, round the lip and up the "
            "inner wall to the deck, the free side on the left walking along it. Starboard is its mirror image" },
          h.port_section_m, at_least(3));
  v.value({ "lip_radius_m", required, "m", "corners of the section are rounded with this radius" }, h.lip_radius_m,
          non_negative());
  v.value({ "friction", required, "", "Coulomb coefficient of the container on the hull" }, h.friction, non_negative());
  v.value({ "opening_table", optional, "s, rad, rad",
            "opening used when no log is given, times ascending from 0 or later, angles in the believable range of "
            "`signal`; empty: the hull stays closed" },
          h.opening_table);
  v.section({ "signal", optional, "", "how logged angles are judged and filtered" }, h.signal);
}

template <class V>
void describe(V& v, SurfaceDescription& s)
{
  v.value({ "line_m", required, "m", "open line; the free side is on the left walking along it" }, s.line_m,
          at_least(2));
  v.value({ "friction", required, "", "Coulomb coefficient" }, s.friction, non_negative());
}

template <class V>
void describe(V& v, OutcomeDescription& o)
{
  v.value({ "hung_up_after_s", optional, "s", "standing still this long in the open slot means hung up" },
          o.hung_up_after_s, positive());
}

template <class V>
void describe(V& v, SceneDescription& s)
{
  v.value({ "name", required, "", "short name, for summaries and records" }, s.name, at_least(1));
  v.value({ "description", optional, "", "one sentence on what the scene shows" }, s.description);
  v.value({ "gravity_m_per_s2", optional, "m/s2", "gravity" }, s.gravity_m_per_s2);
  v.section({ "time", required, "", "duration and output" }, s.time);
  v.section({ "grid", required, "", "background grid and its faces" }, s.grid);
  v.section({ "numerics", optional, "", "time stepping and rest" }, s.numerics);
  v.map({ "materials", required, "", "constitutive laws by name" }, s.materials);
  v.map({ "bodies", required, "", "bodies of particles by name; at least one" }, s.bodies);
  v.map({ "geotextiles", optional, "", "closed sheets by name, each around its own body" }, s.geotextiles);
  v.section({ "hull", optional, "", "split hull: its section, hinge and motion" }, s.hull);
  v.map({ "surfaces", optional, "", "rigid surfaces that stand still, by name: the bed" }, s.surfaces);
  v.section({ "outcome", optional, "", "how the outcome is judged" }, s.outcome);
}

/// Collects the names of one struct's keys.
class Names {
public:
  template <class T>
  void value(const Key& key, T&, const Limits& = {})
  {
    names.emplace_back(key.name);
  }
  template <class T>
  void section(const Key& key, T&)
  {
    names.emplace_back(key.name);
  }
  template <class T>
  void map(const Key& key, T&)
  {
    names.emplace_back(key.name);
  }
  template <class T>
  void checked_by_itself(T&)
  {
  }

  std::vector<std::string> names;
};

template <class T>
std::vector<std::string> names_of()
{
  T fresh{};
  Names names;
  describe(names, fresh);
  return names.names;
}

}  // namespace geocontainer_mpm::scene::grammar
