#pragma once
/// The scene grammar: what acts on bodies and what is measured.

#include "description_key.h"
#include "description_leaf.h"
#include "geocontainer_mpm/scene/description.h"

namespace geocontainer_mpm::scene::grammar {

template <class V>
void describe(V& v, SupportDescription& s)
{
  v.section({ "region", required, "", "nodes within or on the edge of this rectangle; it may be a line or a point" },
            s.region);
  v.value({ "holds_y", optional, "", "prescribes the motion in y" }, s.holds_y);
  v.value({ "holds_z", optional, "", "prescribes the motion in z" }, s.holds_z);
  v.value({ "velocity_table", optional, "s, m/s, m/s", "velocity over time in the directions held; empty: still" },
          s.velocity_table, rows("time_s, v_y, v_z"));
}

template <class V>
void describe(V& v, TractionDescription& t)
{
  v.value({ "body", required, "", "a name in `bodies`" }, t.body, at_least(1));
  v.section({ "region", optional, "",
              "the pieces of the body's boundary whose middle lies in this rectangle at the start; absent: all of it" },
            t.region);
  v.value({ "traction_pa", optional, "Pa", "force per present area, its direction fixed in space" }, t.traction_pa);
  v.value({ "pressure_pa", optional, "Pa", "against the present surface, inwards positive" }, t.pressure_pa);
  v.value({ "table", optional, "s, 1", "factor on both over time; empty: 1" }, t.table, rows("time_s, factor"));
}

template <class V>
void describe(V& v, ContactDescription& c)
{
  v.value({ "between", required, "", "two names of velocity fields of bodies and sheets; `common` is the unnamed one" },
          c.between, exactly(2));
  v.value({ "friction", required, "", "Coulomb coefficient" }, c.friction, non_negative());
}

template <class V>
void describe(V& v, WaterDescription& w)
{
  v.value({ "density_kg_per_m3", required, "kg/m3", "1025 at sea, 1000 fresh" }, w.density_kg_per_m3, positive());
  v.value(
      { "draught_m", optional, "m",
        "how far the surface is above the lowest point of the closed hull; says where it is in a scene with `hull`" },
      w.draught_m, positive());
  v.value({ "level_m", optional, "m", "z of the surface; says where it is in a scene without `hull`" }, w.level_m);
  v.value({ "drag_coefficient", required, "",
            "Cd: drag of a body is density / 2 Cd width speed^2 per metre, the width across its motion. About 1; 0 for "
            "none" },
          w.drag_coefficient, non_negative());
  v.value({ "added_mass_coefficient", required, "",
            "Ca: water that moves with a body, over the water that the body displaces. Circle 1, ellipse that is wide "
            "across its motion: width over height; 0 for none" },
          w.added_mass_coefficient, non_negative());
}

template <class V>
void describe(V& v, PointProbe& p)
{
  v.value({ "body", required, "", "a name in `bodies`" }, p.body, at_least(1));
  v.value({ "at_m", required, "m", "where the material point is at the start; it moves with the body" }, p.at_m);
}

template <class V>
void describe(V& v, SectionProbe& s)
{
  v.value({ "from_m", required, "m", "one end of a straight cut, fixed in space" }, s.from_m);
  v.value({ "to_m", required, "m", "the other end" }, s.to_m);
}

template <class V>
void describe(V& v, GeotextileProbe& g)
{
  v.value({ "name", required, "", "a name in `geotextiles`" }, g.geotextile, at_least(1));
  v.value({ "at_m", optional, "m", "the sheet's point nearest to this at the start is followed as well" }, g.at_m);
}

template <class V>
void describe(V& v, ProbeDescription& p)
{
  v.section({ "point", optional, "", "displacement, velocity and stress of a material point" }, p.point);
  v.value({ "body", optional, "",
            "a name in `bodies`: its centroid, mean velocity, mean stress, volume, extent and energies" },
          p.body, at_least(1));
  v.section({ "section", optional, "",
              "force that what is on the right of a cut, walking along it, exerts on what is on the left" },
            p.section);
  v.section({ "geotextile", optional, "", "largest and mean tension, length, enclosed area and extent of a sheet" },
            p.geotextile);
  v.value({ "surface", optional, "",
            "a name in `surfaces`, or a part of the hull (hull_port, hull_starboard, in space hull_bulkhead_aft_port "
            "and the like): force, moment about the pivot, and work" },
          p.surface, at_least(1));
  v.value({ "manufactured", optional, "", "a name in `bodies`: its distance from its manufactured solution" },
          p.manufactured, at_least(1));
}

}  // namespace geocontainer_mpm::scene::grammar
