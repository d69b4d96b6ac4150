/// The releases themselves: at rest in the hopper, released, hung up; balances and impenetrability on the way.

#include <algorithm>
#include <limits>

#include "geocontainer_mpm/barge/split_hull.h"
#include "geocontainer_mpm/contact/surface.h"
#include "physics_fixture.h"

namespace geocontainer_mpm::scene {
namespace {

double distance_to_segment(const Vec2& x, const Vec2& a, const Vec2& b)
{
  const Vec2 along = b - a;
  const double t = std::clamp((x - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (x - a - t * along).norm();
}

/// How far a point is outside a closed polygon, m; 0 inside.
double outside(const std::vector<Vec2>& polygon, const Vec2& x)
{
  bool in = false;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Vec2 &a = polygon[i], &b = polygon[j];
    if ((a[1] > x[1]) != (b[1] > x[1]) && x[0] < (b[0] - a[0]) * (x[1] - a[1]) / (b[1] - a[1]) + a[0])
      in = !in;
    nearest = std::min(nearest, distance_to_segment(x, a, b));
  }
  return in ? 0.0 : nearest;
}

/// Deepest point of the container behind either half of the hull, m.
double behind_hull(const Frame& frame, const barge::SplitHull& hull)
{
  double deepest = 0.0;
  for (const barge::HullHalf half : { barge::HullHalf::port, barge::HullHalf::starboard }) {
    const contact::Surface surface(hull.section_m(half, frame.opening));
    const auto look = [&](const Vec2& x) {
      const double distance = surface.nearest(x).distance;
      // Deeper than half a metre a point is beyond the other side of the lip, in the open.
      if (distance < 0.0 && distance > -0.5)
        deepest = std::max(deepest, -distance);
    };
    for (const Vec3& x : frame.geotextile[0].node)
      look(x.tail<2>());
    for (const Vec3& x : frame.soil[0].position)
      look(x.tail<2>());
  }
  return deepest;
}

TEST(Hopper, CarriesTheWeightOfTheRestingContainer)
{
  const SceneDescription scene =
      load_scene(scene_path("release"), { "grid.cell_size_m=0.2", "geotextiles.container.segment_length_m=0.2",
                                          "time.end_s=2", "hull.opening_table=[]", "numerics.skip_resting=false" });
  Simulation simulation(scene, 2);
  double first_kinetic = -1.0, weight = 0.0;
  EXPECT_EQ(run(simulation,
                [&](const Simulation& s) {
                  if (first_kinetic < 0.0 && s.counters().steps > 0)
                    first_kinetic = s.energy().kinetic;
                }),
            Advance::finished);
  weight = gravity * (10.8 * 1990 + 18.3 * 0.84);
  const Frame frame = simulation.frame();
  double carried = 0.0, sideways = 0.0;
  for (const BoundaryFrame& boundary : frame.boundary) {
    carried -= boundary.force.z();
    sideways += boundary.force.y();
  }
  EXPECT_NEAR(carried, weight, 0.01 * weight);
  EXPECT_NEAR(sideways, 0.0, 0.01 * weight);
  EXPECT_LT(frame.energy.kinetic, first_kinetic);
  EXPECT_LT(frame.energy.kinetic, 0.01) << "J/m: millimetres per second at most";
  EXPECT_EQ(frame.status.outcome, Outcome::waiting);
}

TEST(DefaultRelease, IsReleasedWithBalancesClosedAndNothingLeaks)
{
  const SceneDescription scene = load_scene(scene_path("release"));
  const barge::SplitHull hull(
      scene.hull->hinge_m, barge::round_corners(scene.hull->port_section_m, scene.hull->lip_radius_m, 0.3, "section"),
      "hull");
  const double quarter_cell = 0.25 * scene.grid.cell_size_m;
  const double bed = scene.surfaces.at("bed").line_m.front()[1];
  Simulation simulation(scene, 2);
  std::size_t frames = 0, leaked = 0, behind = 0, below = 0;
  const Advance end = run(simulation, [&](const Simulation& s) {
    const Frame frame = s.frame();
    ++frames;
    const std::vector<Vec2> sheet = section(frame.geotextile[0].node);
    for (const Vec2& x : section(frame.soil[0].position))
      leaked += outside(sheet, x) > quarter_cell ? 1 : 0;
    behind += behind_hull(frame, hull) > quarter_cell ? 1 : 0;
    for (const Vec2& x : sheet)
      below += x[1] < bed - quarter_cell ? 1 : 0;
  });
  EXPECT_EQ(end, Advance::finished) << simulation.failure().reason;
  EXPECT_GT(frames, 500U);
  EXPECT_EQ(leaked, 0U) << "sand particles outside the geotextile, over all outputs";
  EXPECT_EQ(behind, 0U) << "outputs with the container behind the hull";
  EXPECT_EQ(below, 0U) << "geotextile nodes in the bed, over all outputs";

  const StatusFrame status = simulation.status();
  EXPECT_EQ(status.outcome, Outcome::released);
  EXPECT_TRUE(status.resting);
  EXPECT_NEAR(status.soil_volume, status.soil_volume_initial, 0.03 * status.soil_volume_initial);
  EXPECT_LT(simulation.energy().relative_balance_error, 0.003);
  EXPECT_LT(simulation.counters().momentum_error, 1e-11);
  // Every form of dissipation takes energy, none gives.
  EXPECT_GT(simulation.energy().dissipated_plastic, 0.0);
  EXPECT_GT(simulation.energy().dissipated_contact, 0.0);
  EXPECT_GT(simulation.energy().dissipated_transfer, 0.0);
}

TEST(StuckRelease, IsReportedHungUp)
{
  Simulation simulation(
      load_scene(scene_path("release_stuck"), { "grid.cell_size_m=0.2", "geotextiles.container.segment_length_m=0.2" }),
      2);
  EXPECT_EQ(run(simulation), Advance::finished) << simulation.failure().reason;
  EXPECT_EQ(simulation.status().outcome, Outcome::hung_up);
  EXPECT_LT(simulation.status().release_time_s, 0.0);
}

TEST(Simulation, RepeatsBitForBitAfterResetAndOnAnyNumberOfThreads)
{
  const SceneDescription scene = load_scene(
      scene_path("release"), { "grid.cell_size_m=0.2", "geotextiles.container.segment_length_m=0.2", "time.end_s=14" });
  Simulation one(scene, 1), two(scene, 2), three(scene, 3);
  EXPECT_EQ(one.digest(), two.digest()) << "after settling";
  run(one);
  run(two);
  run(three);
  EXPECT_EQ(one.digest(), two.digest());
  EXPECT_EQ(one.digest(), three.digest());
  EXPECT_EQ(one.counters().steps, two.counters().steps);
  const std::uint64_t first = one.digest();
  one.reset();
  EXPECT_NE(one.digest(), first);
  run(one);
  EXPECT_EQ(one.digest(), first);
}

TEST(Simulation, SkippingRestChangesNothingThatMatters)
{
  // The container rests for the first seconds; stepping through them must not change the release by more than the rest
  // criterion lets through: 2 mm/s. The blow at landing, where sand is bonded, is left out: it goes with the last
  // grain's place, and differs by 7 % between these two.
  const std::vector<std::string> coarse = { "grid.cell_size_m=0.2", "geotextiles.container.segment_length_m=0.2",
                                            "time.end_s=22" };
  std::vector<std::string> stepped = coarse;
  stepped.emplace_back("numerics.skip_resting=false");
  Simulation skipping(load_scene(scene_path("release"), coarse), 2),
      stepping(load_scene(scene_path("release"), stepped), 2);
  const auto peak_in_hull = [](Simulation& simulation) {
    double peak = 0.0;
    run(simulation, [&](const Simulation& s) {
      if (s.status().release_time_s < 0.0)
        peak = s.status().peak_tension_n_per_m;
    });
    return peak;
  };
  const double skipped = peak_in_hull(skipping), all = peak_in_hull(stepping);
  EXPECT_GT(skipping.counters().skipped.resting_time_s, 3.0);
  EXPECT_EQ(stepping.counters().skipped.resting_time_s, 0.0);
  EXPECT_NEAR(skipping.status().release_time_s, stepping.status().release_time_s, 0.1);
  EXPECT_NEAR(skipped, all, 0.05 * all);
}

}  // namespace
}  // namespace geocontainer_mpm::scene
