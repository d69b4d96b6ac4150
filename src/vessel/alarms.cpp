#include "geocontainer_mpm/vessel/alarms.h"

#include <fmt/format.h>

#include <algorithm>

namespace geocontainer_mpm::vessel {
namespace {

constexpr std::chrono::seconds repeat{ 10 };

const char* to_state(AlarmLevel level)
{
  switch (level) {
    case AlarmLevel::alarm:
      return "alarm";
    case AlarmLevel::warn:
      return "warn";
    case AlarmLevel::normal:
      break;
  }
  return "normal";
}

AlarmLevel shown(const Alarm& alarm)
{
  return alarm.acknowledged ? alarm.level : std::max(alarm.level, alarm.latched);
}

const AlarmKind* kind_of(const std::string& name)
{
  const auto& kinds = alarm_kinds();
  const auto found = std::find_if(kinds.begin(), kinds.end(), [&](const AlarmKind& kind) { return name == kind.name; });
  return found == kinds.end() ? nullptr : &*found;
}

/// Printable ASCII without what a sentence reserves (NMEA 0183, 5.1).
std::string as_field(std::string text, std::size_t longest)
{
  for (char& c : text)
    if (c < ' ' || c > '}' || std::string_view("!$*,\\^").find(c) != std::string_view::npos)
      c = ' ';
  text.resize(std::min(text.size(), longest));
  return text;
}

}  // namespace

const std::vector<AlarmKind>& alarm_kinds()
{
  static const std::vector<AlarmKind> kinds = {
    { "sheet_utilisation", 1, "The tension nears or passes the strength of the geotextile" },
    { "seam_utilisation", 2, "The tension nears or passes the strength of the seam" },
    { "forecast_utilisation", 3, "The forecast says that it will" },
    { "hung_up", 4, "The container stands still in the slot" },
    { "lopsided_opening", 5, "Port and starboard do not open alike" },
    { "sensor", 6, "The hull angles are missing or not believable" },
    { "lag", 7, "The prediction is behind the measurement" },
    { "solver", 8, "The prediction has stopped" },
  };
  return kinds;
}

Notice to_notice(const Alarm& alarm)
{
  const AlarmLevel level = shown(alarm);
  return { to_state(level), alarm.message, level == AlarmLevel::alarm && !alarm.acknowledged, alarm.acknowledged };
}

std::string write_alarm(const Alarm& alarm, const NmeaNames& names)
{
  const AlarmKind* const kind = kind_of(alarm.name);
  if (kind == nullptr)
    return "";
  const std::string utc = format_utc(alarm.since);  // 2026-11-26T09:20:14.123Z
  const std::string time = utc.substr(11, 2) + utc.substr(14, 2) + utc.substr(17, 5);
  const std::string number = fmt::format("{:03}", kind->number);
  const char* const condition = alarm.level == AlarmLevel::alarm ? "A" : "V";
  const char* const acknowledged = alarm.acknowledged ? "A" : "V";
  // "$IIALR,092014.12,001,A,V," and "*hh" with the line's end.
  constexpr std::size_t longest = longest_sentence - 25 - 5;
  return write_sentence(names.talker + "ALR",
                        { time, number, condition, acknowledged, as_field(alarm.message, longest) })
      .value_or("");
}

std::string AlarmSentences::due(const std::vector<Alarm>& alarms, Steady now, const NmeaNames& names)
{
  std::string text;
  for (const Alarm& alarm : alarms) {
    const bool standing = shown(alarm) == AlarmLevel::alarm;
    const auto found = told_.find(alarm.name);
    if (!standing && found == told_.end())
      continue;
    const Told fresh{ alarm.level == AlarmLevel::alarm, alarm.acknowledged, now };
    if (found != told_.end() && standing && found->second.condition == fresh.condition &&
        found->second.acknowledged == fresh.acknowledged && now - found->second.when < repeat)
      continue;
    text += write_alarm(alarm, names);
    if (standing)
      told_[alarm.name] = fresh;
    else
      told_.erase(found);
  }
  return text;
}

}  // namespace geocontainer_mpm::vessel
