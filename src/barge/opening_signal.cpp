#include "geocontainer_mpm/barge/opening_signal.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "geocontainer_mpm/error.h"

namespace geocontainer_mpm::barge {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
// Stamps within it have differences that fit 64 bits.
constexpr std::int64_t stamp_limit_ns = (std::int64_t{ 1 } << 62) - 1;
// A cubic with slopes between 0 and its neighbours' steepest chord is at most this much steeper than that chord.
constexpr double cubic_over_chord = 1.5;

double seconds(std::int64_t ns)
{
  return static_cast<double>(ns) / 1e9;
}

std::int64_t nanoseconds(double s)
{
  return std::llround(s * 1e9);
}

double smoothstep(double s)
{
  return s * s * (3.0 - 2.0 * s);
}

OpeningAngles to_angles(const MonotoneHistory::Pair& pair)
{
  return { pair[0], pair[1] };
}

}  // namespace

OpeningSignal::OpeningSignal(const OpeningSignalParameters& parameters)
    : parameters_(parameters), max_gap_ns_(0), half_window_ns_(0)
{
  parameters_.validate("signal");
  max_gap_ns_ = nanoseconds(parameters_.max_gap_s);
  half_window_ns_ = nanoseconds(0.5 * parameters_.smoothing_time_s);
  play_width_.fill(parameters_.backlash_rad);
}

OpeningSignal OpeningSignal::through(const std::vector<OpeningPoint>& points, const std::string& key)
{
  constexpr double latest_s = 1e9;
  OpeningSignal signal{ OpeningSignalParameters{} };
  for (std::size_t i = 0; i < points.size(); ++i) {
    const OpeningPoint& point = points[i];
    const std::string name = key + "[" + std::to_string(i) + "]";
    if (!(point.time_s >= 0.0 && point.time_s <= latest_s))
      throw InputError("", name + ".time_s", std::to_string(point.time_s), "must be a time in [0, 1e9] s");
    for (const auto& [field, angle] :
         { std::pair{ ".port_rad", point.angles.port_rad }, std::pair{ ".starboard_rad", point.angles.starboard_rad } })
      if (!(angle >= 0.0 && angle <= 1.57))
        throw InputError("", name + field, std::to_string(angle), "must be an opening angle in [0, 1.57] rad");
    const std::int64_t time_ns = nanoseconds(point.time_s);
    if (!signal.history_.empty() && time_ns <= signal.history_.last_time_ns())
      throw InputError("", name + ".time_s", std::to_string(point.time_s), "must be later than the row before");
    signal.history_.append(time_ns, { point.angles.port_rad, point.angles.starboard_rad });
  }
  signal.finish();
  return signal;
}

SampleVerdict OpeningSignal::add(const OpeningSample& sample)
{
  const SampleVerdict verdict = judge(sample);
  if (verdict == SampleVerdict::accepted)
    accept(sample);
  ++counts_[static_cast<std::size_t>(verdict)];
  return verdict;
}

SampleVerdict OpeningSignal::judge(const OpeningSample& sample)
{
  const auto& [port, starboard] = sample.angles;
  if (!std::isfinite(port) || !std::isfinite(starboard))
    return SampleVerdict::non_finite;
  const auto believable = [this](double angle) {
    return angle >= parameters_.min_angle_rad && angle <= parameters_.max_angle_rad;
  };
  if (!believable(port) || !believable(starboard) || sample.stamp_ns > stamp_limit_ns ||
      sample.stamp_ns < -stamp_limit_ns)
    return SampleVerdict::out_of_range;
  if (finished_)
    return SampleVerdict::out_of_order;
  if (empty())
    return SampleVerdict::accepted;

  if (sample.stamp_ns <= last_accepted_.stamp_ns) {
    const std::int64_t time_ns = sample.stamp_ns - origin_ns_;
    const bool known = sample.stamp_ns == last_accepted_.stamp_ns ||
                       std::any_of(window_.begin(), window_.end(),
                                   [time_ns](const Measurement& accepted) { return accepted.time_ns == time_ns; });
    return known ? SampleVerdict::duplicate : SampleVerdict::out_of_order;
  }
  if (stretch_closed_ && sample.stamp_ns - origin_ns_ < held_until_ns_)
    return SampleVerdict::out_of_order;
  return judge_rate(sample);
}

SampleVerdict OpeningSignal::judge_rate(const OpeningSample& sample)
{
  if (plausible_step(last_accepted_, sample)) {
    has_candidate_ = false;
    return SampleVerdict::accepted;
  }
  if (has_candidate_ && sample.stamp_ns <= candidate_.stamp_ns)
    return SampleVerdict::too_fast;  // adds nothing to the chain: it spans no time
  if (!has_candidate_ || !plausible_step(candidate_, sample))
    candidate_since_ns_ = sample.stamp_ns;
  has_candidate_ = true;
  candidate_ = sample;
  if (sample.stamp_ns - candidate_since_ns_ <= max_gap_ns_)
    return SampleVerdict::too_fast;
  has_candidate_ = false;
  return SampleVerdict::accepted;
}

bool OpeningSignal::plausible_step(const OpeningSample& from, const OpeningSample& to) const
{
  const double allowed = parameters_.max_rate_rad_per_s * seconds(to.stamp_ns - from.stamp_ns) + parameters_.noise_rad;
  return std::abs(to.angles.port_rad - from.angles.port_rad) <= allowed &&
         std::abs(to.angles.starboard_rad - from.angles.starboard_rad) <= allowed;
}

void OpeningSignal::accept(const OpeningSample& sample)
{
  if (empty())
    origin_ns_ = sample.stamp_ns;
  const std::int64_t time_ns = sample.stamp_ns - origin_ns_;
  const std::int64_t last_ns = last_accepted_.stamp_ns - origin_ns_;

  if (!empty() && time_ns - last_ns > max_gap_ns_) {
    if (stretch_closed_)
      gaps_.back().to_s = seconds(time_ns);
    else
      gaps_.push_back({ seconds(last_ns), seconds(time_ns) });
    close_stretch();
    // What the angle is here does not depend on the new stretch: it is still the held one.
    history_.append(time_ns, history_.last_value());
    window_.clear();
    next_ = 0;
    stretch_starts_ = true;
    stretch_closed_ = false;
  }
  last_accepted_ = sample;
  window_.push_back({ time_ns, { sample.angles.port_rad, sample.angles.starboard_rad } });
  // Later samples are later than this one and so outside these windows.
  while (next_ < window_.size() && window_[next_].time_ns + half_window_ns_ <= time_ns)
    filter_next();
  // Nobody's window reaches further back than half a width before the next one to filter.
  const std::int64_t oldest_ns = (next_ < window_.size() ? window_[next_].time_ns : time_ns) - half_window_ns_;
  while (window_.front().time_ns < oldest_ns) {
    window_.pop_front();
    --next_;
  }
}

void OpeningSignal::close_stretch()
{
  while (next_ < window_.size())
    filter_next();
  stretch_closed_ = true;
}

// Triangular weights rather than equal ones: a sample enters and leaves the average gradually, which halves the jitter
// of the rate. Written as a correction to the sample itself so that equal samples give exactly their value.
OpeningSignal::Pair OpeningSignal::smoothed(std::size_t index) const
{
  const Measurement& here = window_[index];
  double weights = 1.0;
  Pair correction{ 0.0, 0.0 };
  const auto collect = [&](const Measurement& other) {
    const std::int64_t distance_ns = std::abs(other.time_ns - here.time_ns);
    if (distance_ns >= half_window_ns_)
      return false;
    const double weight = 1.0 - static_cast<double>(distance_ns) / static_cast<double>(half_window_ns_);
    weights += weight;
    for (std::size_t i = 0; i < 2; ++i)
      correction[i] += weight * (other.angle[i] - here.angle[i]);
    return true;
  };
  for (std::size_t k = index; k-- > 0 && collect(window_[k]);) {
  }
  for (std::size_t k = index + 1; k < window_.size() && collect(window_[k]); ++k) {
  }
  return { here.angle[0] + correction[0] / weights, here.angle[1] + correction[1] / weights };
}

// A play of constant width would ratchet: once the hull stops, every new extreme of the noise would still push the
// output on, more and more rarely but for ever. Hence the wider band at rest.
void OpeningSignal::play(std::size_t half, double angle_rad, std::int64_t time_ns)
{
  constexpr double narrowing = 0.25;  // of the width per travel; leaving rest is then 4/3 of the hull's rate at most
  double& width = play_width_[half];
  const double moved = std::clamp(play_[half], angle_rad - width, angle_rad + width);
  if (moved != play_[half]) {
    width = std::max(0.5 * parameters_.backlash_rad, width - narrowing * std::abs(moved - play_[half]));
    still_since_ns_[half] = time_ns;
    play_[half] = moved;
  } else if (time_ns - still_since_ns_[half] >= 2 * half_window_ns_) {
    width = parameters_.backlash_rad;
  }
}

void OpeningSignal::filter_next()
{
  const std::int64_t time_ns = window_[next_].time_ns;
  const Pair average = smoothed(next_);
  Pair opening;
  for (std::size_t i = 0; i < 2; ++i) {
    play(i, average[i], time_ns);
    opening[i] = std::max(play_[i], 0.0);
  }
  ++next_;

  if (stretch_starts_) {
    stretch_starts_ = false;
    stretch_since_ns_ = time_ns;
    if (history_.empty()) {
      history_.append(time_ns, opening);
      stretch_since_ns_ -= 2 * half_window_ns_;  // nothing was held before
    } else {
      held_ = history_.last_value();
    }
    return;
  }

  const std::int64_t since_ns = time_ns - stretch_since_ns_;
  const double held_share =
      since_ns < 2 * half_window_ns_
          ? 1.0 - smoothstep(static_cast<double>(since_ns) / static_cast<double>(2 * half_window_ns_))
          : 0.0;
  const double furthest =
      parameters_.max_rate_rad_per_s / cubic_over_chord * seconds(time_ns - history_.last_time_ns());
  const Pair& last = history_.last_value();
  for (std::size_t i = 0; i < 2; ++i) {
    const double goal = opening[i] + held_share * (held_[i] - opening[i]);
    opening[i] = std::clamp(goal, last[i] - furthest, last[i] + furthest);
  }
  history_.append(time_ns, opening);
}

void OpeningSignal::clock(double now_s)
{
  constexpr double latest_s = 4e9;  // well inside 64-bit nanoseconds
  if (empty() || finished_ || !(now_s >= 0.0 && now_s <= latest_s))
    return;
  const std::int64_t last_ns = last_accepted_.stamp_ns - origin_ns_;
  const std::int64_t expected_ns = static_cast<std::int64_t>(std::floor(now_s * 1e9)) - max_gap_ns_;
  if (expected_ns - last_ns <= max_gap_ns_)
    return;
  if (!stretch_closed_) {
    close_stretch();
    gaps_.push_back({ seconds(last_ns), infinity });
    held_until_ns_ = expected_ns;
  }
  held_until_ns_ = std::max(held_until_ns_, expected_ns);
}

void OpeningSignal::finish()
{
  if (finished_)
    return;
  if (stretch_closed_)
    gaps_.pop_back();
  close_stretch();
  finished_ = true;
}

double OpeningSignal::known_until_s() const
{
  if (finished_)
    return infinity;
  return stretch_closed_ ? seconds(held_until_ns_) : history_.settled_until_s();
}

OpeningAngles OpeningSignal::angles(double time_s) const
{
  return to_angles(history_.value(time_s));
}

OpeningAngles OpeningSignal::rates(double time_s) const
{
  return to_angles(history_.rate(time_s));
}

double OpeningSignal::next_motion_s(double time_s) const
{
  return std::min(history_.next_motion_s(time_s), std::max(known_until_s(), time_s));
}

std::uint64_t OpeningSignal::rejected() const
{
  return std::accumulate(counts_.begin() + 1, counts_.end(), std::uint64_t{ 0 });
}

}  // namespace geocontainer_mpm::barge
