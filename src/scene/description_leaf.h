#pragma once
/// The values a scene key may hold: how each type is read from YAML, written, checked and put in words.

#include <yaml-cpp/yaml.h>

#include <optional>
#include <string>
#include <vector>

#include "description_leaf_enum.h"
#include "description_leaf_table.h"
#include "description_limits.h"
#include "geocontainer_mpm/scene/description.h"

namespace geocontainer_mpm::scene::grammar {

// type_text: what is allowed, in words. parse: refuses a node of another type. check: refuses a value out of limits
// or not finite. to_text: YAML that reads back to the same value.
std::string type_text(const double&, const Limits& limits);
std::string type_text(const int&, const Limits& limits);
std::string type_text(const bool&, const Limits& limits);
std::string type_text(const std::string&, const Limits& limits);
std::string type_text(const Vec2&, const Limits& limits);
std::string type_text(const std::vector<Vec2>&, const Limits& limits);
std::string type_text(const std::vector<OpeningRow>&, const Limits& limits);
std::string type_text(const std::vector<std::string>&, const Limits& limits);
std::string type_text(const std::vector<geotextile::ForceStrainRow>&, const Limits& limits);

void parse(const YAML::Node& node, const std::string& key, const Limits& limits, double& value);
void parse(const YAML::Node& node, const std::string& key, const Limits& limits, int& value);
void parse(const YAML::Node& node, const std::string& key, const Limits& limits, bool& value);
void parse(const YAML::Node& node, const std::string& key, const Limits& limits, std::string& value);
void parse(const YAML::Node& node, const std::string& key, const Limits& limits, Vec2& value);
void parse(const YAML::Node& node, const std::string& key, const Limits& limits, std::vector<Vec2>& value);
void parse(const YAML::Node& node, const std::string& key, const Limits& limits, std::vector<OpeningRow>& value);
void parse(const YAML::Node& node, const std::string& key, const Limits& limits, std::vector<std::string>& value);
void parse(const YAML::Node& node, const std::string& key, const Limits& limits,
           std::vector<geotextile::ForceStrainRow>& table);

void check(const double& value, const std::string& key, const Limits& limits);
void check(const int& value, const std::string& key, const Limits& limits);
void check(const bool& value, const std::string& key, const Limits& limits);
void check(const std::string& value, const std::string& key, const Limits& limits);
void check(const Vec2& value, const std::string& key, const Limits& limits);
void check(const std::vector<Vec2>& value, const std::string& key, const Limits& limits);
void check(const std::vector<OpeningRow>& value, const std::string& key, const Limits& limits);
void check(const std::vector<std::string>& value, const std::string& key, const Limits& limits);
void check(const std::vector<geotextile::ForceStrainRow>& table, const std::string& key, const Limits& limits);

std::string to_text(const double& value);
std::string to_text(const int& value);
std::string to_text(const bool& value);
std::string to_text(const std::string& value);
std::string to_text(const Vec2& value);
std::string to_text(const std::vector<Vec2>& value);
std::string to_text(const std::vector<OpeningRow>& value);
std::string to_text(const std::vector<std::string>& value);
std::string to_text(const std::vector<geotextile::ForceStrainRow>& table);

// A value that may be absent: read, checked and written like one that is there.
template <class T>
std::string type_text(const std::optional<T>&, const Limits& limits)
{
  return type_text(T{}, limits);
}
template <class T>
void parse(const YAML::Node& node, const std::string& key, const Limits& limits, std::optional<T>& value)
{
  parse(node, key, limits, value.emplace());
}
template <class T>
void check(const std::optional<T>& value, const std::string& key, const Limits& limits)
{
  if (value)
    check(*value, key, limits);
}
template <class T>
std::string to_text(const std::optional<T>& value)
{
  return value ? to_text(*value) : "absent";
}

/// Whether a value that need not be given was given. An empty text counts as none.
template <class T>
bool given(const T&)
{
  return true;
}
template <class T>
bool given(const std::optional<T>& value)
{
  return value.has_value();
}
inline bool given(const std::string& value)
{
  return !value.empty();
}

}  // namespace geocontainer_mpm::scene::grammar
