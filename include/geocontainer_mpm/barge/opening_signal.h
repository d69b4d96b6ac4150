#pragma once
/// From stamped, noisy hull-opening angles to one continuous opening history.

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "geocontainer_mpm/barge/monotone_history.h"
#include "geocontainer_mpm/state_access.h"

namespace geocontainer_mpm::barge {

/// Rotation of each hull half from closed about its hinge, rad, opening positive.
struct OpeningAngles {
  double port_rad = 0.0;
  double starboard_rad = 0.0;
};

struct OpeningSample {
  std::int64_t stamp_ns = 0;  ///< time of measurement, ns in any epoch; integers keep replay and offline run identical
  OpeningAngles angles;
};

/// How a sample was judged. Everything but `accepted` leaves the history untouched and is counted.
enum class SampleVerdict {
  accepted,
  duplicate,     ///< same stamp as one of the samples accepted within the last smoothing time (the newest in any case)
  out_of_order,  ///< older than the newest accepted sample, or inside a part that is already held, or after finish()
  non_finite,    ///< an angle is NaN or infinite
  out_of_range,  ///< an angle is outside [min_angle_rad, max_angle_rad], or the stamp beyond +-2^62 ns (146 years)
  too_fast       ///< an angle is further from the last accepted one than max_rate_rad_per_s and noise_rad explain
};
inline constexpr int sample_verdict_count = 6;
const char* to_string(SampleVerdict verdict);

struct OpeningSignalParameters {
  double min_angle_rad = -0.02;  ///< lower end of believable angles, rad; a little below closed, for sensor offset
  double max_angle_rad = 0.7;    ///< upper end of believable angles, rad
  /// Fastest believable rate of a hull half, rad/s. Samples that need more are too_fast, and the history never exceeds
  /// it. Give it at least 1.5 times the fastest real rate: two filtered samples are joined at 2/3 of it at most, which
  /// is what keeps the cubic between them below it.
  double max_rate_rad_per_s = 0.1;
  double noise_rad = 0.02;        ///< jump between neighbouring samples that noise alone may cause, rad
  double max_gap_s = 0.5;         ///< longer silence than this holds the last angle and is reported, s
  double smoothing_time_s = 1.0;  ///< full width of the centred, triangular moving average over the samples, s; 0: none
  /// A hull half that stands still starts to move in the output only when its filtered angle has left this band around
  /// the output, rad; while it moves the output follows half of it behind. So a still hull is exactly still. 0: none.
  double backlash_rad = 0.003;

  /// Throws InputError naming `key_prefix.<field>`.
  void validate(const std::string& key_prefix) const;
};

/// A silence longer than max_gap_s over which the angle was held; `to_s` is infinite while it lasts.
struct OpeningGap {
  double from_s = 0.0;
  double to_s = 0.0;
};

/// One point of an exact opening table.
struct OpeningPoint {
  double time_s = 0.0;
  OpeningAngles angles;
};

/// Continuous opening history over simulation time, s; 0 is the stamp of the first accepted sample.
///
/// accepted samples -> centred moving average -> play (backlash) -> contact of the halves -> monotone cubic in time.
///
/// The value at a time t <= known_until_s() depends on the accepted samples alone, never on when they arrived or how
/// add(), clock() and finish() were interleaved: a live node and an offline run see the same bits.
/// - The moving average does not reach over a gap; at the ends of a stretch its window is cut off.
/// - The play starts from closed: a closed hull with filtered noise below backlash_rad is at exactly 0. It is
/// backlash_rad
///   wide to either side of an output that did not move for smoothing_time_s and narrows to half of that with travel.
/// - The halves touch when closed and cannot turn further: a filtered angle below 0 is sensor offset or noise, and the
///   opening is then 0. The range check on the raw sample (min_angle_rad) is what reports a sensor that is far off.
/// - Over a gap the angle is held. From the first sample after it the history goes over from the held to the measured
///   angle within smoothing_time_s, never outside the two, or more slowly where max_rate_rad_per_s asks for it.
/// - Samples that are too_fast but agree among themselves for longer than max_gap_s are a real change (the sensor was
///   moved, the last accepted sample was the outlier): the next one is accepted and ends a gap.
///
/// Memory: a stretch at rest costs nothing however long, a moving one about 50 bytes a sample (an hour of uninterrupted
/// movement at 20 Hz: 3.5 MB), a gap 16 bytes. Const calls may run concurrently with each other.
class OpeningSignal {
public:
  explicit OpeningSignal(const OpeningSignalParameters& parameters);

  /// The finished history through exactly these points (no filter): for tables written by people. Held at the first
  /// angle before the first point and at the last one after the last; no points: closed for ever. Throws InputError
  /// naming `<key>[i]` when times do not increase from >= 0 or an angle is not finite or negative.
  static OpeningSignal through(const std::vector<OpeningPoint>& points, const std::string& key);

  SampleVerdict add(const OpeningSample& sample);

  /// Tells that the clock reached `now_s` (simulation time), so that samples stamped before now_s - max_gap_s are not
  /// expected any more. As soon as that makes a gap certain, i.e. 2 max_gap_s after the last accepted sample, the last
  /// angle is held and known_until_s() grows to now_s - max_gap_s; later samples stamped before that are
  /// out_of_order. A clock that stands still, goes back or is not finite changes nothing.
  void clock(double now_s);

  /// No more samples will come: the last angle holds for ever and known_until_s() becomes infinite. A silence that
  /// lasts at this moment is the end of the log and no gap. Empty: closed for ever.
  void finish();

  /// No sample was accepted yet, nor points given to through().
  bool empty() const { return counts_[0] == 0 && history_.empty(); }
  std::int64_t origin_ns() const { return origin_ns_; }  ///< stamp of simulation time 0; 0 while empty
  /// End of the part of the history that no later sample changes, s; < 0 while not even the angle at 0 is known. Lags
  /// the newest sample by half the smoothing time and up to two samples. Never decreases.
  double known_until_s() const;
  OpeningAngles angles(double time_s) const;  ///< for time_s <= known_until_s(), rad; before 0 as at 0
  OpeningAngles rates(double time_s) const;   ///< time derivative of angles(), rad/s; same range
  /// First time >= time_s at which an angle differs from its value at time_s by any amount (bounded by
  /// known_until_s(), which is returned when nothing moves until then). Lets a resting scene jump ahead.
  double next_motion_s(double time_s) const;

  std::uint64_t count(SampleVerdict verdict) const { return counts_[static_cast<std::size_t>(verdict)]; }
  std::uint64_t rejected() const;  ///< all verdicts but accepted
  const std::vector<OpeningGap>& gaps() const { return gaps_; }
  const OpeningSample& last_accepted() const { return last_accepted_; }

private:
  friend struct geocontainer_mpm::StateAccess;

  using Pair = MonotoneHistory::Pair;  // port, starboard
  struct Measurement {
    std::int64_t time_ns;  // since origin_ns_
    Pair angle;
  };

  SampleVerdict judge(const OpeningSample& sample);
  SampleVerdict judge_rate(const OpeningSample& sample);
  bool plausible_step(const OpeningSample& from, const OpeningSample& to) const;
  void accept(const OpeningSample& sample);
  void close_stretch();
  void filter_next();
  void play(std::size_t half, double angle_rad, std::int64_t time_ns);
  Pair smoothed(std::size_t index) const;

  OpeningSignalParameters parameters_;
  std::int64_t max_gap_ns_;
  std::int64_t half_window_ns_;

  std::array<std::uint64_t, sample_verdict_count> counts_{};
  std::int64_t origin_ns_ = 0;
  OpeningSample last_accepted_;
  // Newest chain of too_fast samples that agree among themselves.
  bool has_candidate_ = false;
  std::int64_t candidate_since_ns_ = 0;
  OpeningSample candidate_;

  // The stretch of samples without a gap that is being filtered: accepted samples still in somebody's window.
  std::deque<Measurement> window_;
  std::size_t next_ = 0;         // index in window_ of the first sample whose filtered value is not final yet
  bool stretch_starts_ = true;   // window_[next_] is the first sample of its stretch
  bool stretch_closed_ = false;  // a gap, or the end, is certain after the last accepted sample
  Pair play_{ 0.0, 0.0 };        // output of the play
  Pair play_width_{ 0.0, 0.0 };  // to either side of it, between backlash_rad / 2 and backlash_rad
  std::array<std::int64_t, 2> still_since_ns_{};
  Pair held_{ 0.0, 0.0 };  // angle over the last gap
  std::int64_t stretch_since_ns_ = 0;

  MonotoneHistory history_;
  std::int64_t held_until_ns_ = 0;  // meaningful while stretch_closed_
  bool finished_ = false;
  std::vector<OpeningGap> gaps_;
};

}  // namespace geocontainer_mpm::barge
