#include "progress_bar.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace geocontainer_mpm::program {

ProgressBar::ProgressBar(double end_s) : terminal_(isatty(STDERR_FILENO) == 1), end_s_(end_s) {}

ProgressBar::~ProgressBar()
{
  if (terminal_)
    fmt::print(stderr, "\r\033[K");
}

void ProgressBar::show(double time_s)
{
  const Clock::time_point now = Clock::now();
  if (!terminal_ || now < next_)
    return;
  next_ = now + std::chrono::milliseconds(100);
  constexpr int width = 30;
  const double part = std::clamp(time_s / end_s_, 0.0, 1.0);
  const int full = static_cast<int>(part * width);
  const double wall_s = std::chrono::duration<double>(now - start_).count();
  const double speed = wall_s > 0.0 ? time_s / wall_s : 0.0;
  fmt::print(stderr, "\r[{:#<{}}{:.<{}}] {:3.0f} %  {:.1f} of {:.1f} s, {:.1f} x real time\033[K", "", full, "",
             width - full, 100.0 * part, time_s, end_s_, speed);
  std::fflush(stderr);
}

}  // namespace geocontainer_mpm::program
