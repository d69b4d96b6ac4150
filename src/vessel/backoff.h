#pragma once
/// Waits between attempts to connect: doubled after each, and drawn from the upper half, so that several clients of a
/// server that comes back do not all come at the same instant ("equal jitter", M. Brooker, Exponential Backoff And
/// Jitter, 2015).

#include <algorithm>
#include <chrono>
#include <random>

namespace geocontainer_mpm::vessel {

class Backoff {
public:
  using Wait = std::chrono::milliseconds;

  Backoff(Wait first, Wait longest) : first_(first), longest_(longest), next_(first), random_(std::random_device{}()) {}

  Wait next()
  {
    const Wait most = next_;
    next_ = std::min(longest_, 2 * next_);
    return Wait(std::uniform_int_distribution<Wait::rep>(most.count() / 2, most.count())(random_));
  }
  void reset() { next_ = first_; }

private:
  Wait first_, longest_, next_;
  std::minstd_rand random_;
};

}  // namespace geocontainer_mpm::vessel
