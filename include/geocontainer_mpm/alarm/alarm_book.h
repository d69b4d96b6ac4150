#pragma once
/// Alarms that somebody has to have seen. A level rises at once (or after a delay), falls only when the value has been
/// below the limit by a band for a while, and what was reached stays latched until it is acknowledged.
///
/// The states are those of IEC 62682 (normal, unacknowledged, acknowledged, returned to normal but unacknowledged) and,
/// by other names, of IMO MSC.302(87) (active, acknowledged, rectified but unacknowledged). Delays and band are what
/// IEC 62682 calls on-delay, off-delay and deadband.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace geocontainer_mpm::alarm {

enum class Level : std::uint8_t { normal, warn, alarm };
const char* to_string(Level level);

/// From which value on the condition holds; warn < alarm.
struct Limits {
  double warn = 0.0;
  double alarm = 0.0;
};

/// What is judged now.
struct Reading {
  Level reached = Level::normal;  ///< the level does not stay below it
  Level held = Level::normal;     ///< the level does not fall below it; >= reached
  double value = 0.0;
  double lead_time_s = 0.0;  ///< until it is expected, s; 0: now, or not known
  std::string message;       ///< one sentence for the superintendent, true of the value whatever the level
};

/// By limits, of which the level lets go below (1 - band) times the limit, 0 <= band < 1. A value that is no number has
/// reached the alarm: what cannot be judged is not said to be well.
Reading graded(double value, const Limits& limits, double band);
/// A condition that is there or not.
Reading stated(Level level);

struct Delays {
  double rise_after_s = 0.0;  ///< a level is reached for so long before it is taken, s, >= 0; 0: at once
  double fall_after_s = 0.0;  ///< a level is not held for so long before it is let go, s, >= 0
};

struct Alarm {
  std::string name;
  std::string unit;  ///< of the value
  Level level = Level::normal;
  Level latched = Level::normal;  ///< highest level since it was last acknowledged and at rest; >= level
  bool acknowledged = false;      ///< somebody has seen what is latched; false where nothing is
  std::int64_t since_ns = 0;      ///< when the level last changed; 0: never
  double value = 0.0;
  double lead_time_s = 0.0;
  /// Of the value now; of an alarm that is over and was not acknowledged, of the worst that it reached.
  std::string message;

  bool waits() const { return latched != Level::normal && !acknowledged; }
};

class AlarmBook {
public:
  /// Alarms keep the order in which they are added. Returns the alarm's number.
  std::size_t add(const std::string& name, const std::string& unit, const Delays& delays);

  /// `now_ns` in any one epoch. A clock that goes back starts the delays again.
  void judge(std::size_t alarm, const Reading& reading, std::int64_t now_ns);

  /// Everything latched up to now has been seen: what is at rest is let go at once, the rest when it comes to rest. A
  /// level that rises again asks anew. Returns the names of the alarms that waited for it.
  std::vector<std::string> acknowledge();

  /// Another run begins: no condition holds yet. What was latched has still to be seen.
  void begin_run(std::int64_t now_ns);

  const std::vector<Alarm>& alarms() const { return alarms_; }

private:
  /// Whether one level is on.
  struct Switch {
    bool on = false;
    std::optional<std::int64_t> changing_since_ns;  ///< since when the reading says otherwise
    void judge(bool reached, bool held, std::int64_t now_ns, const Delays& delays);
  };
  struct Record {
    Delays delays;
    std::array<Switch, 2> switches;  ///< warn, alarm
    double worst = 0.0;              ///< value that `worst_message` is of
    std::string worst_message;
  };

  static void set_level(Alarm& alarm, Level level, std::int64_t now_ns);
  static void let_go(Alarm& alarm);

  std::vector<Alarm> alarms_;
  std::vector<Record> records_;  ///< one an alarm
};

}  // namespace geocontainer_mpm::alarm
