#include "progress_bar.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace geocontainer_mpm::program {

ProgressBar::ProgressBar(double end) : terminal_(isatty(STDERR_FILENO) == 1), end_(end) {}

ProgressBar::~ProgressBar()
{
  if (terminal_)
    fmt::print(stderr, "\r\033[K");
}

bool ProgressBar::due()
{
  const Clock::time_point now = Clock::now();
  if (!terminal_ || now < next_)
    return false;
  next_ = now + std::chrono::milliseconds(100);
  return true;
}

double ProgressBar::wall_s() const
{
  return std::chrono::duration<double>(Clock::now() - start_).count();
}

void ProgressBar::draw(double done, const std::string& text) const
{
  constexpr int width = 30;
  const double part = std::clamp(done / end_, 0.0, 1.0);
  const int full = static_cast<int>(part * width);
  fmt::print(stderr, "\r[{:#<{}}{:.<{}}] {:3.0f} %  {}\033[K", "", full, "", width - full, 100.0 * part, text);
  std::fflush(stderr);
}

void ProgressBar::show(double time_s)
{
  if (!due())
    return;
  const double wall = wall_s(), speed = wall > 0.0 ? time_s / wall : 0.0;
  draw(time_s, fmt::format("{:.1f} of {:.1f} s, {:.1f} x real time", time_s, end_, speed));
}

void ProgressBar::show_members(std::size_t done)
{
  if (!due())
    return;
  const double count = static_cast<double>(done), left_s = wall_s() * (end_ - count) / std::max(1.0, count);
  draw(count, fmt::format("{} of {:.0f} members, about {:.0f} s left", done, end_, left_s));
}

}  // namespace geocontainer_mpm::program
