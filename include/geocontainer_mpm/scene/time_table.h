#pragma once
/// Quantities that a scene prescribes over time, as rows of numbers.

#include <array>
#include <cstddef>
#include <vector>

namespace geocontainer_mpm::scene {

/// One row: time, s, and values.
template <int Count>
struct TableRow {
  double time_s = 0.0;
  std::array<double, Count> value{};
};

/// Times strictly ascending; empty: not given.
template <int Count>
using TimeTable = std::vector<TableRow<Count>>;

/// Linear between the rows, constant before the first and after the last. The table has at least one row.
template <int Count>
std::array<double, Count> value_at(const TimeTable<Count>& table, double time_s)
{
  std::size_t next = 0;
  while (next < table.size() && table[next].time_s <= time_s)
    ++next;
  if (next == 0)
    return table.front().value;
  if (next == table.size())
    return table.back().value;
  const TableRow<Count>& from = table[next - 1];
  const TableRow<Count>& to = table[next];
  const double share = (time_s - from.time_s) / (to.time_s - from.time_s);
  std::array<double, Count> value{};
  for (std::size_t i = 0; i < value.size(); ++i)
    value[i] = from.value[i] + share * (to.value[i] - from.value[i]);
  return value;
}

}  // namespace geocontainer_mpm::scene
