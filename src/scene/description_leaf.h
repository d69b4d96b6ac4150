#pragma once
/// The values a scene key may hold: how each type is read from YAML, written, checked and put in words.

#include <yaml-cpp/yaml.h>

#include <array>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "geocontainer_mpm/scene/description.h"

namespace geocontainer_mpm::scene::grammar {

/// Interval of a number, or least length of a list or text.
struct Limits {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  bool lower_open = false;
  bool upper_open = false;
  std::size_t min_count = 0;
  const char* told = nullptr;  ///< words for an interval that the struct's own validate() checks

  bool contains(double value) const;
  std::string text() const;  ///< such as `> 0` or `in (0, 0.5]`; empty for no limit
};

inline Limits positive()
{
  return { 0.0, std::numeric_limits<double>::infinity(), true, false, 0, nullptr };
}
inline Limits non_negative()
{
  return { 0.0, std::numeric_limits<double>::infinity(), false, false, 0, nullptr };
}
inline Limits closed(double lower, double upper)
{
  return { lower, upper, false, false, 0, nullptr };
}
inline Limits open_closed(double lower, double upper)
{
  return { lower, upper, true, false, 0, nullptr };
}
inline Limits at_least(std::size_t count)
{
  Limits limits;
  limits.min_count = count;
  return limits;
}
inline Limits told(const char* words)
{
  Limits limits;
  limits.told = words;
  return limits;
}

[[noreturn]] void refuse(const std::string& key, const std::string& value, const std::string& allowed);
/// One line for a message, whatever the node is.
std::string text_of(const YAML::Node& node);
/// Shortest text that reads back to the same bits.
std::string number_text(double value);

// type_text: what is allowed, in words. parse: refuses a node of another type. check: refuses a value out of limits
// or not finite. to_text: YAML that reads back to the same value.
std::string type_text(const double&, const Limits& limits);
std::string type_text(const int&, const Limits& limits);
std::string type_text(const bool&, const Limits& limits);
std::string type_text(const std::string&, const Limits& limits);
std::string type_text(const Vec2&, const Limits& limits);
std::string type_text(const std::vector<Vec2>&, const Limits& limits);
std::string type_text(const std::vector<OpeningRow>&, const Limits& limits);

void parse(const YAML::Node& node, const std::string& key, const Limits& limits, double& value);
void parse(const YAML::Node& node, const std::string& key, const Limits& limits, int& value);
void parse(const YAML::Node& node, const std::string& key, const Limits& limits, bool& value);
void parse(const YAML::Node& node, const std::string& key, const Limits& limits, std::string& value);
void parse(const YAML::Node& node, const std::string& key, const Limits& limits, Vec2& value);
void parse(const YAML::Node& node, const std::string& key, const Limits& limits, std::vector<Vec2>& value);
void parse(const YAML::Node& node, const std::string& key, const Limits& limits, std::vector<OpeningRow>& value);

void check(const double& value, const std::string& key, const Limits& limits);
void check(const int& value, const std::string& key, const Limits& limits);
void check(const bool& value, const std::string& key, const Limits& limits);
void check(const std::string& value, const std::string& key, const Limits& limits);
void check(const Vec2& value, const std::string& key, const Limits& limits);
void check(const std::vector<Vec2>& value, const std::string& key, const Limits& limits);
void check(const std::vector<OpeningRow>& value, const std::string& key, const Limits& limits);

std::string to_text(const double& value);
std::string to_text(const int& value);
std::string to_text(const bool& value);
std::string to_text(const std::string& value);
std::string to_text(const Vec2& value);
std::string to_text(const std::vector<Vec2>& value);
std::string to_text(const std::vector<OpeningRow>& value);

/// Words of an enumeration in a scene file, by enumerator.
template <class Enum>
struct Words;
template <>
struct Words<FaceCondition> {
  static constexpr std::array<std::pair<FaceCondition, const char*>, 3> list{
    { { FaceCondition::free, "free" }, { FaceCondition::roller, "roller" }, { FaceCondition::fixed, "fixed" } }
  };
};
template <>
struct Words<InitialStress> {
  static constexpr std::array<std::pair<InitialStress, const char*>, 3> list{
    { { InitialStress::none, "none" }, { InitialStress::k0, "k0" }, { InitialStress::gravity, "gravity" } }
  };
};
template <>
struct Words<material::LawName> {
  static constexpr std::array<std::pair<material::LawName, const char*>, 2> list{
    { { material::LawName::linear_elastic, "linear_elastic" }, { material::LawName::mohr_coulomb, "mohr_coulomb" } }
  };
};

template <class Enum, class = decltype(Words<Enum>::list)>
std::string type_text(const Enum&, const Limits&)
{
  std::string text = "one of ";
  for (const auto& [value, word] : Words<Enum>::list)
    text += (value == Words<Enum>::list.front().first ? "" : ", ") + std::string(word);
  return text;
}

template <class Enum, class = decltype(Words<Enum>::list)>
void parse(const YAML::Node& node, const std::string& key, const Limits& limits, Enum& value)
{
  if (node.IsScalar())
    for (const auto& [candidate, word] : Words<Enum>::list)
      if (node.Scalar() == word) {
        value = candidate;
        return;
      }
  refuse(key, text_of(node), "must be " + type_text(value, limits));
}

template <class Enum, class = decltype(Words<Enum>::list)>
std::string to_text(const Enum& value)
{
  for (const auto& [candidate, word] : Words<Enum>::list)
    if (candidate == value)
      return word;
  return std::to_string(static_cast<int>(value));
}

template <class Enum, class = decltype(Words<Enum>::list)>
void check(const Enum& value, const std::string& key, const Limits& limits)
{
  for (const auto& entry : Words<Enum>::list)
    if (entry.first == value)
      return;
  refuse(key, to_text(value), "must be " + type_text(value, limits));
}

}  // namespace geocontainer_mpm::scene::grammar
