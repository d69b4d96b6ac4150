#pragma once
/// The scene grammar: one `describe` for each struct, one line for each key. Reading, checking, writing, overriding and
/// documenting a scene are visitors of these functions, so that a key, its type, unit, range and meaning stand once.
/// This file has the scene itself; its parts are in the files that it includes.
///
/// A visitor offers: value(key, member, limits), section(key, member or std::optional member),
/// map(key, std::map by name), checked_by_itself(struct with a validate() of its own).

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "description_grammar_body.h"
#include "description_grammar_boundary.h"
#include "description_grammar_load.h"
#include "description_grammar_run.h"

namespace geocontainer_mpm::scene::grammar {

template <class V>
void describe(V& v, SceneDescription& s)
{
  v.value({ "name", required, "", "short name, for summaries and records" }, s.name, at_least(1));
  v.value({ "description", optional, "", "one sentence on what the scene shows" }, s.description);
  v.value({ "gravity_table", optional, "s, m/s2, m/s2", "gravity over time" }, s.gravity_table,
          rows("time_s, g_y, g_z"));
  v.value({ "gravity_m_per_s2", optional, "m/s2", "gravity, or another force per mass", s.gravity_table.empty(),
            "a scene without `gravity_table`" },
          s.gravity_m_per_s2);
  v.section({ "time", required, "", "duration and output" }, s.time);
  v.section({ "grid", required, "", "background grid and its faces" }, s.grid);
  v.section({ "space", optional, "",
              "given: the scene is three-dimensional, and the section that all else draws in y and z reaches along x" },
            s.space);
  v.section({ "numerics", optional, "", "discretisation, time stepping and rest" }, s.numerics);
  v.map({ "materials", optional, "", "constitutive laws by name" }, s.materials);
  v.map({ "bodies", optional, "", "bodies of particles by name; at least one body or geotextile" }, s.bodies);
  v.map({ "geotextiles", optional, "", "sheets by name, each around its own body, or free" }, s.geotextiles);
  v.section({ "hull", optional, "", "split hull: its section, hinge and motion" }, s.hull);
  v.map({ "surfaces", optional, "", "rigid surfaces by name, standing still or moved: the bed" }, s.surfaces);
  v.map({ "supports", optional, "", "regions of the grid whose nodes are held or moved, by name" }, s.supports);
  v.map({ "tractions", optional, "", "stresses on the boundary of a body, by name" }, s.tractions);
  v.map({ "contacts", optional, "",
          "contact between velocity fields, by name: each pair of fields that bodies and sheets use is named once" },
        s.contacts);
  v.map({ "probes", optional, "",
          "what is measured during the run, by name: exactly one of the six below each. The time series land in "
          "summary and record" },
        s.probes);
  v.section({ "outcome", optional, "", "how the outcome is judged" }, s.outcome);
  v.section({ "water", optional, "",
              "still water around the bodies: buoyancy, drag and added mass. Needs constant gravity along -z" },
            s.water);
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
