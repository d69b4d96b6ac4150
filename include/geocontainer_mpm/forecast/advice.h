#pragma once
/// How fast the hull may be opened.

#include <cstddef>
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
  none,      ///< not searched, or nothing known yet
  any_rate,  ///< all that were tried will do
  rate,      ///< some of those that were tried will do
  no_rate    ///< none of them will
};

struct Advice {
  Verdict verdict = Verdict::none;
  double rate_rad_per_s = 0.0;  ///< the fastest that will do, of those that were tried
  /// Rates below this one will not do, or have not been tried yet; 0: they will, as far as was tried.
  double slowest_rad_per_s = 0.0;
  bool complete = false;     ///< all rates that are to be tried have been
  double utilisation = 0.0;  ///< at the fastest that will do; no_rate: the least that was found
  double utilisation_limit = 0.0;
};

/// Search for the fastest rate with which the utilisation stays below the limit. Utilisation need not grow with the
/// rate (a hull that opens slowly holds its container longer in the slot): all rates of the ladder are tried before the
/// step above the first that will do is halved, and advice says where slower would be worse.
class RateSearch {
public:
  explicit RateSearch(const AdviceSettings& settings);

  std::optional<double> next() const { return next_; }  ///< rate to try, rad/s; none: done
  void add(double utilisation);                         ///< of next()
  /// Before it is done what the rates that were tried so far allow; none where they allow nothing.
  Advice advice() const;

private:
  struct Trial {
    double rate, utilisation;
  };
  bool will_do(const Trial& trial) const { return trial.utilisation < settings_.utilisation_limit; }
  std::size_t fastest_good() const;  ///< number of trials: none
  std::optional<double> choose() const;

  AdviceSettings settings_;
  std::vector<Trial> trials_;  ///< from the fastest down
  int halved_ = 0;
  std::optional<double> next_;
};

}  // namespace geocontainer_mpm::forecast
