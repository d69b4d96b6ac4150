// Every key of the grammar: it can be read, written, and overridden. Which keys there are is read from the reference
// page, so that a new one is tried as well.

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <set>
#include <sstream>

#include "description_fixture.h"
#include "geocontainer_mpm/scene/description.h"

namespace geocontainer_mpm::scene {
namespace {

std::string joined(const std::string& path, const std::string& name)
{
  return path.empty() ? name : path + "." + name;
}

/// What the reference page says: dotted keys with `<name>` for names, values and maps of sections by name apart.
struct Grammar {
  std::set<std::string> values, maps;

  Grammar()
  {
    std::istringstream page(scene_reference());
    std::string line, path;
    while (std::getline(page, line)) {
      if (line.compare(0, 4, "## `") == 0)
        path = line.substr(4, line.rfind('`') - 4);
      if (line.compare(0, 3, "| `") != 0)
        continue;
      const std::string key = joined(path, line.substr(3, line.find('`', 3) - 3));
      if (line.find("| sections by name |") != std::string::npos)
        maps.insert(key);
      else if (line.find("| section |") == std::string::npos)
        values.insert(key);
    }
  }
};

/// A value of a scene: its dotted key, the same with `<name>` for names, and its text.
struct Leaf {
  std::string key, pattern, text;
};

void collect(const YAML::Node& node, const std::string& key, const std::string& pattern, const Grammar& grammar,
             std::vector<Leaf>& leaves)
{
  if (!node.IsMap()) {
    YAML::Emitter text;
    text << YAML::Flow << node;
    leaves.push_back({ key, pattern, text.c_str() });
    return;
  }
  const bool named = grammar.maps.count(pattern) > 0;
  for (const auto& entry : node) {
    const std::string& name = entry.first.Scalar();
    collect(entry.second, joined(key, name), joined(pattern, named ? "<name>" : name), grammar, leaves);
  }
}

std::vector<Leaf> leaves_of(const std::string& scene)
{
  std::vector<Leaf> leaves;
  collect(YAML::Load(scene), "", "", Grammar(), leaves);
  return leaves;
}

TEST(DescriptionKey, EveryOneIsTried)
{
  std::set<std::string> tried{ "gravity_table", "water.level_m" };  // exclude gravity_m_per_s2 and water.draught_m
  for (const std::string& scene : { full_scene, wet_scene, solid_scene })
    for (const Leaf& leaf : leaves_of(scene))
      tried.insert(leaf.pattern);
  const Grammar grammar;
  EXPECT_GT(grammar.values.size(), 100u);
  // Both ends of a sheet are the same struct; the one is held, the other is not.
  for (const std::string& key : grammar.values) {
    const bool other_end = key.find(".end.motion_table") != std::string::npos;
    EXPECT_TRUE(other_end || key.find(".start.force_") != std::string::npos || tried.count(key) == 1)
        << key << " is missing in full_scene, wet_scene and solid_scene";
  }
}

/// Scenes that hold every key.
class DescriptionKeys : public testing::TestWithParam<const std::string*> {};

INSTANTIATE_TEST_SUITE_P(Scenes, DescriptionKeys, testing::Values(&full_scene, &wet_scene, &solid_scene));

TEST_P(DescriptionKeys, AreWrittenAndReadBack)
{
  const SceneDescription scene = parse_scene(*GetParam(), "full.yaml");
  const std::string text = scene_text(scene);
  EXPECT_EQ(scene_text(parse_scene(text, "written.yaml")), text);
  std::set<std::string> written;
  for (const Leaf& leaf : leaves_of(text))
    written.insert(leaf.key);
  for (const Leaf& leaf : leaves_of(*GetParam()))
    EXPECT_EQ(written.count(leaf.key), 1u) << leaf.key;
}

TEST_P(DescriptionKeys, TakeAnOverride)
{
  std::vector<std::string> same;
  for (const Leaf& leaf : leaves_of(*GetParam())) {
    SCOPED_TRACE(leaf.key);
    try {
      parse_scene(*GetParam(), "full.yaml", { leaf.key + "={ a: map }" });
      ADD_FAILURE() << "a map was accepted as a value";
    } catch (const InputError& error) {
      EXPECT_EQ(error.key(), leaf.key);
      EXPECT_EQ(error.source(), "full.yaml --set");
    }
    same.push_back(leaf.key + "=" + leaf.text);
  }
  EXPECT_EQ(scene_text(parse_scene(*GetParam(), "full.yaml", same)), scene_text(parse_scene(*GetParam(), "full.yaml")));
}

TEST(DescriptionKey, OverrideReachesTablesListsAndOptionalValues)
{
  const SceneDescription scene = parse_scene(
      full_scene, "full.yaml",
      { "numerics.update=usf", "time.probe_interval_s=0.01", "geotextiles.cable.slack=0.1",
        "geotextiles.cable.start.motion_table=[[0, 0, 0], [0.25, 1, 2]]", "surfaces.bed.motion.table=[[0, 1, 2, 3]]",
        "tractions.load.table=[]", "contacts.dry.between=[common, cable]", "probes.pull.geotextile.at_m=[0.5, -5]",
        "probes.mean={ body: wedge }", "bodies.drop.velocity_field=fluid" });
  EXPECT_EQ(scene.numerics.method.update, mpm::UpdateOrder::usf);
  EXPECT_EQ(scene.time.probe_interval_s, 0.01);
  EXPECT_EQ(scene.geotextiles.at("cable").slack, 0.1);
  const TimeTable<2>& motion = scene.geotextiles.at("cable").start.motion_table;
  ASSERT_EQ(motion.size(), 2u);
  EXPECT_EQ(motion[1].time_s, 0.25);
  EXPECT_EQ(motion[1].value, (std::array<double, 2>{ 1.0, 2.0 }));
  EXPECT_EQ(scene.surfaces.at("bed").motion->table.at(0).value, (std::array<double, 3>{ 1.0, 2.0, 3.0 }));
  EXPECT_TRUE(scene.tractions.at("load").table.empty());
  EXPECT_EQ(scene.contacts.at("dry").between, (std::vector<std::string>{ "common", "cable" }));
  EXPECT_EQ(scene.probes.at("pull").geotextile->at_m, Vec2(0.5, -5.0));
  EXPECT_EQ(scene.probes.at("mean").body, "wedge");
}

TEST(DescriptionKey, OverrideInASectionThatIsNotThereAsksForTheWholeSection)
{
  try {
    parse_scene(full_scene, "full.yaml", { "geotextiles.cable.inside_pressure.pressure_pa=3" });
    FAIL() << "accepted";
  } catch (const InputError& error) {
    expect_error(error, "full.yaml --set", "geotextiles.cable.inside_pressure.pressure_pa", "3",
                 "the scene has no geotextiles.cable.inside_pressure; give the whole section");
  }
}

TEST(DescriptionKey, WritesOptionalOnesOnlyWhenGiven)
{
  const std::string text = scene_text(parse_scene(small_scene, "small.yaml"));
  for (const char* absent : { "probe_interval_s", "flip_fraction", "slack", "pretension_n_per_m", "start", "end:",
                              "inside_pressure", "velocity_field", "motion", "region", "manufactured", "line:" })
    EXPECT_EQ(text.find(absent), std::string::npos) << absent;
}

TEST(DescriptionKey, KeepsTheBitsOfTablesAndOptionalNumbers)
{
  const std::string odd = "0.30000000000000004", tiny = "5e-324", third = "0.3333333333333333";
  const SceneDescription scene =
      parse_scene(full_scene, "full.yaml",
                  { "tractions.load.table=[[" + tiny + ", " + third + "], [" + third + ", " + odd + "]]",
                    "geotextiles.cable.slack=" + odd, "probes.pull.geotextile.at_m=[" + third + ", -" + third + "]" });
  const SceneDescription again = parse_scene(scene_text(scene), "written.yaml");
  const TimeTable<1>& table = again.tractions.at("load").table;
  EXPECT_EQ(table.at(0).time_s, 5e-324);
  EXPECT_EQ(table.at(0).value[0], 1.0 / 3.0);
  EXPECT_EQ(table.at(1).value[0], 0.1 + 0.2);
  EXPECT_EQ(again.geotextiles.at("cable").slack, 0.1 + 0.2);
  EXPECT_EQ(again.probes.at("pull").geotextile->at_m, Vec2(1.0 / 3.0, -1.0 / 3.0));
}

TEST(DescriptionKey, GravityIsATableOrAVector)
{
  const SceneDescription ramped = parse_scene(small_scene + "gravity_table: [[0, 0, 0], [2, 1, -10]]\n", "ramp.yaml",
                                              { "bodies.fill.initial_stress=none" });
  EXPECT_EQ(ramped.gravity_at(-1.0), Vec2(0.0, 0.0));
  EXPECT_EQ(ramped.gravity_at(0.5), Vec2(0.25, -2.5));
  EXPECT_EQ(ramped.gravity_at(3.0), Vec2(1.0, -10.0));
  EXPECT_EQ(parse_scene(scene_text(ramped), "written.yaml").gravity_at(1.0), Vec2(0.5, -5.0));
  EXPECT_EQ(parse_scene(small_scene, "small.yaml").gravity_at(1.0), Vec2(0.0, -9.81));
}

TEST(DescriptionKey, VelocityFieldsAreThoseOfBodiesAndFreeSheets)
{
  const SceneDescription scene = parse_scene(full_scene, "full.yaml");
  EXPECT_EQ(scene.velocity_fields(), (std::vector<std::string>{ "cable", "common", "fluid" }));
}

TEST(DescriptionKey, ASceneMayHoldASheetAlone)
{
  const std::string cable = R"(name: cable
time: { end_s: 1 }
grid: { cell_size_m: 0.1, lower_m: [0, 0], upper_m: [2, 2], faces: { y_min: free, y_max: free, z_min: free, z_max: free } }
geotextiles:
  cable:
    line: { points_m: [[0.5, 1], [1.5, 1]] }
    start: { held: true }
    end: { held: true }
    stiffness_n_per_m: 1.0e5
    mass_kg_per_m2: 0.5
    computational_mass_kg_per_m2: 0.5
    strength_n_per_m: 100e3
    segment_length_m: 0.1
)";
  const SceneDescription scene = parse_scene(cable, "cable.yaml");
  EXPECT_TRUE(scene.bodies.empty());
  EXPECT_TRUE(scene.geotextiles.at("cable").end.held);
  EXPECT_EQ(scene.velocity_fields(), std::vector<std::string>{ "common" });
  EXPECT_EQ(scene_text(parse_scene(scene_text(scene), "written.yaml")), scene_text(scene));
}

}  // namespace
}  // namespace geocontainer_mpm::scene
