#pragma once
/// How the hull is taken to open from now on.

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "geocontainer_mpm/barge/opening_signal.h"
#include "geocontainer_mpm/forecast/forecast.h"

namespace geocontainer_mpm::forecast {

/// Straight lines between points in time, held before the first and after the last.
class AssumedOpening {
public:
  /// Both halves go on at `rate` (rad/s) from `from` at `from_s` until each is closed or at `full_rad`.
  static AssumedOpening at_rate(double from_s, barge::OpeningAngles from, barge::OpeningAngles rate, double full_rad);
  /// Throws InputError naming `<key>[i]` where `parameters` would not believe the points: times that do not increase,
  /// angles out of range, a step that is too fast.
  static AssumedOpening planned(std::vector<barge::OpeningPoint> points,
                                const barge::OpeningSignalParameters& parameters, const std::string& key);

  Assumption assumption() const { return assumption_; }
  double end_s() const { return points_.back().time_s; }  ///< from here on it is held
  barge::OpeningAngles at(double time_s) const;
  /// Larger of both halves' departures from it, rad.
  double departure(double time_s, const barge::OpeningAngles& measured) const;

  /// The history `so_far` as if samples of this opening were measured next, until `settle_s` after its end (the
  /// filter's smoothing time); finished. What the filter does to a measured opening it does to this one too. `so_far`
  /// must not be empty.
  barge::OpeningSignal continue_from(const barge::OpeningSignal& so_far, double settle_s) const;

private:
  AssumedOpening(Assumption assumption, std::vector<barge::OpeningPoint> points);

  Assumption assumption_;
  std::vector<barge::OpeningPoint> points_;
};

/// The last samples, and how fast the hull opens by them.
class RecentSamples {
public:
  explicit RecentSamples(double window_s) : window_s_(window_s) {}

  void add(double time_s, const barge::OpeningAngles& angles);
  void clear() { samples_.clear(); }
  bool empty() const { return samples_.empty(); }
  const barge::OpeningPoint& newest() const { return samples_.back(); }

  struct Trend {
    barge::OpeningAngles angles;  ///< at the newest sample, rad
    barge::OpeningAngles rate;    ///< rad/s
  };
  /// Straight line through the window by least squares. Not of an empty window; of one sample at rest.
  Trend trend() const;

private:
  double window_s_;
  std::deque<barge::OpeningPoint> samples_;
};

}  // namespace geocontainer_mpm::forecast
