#pragma once
/// Rules that tie several keys together; those of a single key stand in the grammar. Each throws InputError without a
/// source. Every key by itself is within its limits already.

#include <Eigen/Geometry>
#include <initializer_list>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "description_limits.h"
#include "geocontainer_mpm/scene/description.h"

namespace geocontainer_mpm::scene {

void check_rules(const SceneDescription& scene);

// By topic, a file each.
void check_bodies(const SceneDescription& scene);
void check_geotextiles(const SceneDescription& scene);
void check_boundaries(const SceneDescription& scene);
void check_loads(const SceneDescription& scene);
void check_contacts(const SceneDescription& scene);
void check_probes(const SceneDescription& scene);
void check_water(const SceneDescription& scene);
void check_space(const SceneDescription& scene);

// What several topics need.
inline constexpr double relative_tolerance = 1e-9;
/// Share of a cell by which a position may miss a grid line and still lie on it.
inline constexpr double cell_tolerance = 1e-6;

/// Names become HDF5 groups, marker namespaces and parts of dotted keys.
void check_name(const std::string& name, const std::string& key, const std::string& value);

/// Refuses `key` unless the number of things that are set lies in [least, most].
using Choice = std::pair<const char*, bool>;
void check_choice(const std::string& key, std::initializer_list<Choice> choices, int least, int most);

/// Refuses a line (closed: a polygon) whose sides cross or have no length.
void check_simple(const std::string& key, const std::vector<Vec2>& vertices, bool closed);

/// Refuses corners of an open line that a rounding of this radius does not fit.
void check_rounding(const std::string& key, double radius_m, const std::vector<Vec2>& line, const char* line_name);

/// Beyond this a scene is a slip of the pen (a cell size in millimetres) and would end in a crash for lack of memory.
inline constexpr double max_cells = 5e7;

Eigen::AlignedBox2d space_of(const GridDescription& grid);
void check_inside(const std::string& key, const Eigen::AlignedBox2d& box, const GridDescription& grid);

template <class Map>
std::string names_in(const Map& map)
{
  std::string text;
  for (const auto& entry : map)
    text += (text.empty() ? "" : ", ") + entry.first;
  return text.empty() ? "none" : text;
}

/// The entry of that name, or a refusal of `key`.
template <class T>
const T& entry_of(const std::map<std::string, T>& map, const std::string& name, const std::string& key,
                  const char* map_name)
{
  const auto entry = map.find(name);
  if (entry == map.end())
    grammar::refuse(key, name, std::string("must be a name in ") + map_name + ": " + names_in(map));
  return entry->second;
}

}  // namespace geocontainer_mpm::scene
