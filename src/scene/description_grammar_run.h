#pragma once
/// The scene grammar: how long, on what grid, and how a case is computed.

#include <array>

#include "description_key.h"
#include "description_leaf.h"
#include "geocontainer_mpm/scene/description.h"

namespace geocontainer_mpm::scene::grammar {

template <class V>
void describe(V& v, TimeDescription& t)
{
  v.value({ "end_s", required, "s", "simulated time at which the run is complete" }, t.end_s, positive());
  v.value({ "output_interval_s", optional, "s", "spacing of frames in record and topics" }, t.output_interval_s,
          positive());
  v.value({ "probe_interval_s", optional, "s", "spacing of the samples of `probes`; absent: one a frame" },
          t.probe_interval_s, positive());
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
void describe(V& v, SpaceDescription& s)
{
  v.value({ "along_m", required, "m",
            "[from, to]: extent along x of the space that material may occupy, a whole number of cells" },
          s.along_m);
  v.value({ "x_min", optional, "", "face towards aft" }, s.faces[0]);
  v.value({ "x_max", optional, "", "face towards the bow" }, s.faces[1]);
  v.value({ "symmetry", optional, "",
            "which part of a scene that is its own mirror image is computed. `half`: y >= 0; `quarter`: x >= 0 and "
            "y >= 0; the scene describes all of it" },
          s.symmetry);
}

template <class V>
void describe(V& v, NumericsDescription& n)
{
  using mpm::Transfer;
  v.value({ "shape", optional, "",
            "shape functions. `bspline2`: quadratic B-splines; `linear_simplex`: three-node triangles, two a cell, the "
            "founding paper's; `gimp`: linear ones averaged over the particle's box, which follows its stretch" },
          n.method.shape);
  v.value(
      { "transfer", optional, "",
        "between particles and grid. `apic`: affine, not with `linear_simplex`; `flip`: particles take the grid's "
        "change of velocity; `aflip`: affine, and particles keep for `transfer_memory_s` what the grid does not see "
        "of their velocity" },
      n.method.transfer);
  v.value({ "flip_fraction", optional, "", "1: pure FLIP; 0: particles take the grid's velocity itself (PIC)",
            n.method.transfer == Transfer::flip, "transfer `flip`" },
          n.method.flip_fraction, closed(0.0, 1.0));
  v.value({ "transfer_memory_s", optional, "s",
            "time in which what the grid does not see of a particle's velocity falls by a factor e, however short the "
            "steps",
            n.method.transfer == Transfer::aflip, "transfer `aflip`" },
          n.transfer_memory_s, positive());
  v.value(
      { "mass", optional, "",
        "mass matrix; `consistent` with transfer `flip` and where nothing touches or is held but by the grid's faces" },
      n.method.mass);
  v.value({ "update", optional, "",
            "when stress is updated. `usl`: last; `usf`: first; `musl`: last, from velocities mapped back from the "
            "moved particles" },
          n.method.update);
  v.value({ "smoothing", optional, "",
            "remedy against locking. `cell_average`: mean strain rate and stress of an element; `nodal_mixed`: "
            "volumetric strain rate and mean stress averaged over the nodes" },
          n.method.smoothing);
  v.value({ "time_step_factor", optional, "", "fraction of the stability bound that a step may use" },
          n.time_step_factor, open_closed(0.0, 1.0));
  v.value({ "max_step_s", optional, "s", "upper bound of a step" }, n.max_step_s, positive());
  v.value({ "max_travel_cells", optional, "cells", "furthest that a particle may move in a step" }, n.max_travel_cells,
          open_closed(0.0, 0.5));
  v.value({ "damping_per_s", optional, "1/s", "mass-proportional damping of the live run; 0 for physics" },
          n.damping_per_s, non_negative());
  v.value({ "skip_resting", optional, "", "take no steps while nothing moves; absent: in a scene with a hull" },
          n.skip_resting);
  v.value(
      { "rest_velocity_m_per_s", optional, "m/s", "root-mean-square velocity below which a body counts as resting" },
      n.rest_velocity_m_per_s, positive());
  v.value({ "rest_time_s", optional, "s", "how long it must stay below" }, n.rest_time_s, positive());
  v.value({ "max_halvings", optional, "", "how often a step that went wrong is halved before the run ends" },
          n.max_halvings, closed(0, 20));
  v.value({ "energy_jump", optional, "",
            "energy from nowhere, over that present or exchanged, at which a step counts as gone wrong" },
          n.energy_jump, positive());
  v.value(
      { "speed_jump", optional, "",
        "speed of a particle, over what fall, start, walls and loads explain, at which a step counts as gone wrong; "
        "of a sheet five times that" },
      n.speed_jump, above(1.0));
}

template <class V>
void describe(V& v, OutcomeDescription& o)
{
  v.value({ "hung_up_after_s", optional, "s", "standing still this long in the open slot means hung up" },
          o.hung_up_after_s, positive());
}

}  // namespace geocontainer_mpm::scene::grammar
