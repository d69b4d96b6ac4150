#pragma once
/// When what a scene prescribes over time changes.

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "geocontainer_mpm/scene/time_table.h"

namespace geocontainer_mpm::scene {

class ChangingTimes {
public:
  template <int Count>
  void add(const TimeTable<Count>& table)
  {
    for (std::size_t k = 0; k + 1 < table.size(); ++k)
      if (table[k].value != table[k + 1].value)
        intervals_.push_back({ table[k].time_s, table[k + 1].time_s });
  }
  /// Something that happens at once.
  void add_instant(double time_s)
  {
    intervals_.push_back({ time_s, std::nextafter(time_s, std::numeric_limits<double>::infinity()) });
  }
  void always() { intervals_.push_back({ 0.0, std::numeric_limits<double>::infinity() }); }

  /// First time >= time_s at which something changes; infinite for none.
  double next(double time_s) const
  {
    double first = std::numeric_limits<double>::infinity();
    for (const Interval& i : intervals_)
      if (i.end_s > time_s)
        first = std::min(first, std::max(time_s, i.begin_s));
    return first;
  }

private:
  struct Interval {
    double begin_s, end_s;
  };
  std::vector<Interval> intervals_;
};

}  // namespace geocontainer_mpm::scene
