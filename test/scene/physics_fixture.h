#pragma once
/// Helpers of the physics tests: run a scene to its end and look at what came out.

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "geocontainer_mpm/scene/simulation.h"

namespace geocontainer_mpm::scene {

inline std::string scene_path(const std::string& name)
{
  return std::string(GEOCONTAINER_MPM_SOURCE_DIR) + "/config/scenes/" + name + ".yaml";
}

/// Runs a scene on its own opening table. `look` is called at every output instant.
template <class Look>
Advance run(Simulation& simulation, Look&& look)
{
  simulation.use_scene_opening();
  for (;;) {
    const Advance now = simulation.advance(1000);
    if (now == Advance::frame_due)
      look(simulation);
    if (now == Advance::finished || now == Advance::stopped || now == Advance::waiting)
      return now;
  }
}

inline Advance run(Simulation& simulation)
{
  return run(simulation, [](const Simulation&) {});
}

/// The points of a plane-strain frame in their section, (y, z).
inline std::vector<Vec2> section(const std::vector<Vec3>& points)
{
  std::vector<Vec2> result;
  for (const Vec3& point : points)
    result.emplace_back(point.tail<2>());
  return result;
}

constexpr double degrees = 3.14159265358979323846 / 180.0;
constexpr double gravity = 9.81;

}  // namespace geocontainer_mpm::scene
