/// The hand rules: the numbers of the source's worked example, closed forms, limits, and what the summary makes of
/// them.

#include "geocontainer_mpm/scene/design_rules.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "geocontainer_mpm/scene/doubts.h"
#include "geocontainer_mpm/scene/simulation.h"

namespace geocontainer_mpm::scene {
namespace {

const std::string release = std::string(GEOCONTAINER_MPM_SOURCE_DIR) + "/config/scenes/release.yaml";

/// Worked example of CUR 217: sand of porosity 0.40, saturated, in fresh water.
ContainerData example()
{
  ContainerData container;
  container.fill_area_m2 = 10.8;
  container.circumference_m = 18.3;
  container.density_kg_per_m3 = 1990.0;
  container.slot_width_m = 3.0;
  container.gravity_m_per_s2 = 9.81;
  container.water = { 1000.0, 1.0, false };
  return container;
}

const DesignRule& rule(const std::vector<DesignRule>& rules, const std::string& name)
{
  for (const DesignRule& one : rules)
    if (one.name == name)
      return one;
  throw std::out_of_range(name);
}

TEST(DesignRules, GiveTheNumbersOfTheWorkedExample)
{
  const std::vector<DesignRule> rules = design_rules(example());
  // As printed there, to the digits printed.
  EXPECT_NEAR(*rule(rules, "circumference_needed").value, 16.50, 0.005);
  EXPECT_NEAR(*rule(rules, "tension_opening").value, 47.2e3, 50.0);
  EXPECT_NEAR(terminal_velocity_m_per_s(320.0 / 100.0, 1990.0, 9.81, { 1000.0, 1.0, false }), 7.9, 0.05);
}

TEST(DesignRules, AgreeWithClosedForms)
{
  const std::vector<DesignRule> rules = design_rules(example());
  EXPECT_DOUBLE_EQ(*rule(rules, "circumference_of_rectangle").value, 2.0 * (3.0 + 3.6));
  const double submerged_n_per_m = 990.0 * 9.81 * 10.8;
  EXPECT_DOUBLE_EQ(*rule(rules, "tension_hanging").value, 0.5 * submerged_n_per_m);
  const double velocity = *rule(rules, "terminal_velocity").value, width = std::sqrt(10.8);
  EXPECT_NEAR(0.5 * 1000.0 * velocity * velocity * width, submerged_n_per_m, 1e-9 * submerged_n_per_m)
      << "drag carries the submerged weight";

  ContainerData dry = example();
  dry.water = DesignWater();
  dry.sheet_mass_kg_per_m2 = 0.84;
  EXPECT_DOUBLE_EQ(*rule(design_rules(dry), "tension_hanging").value, 0.5 * (1990.0 * 10.8 + 0.84 * 18.3) * 9.81)
      << "a scene without water: the full weight, sheet included";
}

TEST(DesignRules, SlotAndCircumferenceAreEachOthersInverse)
{
  for (const double area : { 2.0, 10.8, 25.0 })
    for (const double part : { 0.1, 0.5, 0.9 }) {
      const double slot = part * std::sqrt(area);
      const double needed = circumference_for_slot_m(2.5, area, slot);
      const std::optional<double> back = slot_for_circumference_m(2.5, area, needed);
      ASSERT_TRUE(back);
      EXPECT_NEAR(*back, slot, 1e-12 * area);
    }
}

TEST(DesignRules, HaveNoAnswerWhereThereIsNone)
{
  EXPECT_FALSE(slot_for_circumference_m(2.5, 10.8, 16.0)) << "5 sqrt(A) = 16.4 m is the least";
  EXPECT_DOUBLE_EQ(circumference_for_slot_m(2.0, 9.0, 50.0), 12.0) << "a wider slot than the square asks for no more";
  ContainerData closed = example();
  closed.slot_width_m = 0.0;
  EXPECT_FALSE(rule(design_rules(closed), "circumference_needed").value);
  ContainerData floating = example();
  floating.density_kg_per_m3 = 900.0;
  EXPECT_FALSE(rule(design_rules(floating), "terminal_velocity").value);
}

TEST(DesignRules, TakeTheirDataFromTheScene)
{
  const std::vector<ContainerData> containers = container_data(load_scene(release), 3.0);
  ASSERT_EQ(containers.size(), 1u);
  EXPECT_EQ(containers[0].name, "container");
  EXPECT_NEAR(containers[0].fill_area_m2, 10.8, 1e-9);
  EXPECT_DOUBLE_EQ(containers[0].circumference_m, 18.3);
  EXPECT_DOUBLE_EQ(containers[0].density_kg_per_m3, 1990.0);
  EXPECT_DOUBLE_EQ(containers[0].gravity_m_per_s2, 9.81);
  const std::string block = std::string(GEOCONTAINER_MPM_SOURCE_DIR) + "/config/scenes/block_on_incline.yaml";
  EXPECT_TRUE(container_data(load_scene(block), 0.0).empty());
}

TEST(DesignRules, StandInTheSummaryBesideWhatIsComputed)
{
  const SceneDescription scene =
      load_scene(release, { "grid.cell_size_m=0.4", "grid.upper_m=[6, 0.8]", "grid.lower_m=[-6, -10]",
                            "geotextiles.container.segment_length_m=0.4", "time.end_s=0.1",
                            "hull.opening_table=[[0, 0, 0], [0.05, 0.365, 0.365], [60, 0.365, 0.365]]" });
  Simulation simulation(scene, 1);
  simulation.use_scene_opening();
  for (Advance result = Advance::stepped; result != Advance::finished; result = simulation.advance())
    ASSERT_NE(result, Advance::stopped) << simulation.failure().reason;
  const nlohmann::json summary = nlohmann::json::parse(summary_json(simulation, 1.0, 1));
  const nlohmann::json& rules = summary.at("design_rules").at(0).at("rules");
  for (const char* name : { "circumference_needed", "circumference_of_rectangle", "slot_needed", "tension_opening",
                            "tension_hanging", "terminal_velocity" }) {
    EXPECT_TRUE(rules.at(name).at("value").is_number()) << name;
    for (const char* key : { "unit", "rule", "source" })
      EXPECT_FALSE(rules.at(name).at(key).get<std::string>().empty()) << name << " " << key;
    EXPECT_FALSE(rules.at(name).at("inputs").empty()) << name;
  }
  // The hull stands open: twice the way of the lips' upper corners, 3.9 m below the hinge.
  EXPECT_NEAR(rules.at("circumference_needed").at("inputs").at("b0").at("value").get<double>(),
              2.0 * 3.9 * std::sin(0.365), 1e-9);
  EXPECT_EQ(rules.at("circumference_needed").at("beside").at("value"), 18.3);
  EXPECT_EQ(rules.at("tension_opening").at("inputs").at("rho_w").at("assumed"), true);
  EXPECT_TRUE(rules.at("terminal_velocity").at("beside").is_null());
}

TEST(Summary, FlagsARunThatLosesVolume)
{
  // A soft column let go into its weight: half a period later (2 L / c = 0.14 s) it is shorter by rho g L / E = 5 %.
  const std::string yaml = R"(
name: soft
time: { end_s: 0.14 }
grid: { cell_size_m: 0.25, lower_m: [0, 0], upper_m: [1, 2], faces: { y_min: roller, y_max: roller, z_min: roller, z_max: free } }
materials: { jelly: { law: linear_elastic, density_kg_per_m3: 1000, young_modulus_pa: 2.0e5, poisson_ratio: 0 } }
bodies: { block: { material: jelly, shape: { box: { lower_m: [0, 0], upper_m: [1, 1] } } } }
)";
  Simulation simulation(parse_scene(yaml, "soft.yaml"), 1);
  simulation.use_scene_opening();
  EXPECT_TRUE(nlohmann::json::parse(summary_json(simulation, 1.0, 1)).at("flags").empty()) << "before anything moved";
  for (Advance result = Advance::stepped; result != Advance::finished; result = simulation.advance())
    ASSERT_NE(result, Advance::stopped) << simulation.failure().reason;
  const nlohmann::json flags = nlohmann::json::parse(summary_json(simulation, 1.0, 1)).at("flags");
  ASSERT_EQ(flags.size(), 1u) << flags;
  EXPECT_NE(flags[0].get<std::string>().find("volume"), std::string::npos) << flags;
}

TEST(Summary, FlagsASheetThatHoldsMoreAtRestThanWeightCanGive)
{
  EnergyFrame energy;
  StatusFrame status;
  status.outcome = Outcome::released;
  status.soil_volume = status.soil_volume_initial = 10.8;
  const double weight = weight_in_air_n_per_m(load_scene(release));
  EXPECT_NEAR(weight, 9.81 * (1990.0 * 10.8 + 0.84 * 18.3), 1e-9 * weight);
  // A tube of fluid of this weight, as high as wide: gamma h^2 / 4.
  status.current_tension_n_per_m = 0.25 * weight;
  EXPECT_TRUE(doubts(status, energy, weight).empty());
  status.current_tension_n_per_m = 0.51 * weight;
  ASSERT_EQ(doubts(status, energy, weight).size(), 1u);
  EXPECT_NE(doubts(status, energy, weight)[0].find("108 kN/m at rest"), std::string::npos)
      << doubts(status, energy, weight)[0];
  status.outcome = Outcome::hung_up;
  EXPECT_EQ(doubts(status, energy, weight).size(), 1u);
  energy.kinetic = 1.1e-3 * weight;
  EXPECT_TRUE(doubts(status, energy, weight).empty()) << "what moves may pull harder";
  energy.kinetic = 0.0;
  status.outcome = Outcome::waiting;
  EXPECT_TRUE(doubts(status, energy, weight).empty()) << "laid in taut";
}

TEST(Summary, FlagsContactThatGivesEnergy)
{
  EnergyFrame energy;
  energy.dissipated_plastic = 5.0e5;
  energy.dissipated_contact = -1.0e4;  // penetration that is worked off
  EXPECT_TRUE(doubts({}, energy, 1e5).empty());
  energy.dissipated_contact = -5.0e4;
  ASSERT_EQ(doubts({}, energy, 1e5).size(), 1u);
  EXPECT_NE(doubts({}, energy, 1e5)[0].find("50 kJ/m"), std::string::npos) << doubts({}, energy, 1e5)[0];
}

}  // namespace
}  // namespace geocontainer_mpm::scene
