#include "geocontainer_mpm/vessel/path_ledger.h"

#include <algorithm>
#include <cmath>

namespace geocontainer_mpm::vessel {
namespace {

/// Deltas on their way to the server and back; at ten a second this is some seconds of a slow server.
constexpr std::size_t most_in_flight = 64;

/// What the wire carries of a stamp.
Stamp to_milliseconds(Stamp stamp)
{
  return Stamp(std::chrono::floor<std::chrono::milliseconds>(stamp.time_since_epoch()));
}

/// JSON has no other numbers: they would go out as null and come back as something else.
bool all_finite(const Value& value)
{
  const auto finite = [](double number) { return std::isfinite(number); };
  if (const auto* number = std::get_if<double>(&value))
    return finite(*number);
  if (const auto* columns = std::get_if<Columns>(&value))
    return std::all_of(columns->begin(), columns->end(), [&](const auto& column) {
      return std::all_of(column.second.begin(), column.second.end(), finite);
    });
  return true;
}

}  // namespace

PathLedger::PathLedger(const std::vector<PathMeta>& announced)
{
  for (const PathMeta& meta : announced)
    slots_[meta.path];
}

PathLedger::Put PathLedger::put(const PathValue& value)
{
  const auto found = slots_.find(value.path);
  if (found == slots_.end())
    return Put::refused;
  Slot& slot = found->second;
  const bool replaced = slot.to_send;
  slot.newest = value;
  if (!all_finite(value.value))
    slot.newest->value = {};
  slot.to_send = true;
  return replaced ? Put::replaced : Put::queued;
}

std::vector<PathValue> PathLedger::take(std::size_t most, Steady now)
{
  std::vector<PathValue> values;
  for (auto& [path, slot] : slots_) {
    if (!slot.to_send || values.size() >= most)
      continue;
    slot.to_send = false;
    values.push_back(*slot.newest);
    slot.sent.push_back({ slot.newest->value, to_milliseconds(slot.newest->stamp), now });
    if (slot.sent.size() > most_in_flight)
      slot.sent.pop_front();
    if (!slot.waiting_since)
      slot.waiting_since = now;
    anything_sent_ = true;
  }
  return values;
}

void PathLedger::begin_connection()
{
  for (auto& [path, slot] : slots_) {
    slot.to_send = slot.newest.has_value();
    slot.sent.clear();
    slot.waiting_since.reset();
  }
}

bool PathLedger::confirm(const IncomingValue& value)
{
  const auto found = slots_.find(value.path);
  if (found == slots_.end() || !value.stamp)
    return false;
  Slot& slot = found->second;
  // The latest that fits: the server has gone past those before it.
  const auto fits = std::find_if(slot.sent.rbegin(), slot.sent.rend(), [&](const Sent& sent) {
    return sent.value == value.value && *value.stamp >= sent.stamp;
  });
  if (fits == slot.sent.rend())
    return false;
  slot.sent.erase(slot.sent.begin(), fits.base());
  slot.waiting_since = slot.sent.empty() ? std::nullopt : std::optional<Steady>(slot.sent.front().when);
  return true;
}

std::optional<std::pair<std::string, PathLedger::Steady>> PathLedger::oldest_wait() const
{
  std::optional<std::pair<std::string, Steady>> oldest;
  for (const auto& [path, slot] : slots_)
    if (slot.waiting_since && (!oldest || *slot.waiting_since < oldest->second))
      oldest = { path, *slot.waiting_since };
  return oldest;
}

std::vector<std::string> PathLedger::paths() const
{
  std::vector<std::string> paths;
  for (const auto& [path, slot] : slots_)
    paths.push_back(path);
  return paths;
}

}  // namespace geocontainer_mpm::vessel
