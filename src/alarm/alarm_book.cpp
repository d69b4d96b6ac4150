#include "geocontainer_mpm/alarm/alarm_book.h"

#include <algorithm>

namespace geocontainer_mpm::alarm {
namespace {

/// Written so that a value that is no number is above every limit.
Level grade(double value, double warn, double alarm)
{
  if (!(value < alarm))
    return Level::alarm;
  return value < warn ? Level::normal : Level::warn;
}

}  // namespace

const char* to_string(Level level)
{
  switch (level) {
    case Level::normal:
      return "normal";
    case Level::warn:
      return "warn";
    case Level::alarm:
      break;
  }
  return "alarm";
}

Reading graded(double value, const Limits& limits, double band)
{
  Reading reading;
  reading.value = value;
  reading.reached = grade(value, limits.warn, limits.alarm);
  reading.held = grade(value, limits.warn * (1.0 - band), limits.alarm * (1.0 - band));
  return reading;
}

Reading stated(Level level)
{
  Reading reading;
  reading.reached = reading.held = level;
  return reading;
}

std::size_t AlarmBook::add(const std::string& name, const std::string& unit, const Delays& delays)
{
  Alarm alarm;
  alarm.name = name;
  alarm.unit = unit;
  alarms_.push_back(alarm);
  records_.push_back({ delays, {}, 0.0, {} });
  return alarms_.size() - 1;
}

void AlarmBook::Switch::judge(bool reached, bool held, std::int64_t now_ns, const Delays& delays)
{
  const bool wants_to_change = on ? !held : reached;
  if (!wants_to_change) {
    changing_since_ns.reset();
    return;
  }
  if (!changing_since_ns || *changing_since_ns > now_ns)
    changing_since_ns = now_ns;
  const double waited_s = static_cast<double>(now_ns - *changing_since_ns) / 1e9;
  if (waited_s < (on ? delays.fall_after_s : delays.rise_after_s))
    return;
  on = !on;
  changing_since_ns.reset();
}

void AlarmBook::judge(std::size_t number, const Reading& reading, std::int64_t now_ns)
{
  Alarm& alarm = alarms_[number];
  Record& record = records_[number];
  alarm.value = reading.value;
  alarm.lead_time_s = reading.lead_time_s;
  for (const Level level : { Level::warn, Level::alarm })
    record.switches[level == Level::alarm].judge(reading.reached >= level, reading.held >= level, now_ns,
                                                 record.delays);
  // What holds the alarm holds the warning, and with equal delays no longer than it.
  const Level before = alarm.latched;
  set_level(alarm, record.switches[1].on ? Level::alarm : record.switches[0].on ? Level::warn : Level::normal, now_ns);

  if (alarm.latched > before || (reading.reached >= alarm.latched && reading.value >= record.worst)) {
    record.worst = reading.value;
    record.worst_message = reading.message;
  }
  alarm.message = alarm.level == Level::normal && alarm.waits() ? record.worst_message : reading.message;
}

void AlarmBook::set_level(Alarm& alarm, Level level, std::int64_t now_ns)
{
  if (level == alarm.level)
    return;
  if (level > alarm.level)
    alarm.acknowledged = false;
  alarm.level = level;
  alarm.since_ns = now_ns;
  alarm.latched = std::max(alarm.latched, level);
  let_go(alarm);
}

void AlarmBook::let_go(Alarm& alarm)
{
  if (alarm.level != Level::normal || !alarm.acknowledged)
    return;
  alarm.latched = Level::normal;
  alarm.acknowledged = false;
}

std::vector<std::string> AlarmBook::acknowledge()
{
  std::vector<std::string> seen;
  for (Alarm& alarm : alarms_) {
    if (!alarm.waits())
      continue;
    seen.push_back(alarm.name);
    alarm.acknowledged = true;
    let_go(alarm);
  }
  return seen;
}

void AlarmBook::begin_run(std::int64_t now_ns)
{
  for (std::size_t i = 0; i < alarms_.size(); ++i) {
    records_[i].switches = {};
    set_level(alarms_[i], Level::normal, now_ns);
    alarms_[i].value = alarms_[i].lead_time_s = 0.0;
    alarms_[i].message = alarms_[i].waits() ? records_[i].worst_message : std::string();
  }
}

}  // namespace geocontainer_mpm::alarm
