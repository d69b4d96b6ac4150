#pragma once
/// The release's alarms for the vessel: Signal K notifications, and NMEA 0183's ALR (IEC 61162-1, "Set alarm state").

#include <chrono>
#include <map>
#include <string>
#include <vector>

#include "geocontainer_mpm/vessel/figures.h"
#include "geocontainer_mpm/vessel/nmea_angles.h"

namespace geocontainer_mpm::vessel {

enum class AlarmLevel { normal, warn, alarm };

struct Alarm {
  std::string name;  ///< one of alarm_kinds()
  AlarmLevel level = AlarmLevel::normal;
  AlarmLevel latched = AlarmLevel::normal;  ///< highest since it was last acknowledged at rest
  bool acknowledged = false;                ///< somebody has seen the latched level
  Stamp since;                              ///< of the level
  std::string message;
};

struct AlarmKind {
  const char* name;
  int number;  ///< in ALR, 1 to 999
  const char* meaning;
};

/// The alarms that may come. One that is not here has no path on the server.
const std::vector<AlarmKind>& alarm_kinds();

/// What the crew is to see: an alarm stays up until it is acknowledged, then as long as its condition lasts, without
/// sound.
Notice to_notice(const Alarm& alarm);

/// `$--ALR,<hhmmss.ss of its level, UTC>,<number>,<A condition, V no longer>,<A acknowledged, V not>,<message>*hh`;
/// nothing for a name that is not known. Of a long message the beginning.
std::string write_alarm(const Alarm& alarm, const NmeaNames& names);

/// Which alarms are sentences now: those of the level alarm, when they rise, are acknowledged or end, and every ten
/// seconds while they last, for displays that have come later.
class AlarmSentences {
public:
  using Steady = std::chrono::steady_clock::time_point;
  std::string due(const std::vector<Alarm>& alarms, Steady now, const NmeaNames& names);

private:
  struct Told {
    bool condition = false, acknowledged = false;
    Steady when;
  };
  std::map<std::string, Told> told_;  ///< alarms that displays show
};

}  // namespace geocontainer_mpm::vessel
