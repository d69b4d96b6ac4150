// The basis of bit-for-bit replay: the history depends on the samples, not on when they and the clock came.

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "geocontainer_mpm/barge/opening_signal.h"

namespace geocontainer_mpm::barge {
namespace {

constexpr std::int64_t epoch_ns = 1'750'150'800'000'000'000;

OpeningSignalParameters any_parameters()
{
  OpeningSignalParameters parameters;
  parameters.smoothing_time_s = *rc::gen::element(0.0, 0.3, 1.0);
  parameters.backlash_rad = *rc::gen::element(0.0, 0.003);
  parameters.max_gap_s = *rc::gen::element(0.2, 0.5);
  return parameters;
}

// A walk with steps from still to too fast, NaN, repeated and backward stamps, short and long silences.
std::vector<OpeningSample> any_samples()
{
  const int count = *rc::gen::inRange(1, 120);
  std::vector<OpeningSample> samples;
  std::int64_t stamp_ns = epoch_ns;
  double angle = 0.1;
  for (int i = 0; i < count; ++i) {
    const int kind = *rc::gen::inRange(0, 40);
    std::int64_t step_ns = *rc::gen::inRange<std::int64_t>(10'000'000, 100'000'000);
    if (kind < 2)
      step_ns = *rc::gen::inRange<std::int64_t>(150'000'000, 2'500'000'000);
    if (kind == 2)
      step_ns = -step_ns;
    if (kind == 3)
      step_ns = 0;
    stamp_ns += step_ns;
    angle = std::clamp(angle + *rc::gen::inRange(-40, 41) * 1e-4, 0.0, 0.6);
    if (kind == 4)
      angle = *rc::gen::inRange(0, 60) * 0.01;
    const double port = kind == 5 ? NAN : kind == 6 ? angle + 0.2 : angle;
    samples.push_back({ stamp_ns, { port, 0.9 * angle } });
  }
  return samples;
}

// What anybody ever saw as known must be what the finished history holds.
class Witness {
public:
  void look(const OpeningSignal& signal)
  {
    const double known = signal.known_until_s();
    RC_ASSERT(known >= known_);
    known_ = known;
    if (known < 0.0)
      return;
    for (int n = 0; n < 5; ++n) {
      const double t = std::min(known * *rc::gen::inRange(0, 1001) / 1000.0, known);
      seen_[t] = signal.angles(t);
      next_[t] = { signal.next_motion_s(t), known };
    }
    seen_[known] = signal.angles(known);
  }

  void compare(const OpeningSignal& finished) const
  {
    for (const auto& [t, angles] : seen_) {
      RC_ASSERT(finished.angles(t).port_rad == angles.port_rad);
      RC_ASSERT(finished.angles(t).starboard_rad == angles.starboard_rad);
    }
    for (const auto& [t, next] : next_)
      RC_ASSERT(std::min(finished.next_motion_s(t), next.second) == next.first);
  }

private:
  double known_ = -1.0;
  std::map<double, OpeningAngles> seen_;
  std::map<double, std::pair<double, double>> next_;
};

RC_GTEST_PROP(OpeningReplay, HistoryDoesNotDependOnTheClock, ())
{
  const OpeningSignalParameters parameters = any_parameters();
  const std::vector<OpeningSample> samples = any_samples();
  OpeningSignal offline(parameters);
  for (const OpeningSample& sample : samples)
    offline.add(sample);
  offline.finish();

  OpeningSignal live(parameters);
  Witness witness;
  double clock = 0.0;
  // A sample may be delayed, but not late: the clock is ahead of no stamp still to come by more than max_gap_s.
  std::vector<std::int64_t> oldest_to_come_ns(samples.size());
  for (std::size_t i = samples.size(); i-- > 0;)
    oldest_to_come_ns[i] =
        i + 1 < samples.size() ? std::min(samples[i].stamp_ns, oldest_to_come_ns[i + 1]) : samples[i].stamp_ns;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const OpeningSample& sample = samples[i];
    if (!live.empty()) {
      const double latest =
          static_cast<double>(oldest_to_come_ns[i] - live.origin_ns()) / 1e9 + 0.999 * parameters.max_gap_s;
      const int ticks = *rc::gen::inRange(0, 4);
      for (int k = 0; k < ticks && latest > clock; ++k) {
        clock += (latest - clock) * *rc::gen::inRange(0, 101) / 100.0;
        live.clock(clock);
        witness.look(live);
      }
    }
    live.add(sample);
    if (*rc::gen::inRange(0, 5) == 0)
      witness.look(live);
  }
  if (*rc::gen::inRange(0, 2) == 0) {
    live.clock(clock + 10.0);
    witness.look(live);
  }
  live.finish();
  witness.compare(live);
  witness.compare(offline);

  for (int verdict = 0; verdict < sample_verdict_count; ++verdict)
    RC_ASSERT(live.count(SampleVerdict(verdict)) == offline.count(SampleVerdict(verdict)));
  RC_ASSERT(live.gaps().size() == offline.gaps().size());
  for (std::size_t i = 0; i < live.gaps().size(); ++i) {
    RC_ASSERT(live.gaps()[i].from_s == offline.gaps()[i].from_s);
    RC_ASSERT(live.gaps()[i].to_s == offline.gaps()[i].to_s);
  }
  const double end = static_cast<double>(live.last_accepted().stamp_ns - live.origin_ns()) / 1e9 + 1.0;
  for (int n = 0; n <= 1000; ++n) {
    const double t = end * n / 1000.0;
    RC_ASSERT(live.angles(t).port_rad == offline.angles(t).port_rad);
    RC_ASSERT(live.angles(t).starboard_rad == offline.angles(t).starboard_rad);
  }
}

RC_GTEST_PROP(OpeningReplay, RateLimitAndRangeHoldWhateverTheSamples, ())
{
  const OpeningSignalParameters parameters = any_parameters();
  OpeningSignal signal(parameters);
  double highest = 0.0;
  for (const OpeningSample& sample : any_samples()) {
    if (signal.add(sample) == SampleVerdict::accepted)
      highest = std::max(highest, sample.angles.port_rad);
  }
  signal.finish();
  if (signal.empty())
    return;
  const double end = static_cast<double>(signal.last_accepted().stamp_ns - signal.origin_ns()) / 1e9;
  double before = signal.angles(0.0).port_rad;
  const double step = end / 2000.0;
  for (int n = 1; n <= 2000; ++n) {
    const double now = signal.angles(n * step).port_rad;
    RC_ASSERT(std::abs(now - before) <= parameters.max_rate_rad_per_s * step + 1e-12);
    RC_ASSERT(std::abs(signal.rates(n * step).port_rad) <= parameters.max_rate_rad_per_s + 1e-12);
    RC_ASSERT(now >= 0.0);
    RC_ASSERT(now <= highest + 1e-12);
    before = now;
  }
}

TEST(OpeningReplay, CopyContinuesLikeTheOriginal)
{
  OpeningSignal original{ OpeningSignalParameters{} };
  for (int i = 0; i < 100; ++i)
    original.add({ epoch_ns + i * 50'000'000LL, { 1e-3 * i, 1e-3 * i } });
  OpeningSignal copy = original;
  for (int i = 100; i < 200; ++i) {
    original.add({ epoch_ns + i * 50'000'000LL, { 1e-3 * i, 1e-3 * i } });
    copy.add({ epoch_ns + i * 50'000'000LL, { 1e-3 * i, 1e-3 * i } });
  }
  EXPECT_EQ(original.known_until_s(), copy.known_until_s());
  EXPECT_GT(original.angles(8.0).port_rad, 0.1);
  EXPECT_EQ(original.angles(8.0).port_rad, copy.angles(8.0).port_rad);
}

}  // namespace
}  // namespace geocontainer_mpm::barge
