#include "description_leaf.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "geocontainer_mpm/error.h"

namespace geocontainer_mpm::scene::grammar {

namespace {

constexpr std::size_t longest_value_shown = 60;

/// yaml-cpp gives quoted scalars the tag `!`: a number or a switch in quotes is text.
template <class T>
bool convert(const YAML::Node& node, T& value)
{
  return node.IsScalar() && node.Tag() != "!" && YAML::convert<T>::decode(node, value);
}

std::string counted(const std::string& things, const Limits& limits)
{
  if (limits.min_count == limits.max_count)
    return fmt::format("a list of {} {}", limits.min_count, things);
  return limits.min_count > 0 ? fmt::format("a list of at least {} {}", limits.min_count, things)
                              : fmt::format("a list of {}", things);
}

template <class Item, class ItemText>
std::string list_text(const std::vector<Item>& items, ItemText item_text)
{
  std::string text = "[";
  for (const Item& item : items)
    text += (text.size() > 1 ? ", " : "") + item_text(item);
  return text + "]";
}

std::string row_text(const OpeningRow& row)
{
  return fmt::format("[{}, {}, {}]", number_text(row.time_s), number_text(row.port_rad),
                     number_text(row.starboard_rad));
}

void parse_row(const YAML::Node& node, const std::string& key, OpeningRow& row)
{
  const bool good = node.IsSequence() && node.size() == 3 && convert(node[0], row.time_s) &&
                    convert(node[1], row.port_rad) && convert(node[2], row.starboard_rad);
  if (!good)
    refuse(key, text_of(node), "must be [time_s, port_rad, starboard_rad]: three numbers");
}

template <class List>
void check_count(const List& list, const std::string& key, const Limits& limits)
{
  if (list.size() < limits.min_count || list.size() > limits.max_count)
    refuse(key, fmt::format("{} given", list.size()), "must be " + type_text(list, limits));
}

}  // namespace

bool Limits::contains(double value) const
{
  return std::isfinite(value) && (lower_open ? value > lower : value >= lower) &&
         (upper_open ? value < upper : value <= upper);
}

std::string Limits::text() const
{
  if (told)
    return told;
  const bool bounded_below = std::isfinite(lower);
  const bool bounded_above = std::isfinite(upper);
  if (bounded_below && bounded_above)
    return fmt::format("in {}{}, {}{}", lower_open ? '(' : '[', number_text(lower), number_text(upper),
                       upper_open ? ')' : ']');
  if (bounded_below)
    return fmt::format("{} {}", lower_open ? ">" : ">=", number_text(lower));
  if (bounded_above)
    return fmt::format("{} {}", upper_open ? "<" : "<=", number_text(upper));
  return {};
}

void refuse(const std::string& key, const std::string& value, const std::string& allowed)
{
  throw InputError("", key, value, allowed);
}

std::string text_of(const YAML::Node& node)
{
  if (!node.IsDefined() || node.IsNull())
    return "nothing";
  if (node.IsMap())
    return "a map of keys";
  std::string text;
  if (node.IsScalar()) {
    text = node.Scalar().empty() ? "''" : node.Scalar();
  } else {
    YAML::Emitter emitter;
    emitter << YAML::Flow << node;
    text = emitter.c_str();
  }
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r' || c == '\t'; }, ' ');
  if (text.size() > longest_value_shown)
    text = text.substr(0, longest_value_shown) + "...";
  return text;
}

std::string indexed(const std::string& key, std::size_t index)
{
  return fmt::format("{}[{}]", key, index);
}

std::string number_text(double value)
{
  std::string text = fmt::format("{}", value);
  if (text.size() > 2 && text.compare(text.size() - 2, 2, ".0") == 0)
    text.resize(text.size() - 2);  // releases of fmt differ in this
  return text;
}

std::string type_text(const double&, const Limits& limits)
{
  const std::string range = limits.text();
  return range.empty() ? "a finite number" : "a number " + range;
}

std::string type_text(const int&, const Limits& limits)
{
  const std::string range = limits.text();
  return range.empty() ? "a whole number" : "a whole number " + range;
}

std::string type_text(const bool&, const Limits&)
{
  return "true or false";
}

std::string type_text(const std::string&, const Limits& limits)
{
  return limits.min_count > 0 ? "text that is not empty" : "text";
}

std::string type_text(const Vec2&, const Limits&)
{
  return "[y, z]: two finite numbers";
}

std::string type_text(const std::vector<Vec2>&, const Limits& limits)
{
  return counted("points [y, z]", limits);
}

std::string type_text(const std::vector<OpeningRow>&, const Limits& limits)
{
  return counted("rows [time_s, port_rad, starboard_rad]", limits);
}

std::string type_text(const std::vector<std::string>&, const Limits& limits)
{
  return counted("texts", limits);
}

void parse(const YAML::Node& node, const std::string& key, const Limits& limits, double& value)
{
  if (!convert(node, value))
    refuse(key, text_of(node), "must be " + type_text(value, limits));
}

void parse(const YAML::Node& node, const std::string& key, const Limits& limits, int& value)
{
  if (!convert(node, value))
    refuse(key, text_of(node), "must be " + type_text(value, limits));
}

void parse(const YAML::Node& node, const std::string& key, const Limits& limits, bool& value)
{
  if (!convert(node, value))
    refuse(key, text_of(node), "must be " + type_text(value, limits));
}

void parse(const YAML::Node& node, const std::string& key, const Limits& limits, std::string& value)
{
  if (!node.IsScalar())
    refuse(key, text_of(node), "must be " + type_text(value, limits));
  value = node.Scalar();
}

void parse(const YAML::Node& node, const std::string& key, const Limits& limits, Vec2& value)
{
  if (!node.IsSequence() || node.size() != 2 || !convert(node[0], value[0]) || !convert(node[1], value[1]))
    refuse(key, text_of(node), "must be " + type_text(value, limits));
}

void parse(const YAML::Node& node, const std::string& key, const Limits& limits, std::vector<Vec2>& value)
{
  if (!node.IsSequence())
    refuse(key, text_of(node), "must be " + type_text(value, limits));
  value.resize(node.size());
  for (std::size_t i = 0; i < value.size(); ++i)
    parse(node[i], indexed(key, i), {}, value[i]);
}

void parse(const YAML::Node& node, const std::string& key, const Limits& limits, std::vector<OpeningRow>& value)
{
  if (!node.IsSequence())
    refuse(key, text_of(node), "must be " + type_text(value, limits));
  value.resize(node.size());
  for (std::size_t i = 0; i < value.size(); ++i)
    parse_row(node[i], indexed(key, i), value[i]);
}

void parse(const YAML::Node& node, const std::string& key, const Limits& limits, std::vector<std::string>& value)
{
  if (!node.IsSequence())
    refuse(key, text_of(node), "must be " + type_text(value, limits));
  value.resize(node.size());
  for (std::size_t i = 0; i < value.size(); ++i)
    parse(node[i], indexed(key, i), {}, value[i]);
}

void check(const double& value, const std::string& key, const Limits& limits)
{
  if (!limits.contains(value))
    refuse(key, number_text(value), "must be " + type_text(value, limits));
}

void check(const int& value, const std::string& key, const Limits& limits)
{
  if (!limits.contains(value))
    refuse(key, std::to_string(value), "must be " + type_text(value, limits));
}

void check(const bool&, const std::string&, const Limits&) {}

void check(const std::string& value, const std::string& key, const Limits& limits)
{
  if (value.size() < limits.min_count)
    refuse(key, "''", "must be " + type_text(value, limits));
}

void check(const Vec2& value, const std::string& key, const Limits& limits)
{
  if (!value.allFinite())
    refuse(key, to_text(value), "must be " + type_text(value, limits));
}

void check(const std::vector<Vec2>& value, const std::string& key, const Limits& limits)
{
  check_count(value, key, limits);
  for (std::size_t i = 0; i < value.size(); ++i)
    check(value[i], indexed(key, i), {});
}

void check(const std::vector<OpeningRow>& value, const std::string& key, const Limits& limits)
{
  check_count(value, key, limits);
  for (std::size_t i = 0; i < value.size(); ++i) {
    const OpeningRow& row = value[i];
    if (!std::isfinite(row.time_s) || !std::isfinite(row.port_rad) || !std::isfinite(row.starboard_rad))
      refuse(indexed(key, i), row_text(row), "must be three finite numbers");
    if (row.time_s < 0.0 || (i > 0 && row.time_s <= value[i - 1].time_s))
      refuse(indexed(key, i), row_text(row), "time_s must be >= 0 and later than in the row before");
  }
}

void check(const std::vector<std::string>& value, const std::string& key, const Limits& limits)
{
  check_count(value, key, limits);
}

std::string to_text(const double& value)
{
  return number_text(value);
}

std::string to_text(const int& value)
{
  return std::to_string(value);
}

std::string to_text(const bool& value)
{
  return value ? "true" : "false";
}

std::string to_text(const std::string& value)
{
  // A JSON string is a YAML double-quoted scalar; bytes that are not UTF-8 become U+FFFD instead of an exception.
  return nlohmann::json(value).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string to_text(const Vec2& value)
{
  return fmt::format("[{}, {}]", number_text(value[0]), number_text(value[1]));
}

std::string to_text(const std::vector<Vec2>& value)
{
  return list_text(value, [](const Vec2& point) { return to_text(point); });
}

std::string to_text(const std::vector<OpeningRow>& value)
{
  return list_text(value, [](const OpeningRow& row) { return row_text(row); });
}

std::string to_text(const std::vector<std::string>& value)
{
  return list_text(value, [](const std::string& item) { return to_text(item); });
}

std::string row_text(const double* numbers, std::size_t count)
{
  return list_text(std::vector<double>(numbers, numbers + count), number_text);
}

void parse_row(const YAML::Node& node, const std::string& key, const char* columns, double* numbers, std::size_t count)
{
  bool good = node.IsSequence() && node.size() == count;
  for (std::size_t i = 0; good && i < count; ++i)
    good = convert(node[i], numbers[i]);
  if (!good)
    refuse(key, text_of(node), fmt::format("must be [{}]: {} numbers", columns, count));
}

void check_row(const double* numbers, std::size_t count, const double* before, const std::string& key)
{
  for (std::size_t i = 0; i < count; ++i)
    if (!std::isfinite(numbers[i]))
      refuse(key, row_text(numbers, count), fmt::format("must be {} finite numbers", count));
  if (before && !(numbers[0] > *before))
    refuse(key, row_text(numbers, count), "time_s must be later than in the row before");
}

std::string table_type_text(const Limits& limits)
{
  return counted(fmt::format("rows [{}]", limits.columns), limits);
}

void check_row_count(std::size_t rows, const std::string& key, const Limits& limits)
{
  if (rows < limits.min_count)
    refuse(key, fmt::format("{} given", rows), "must be " + table_type_text(limits));
}

std::string type_text(const std::vector<geotextile::ForceStrainRow>&, const Limits& limits)
{
  return table_type_text(limits);
}

void parse(const YAML::Node& node, const std::string& key, const Limits& limits,
           std::vector<geotextile::ForceStrainRow>& table)
{
  if (!node.IsSequence())
    refuse(key, text_of(node), "must be " + table_type_text(limits));
  table.resize(node.size());
  for (std::size_t i = 0; i < table.size(); ++i) {
    std::array<double, 2> numbers{};
    parse_row(node[i], indexed(key, i), limits.columns, numbers.data(), numbers.size());
    table[i] = { numbers[0], numbers[1] };
  }
}

void check(const std::vector<geotextile::ForceStrainRow>& table, const std::string& key, const Limits&)
{
  if (table.size() == 1)
    refuse(key, "1 given", "must be absent, empty, or have two rows or more");
  for (std::size_t i = 0; i < table.size(); ++i) {
    const std::array<double, 2> row{ table[i].strain, table[i].force };
    const std::string text = row_text(row.data(), row.size());
    if (!std::isfinite(row[0]) || !std::isfinite(row[1]))
      refuse(indexed(key, i), text, "must be 2 finite numbers");
    if (i == 0 && (row[0] != 0.0 || row[1] != 0.0))
      refuse(indexed(key, i), text, "must be [0, 0]: an unstretched sheet carries nothing");
    if (i > 0 && !(row[0] > table[i - 1].strain && row[1] > table[i - 1].force))
      refuse(indexed(key, i), text, "strain and force must be greater than in the row before");
  }
}

std::string to_text(const std::vector<geotextile::ForceStrainRow>& table)
{
  return list_text(table, [](const geotextile::ForceStrainRow& row) {
    return fmt::format("[{}, {}]", number_text(row.strain), number_text(row.force));
  });
}

}  // namespace geocontainer_mpm::scene::grammar
