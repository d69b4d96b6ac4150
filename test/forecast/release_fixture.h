#pragma once
/// The default release on a coarse grid, with a hull that opens within two seconds, fed as a log would.

#include <algorithm>
#include <string>
#include <vector>

#include "geocontainer_mpm/forecast/assumed_opening.h"
#include "geocontainer_mpm/scene/simulation.h"

namespace geocontainer_mpm::forecast {

constexpr double sample_interval_s = 0.05;
constexpr double opens_at_s = 0.5, opens_within_s = 2.0, full_rad = 0.365;
constexpr double log_end_s =
    3.55;  ///< a smoothing time and a sample after the hull has stopped, as a run ahead assumes

inline std::string release_path()
{
  return std::string(GEOCONTAINER_MPM_SOURCE_DIR) + "/config/scenes/release.yaml";
}

inline std::vector<std::string> coarse_overrides()
{
  return { "grid.cell_size_m=0.4",
           "grid.lower_m=[-6, -10.4]",
           "grid.upper_m=[6, 0.8]",
           "geotextiles.container.segment_length_m=0.4",
           "hull.signal.max_rate_rad_per_s=0.5",
           "time.end_s=12" };
}

inline scene::SceneDescription coarse_release()
{
  return scene::load_scene(release_path(), coarse_overrides());
}

/// The whole opening as it is planned, and measured too.
inline const AssumedOpening& planned()
{
  static const AssumedOpening opening = AssumedOpening::planned(
      { { 0.0, { 0.0, 0.0 } }, { opens_at_s, { 0.0, 0.0 } }, { opens_at_s + opens_within_s, { full_rad, full_rad } } },
      coarse_release().hull->signal, "plan");
  return opening;
}

inline barge::OpeningSample sample_at(int index)
{
  const std::int64_t time_ns = index * std::int64_t{ 50'000'000 };
  return { 1'000'000'000'000 + time_ns, planned().at(static_cast<double>(time_ns) / 1e9) };
}

/// A log that is followed sample by sample.
class LiveRun {
public:
  explicit LiveRun(const scene::SceneDescription& scene) : simulation_(scene, 1) {}

  /// The next sample, and all that can be computed with it.
  scene::Advance follow()
  {
    simulation_.opening().add(sample_at(next_++));
    return catch_up();
  }
  scene::Advance catch_up()
  {
    scene::Advance result = scene::Advance::stepped;
    while (result == scene::Advance::stepped || result == scene::Advance::frame_due)
      result = simulation_.advance();
    return result;
  }
  void follow_until(double time_s)
  {
    while (next_ * sample_interval_s <= time_s + 1e-9)
      follow();
  }
  scene::Simulation& simulation() { return simulation_; }
  double measured_s() const { return (next_ - 1) * sample_interval_s; }  ///< time of the newest sample

private:
  scene::Simulation simulation_;
  int next_ = 0;
};

}  // namespace geocontainer_mpm::forecast
