/// Containers: fill that slips in its geotextile, containers that touch, and bodies that start late.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "geocontainer_mpm/error.h"
#include "physics_fixture.h"

namespace geocontainer_mpm::scene {
namespace {

const std::vector<double>& column(const Simulation& simulation, const std::string& probe, const std::string& name)
{
  for (const ProbeFrame& series : simulation.probes())
    if (series.name == probe)
      for (const ProbeFrame::Column& one : series.columns)
        if (one.name == name)
          return one.values;
  throw std::runtime_error(probe + "." + name);
}

/// Furthest that a point is on the inner side of a closed sheet laid against the clock, m; negative: all are outside.
double deepest_inside(const std::vector<Vec2>& points, const std::vector<Vec2>& sheet)
{
  double deepest = -1e9;
  for (const Vec2& x : points) {
    double nearest = 1e9, depth = 0.0;
    for (std::size_t i = 0; i < sheet.size(); ++i) {
      const Vec2 a = sheet[i], along = sheet[(i + 1) % sheet.size()] - a;
      const Vec2 apart = x - a - std::clamp((x - a).dot(along) / along.squaredNorm(), 0.0, 1.0) * along;
      if (apart.norm() < nearest) {
        nearest = apart.norm();
        depth = along[0] * apart[1] - along[1] * apart[0] >= 0.0 ? nearest : -nearest;
      }
    }
    deepest = std::max(deepest, depth);
  }
  return deepest;
}

/// Furthest that a particle of the fill has come out of its sheet, m; negative: none.
double furthest_out(const std::vector<Vec2>& particles, const std::vector<Vec2>& sheet)
{
  double furthest = -1e9;
  for (const Vec2& x : particles)
    furthest = std::max(furthest, -deepest_inside({ x }, sheet));
  return furthest;
}

/// A block of rubber, 1 m x 0.4 m, in a loose sheet of next to no mass, on a slope that the sheet cannot slide on:
/// gravity is turned by 35 degrees instead of the slope.
std::string block_in_sheet(double friction)
{
  return fmt::format(R"(
name: block
gravity_m_per_s2: [{}, {}]
time: {{ end_s: 0.4, output_interval_s: 0.1, probe_interval_s: 0.01 }}
grid: {{ cell_size_m: 0.1, lower_m: [-1, -0.5], upper_m: [4, 1.5], faces: {{ y_min: free, y_max: free, z_min: free, z_max: free }} }}
materials:
  rubber: {{ law: linear_elastic, density_kg_per_m3: 1000, young_modulus_pa: 1.0e6, poisson_ratio: 0.2, stiffness_damping_s: 1.0e-3 }}
bodies:
  block:
    material: rubber
    shape: {{ box: {{ lower_m: [0, 0], upper_m: [1, 0.4] }} }}
geotextiles:
  sheet:
    encloses: block
    slack: 4
    stiffness_n_per_m: 1.0e4
    mass_kg_per_m2: 0.05
    computational_mass_kg_per_m2: 0.5
    strength_n_per_m: 1.0e5
    segment_length_m: 0.1
    interface: frictional
    interface_friction: {}
surfaces:
  slope: {{ line_m: [[-1, 0], [4, 0]], friction: 2 }}
probes:
  block: {{ body: block }}
  slope: {{ surface: slope }}
)",
                     gravity * std::sin(35.0 * degrees), -gravity * std::cos(35.0 * degrees), friction);
}

TEST(Interface, ABlockSlidesInItsSheetByCoulombsLaw)
{
  for (const double friction : { 0.0, 0.3 }) {
    Simulation simulation(parse_scene(block_in_sheet(friction), "block"), 1);
    ASSERT_EQ(run(simulation), Advance::finished) << simulation.failure().reason;
    // Once the sheet's front has come to lie under the block, and before its slack there is used up. What goes along of
    // the sheet weighs up to 1 % of the block.
    const std::vector<double>& velocity = column(simulation, "block", "velocity_y_m_per_s");
    const double acceleration = (velocity[40] - velocity[20]) / 0.2;
    const double expected = gravity * (std::sin(35.0 * degrees) - friction * std::cos(35.0 * degrees));
    EXPECT_NEAR(acceleration, expected, 0.02 * expected) << friction;
    // Pulled out from under the block, the sheet hands on what friction allows and no more.
    double along = 0.0, across = 0.0;
    for (std::size_t i = 20; i <= 40; ++i) {
      along += column(simulation, "slope", "force_y_n_per_m")[i];
      across += column(simulation, "slope", "force_z_n_per_m")[i];
    }
    EXPECT_NEAR(std::abs(along / across), friction, 0.01);
  }
}

TEST(Interface, AFluidStretchesAFrictionlessSheetToTensionOverRadius)
{
  // The sheet is laid with a tension that the fluid does not yet carry, and shrinks until T = p R.
  Simulation simulation(parse_scene(R"(
name: drop
gravity_m_per_s2: [0, 0]
time: { end_s: 0.5, output_interval_s: 0.5 }
grid: { cell_size_m: 0.2, lower_m: [-1.6, -1.6], upper_m: [1.6, 1.6], faces: { y_min: free, y_max: free, z_min: free, z_max: free } }
numerics: { damping_per_s: 40 }
materials:
  water: { law: newtonian, density_kg_per_m3: 1000, bulk_modulus_pa: 1.0e6, viscosity_pa_s: 1 }
bodies:
  water: { material: water, shape: { disc: { center_m: [0, 0], radius_m: 1 } }, particles_per_cell: 3 }
geotextiles:
  sheet:
    encloses: water
    pretension_n_per_m: 2.0e4
    stiffness_n_per_m: 1.0e6
    mass_kg_per_m2: 20
    computational_mass_kg_per_m2: 20
    strength_n_per_m: 1.0e5
    segment_length_m: 0.2
    interface: frictional
    interface_friction: 0
probes:
  water: { body: water }
  sheet: { geotextile: { name: sheet } }
)",
                                    "drop"),
                        1);
  ASSERT_EQ(run(simulation), Advance::finished) << simulation.failure().reason;
  const Frame frame = simulation.frame();
  double radius = 0.0;
  for (const Vec3& x : frame.geotextile[0].node)
    radius += x.norm() / static_cast<double>(frame.geotextile[0].node.size());
  double pressure = 0.0;
  std::size_t deep = 0;
  for (std::size_t p = 0; p < frame.soil[0].position.size(); ++p)
    if (frame.soil[0].position[p].norm() < 0.5) {
      pressure -= 0.5 * (frame.soil[0].stress[p][1] + frame.soil[0].stress[p][2]);
      ++deep;
    }
  pressure /= static_cast<double>(deep);
  const double tension = column(simulation, "sheet", "tension_mean_n_per_m").back();
  EXPECT_GT(tension, 1.0e4);
  // The outermost particles are pressed at their middles, half their width inside the sheet: that is the radius on
  // which the pressure stands. Sides of the sheet are 0.2 m on a radius of 1 m.
  const double half_width = 0.5 * std::sqrt(frame.soil[0].volume[0]);
  EXPECT_NEAR(tension, pressure * (radius - half_width), 0.02 * tension);
  EXPECT_LT(furthest_out(section(frame.soil[0].position), section(frame.geotextile[0].node)), 0.0);
}

TEST(Interface, MustHaveTheVelocityFieldToItself)
{
  const std::string second =
      "  other: { material: rubber, shape: { box: { lower_m: [2, 0], upper_m: [3, 1] } } }\ngeotextiles:";
  std::string text = block_in_sheet(0.3);
  text.replace(text.find("geotextiles:"), 12, second);
  EXPECT_THROW(parse_scene(text, "block"), InputError);
}

TEST(Wrinkles, MustLieOnThePath)
{
  const std::vector<std::string> beside{
    "geotextiles.sheet.wrinkles={ region: { lower_m: [2, 0], upper_m: [3, 1] }, number: 3, amplitude_m: 0.1 }"
  };
  EXPECT_THROW(Simulation(parse_scene(block_in_sheet(0.3), "block", beside), 1), InputError);
  const std::vector<std::string> bottom{
    "geotextiles.sheet.wrinkles={ region: { lower_m: [0, 0], upper_m: [1, 0] }, number: 3, amplitude_m: 0.1 }"
  };
  EXPECT_NO_THROW(Simulation(parse_scene(block_in_sheet(0.3), "block", bottom), 1));
}

TEST(LateStart, FallsFreelyFromItsInstantOn)
{
  const std::string text = R"(
name: late
gravity_m_per_s2: [0, -9.81]
time: { end_s: 0.83, output_interval_s: 0.1, probe_interval_s: 0.05 }
grid: { cell_size_m: 0.2, lower_m: [-2, -3], upper_m: [3, 3], faces: { y_min: free, y_max: free, z_min: free, z_max: free } }
materials:
  rubber: { law: linear_elastic, density_kg_per_m3: 1000, young_modulus_pa: 1.0e5, poisson_ratio: 0.2 }
bodies:
  block:
    material: rubber
    shape: { box: { lower_m: [0, 0], upper_m: [1, 1] } }
    initial_velocity_m_per_s: [0.5, 1]
    held_until_s: 0.33
geotextiles:
  sheet:
    encloses: block
    stiffness_n_per_m: 1.0e4
    mass_kg_per_m2: 5
    computational_mass_kg_per_m2: 5
    strength_n_per_m: 1.0e5
    segment_length_m: 0.2
probes:
  block: { body: block }
)";
  Simulation simulation(parse_scene(text, "late"), 1);
  ASSERT_EQ(run(simulation,
                [](const Simulation& now) {
                  if (now.time_s() < 0.33) {
                    EXPECT_EQ(now.status().centroid_m, Vec3(0.0, 0.5, 0.5));
                  }
                }),
            Advance::finished)
      << simulation.failure().reason;
  // Exact but for the scheme's own g dt t / 2, with steps of at most 0.01 s.
  EXPECT_NEAR(simulation.status().centroid_m.y(), 0.5 + 0.5 * 0.5, 1e-9);
  EXPECT_NEAR(simulation.status().centroid_m.z(), 0.5 + 1.0 * 0.5 - 0.5 * gravity * 0.25, 1e-9);
  EXPECT_LT(simulation.counters().momentum_error, 1e-12);
  // The velocity put half a step back at the start makes (g dt / 2)^2 / 2 of energy a kilogram, of some 7 J that change
  // hands, with steps of at most 0.01 s.
  EXPECT_LT(simulation.energy().relative_balance_error, 2e-4);
}

/// The second container lands on the first; coarse and short.
Simulation drop(std::vector<std::string> overrides)
{
  for (const char* more : { "grid.cell_size_m=0.2", "geotextiles.lower.segment_length_m=0.2",
                            "geotextiles.upper.segment_length_m=0.2", "time.end_s=2.5" })
    overrides.emplace_back(more);
  return { load_scene(scene_path("two_containers"), overrides), 1 };
}

void expect_apart(const Simulation& simulation)
{
  const Frame frame = simulation.frame();
  const std::vector<Vec2> lower = section(frame.geotextile[0].node), upper = section(frame.geotextile[1].node);
  EXPECT_LT(deepest_inside(upper, lower), 0.25 * 0.2) << frame.time_s;
  EXPECT_LT(deepest_inside(lower, upper), 0.25 * 0.2) << frame.time_s;
}

TEST(TwoContainers, TheSecondLandsOnTheFirstAndBothAreReported)
{
  Simulation simulation = drop({});
  ASSERT_EQ(run(simulation, expect_apart), Advance::finished) << simulation.failure().reason;
  const auto summary = nlohmann::json::parse(summary_json(simulation, 1.0, 1));
  ASSERT_EQ(summary["containers"].size(), 2U);
  EXPECT_EQ(summary["containers"][0]["name"], "lower");
  EXPECT_EQ(summary["peak_tension_n_per_m"][1], summary["containers"][1]["peak_tension_n_per_m"]);
  EXPECT_EQ(summary["container_centroid_m"].size(), 2U);
  const auto& impact = summary["containers"][0]["episodes"][0];
  EXPECT_EQ(impact["started"], "upper_sand");
  EXPECT_GT(impact["peak_tension_n_per_m"], 2.0 * impact["tension_before_n_per_m"].get<double>());
  // It starts at 1 s and falls 1.5 m less what the lower one has settled: 0.55 s.
  EXPECT_GT(impact["peak_tension_time_s"], 1.55);
  EXPECT_GT(summary["containers"][1]["container_centroid_m"][1], summary["containers"][0]["container_centroid_m"][1]);
  EXPECT_LT(simulation.energy().relative_balance_error, 0.03);
}

TEST(TwoContainers, FillMaySlipInBoth)
{
  Simulation simulation =
      drop({ "geotextiles.lower.interface=frictional", "geotextiles.lower.interface_friction=0.5",
             "geotextiles.upper.interface=frictional", "geotextiles.upper.interface_friction=0.5", "time.end_s=2" });
  ASSERT_EQ(run(simulation,
                [](const Simulation& now) {
                  expect_apart(now);
                  const Frame frame = now.frame();
                  if (frame.time_s < 1.2)  // as laid, sides of the sheet that is held cut the corners of its fill
                    return;
                  for (std::size_t c = 0; c < 2; ++c)
                    EXPECT_LT(furthest_out(section(frame.soil[c].position), section(frame.geotextile[c].node)), 0.0)
                        << frame.time_s;
                }),
            Advance::finished)
      << simulation.failure().reason;
  EXPECT_LT(simulation.energy().relative_balance_error, 0.03);
}

}  // namespace
}  // namespace geocontainer_mpm::scene
