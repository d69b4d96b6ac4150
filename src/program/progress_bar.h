#pragma once
/// One line on stderr that shows how far a run is, on a terminal only.

#include <chrono>
#include <cstddef>
#include <string>

namespace geocontainer_mpm::program {

class ProgressBar {
public:
  /// `end`: simulated time, s, or how many members.
  explicit ProgressBar(double end);
  ~ProgressBar();  ///< wipes the line
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  // Redraw at most ten times a second.
  void show(double time_s);
  void show_members(std::size_t done);

private:
  using Clock = std::chrono::steady_clock;

  bool due();
  double wall_s() const;
  void draw(double done, const std::string& text) const;

  const bool terminal_;
  const double end_;
  const Clock::time_point start_ = Clock::now();
  Clock::time_point next_ = start_;
};

}  // namespace geocontainer_mpm::program
