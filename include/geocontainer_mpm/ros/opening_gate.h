#pragma once
/// Holds arriving samples against the clock, before the opening signal judges them.
///
/// Clock and samples come over different connections, so either may be late. A sample that contradicts the clock (far
/// ahead of it: left over from the loop before; far behind the newest: first of the next loop) waits in the queue until
/// the clock explains it or the transport's patience is over. What the signal is given therefore depends on the log,
/// not on the delays of the day.

#include <cstdint>
#include <deque>
#include <optional>

#include "geocontainer_mpm/barge/opening_signal.h"

namespace geocontainer_mpm::ros_bridge {

struct ArrivedSample {
  barge::OpeningSample sample;
  std::int64_t arrived_ns = 0;  ///< steady clock of this machine, ns
};

struct GateParameters {
  std::int64_t max_future_ns = 1'000'000'000;
  std::int64_t time_jump_back_ns = 1'000'000'000;
  std::int64_t patience_ns = 500'000'000;
};

enum class GateDecision {
  take,           ///< give it to the opening signal
  wait,           ///< ask again later
  reject_future,  ///< stamped further ahead of the clock than is believable
  reject_unstamped
};

class OpeningGate {
public:
  explicit OpeningGate(const GateParameters& parameters) : parameters_(parameters) {}

  /// `now_ns` is the clock of the samples (0: it has not been heard yet), `steady_ns` this machine's steady clock.
  GateDecision judge(const ArrivedSample& arrived, std::int64_t now_ns, std::int64_t steady_ns) const;
  void taken(const barge::OpeningSample& sample);

  /// True when the clock went back by more than time_jump_back: a new loop, a seek back.
  bool jumped_back(std::int64_t now_ns);
  /// The clock as it was a whole patience ago: everything stamped and sent before has arrived. Nothing when it has not
  /// run for so long.
  std::optional<std::int64_t> settled_clock(std::int64_t now_ns, std::int64_t steady_ns);
  void reset();

private:
  struct ClockReading {
    std::int64_t now_ns, steady_ns;
  };
  GateParameters parameters_;
  std::int64_t newest_taken_ns_ = 0;
  std::int64_t newest_now_ns_ = 0;
  std::deque<ClockReading> readings_;
  std::optional<std::int64_t> settled_ns_;
};

}  // namespace geocontainer_mpm::ros_bridge
