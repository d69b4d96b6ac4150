#pragma once
/// The scene grammar: sheets, the hull, and rigid surfaces.

#include "description_grammar_body.h"

namespace geocontainer_mpm::scene::grammar {

template <class V>
void describe(V& v, SheetLine& l)
{
  v.value({ "points_m", required, "m", "corners of the path in order; sides do not cross" }, l.points_m, at_least(2));
  v.value({ "closed", optional, "", "joined from the last point to the first" }, l.closed);
}

template <class V>
void describe(V& v, SheetEnd& e)
{
  v.value({ "held", optional, "", "stays in place, or follows `motion_table`" }, e.held);
  v.value({ "motion_table", optional, "s, m, m", "displacement over time, zero at time 0; empty: still", e.held,
            "a held end" },
          e.motion_table, rows("time_s, y, z"));
  v.value({ "force_n_per_m", optional, "N/m", "pulls at the end", !e.held, "an end that is not held" },
          e.force_n_per_m);
  v.value({ "force_table", optional, "s, 1", "factor on `force_n_per_m` over time; empty: 1", !e.held,
            "an end that is not held" },
          e.force_table, rows("time_s, factor"));
}

template <class V>
void describe(V& v, InsidePressure& p)
{
  v.value({ "pressure_pa", optional, "Pa", "pressure at the level, outwards positive" }, p.pressure_pa);
  v.value({ "gradient_pa_per_m", optional, "Pa/m", "growth of pressure with depth: unit weight of what is inside" },
          p.gradient_pa_per_m, non_negative());
  v.value({ "level_m", optional, "m", "z at which `pressure_pa` acts; absent: the sheet's own highest point" },
          p.level_m);
  v.value({ "table", optional, "s, 1", "factor on the pressure over time; empty: 1" }, p.table, rows("time_s, factor"));
}

template <class V>
void describe(V& v, SeamDescription& s)
{
  v.value({ "at_m", optional, "m", "place: the sheet's segment nearest to this, as it is laid" }, s.at_m);
  v.value({ "along", optional, "", "place: part of the sheet's length from its first point" }, s.along,
          closed(0.0, 1.0));
  v.value({ "efficiency", optional, "", "its strength over the sheet's; absent: `seam_efficiency`" }, s.efficiency,
          open_closed(0.0, 1.0));
  v.value({ "tears", optional, "", "whether it comes apart where its tension reaches its strength" }, s.tears);
}

template <class V>
void describe(V& v, Wrinkles& w)
{
  v.section({ "region", required, "", "the parts of the path in this rectangle hold the folds" }, w.region);
  v.value({ "number", required, "", "of folds, at even distances" }, w.number, closed(1, 10000));
  v.value({ "amplitude_m", required, "m",
            "height of a fold: n folds of height a make a stretch of length L sqrt(L^2 + (2 n a)^2) long" },
          w.amplitude_m, positive());
}

template <class V>
void describe(V& v, GeotextileDescription& g)
{
  v.value({ "encloses", optional, "", "the body in `bodies` around whose outline the closed sheet is laid" },
          g.encloses);
  v.section({ "line", optional, "", "path along which a free sheet is laid, open or closed" }, g.line);
  v.section({ "circle", optional, "", "circle along which a free, closed sheet is laid" }, g.circle);
  v.value({ "circumference_m", optional, "m",
            "unstretched length around, or from end to end; the excess over the path is slack, laid in evenly" },
          g.circumference_m, positive());
  v.value({ "slack", optional, "", "the same as unstretched length over that of the path, less 1" }, g.slack,
          non_negative());
  v.value({ "pretension_n_per_m", optional, "N/m", "tension in the sheet as it is laid" }, g.pretension_n_per_m,
          non_negative());
  const bool open = g.line && !g.line->closed;
  const bool free = g.encloses.empty();
  v.section({ "start", optional, "", "what happens at the first point of an open line", open, "an open `line`" },
            g.start);
  v.section({ "end", optional, "", "what happens at the last point of an open line", open, "an open `line`" }, g.end);
  v.section(
      { "inside_pressure", optional, "",
        "pressure on the inner side: (pressure_pa + gradient_pa_per_m (level - z)) factor", !open, "a closed sheet" },
      g.inside_pressure);
  v.value({ "velocity_field", optional, "", "as for bodies; a sheet around a body moves in the body's field", free,
            "a free sheet (`line` or `circle`)" },
          g.velocity_field);
  v.value({ "initial_velocity_m_per_s", optional, "m/s", "velocity of the whole sheet at the start", free,
            "a free sheet (`line` or `circle`)" },
          g.initial_velocity_m_per_s);
  v.section({ "initial_velocity_wave", optional, "", "a sine over space on top: a mode of vibration", free,
              "a free sheet (`line` or `circle`)" },
            g.initial_velocity_wave);
  v.value({ "formulation", optional, "",
            "how its tension arises: from the distance of its points, or as York's membrane points from the grid's "
            "velocity gradient" },
          g.formulation);
  v.value({ "force_strain_table", optional, "1, N/m",
            "force per width over strain (warp) from [0, 0], both ascending; beyond the last row with the last slope" },
          g.force_strain_table, rows("strain, n_per_m"));
  const bool linear = g.force_strain_table.empty();
  v.value({ "stiffness_n_per_m", linear ? required : optional, "N/m",
            "J (warp): force per width and unit strain; of no account with `force_strain_table`" },
          g.stiffness_n_per_m, linear ? positive() : non_negative());
  v.value({ "stiffness_weft_n_per_m", optional, "N/m",
            "in a scene with `space`, J along the barge; absent: as across it. Of no account with "
            "`force_strain_weft_table`" },
          g.stiffness_weft_n_per_m, positive());
  v.value({ "force_strain_weft_table", optional, "1, N/m", "the same as `force_strain_table` along the barge" },
          g.force_strain_weft_table, rows("strain, force"));
  v.value({ "strength_weft_n_per_m", optional, "N/m", "tensile strength along the barge; absent: as across it" },
          g.strength_weft_n_per_m, positive());
  v.value({ "end_slack", optional, "",
            "in a scene with `space`, length of cloth in a closed end over that of the flat end, both ways, less 1; "
            "absent: as around the section" },
          g.end_slack, non_negative());
  v.value({ "mass_kg_per_m2", required, "kg/m2", "true mass: what gravity pulls" }, g.mass_kg_per_m2, positive());
  v.value(
      { "computational_mass_kg_per_m2", required, "kg/m2", "inertia used (mass scaling), not below `mass_kg_per_m2`" },
      g.computational_mass_kg_per_m2, positive());
  v.value({ "strength_n_per_m", required, "N/m", "tensile strength of the sheet (warp)" }, g.strength_n_per_m,
          positive());
  v.value({ "rupture_strain", optional, "",
            "strain at which a piece of the sheet breaks and from then on carries nothing; absent: never" },
          g.rupture_strain, positive());
  v.map({ "seams", optional, "", "seams that run along the barge, by name; none: a seam may be anywhere" }, g.seams);
  v.value({ "seam_efficiency", optional, "", "strength of a seam over the sheet's, where the seam gives no own" },
          g.seam_efficiency, open_closed(0.0, 1.0));
  v.value({ "segment_length_m", required, "m", "wanted length of a membrane segment; about a cell" },
          g.segment_length_m, positive());
  v.value({ "gauge_length_m", optional, "m", "reported tension is the mean over this; not below `segment_length_m`" },
          g.gauge_length_m, positive());
  v.section({ "wrinkles", optional, "", "cloth laid in folds along part of the path; other slack is spread evenly" },
            g.wrinkles);
  v.value(
      { "interface", optional, "",
        "between the sheet and the body that it encloses. `bonded`: one velocity field; `frictional`: they slip and "
        "part",
        !free, "a sheet that encloses a body" },
      g.interface);
  const bool slips = g.interface == SheetInterface::frictional;
  v.value({ "interface_friction", required, "", "Coulomb coefficient between sheet and body: tan(delta)", slips,
            "interface `frictional`" },
          g.interface_friction, non_negative());
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
  v.value({ "along_m", optional, "m",
            "[from, to]: in a scene with `space` the hopper between its end bulkheads, which part with the halves; "
            "absent: no bulkheads" },
          h.along_m);
  v.value({ "opening_table", optional, "s, rad, rad",
            "opening used when no log is given, times ascending from 0 or later, angles in the believable range of "
            "`signal`; empty: the hull stays closed" },
          h.opening_table);
  v.section({ "signal", optional, "", "how logged angles are judged and filtered" }, h.signal);
  v.value({ "full_opening_rad", optional, "rad",
            "where the halves stop, as a forecast assumes; absent: the largest angle of `opening_table`, without one "
            "`signal.max_angle_rad`" },
          h.full_opening_rad, positive());
}

template <class V>
void describe(V& v, MotionDescription& m)
{
  v.value({ "pivot_m", optional, "m", "point about which the surface turns, where it is without displacement" },
          m.pivot_m);
  v.value({ "table", required, "s, m, m, rad",
            "displacement of the pivot, and rotation about +x (y towards z), over time" },
          m.table, rows("time_s, y, z, angle", 1));
}

template <class V>
void describe(V& v, SurfaceDescription& s)
{
  v.value({ "line_m", required, "m", "corners of the line; the free side is on the left walking along it" }, s.line_m,
          at_least(2));
  v.value({ "closed", optional, "", "joined from the last point to the first" }, s.closed);
  v.value({ "corner_radius_m", optional, "m", "corners are rounded with this radius", !s.closed, "an open line" },
          s.corner_radius_m, non_negative());
  v.value({ "friction", required, "", "Coulomb coefficient" }, s.friction, non_negative());
  v.section({ "motion", optional, "",
              "prescribed rigid motion: x = pivot + R(angle) (X - pivot) + displacement; absent: stands still" },
            s.motion);
}

}  // namespace geocontainer_mpm::scene::grammar
