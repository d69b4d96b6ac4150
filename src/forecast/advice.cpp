#include "geocontainer_mpm/forecast/advice.h"

#include <algorithm>
#include <cmath>

namespace geocontainer_mpm::forecast {

RateSearch::RateSearch(const AdviceSettings& settings) : settings_(settings), next_(choose()) {}

void RateSearch::add(double utilisation)
{
  const Trial trial{ *next_, utilisation };
  const auto slower =
      std::find_if(trials_.begin(), trials_.end(), [&trial](const Trial& other) { return other.rate < trial.rate; });
  trials_.insert(slower, trial);
  halved_ += static_cast<int>(trials_.size()) > settings_.ladder ? 1 : 0;
  next_ = choose();
}

std::size_t RateSearch::fastest_good() const
{
  const auto good = [this](const Trial& trial) { return will_do(trial); };
  return static_cast<std::size_t>(std::find_if(trials_.begin(), trials_.end(), good) - trials_.begin());
}

/// The next rung of the ladder; behind it the middle, by equal factors, of the step above the fastest that will do.
std::optional<double> RateSearch::choose() const
{
  const auto tried = static_cast<int>(trials_.size());
  if (tried < settings_.ladder)
    return settings_.fastest_rad_per_s *
           std::pow(settings_.slowest_rad_per_s / settings_.fastest_rad_per_s, tried / (settings_.ladder - 1.0));
  const std::size_t good = fastest_good();
  if (good == 0 || good == trials_.size() || halved_ == settings_.halvings)
    return std::nullopt;
  return std::sqrt(trials_[good - 1].rate * trials_[good].rate);
}

Advice RateSearch::advice() const
{
  Advice advice;
  advice.utilisation_limit = settings_.utilisation_limit;
  advice.complete = !next_;
  const bool all_tried = static_cast<int>(trials_.size()) >= settings_.ladder;
  const std::size_t good = fastest_good();
  if (good == trials_.size()) {
    if (!all_tried)
      return advice;
    advice.verdict = Verdict::no_rate;
    const auto less = [](const Trial& a, const Trial& b) { return a.utilisation < b.utilisation; };
    advice.utilisation = std::min_element(trials_.begin(), trials_.end(), less)->utilisation;
    return advice;
  }
  std::size_t last = good;
  while (last + 1 < trials_.size() && will_do(trials_[last + 1]))
    ++last;
  const bool slower_will_do = all_tried && last + 1 == trials_.size();
  advice.verdict = good == 0 && slower_will_do ? Verdict::any_rate : Verdict::rate;
  advice.rate_rad_per_s = trials_[good].rate;
  advice.slowest_rad_per_s = slower_will_do ? 0.0 : trials_[last].rate;
  advice.utilisation = trials_[good].utilisation;
  return advice;
}

}  // namespace geocontainer_mpm::forecast
