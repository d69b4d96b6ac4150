#pragma once
/// The alarms of a release: what each of them judges, and the book that they are kept in. Knows no ROS.

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "geocontainer_mpm/alarm/alarm_book.h"
#include "geocontainer_mpm/forecast/forecast.h"
#include "geocontainer_mpm/ros/progress.h"

namespace geocontainer_mpm::ros_bridge {

struct AlarmParameters {
  alarm::Limits utilisation{ 0.8, 1.0 };    ///< tension over strength, of sheet, seam and forecast
  alarm::Limits lopsided_rad{ 0.05, 0.1 };  ///< between port and starboard
  alarm::Limits silence_s{ 1.0, 5.0 };      ///< since the newest accepted sample, by the log's clock
  double rejected_warn = 0.2;               ///< share of the samples of the last 5 s, (0, 1]
  alarm::Limits lag_s{ 3.0, 10.0 };         ///< of the simulation behind the newest measurement
  double not_sinking_s = 5.0;               ///< the container has not sunk for so long (simulated): it may hang, s, > 0
  double not_sinking_m = 0.02;              ///< that is by less than this, m, > 0
  double band = 0.1;                        ///< a level is let go below (1 - band) times its limit, [0, 1)
  double fall_after_s = 2.0;                ///< and only after so long, by the log's clock, s, >= 0
};

/// All alarms, in a fixed order.
struct AlarmReport {
  bool replay = false;  ///< of a log that is replayed: not of now
  std::vector<alarm::Alarm> alarms;
};

class ReleaseAlarms {
public:
  ReleaseAlarms(const AlarmParameters& parameters, bool replay);

  /// Judges everything. `now_ns`: the log's clock, 0 while it is not heard.
  AlarmReport look(const Progress& progress, std::int64_t now_ns, unsigned senders);
  /// What the next looks judge as lying ahead; none: nothing is known.
  void expect(std::shared_ptr<const forecast::Forecast> forecast);
  std::string acknowledge();  ///< what was acknowledged, in one sentence
  AlarmReport report() const;

private:
  enum Kind { sheet, seam, ahead, hung_up, lopsided, sensor, lag, solver, kind_count };
  /// Samples up to a look.
  struct Counted {
    std::int64_t now_ns;
    std::uint64_t accepted, rejected;
  };

  void begin_run(std::uint64_t run, std::int64_t now_ns);
  alarm::Reading judge_tension(const Progress& progress, bool of_seam);
  alarm::Reading judge_ahead(const Progress& progress) const;
  alarm::Reading judge_hung_up(const Progress& progress);
  alarm::Reading judge_lopsided(const Progress& progress) const;
  alarm::Reading judge_sensor(const Progress& progress, std::int64_t now_ns, unsigned senders);
  alarm::Reading judge_lag(const Progress& progress) const;
  double rejected_share(const Progress& progress, std::int64_t now_ns);

  AlarmParameters parameters_;
  bool replay_;
  mutable std::mutex mutex_;  ///< guards what follows
  alarm::AlarmBook book_;
  std::shared_ptr<const forecast::Forecast> ahead_;

  // Of the run.
  std::uint64_t run_ = 0;
  double peak_sheet_ = 0.0, peak_seam_ = 0.0;  ///< at the last look
  double lowest_m_ = 0.0;                      ///< centroid when it had last sunk
  std::optional<double> sunk_s_;               ///< when that was
  std::optional<std::int64_t> waiting_since_ns_;
  std::deque<Counted> counted_;
};

}  // namespace geocontainer_mpm::ros_bridge
