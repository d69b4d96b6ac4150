#include <cmath>
#include <cstdio>

#include "geocontainer_mpm/barge/opening_signal.h"
#include "geocontainer_mpm/error.h"

namespace geocontainer_mpm::barge {
namespace {

std::string text(double value)
{
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.9g", value);
  return buffer;
}

void require(bool holds, const std::string& key, double value, const std::string& allowed)
{
  if (!holds)
    throw InputError("", key, text(value), allowed);
}

}  // namespace

const char* to_string(SampleVerdict verdict)
{
  switch (verdict) {
    case SampleVerdict::accepted:
      return "accepted";
    case SampleVerdict::duplicate:
      return "duplicate";
    case SampleVerdict::out_of_order:
      return "out_of_order";
    case SampleVerdict::non_finite:
      return "non_finite";
    case SampleVerdict::out_of_range:
      return "out_of_range";
    case SampleVerdict::too_fast:
      return "too_fast";
  }
  return "unknown";
}

void OpeningSignalParameters::validate(const std::string& key_prefix) const
{
  // Comparisons are written so that NaN fails them.
  const std::string p = key_prefix.empty() ? "" : key_prefix + ".";
  require(min_angle_rad >= -1.57 && min_angle_rad <= 0.0, p + "min_angle_rad", min_angle_rad,
          "must be in [-1.57, 0] rad");
  require(max_angle_rad > 0.0 && max_angle_rad <= 1.57, p + "max_angle_rad", max_angle_rad, "must be in (0, 1.57] rad");
  require(max_rate_rad_per_s > 0.0 && max_rate_rad_per_s <= 100.0, p + "max_rate_rad_per_s", max_rate_rad_per_s,
          "must be in (0, 100] rad/s");
  require(noise_rad >= 0.0 && noise_rad <= 1.57, p + "noise_rad", noise_rad, "must be in [0, 1.57] rad");
  require(max_gap_s > 0.0 && max_gap_s <= 3600.0, p + "max_gap_s", max_gap_s, "must be in (0, 3600] s");
  require(smoothing_time_s >= 0.0 && smoothing_time_s <= 60.0, p + "smoothing_time_s", smoothing_time_s,
          "must be in [0, 60] s");
  require(backlash_rad >= 0.0 && backlash_rad <= 0.1, p + "backlash_rad", backlash_rad, "must be in [0, 0.1] rad");
}

}  // namespace geocontainer_mpm::barge
