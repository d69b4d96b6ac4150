#pragma once
/// How fast the hull may be opened.

#include <optional>
#include <vector>

namespace geocontainer_mpm::forecast {

struct AdviceSettings {
  double utilisation_limit = 0.9;    ///< of the peak tension over the strength of sheet or seam, > 0
  double slowest_rad_per_s = 0.005;  ///< of each half; rates that are tried, 0 < slowest < fastest
  double fastest_rad_per_s = 0.03;
  int ladder = 4;    ///< rates from fastest to slowest by equal factors, >= 2
  int halvings = 2;  ///< of the step between the one that will do and the next faster, >= 0
};

enum class Verdict {
  none,      ///< not searched
  any_rate,  ///< the fastest that was tried will do
  rate,      ///< the fastest that will do, of those that were tried
  no_rate    ///< none of those that were tried will do
};

struct Advice {
  Verdict verdict = Verdict::none;
  double rate_rad_per_s = 0.0;  ///< any_rate: the fastest that was tried
  double utilisation = 0.0;     ///< at that rate; no_rate: the least that was found
  double utilisation_limit = 0.0;
};

/// Search for the fastest rate with which the utilisation stays below the limit. Utilisation need not grow with the
/// rate (a hull that opens slowly holds its container longer in the slot), so that a bracket is looked for from the
/// fastest rate down before it is halved.
class RateSearch {
public:
  explicit RateSearch(const AdviceSettings& settings);

  std::optional<double> next() const { return next_; }  ///< rate to try, rad/s; none: done
  void add(double utilisation);                         ///< of next()
  Advice advice() const;                                ///< when done

private:
  AdviceSettings settings_;
  std::optional<double> next_;
  int tried_ = 0, halved_ = 0;
  double too_fast_ = 0.0, will_do_ = 0.0;  ///< 0: none yet
  double utilisation_ = 0.0;               ///< at will_do_; before that the least so far
};

}  // namespace geocontainer_mpm::forecast
