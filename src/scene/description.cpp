#include "geocontainer_mpm/scene/description.h"

#include <algorithm>
#include <cctype>
#include <limits>
#include <set>

#include "description_grammar.h"
#include "description_rules.h"
#include "geocontainer_mpm/error.h"

namespace geocontainer_mpm::scene {

double HullDescription::full_opening() const
{
  if (full_opening_rad)
    return *full_opening_rad;
  double largest = 0.0;
  for (const OpeningRow& row : opening_table)
    largest = std::max({ largest, row.port_rad, row.starboard_rad });
  return largest > 0.0 ? largest : signal.max_angle_rad;
}

namespace {

using grammar::joined;
using grammar::Key;
using grammar::Limits;

/// Holds each key to its own limits.
class Checker {
public:
  explicit Checker(std::string path) : path_(std::move(path)) {}

  template <class T>
  void value(const Key& key, T& member, const Limits& limits = {})
  {
    if (key.applies)
      grammar::check(member, joined(path_, key.name), limits);
  }
  template <class T>
  void section(const Key& key, T& member)
  {
    if (!key.applies)
      return;
    Checker checker(joined(path_, key.name));
    grammar::describe(checker, member);
  }
  template <class T>
  void section(const Key& key, std::optional<T>& member)
  {
    if (member && !key.applies)
      grammar::refuse(joined(path_, key.name), "", grammar::does_not_apply(key));
    if (member)
      section(key, *member);
  }
  template <class T>
  void map(const Key& key, std::map<std::string, T>& member)
  {
    const std::string path = joined(path_, key.name);
    for (auto& [name, entry] : member) {
      check_name(name, joined(path, name), "");
      Checker checker(joined(path, name));
      grammar::describe(checker, entry);
    }
  }
  template <class T>
  void checked_by_itself(T& member)
  {
    member.validate(path_);
  }

private:
  std::string path_;
};

}  // namespace

Vec2 SceneDescription::gravity_at(double time_s) const
{
  if (gravity_table.empty())
    return gravity_m_per_s2;
  const std::array<double, 2> value = value_at(gravity_table, time_s);
  return { value[0], value[1] };
}

double SceneDescription::water_level_m() const
{
  if (!water->draught_m)
    return water->level_m.value();
  double keel = std::numeric_limits<double>::infinity();
  for (const Vec2& corner : hull->port_section_m)
    keel = std::min(keel, corner[1]);
  return keel + *water->draught_m;
}

std::vector<std::string> SceneDescription::velocity_fields() const
{
  std::set<std::string> fields;
  const auto add = [&fields](const std::string& field) { fields.insert(field.empty() ? common_field : field); };
  for (const auto& entry : bodies)
    add(entry.second.velocity_field);
  for (const auto& entry : geotextiles)
    if (entry.second.encloses.empty())
      add(entry.second.velocity_field);
  return { fields.begin(), fields.end() };
}

bool SceneDescription::is_container(const std::string& field) const
{
  const auto in_field = [&field](const std::string& named) { return (named.empty() ? common_field : named) == field; };
  std::size_t bodies_in = 0, sheets_around = 0;
  for (const auto& entry : bodies)
    bodies_in += in_field(entry.second.velocity_field) ? 1 : 0;
  for (const auto& entry : geotextiles) {
    const bool free = entry.second.encloses.empty();
    if (free && in_field(entry.second.velocity_field))
      return false;
    sheets_around += !free && in_field(bodies.at(entry.second.encloses).velocity_field) ? 1 : 0;
  }
  return bodies_in == 1 && sheets_around == 1;
}

void SceneDescription::validate() const
{
  try {
    SceneDescription copy = *this;  // a description is visited as something that can be written to
    Checker checker("");
    grammar::describe(checker, copy);
    check_rules(*this);
  } catch (const InputError& error) {
    throw InputError(source, error.key(), error.value(), error.allowed());
  }
}

}  // namespace geocontainer_mpm::scene
