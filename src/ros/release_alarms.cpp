#include "geocontainer_mpm/ros/release_alarms.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "geocontainer_mpm/ros/conversions.h"
#include "message_parts.h"

namespace geocontainer_mpm::ros_bridge {
namespace {

using alarm::Level;
using alarm::Reading;

constexpr std::int64_t counting_ns = 5'000'000'000;  ///< over which the share of rejected samples is taken
constexpr std::uint64_t fewest_counted = 5;          ///< of fewer samples no share is made
constexpr double burst_s = 1.0;  ///< a sender that sends in bursts, or a pause that ends, makes a lag that is soon over

double seconds(std::int64_t ns)
{
  return static_cast<double>(ns) / 1e9;
}

/// Of several reasons for one alarm the worse; its message tells.
void take_worse(Reading& reading, Level level, const std::string& message)
{
  if (level > reading.reached)
    reading.message = message;
  reading.reached = std::max(reading.reached, level);
  reading.held = std::max(reading.held, level);
}

/// Not by the opening signal's window of duplicates: a sender that says everything twice is heard well.
std::uint64_t rejected_in(const Progress& progress)
{
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < reject_reason_count; ++i)
    if (static_cast<RejectReason>(i) != RejectReason::duplicate)
      sum += progress.rejected[i];
  return sum;
}

bool over(const Progress& progress)
{
  return progress.state == RunState::finished || progress.log_over;
}

}  // namespace

ReleaseAlarms::ReleaseAlarms(const AlarmParameters& parameters, bool replay) : parameters_(parameters), replay_(replay)
{
  const alarm::Delays at_once{ 0.0, parameters.fall_after_s }, after_bursts{ burst_s, parameters.fall_after_s };
  // In the order of Kind.
  book_.add("sheet_utilisation", "1", at_once);
  book_.add("seam_utilisation", "1", at_once);
  book_.add("forecast_utilisation", "1", at_once);
  book_.add("hung_up", "s", at_once);
  book_.add("lopsided_opening", "rad", at_once);
  book_.add("sensor", "s", at_once);
  book_.add("lag", "s", after_bursts);
  book_.add("solver", "", at_once);
}

AlarmReport ReleaseAlarms::look(const Progress& progress, std::int64_t now_ns, unsigned senders)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  if (progress.run != run_)
    begin_run(progress.run, now_ns);
  book_.judge(sheet, judge_tension(progress, false), now_ns);
  book_.judge(seam, judge_tension(progress, true), now_ns);
  book_.judge(ahead, judge_ahead(progress), now_ns);
  book_.judge(hung_up, judge_hung_up(progress), now_ns);
  book_.judge(lopsided, judge_lopsided(progress), now_ns);
  book_.judge(sensor, judge_sensor(progress, now_ns, senders), now_ns);
  book_.judge(lag, judge_lag(progress), now_ns);
  const bool stopped = progress.state == RunState::stopped;
  Reading reading = alarm::stated(stopped ? Level::alarm : Level::normal);
  reading.message = stopped ? status_sentence(progress) : "The prediction runs";
  book_.judge(solver, reading, now_ns);
  return { replay_, book_.alarms() };
}

void ReleaseAlarms::expect(std::shared_ptr<const forecast::Forecast> forecast)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  ahead_ = std::move(forecast);
}

std::string ReleaseAlarms::acknowledge()
{
  const std::lock_guard<std::mutex> lock(mutex_);
  const std::vector<std::string> seen = book_.acknowledge();
  return seen.empty() ? "no alarm waits for it" : fmt::format("acknowledged: {}", fmt::join(seen, ", "));
}

AlarmReport ReleaseAlarms::report() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return { replay_, book_.alarms() };
}

void ReleaseAlarms::begin_run(std::uint64_t run, std::int64_t now_ns)
{
  if (run_ != 0)
    book_.begin_run(now_ns);
  run_ = run;
  peak_sheet_ = peak_seam_ = 0.0;
  sunk_s_.reset();
  waiting_since_ns_.reset();
  counted_.clear();
}

/// Of the tension now; where the peak has grown since the last look, of that: nothing passes between two looks.
Reading ReleaseAlarms::judge_tension(const Progress& progress, bool of_seam)
{
  const scene::StatusFrame& status = progress.status;
  const double peak = of_seam ? status.peak_utilisation_seam : status.peak_utilisation_sheet;
  double& peak_before = of_seam ? peak_seam_ : peak_sheet_;
  double value = of_seam ? status.utilisation_seam : status.utilisation_sheet;
  if (peak > peak_before)
    value = std::max(value, peak);
  peak_before = std::max(peak_before, peak);

  Reading reading = alarm::graded(value, parameters_.utilisation, parameters_.band);
  const char* const what = of_seam ? "seam" : "geotextile";
  reading.message = fmt::format("The {} is pulled to {:.0f} % of its strength{}", what, 100.0 * value,
                                value >= 1.0 ? ": it fails" : "");
  if (!of_seam && status.ruptures > 0)
    take_worse(reading, Level::alarm, "");
  if (!of_seam && status.ruptures > 0)
    reading.message = fmt::format("The geotextile has torn, first after {:.1f} s at {}", status.rupture_time_s,
                                  scene::place(status.rupture_position_m, status.dimensions));
  return reading;
}

/// What is still ahead: the utilisation of a forecast is that of the largest tension up to each instant.
Reading ReleaseAlarms::judge_ahead(const Progress& progress) const
{
  Reading reading = alarm::stated(Level::normal);
  if (!ahead_ || ahead_->run != progress.run || ahead_->instants.empty()) {
    reading.message = "No forecast";
    return reading;
  }
  const std::vector<forecast::Instant>& instants = ahead_->instants;
  const double now_s = std::max(progress.time_s, ahead_->from_s);
  const auto next = std::find_if(instants.begin(), instants.end(),
                                 [now_s](const forecast::Instant& instant) { return instant.time_s > now_s; });
  const double so_far = next == instants.begin() ? 0.0 : std::prev(next)->utilisation;
  const double worst = instants.back().utilisation;
  if (!(worst <= so_far) && next != instants.end())
    reading = alarm::graded(worst, parameters_.utilisation, parameters_.band);
  if (reading.reached == Level::normal) {
    reading.message = reading.value > 0.0 ? fmt::format("At most {:.0f} % of the strength is ahead", 100.0 * worst)
                                          : "No larger tension is ahead";
    return reading;
  }
  const double limit = reading.reached == Level::alarm ? parameters_.utilisation.alarm : parameters_.utilisation.warn;
  const auto when = std::find_if(next, instants.end(),
                                 [limit](const forecast::Instant& instant) { return !(instant.utilisation < limit); });
  const double newest_s = progress.time_s + progress.lag_s;
  reading.lead_time_s = when == instants.end() ? 0.0 : std::max(0.0, when->time_s - newest_s);
  reading.message = fmt::format("In {:.0f} s {:.0f} % of the strength is reached, {:.0f} % at the worst",
                                reading.lead_time_s, 100.0 * limit, 100.0 * worst);
  return reading;
}

/// Suspected before ReleaseWatch is sure of it (which waits for all to stand still, the hull too).
Reading ReleaseAlarms::judge_hung_up(const Progress& progress)
{
  const scene::StatusFrame& status = progress.status;
  if (status.outcome != scene::Outcome::releasing && status.outcome != scene::Outcome::hung_up) {
    sunk_s_.reset();
    Reading reading = alarm::stated(Level::normal);
    reading.message = status.outcome == scene::Outcome::released ? "The container is out" : "The hull is closed";
    return reading;
  }
  const double height_m = status.centroid_m.z();
  if (!sunk_s_ || lowest_m_ - height_m >= parameters_.not_sinking_m) {
    sunk_s_ = progress.time_s;
    lowest_m_ = height_m;
  }
  const double still_s = progress.time_s - *sunk_s_;
  Reading reading = alarm::stated(Level::normal);
  reading.value = still_s;
  reading.message = "The container sinks";
  if (status.outcome == scene::Outcome::hung_up)
    take_worse(reading, Level::alarm, "The container hangs in the slot");
  else if (still_s >= parameters_.not_sinking_s)
    take_worse(reading, Level::warn,
               fmt::format("The hull is open, and the container has not sunk for {:.0f} s", still_s));
  return reading;
}

Reading ReleaseAlarms::judge_lopsided(const Progress& progress) const
{
  const auto& [port_rad, starboard_rad] = progress.newest_opening;
  const double apart_rad = std::abs(port_rad - starboard_rad);
  Reading reading = alarm::graded(apart_rad, parameters_.lopsided_rad, parameters_.band);
  reading.message =
      fmt::format("{} is {:.1f} deg further open than {}", port_rad >= starboard_rad ? "Port" : "Starboard",
                  apart_rad * degrees_per_radian, port_rad >= starboard_rad ? "starboard" : "port");
  return reading;
}

Reading ReleaseAlarms::judge_sensor(const Progress& progress, std::int64_t now_ns, unsigned senders)
{
  Reading reading = alarm::stated(Level::normal);
  reading.message = "The opening is heard";
  const double share = rejected_share(progress, now_ns);
  if (over(progress) || now_ns == 0) {
    reading.message = now_ns == 0 ? "The clock is not heard yet" : "The log is over";
    return reading;
  }
  if (progress.newest_stamp_ns == 0) {
    if (!waiting_since_ns_ || *waiting_since_ns_ > now_ns)
      waiting_since_ns_ = now_ns;
    reading = alarm::graded(seconds(now_ns - *waiting_since_ns_),
                            { parameters_.silence_s.alarm, 2.0 * parameters_.silence_s.alarm }, parameters_.band);
    reading.message = senders == 0 ? "Nobody sends the opening" : "No opening was believable yet";
    return reading;
  }
  const double silence_s = std::max(0.0, seconds(now_ns - progress.newest_stamp_ns));
  reading = alarm::graded(silence_s, parameters_.silence_s, parameters_.band);
  reading.message = reading.reached == Level::normal
                        ? "The opening is heard"
                        : fmt::format("No believable opening for {:.1f} s, the last one is held", silence_s);
  if (share >= parameters_.rejected_warn)
    take_worse(reading, Level::warn, fmt::format("{:.0f} % of the opening's samples are rejected", 100.0 * share));
  return reading;
}

/// 0 where too few are known.
double ReleaseAlarms::rejected_share(const Progress& progress, std::int64_t now_ns)
{
  if (!counted_.empty() && counted_.back().now_ns > now_ns)
    counted_.clear();
  counted_.push_back({ now_ns, progress.accepted, rejected_in(progress) });
  while (counted_.front().now_ns < now_ns - counting_ns)
    counted_.pop_front();
  const std::uint64_t rejected = counted_.back().rejected - counted_.front().rejected;
  const std::uint64_t all = counted_.back().accepted - counted_.front().accepted + rejected;
  return all < fewest_counted ? 0.0 : static_cast<double>(rejected) / static_cast<double>(all);
}

Reading ReleaseAlarms::judge_lag(const Progress& progress) const
{
  Reading reading = alarm::graded(progress.lag_s, parameters_.lag_s, parameters_.band);
  reading.message = fmt::format("The prediction is {:.1f} s behind the measurement{}", progress.lag_s,
                                progress.state == RunState::paused ? ": it is held" : "");
  return reading;
}

}  // namespace geocontainer_mpm::ros_bridge
