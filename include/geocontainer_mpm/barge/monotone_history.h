#pragma once
/// Two values over time, joined by a monotone piecewise cubic that grows at its end.

#include <array>
#include <cstdint>
#include <vector>

#include "geocontainer_mpm/state_access.h"

namespace geocontainer_mpm::barge {

/// Between knots the values follow a cubic Hermite polynomial whose slopes satisfy the monotonicity condition of
/// Fritsch and Carlson (1980, SIAM J. Numer. Anal. 17:238), chosen as the weighted harmonic mean of Fritsch and Butland
/// (1984, SIAM J. Sci. Stat. Comput. 5:300): no overshoot, a continuous rate, and a rate of at most 1.5 times the
/// steepest chord nearby. Flat before the first and after the last knot, with zero slope at both. Knots inside a flat
/// run are dropped, which changes nothing but memory.
class MonotoneHistory {
public:
  using Pair = std::array<double, 2>;

  /// `time_ns` must be later than the last knot.
  void append(std::int64_t time_ns, const Pair& value);

  bool empty() const { return knots_.empty(); }
  std::int64_t last_time_ns() const { return knots_.back().time_ns; }
  const Pair& last_value() const { return knots_.back().value; }
  std::size_t knot_count() const { return knots_.size(); }
  /// End of the part that no later append() changes, s; -1 while empty.
  double settled_until_s() const;

  Pair value(double time_s) const;
  Pair rate(double time_s) const;
  /// First time >= time_s from which a value changes; infinite when none does up to the last knot.
  double next_motion_s(double time_s) const;

private:
  friend struct geocontainer_mpm::StateAccess;

  struct Knot {
    std::int64_t time_ns;
    double time_s;
    Pair value;
    Pair rate;
  };
  std::size_t interval(double time_s) const;  // index of the last knot at or before time_s; knots_.size() when none
  std::vector<Knot> knots_;
};

}  // namespace geocontainer_mpm::barge
