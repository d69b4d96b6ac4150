/// What holds and drives a body: supports, tractions, gravity over time, and the probes that measure it.

#include <fmt/format.h>

#include "physics_fixture.h"

namespace geocontainer_mpm::scene {
namespace {

std::string bar(const std::string& faces, const std::string& more)
{
  return fmt::format(R"(
name: bar
gravity_m_per_s2: [0, 0]
grid: {{ cell_size_m: 0.05, lower_m: [-0.2, 0], upper_m: [1.4, 0.1], faces: {{ y_min: free, y_max: free, {} }} }}
materials:
  rubber: {{ law: linear_elastic, density_kg_per_m3: 1000, young_modulus_pa: 1.0e5, poisson_ratio: 0 }}
{})",
                     faces, more);
}

const ProbeFrame& probe(const Simulation& simulation, const std::string& name)
{
  for (const ProbeFrame& series : simulation.probes())
    if (series.name == name)
      return series;
  throw std::runtime_error(name);
}

const std::vector<double>& column(const ProbeFrame& series, const std::string& name)
{
  for (const ProbeFrame::Column& one : series.columns)
    if (one.name == name)
      return one.values;
  throw std::runtime_error(name);
}

/// Period of a bar held by a support at its left end and free at its right, from the centroid's velocity.
double period(const std::string& update, const std::string& transfer)
{
  Simulation simulation(parse_scene(bar("z_min: roller, z_max: roller", R"(
time: { end_s: 0.6, output_interval_s: 0.1, probe_interval_s: 0.001 }
bodies:
  bar:
    material: rubber
    shape: { box: { lower_m: [0, 0], upper_m: [1, 0.1] } }
    initial_velocity_wave: { amplitude_m_per_s: [0.05, 0], wave_number_rad_per_m: [1.5707963267948966, 0] }
supports:
  left: { region: { lower_m: [-0.2, 0], upper_m: [0, 0.1] } }
probes:
  bar: { body: bar }
)"),
                                    "bar", { "numerics.update=" + update, "numerics.transfer=" + transfer }),
                        1);
  EXPECT_EQ(run(simulation), Advance::finished) << simulation.failure().reason;
  const ProbeFrame& series = probe(simulation, "bar");
  const std::vector<double>& velocity = column(series, "velocity_y_m_per_s");
  std::vector<double> crossings;
  for (std::size_t i = 1; i < velocity.size(); ++i)
    if (velocity[i - 1] * velocity[i] < 0.0)
      crossings.push_back(series.time_s[i - 1] + (series.time_s[i] - series.time_s[i - 1]) * velocity[i - 1] /
                                                     (velocity[i - 1] - velocity[i]));
  EXPECT_GE(crossings.size(), 2U);
  return crossings.size() < 2 ? 0.0 : 2.0 * (crossings[1] - crossings[0]);
}

TEST(Support, HoldsTheEndOfAVibratingBar)
{
  // A quarter wave in 1 m at c = sqrt(E / rho) = 10 m/s: 0.4 s. Held nodes stand for a face to half a cell's strain, of
  // 20 cells: 2 %.
  for (const char* update : { "usl", "usf", "musl" })
    for (const char* transfer : { "apic", "flip" })
      EXPECT_NEAR(period(update, transfer), 0.4, 0.02 * 0.4) << update << ", " << transfer;
}

TEST(Support, CarriesABodyAlongAndBooksItsWork)
{
  // Every node that the body reaches moves at 0.5 m/s from the first step on: half of the work becomes kinetic energy,
  // half is lost in the jerk.
  Simulation simulation(parse_scene(bar("z_min: free, z_max: free", R"(
time: { end_s: 0.2, output_interval_s: 0.1 }
bodies:
  block: { material: rubber, shape: { box: { lower_m: [0.2, 0.025], upper_m: [0.4, 0.075] } } }
supports:
  all: { region: { lower_m: [-0.2, -0.1], upper_m: [1.4, 0.2] }, velocity_table: [[0, 0.5, 0]] }
)"),
                                    "bar", {}),
                        1);
  const double y = simulation.status().centroid_m.y();
  ASSERT_EQ(run(simulation), Advance::finished);
  EXPECT_NEAR(simulation.status().centroid_m.y() - y, 0.1, 1e-12);
  const EnergyFrame energy = simulation.energy();
  const double mass = 1000 * 0.2 * 0.05;
  EXPECT_NEAR(energy.kinetic, 0.5 * mass * 0.25, 1e-12 * mass);
  EXPECT_NEAR(energy.work_in, mass * 0.25, 1e-10 * mass);
  EXPECT_LT(energy.relative_balance_error, 1e-10);
}

TEST(Traction, PullsThroughEverySectionAndBalancesAtTheSupport)
{
  // 1 kPa on the right end, at rest after damping: N = sigma A = 100 N/m in every section, and u = sigma x / E.
  Simulation simulation(parse_scene(bar("z_min: roller, z_max: roller", R"(
time: { end_s: 4, output_interval_s: 1 }
numerics: { damping_per_s: 10 }
bodies:
  bar: { material: rubber, shape: { box: { lower_m: [0, 0], upper_m: [1, 0.1] } } }
supports:
  left: { region: { lower_m: [-0.2, 0], upper_m: [0, 0.1] } }
tractions:
  right: { body: bar, region: { lower_m: [0.99, -1], upper_m: [1.01, 1] }, traction_pa: [1000, 0] }
probes:
  cut: { section: { from_m: [0.5, 0.2], to_m: [0.5, -0.1] } }
  end: { point: { body: bar, at_m: [1, 0.05] } }
)"),
                                    "bar", {}),
                        1);
  ASSERT_EQ(run(simulation), Advance::finished);
  // Walking down, what is on the right of the cut lies towards -y: it pulls the other part back.
  EXPECT_NEAR(column(probe(simulation, "cut"), "force_y_n_per_m").back(), -100.0, 1.0);
  EXPECT_NEAR(column(probe(simulation, "cut"), "force_z_n_per_m").back(), 0.0, 0.1);
  // 1 % strain; the linear law in the present configuration and the held nodes' half cell make the 2 %.
  EXPECT_NEAR(column(probe(simulation, "end"), "displacement_y_m").back(), 0.01, 0.02 * 0.01);
}

TEST(Gravity, FollowsItsTableAndItsWorkIsBooked)
{
  // From 0 to g in 0.4 s: v = g t^2 / 0.8.
  Simulation simulation(parse_scene(R"(
name: fall
gravity_table: [[0, 0, 0], [0.4, 0, -9.81]]
time: { end_s: 0.4, output_interval_s: 0.1 }
grid: { cell_size_m: 0.1, lower_m: [0, -1], upper_m: [1, 1], faces: { y_min: free, y_max: free, z_min: free, z_max: free } }
materials:
  block: { law: linear_elastic, density_kg_per_m3: 1000, young_modulus_pa: 1.0e5, poisson_ratio: 0.3 }
bodies:
  block: { material: block, shape: { box: { lower_m: [0.3, 0.4], upper_m: [0.7, 0.6] } } }
)",
                                    "fall", {}),
                        1);
  const double z = simulation.status().centroid_m.z();
  ASSERT_EQ(run(simulation), Advance::finished);
  const double mass = 1000 * 0.08, speed = gravity * 0.4 * 0.4 / 0.8;
  // The leapfrog takes the table at the steps' instants: its end is half a step's kick short.
  EXPECT_NEAR(simulation.status().centroid_m.z() - z, -gravity * 0.4 * 0.4 * 0.4 / 2.4, 1e-3);
  EXPECT_NEAR(simulation.energy().work_in, 0.5 * mass * speed * speed, 0.06 * 0.5 * mass * speed * speed);
  EXPECT_LT(simulation.energy().relative_balance_error, 1e-9);
  EXPECT_EQ(simulation.energy().potential, 0.0);
}

TEST(Bodies, JitterMovesParticlesWithinTheirPlaces)
{
  const std::string text = bar("z_min: roller, z_max: roller", R"(
time: { end_s: 0.1 }
bodies:
  bar: { material: rubber, shape: { box: { lower_m: [0, 0], upper_m: [1, 0.1] } } }
)");
  const auto places = [&](const std::string& jitter) {
    Simulation simulation(parse_scene(text, "bar", { "bodies.bar.jitter=" + jitter }), 1);
    return section(simulation.frame().soil.front().position);
  };
  const std::vector<Vec2> lattice = places("0"), moved = places("0.4");
  EXPECT_EQ(moved, places("0.4"));
  double furthest = 0.0;
  Vec2 mean = Vec2::Zero();
  for (std::size_t p = 0; p < lattice.size(); ++p) {
    const Vec2 offset = moved[p] - lattice[p];
    furthest = std::max(furthest, offset.cwiseAbs().maxCoeff());
    mean += offset / static_cast<double>(lattice.size());
  }
  EXPECT_LE(furthest, 0.4 * 0.025);
  EXPECT_GE(furthest, 0.9 * 0.4 * 0.025);  // of 160 particles
  EXPECT_LE(mean.norm(), 0.1 * 0.4 * 0.025 * 2.0);
}

}  // namespace
}  // namespace geocontainer_mpm::scene
