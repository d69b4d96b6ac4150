#pragma once
/// What a scene key may hold, and how a value is refused.

#include <yaml-cpp/yaml.h>

#include <cstddef>
#include <limits>
#include <string>

namespace geocontainer_mpm::scene::grammar {

/// Interval of a number, or length of a list or text.
struct Limits {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  bool lower_open = false;
  bool upper_open = false;
  std::size_t min_count = 0;
  const char* told = nullptr;     ///< words for an interval that the struct's own validate() checks
  const char* columns = nullptr;  ///< words for a row of a table
  std::size_t max_count = std::numeric_limits<std::size_t>::max();

  bool contains(double value) const;
  std::string text() const;  ///< such as `> 0` or `in (0, 0.5]`; empty for no limit
};

inline Limits positive()
{
  Limits limits;
  limits.lower = 0.0;
  limits.lower_open = true;
  return limits;
}
inline Limits above(double lower)
{
  Limits limits;
  limits.lower = lower;
  limits.lower_open = true;
  return limits;
}
inline Limits non_negative()
{
  Limits limits;
  limits.lower = 0.0;
  return limits;
}
inline Limits closed(double lower, double upper)
{
  Limits limits;
  limits.lower = lower;
  limits.upper = upper;
  return limits;
}
inline Limits open_closed(double lower, double upper)
{
  Limits limits = closed(lower, upper);
  limits.lower_open = true;
  return limits;
}
inline Limits at_least(std::size_t count)
{
  Limits limits;
  limits.min_count = count;
  return limits;
}
inline Limits exactly(std::size_t count)
{
  Limits limits = at_least(count);
  limits.max_count = count;
  return limits;
}
inline Limits rows(const char* columns, std::size_t min_count = 0)
{
  Limits limits = at_least(min_count);
  limits.columns = columns;
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

/// Key of an item of a list, such as `hull.opening_table[1]`.
std::string indexed(const std::string& key, std::size_t index);

}  // namespace geocontainer_mpm::scene::grammar
