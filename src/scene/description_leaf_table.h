#pragma once
/// Tables over time as values of a scene key: `[[t, v1, v2], ...]`.

#include <yaml-cpp/yaml.h>

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "description_limits.h"
#include "geocontainer_mpm/scene/time_table.h"

namespace geocontainer_mpm::scene::grammar {

/// A row of numbers as text and back, whatever its length; `columns` names them in messages.
std::string row_text(const double* numbers, std::size_t count);
void parse_row(const YAML::Node& node, const std::string& key, const char* columns, double* numbers, std::size_t count);
/// Refuses numbers that are not finite and a time that is not later than `before` (null: no row before).
void check_row(const double* numbers, std::size_t count, const double* before, const std::string& key);
std::string table_type_text(const Limits& limits);
void check_row_count(std::size_t rows, const std::string& key, const Limits& limits);

template <int Count>
using Numbers = std::array<double, static_cast<std::size_t>(Count) + 1>;

template <int Count>
Numbers<Count> numbers_of(const TableRow<Count>& row)
{
  Numbers<Count> numbers{ row.time_s };
  for (std::size_t i = 0; i < row.value.size(); ++i)
    numbers[i + 1] = row.value[i];
  return numbers;
}

template <int Count>
std::string type_text(const std::vector<TableRow<Count>>&, const Limits& limits)
{
  return table_type_text(limits);
}

template <int Count>
void parse(const YAML::Node& node, const std::string& key, const Limits& limits, std::vector<TableRow<Count>>& table)
{
  if (!node.IsSequence())
    refuse(key, text_of(node), "must be " + table_type_text(limits));
  table.resize(node.size());
  for (std::size_t i = 0; i < table.size(); ++i) {
    Numbers<Count> numbers{};
    parse_row(node[i], indexed(key, i), limits.columns, numbers.data(), numbers.size());
    table[i].time_s = numbers[0];
    for (std::size_t k = 0; k < table[i].value.size(); ++k)
      table[i].value[k] = numbers[k + 1];
  }
}

template <int Count>
void check(const std::vector<TableRow<Count>>& table, const std::string& key, const Limits& limits)
{
  check_row_count(table.size(), key, limits);
  for (std::size_t i = 0; i < table.size(); ++i) {
    const Numbers<Count> numbers = numbers_of(table[i]);
    check_row(numbers.data(), numbers.size(), i > 0 ? &table[i - 1].time_s : nullptr, indexed(key, i));
  }
}

template <int Count>
std::string to_text(const std::vector<TableRow<Count>>& table)
{
  std::string text = "[";
  for (const TableRow<Count>& row : table) {
    const Numbers<Count> numbers = numbers_of(row);
    text += (text.size() > 1 ? ", " : "") + row_text(numbers.data(), numbers.size());
  }
  return text + "]";
}

}  // namespace geocontainer_mpm::scene::grammar
