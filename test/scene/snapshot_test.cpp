/// A run that goes on from a snapshot of another one.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "physics_fixture.h"

namespace geocontainer_mpm::scene {
namespace {

struct Case {
  const char* name;
  const char* scene;
  std::vector<std::string> overrides;
};

void PrintTo(const Case& one, std::ostream* out)
{
  *out << one.name;
}

std::string all_of(const Simulation& simulation)
{
  auto summary = nlohmann::ordered_json::parse(summary_json(simulation, 1.0, 1));
  summary.erase("stages");
  return summary.dump(1);
}

class SnapshotOf : public testing::TestWithParam<Case> {};

TEST_P(SnapshotOf, GoesOnBitForBitWhileItsRunDoesToo)
{
  const SceneDescription scene = load_scene(scene_path(GetParam().scene), GetParam().overrides);
  Simulation live(scene, 1);
  live.use_scene_opening();
  EXPECT_FALSE(live.snapshot());  // not begun
  while (live.time_s() < 0.5)
    live.advance(1);
  const std::optional<Snapshot> kept = live.snapshot();
  ASSERT_TRUE(kept);
  EXPECT_LE(kept->time_s(), live.time_s());
  Simulation copy(scene, 2, *kept);
  EXPECT_EQ(copy.time_s(), kept->time_s());
  Advance of_live = Advance::stepped, of_copy = Advance::stepped;
  while (of_live != Advance::finished && of_live != Advance::stopped)
    of_live = live.advance();
  while (of_copy != Advance::finished && of_copy != Advance::stopped)
    of_copy = copy.advance();
  EXPECT_EQ(of_live, Advance::finished);
  EXPECT_EQ(copy.digest(), live.digest());
  EXPECT_EQ(all_of(copy), all_of(live));

  const std::uint64_t end = live.digest();
  copy.reset();
  live.reset();
  EXPECT_EQ(copy.digest(), live.digest());
  EXPECT_NE(copy.digest(), end);
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, SnapshotOf,
    testing::Values(
        Case{ "bonded",
              "release",
              { "grid.cell_size_m=0.4", "grid.upper_m=[6, 0.8]", "geotextiles.container.segment_length_m=0.4",
                "hull.opening_table=[[0, 0, 0], [0.2, 0, 0], [1.2, 0.365, 0.365]]", "time.end_s=1" } },
        Case{ "slip",
              "release",
              { "grid.cell_size_m=0.4", "grid.upper_m=[6, 0.8]", "geotextiles.container.segment_length_m=0.4",
                "geotextiles.container.interface=frictional", "geotextiles.container.interface_friction=0.5",
                "hull.opening_table=[[0, 0, 0], [0.2, 0, 0], [1.2, 0.365, 0.365]]", "time.end_s=1" } },
        Case{ "space",
              "release_3d",
              { "grid.cell_size_m=0.5", "grid.upper_m=[7, 1]", "geotextiles.container.segment_length_m=0.5",
                "space.symmetry=quarter", "hull.opening_table=[[0, 0, 0], [0.2, 0, 0], [1.2, 0.365, 0.365]]",
                "time.end_s=0.6" } }),
    [](const auto& one) { return one.param.name; });

}  // namespace
}  // namespace geocontainer_mpm::scene
