#pragma once
/// One line on stderr that shows how far a run is, on a terminal only.

#include <chrono>
#include <cstddef>

namespace geocontainer_mpm::program {

class ProgressBar {
public:
  explicit ProgressBar(double end_s);
  ~ProgressBar();  ///< wipes the line
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// Redraws at most ten times a second.
  void show(double time_s);

private:
  using Clock = std::chrono::steady_clock;

  const bool terminal_;
  const double end_s_;
  const Clock::time_point start_ = Clock::now();
  Clock::time_point next_ = start_;
};

}  // namespace geocontainer_mpm::program
