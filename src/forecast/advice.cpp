#include "geocontainer_mpm/forecast/advice.h"

#include <algorithm>
#include <cmath>

namespace geocontainer_mpm::forecast {

RateSearch::RateSearch(const AdviceSettings& settings) : settings_(settings), next_(settings.fastest_rad_per_s) {}

void RateSearch::add(double utilisation)
{
  const double rate = *next_;
  const bool will_do = utilisation < settings_.utilisation_limit;
  if (will_do) {
    will_do_ = rate;
    utilisation_ = utilisation;
  } else {
    too_fast_ = rate;
    if (will_do_ == 0.0)
      utilisation_ = tried_ == 0 ? utilisation : std::min(utilisation_, utilisation);
  }
  ++tried_;
  if (will_do_ == 0.0) {
    const double part = static_cast<double>(tried_) / (settings_.ladder - 1);
    next_.reset();
    if (tried_ < settings_.ladder)
      next_ = settings_.fastest_rad_per_s * std::pow(settings_.slowest_rad_per_s / settings_.fastest_rad_per_s, part);
    return;
  }
  next_.reset();
  if (too_fast_ > 0.0 && halved_ < settings_.halvings) {
    ++halved_;
    next_ = std::sqrt(too_fast_ * will_do_);
  }
}

Advice RateSearch::advice() const
{
  const Verdict verdict = will_do_ == 0.0 ? Verdict::no_rate : too_fast_ == 0.0 ? Verdict::any_rate : Verdict::rate;
  return { verdict, will_do_, utilisation_, settings_.utilisation_limit };
}

}  // namespace geocontainer_mpm::forecast
