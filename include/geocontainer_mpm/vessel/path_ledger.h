#pragma once
/// What is to be sent on each path, and what of it the server has shown to have.

#include <chrono>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "geocontainer_mpm/vessel/signalk_delta.h"

namespace geocontainer_mpm::vessel {

/// One newest value for each announced path, so that a slow or dead peer costs no memory. Not thread-safe.
class PathLedger {
public:
  using Steady = std::chrono::steady_clock::time_point;

  explicit PathLedger(const std::vector<PathMeta>& announced);

  enum class Put { queued, replaced, refused };
  Put put(const PathValue& value);

  /// Values that wait to be sent, at most so many; they count as sent at `now`.
  std::vector<PathValue> take(std::size_t most, Steady now);

  /// A new connection: the newest value of every path is to be sent again, nothing waits for its confirmation.
  void begin_connection();

  /// A value of our own source came back. True when it confirms one that was sent: the same value, and stamped no
  /// earlier (a server may put its own stamps).
  bool confirm(const IncomingValue& value);

  bool anything_sent() const { return anything_sent_; }
  /// Path and instant of the longest wait for a confirmation.
  std::optional<std::pair<std::string, Steady>> oldest_wait() const;
  std::vector<std::string> paths() const;

private:
  struct Sent {
    Value value;
    Stamp stamp;
    Steady when;
  };
  struct Slot {
    std::optional<PathValue> newest;
    bool to_send = false;
    std::deque<Sent> sent;                ///< not read back, the latest few
    std::optional<Steady> waiting_since;  ///< the first of them, also of those that were dropped
  };
  std::map<std::string, Slot> slots_;
  bool anything_sent_ = false;
};

}  // namespace geocontainer_mpm::vessel
