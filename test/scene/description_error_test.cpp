// Bad scenes: one clear line that names file, key, value and what is allowed.

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>

#include "description_fixture.h"
#include "geocontainer_mpm/error.h"
#include "geocontainer_mpm/scene/description.h"

namespace geocontainer_mpm::scene {
namespace {

/// One change of the small scene and the error that it must end in; texts are parts of the error's fields.
struct Bad {
  const char* what;
  std::string from, to;  ///< replaced in the text; `from` empty: appended
  std::string source, key, value, allowed;
};

void PrintTo(const Bad& bad, std::ostream* out)
{
  *out << bad.what;
}

class BadScene : public testing::TestWithParam<Bad> {};

TEST_P(BadScene, IsRefusedInOneClearLine)
{
  const Bad& bad = GetParam();
  try {
    parse_scene(changed(small_scene, bad.from, bad.to), "bad.yaml");
    FAIL() << "accepted";
  } catch (const InputError& error) {
    expect_error(error, bad.source, bad.key, bad.value, bad.allowed);
  }
}

const Bad bad_keys[] = {
  { "misspelt", "young_modulus_pa: 3.0e6", "young_modulus_Pa: 3.0e6", "bad.yaml:13", "materials.sand.young_modulus_Pa",
    "3.0e6", "unknown key; did you mean young_modulus_pa?" },
  { "without its unit", "end_s: 2", "end: 2", "bad.yaml:3", "time.end", "2", "did you mean end_s?" },
  { "unknown section", "", "tide:\n  level_m: 0\n", "bad.yaml:65", "tide", "a map of keys", "allowed: name" },
  { "unknown, nothing near", "end_s: 2", "end_s: 2\n  qqq: 1", "bad.yaml:4", "time.qqq", "1",
    "allowed: end_s, output_interval_s" },
  { "missing", "    poisson_ratio: 0.3\n", "", "bad.yaml:10", "materials.sand.poisson_ratio", "",
    "missing; must be a number in [0, 0.49]" },
  { "missing section", "time:\n  end_s: 2\n", "", "bad.yaml", "time", "", "missing; must be a section with keys" },
  { "missing face", "y_max: roller, ", "", "bad.yaml:8", "grid.faces.y_max", "", "one of free, roller, fixed" },
  { "missing for this law only", "    friction_angle_deg: 33\n", "", "bad.yaml:10", "materials.sand.friction_angle_deg",
    "", "missing" },
  { "meaningless for this law", "poisson_ratio: 0.4", "poisson_ratio: 0.4\n    cohesion_pa: 10", "bad.yaml:24",
    "materials.rubber.cohesion_pa", "10", "applies only to law `mohr_coulomb`" },
  { "without a value", "end_s: 2", "end_s:", "bad.yaml:3", "time.end_s", "", "has no value" },
  { "section without a value", "time:\n  end_s: 2", "time:", "bad.yaml:2", "time", "", "has no value" },
  { "given twice", "end_s: 2", "end_s: 2\n  end_s: 3", "bad.yaml:4", "time.end_s", "3",
    "given twice, first on line 3" },
  { "section given twice", "", "time:\n  end_s: 5\n", "bad.yaml:65", "time", "a map of keys",
    "given twice, first on line 2" },
  { "key that is a list", "end_s: 2", "? [end_s]\n  : 2", "bad.yaml:3", "time", "[end_s]", "a key must be plain text" },
};

const Bad bad_types[] = {
  { "text for a number", "end_s: 2", "end_s: two", "bad.yaml:3", "time.end_s", "two", "must be a number > 0" },
  { "unit in a number", "end_s: 2", "end_s: 2 s", "bad.yaml:3", "time.end_s", "2 s", "must be a number > 0" },
  { "quoted number", "end_s: 2", "end_s: '2'", "bad.yaml:3", "time.end_s", "2", "must be a number > 0" },
  { "list for a number", "end_s: 2", "end_s: [2]", "bad.yaml:3", "time.end_s", "[2]", "must be a number > 0" },
  { "map for a number", "end_s: 2", "end_s: { s: 2 }", "bad.yaml:3", "time.end_s", "a map of keys",
    "must be a number > 0" },
  { "number for a section", "time:\n  end_s: 2", "time: 2", "bad.yaml:2", "time", "2", "must be a section" },
  { "list for a map", "surfaces:\n  bed:", "surfaces:\n  - bed:", "bad.yaml:61", "surfaces",
    "[{bed: ~, line_m: [[-4, -5.5], [4, -5.5]], friction: 0.5}]", "must be a map of sections by name" },
  { "fraction for a whole number", "initial_stress: k0", "particles_per_cell: 2.5", "bad.yaml:28",
    "bodies.fill.particles_per_cell", "2.5", "must be a whole number in [1, 4]" },
  { "number for a switch", "", "numerics:\n  skip_resting: 2\n", "bad.yaml:66", "numerics.skip_resting", "2",
    "must be true or false" },
  { "unknown word", "y_min: free", "y_min: sticky", "bad.yaml:8", "grid.faces.y_min", "sticky",
    "one of free, roller, fixed" },
  { "unknown law", "law: linear_elastic", "law: jelly", "bad.yaml:20", "materials.rubber.law", "jelly",
    "one of linear_elastic, mohr_coulomb" },
  { "point of wrong length", "lower_m: [-4, -6]", "lower_m: [-4, -6, 0]", "bad.yaml:6", "grid.lower_m", "[-4, -6, 0]",
    "[y, z]: two finite numbers" },
  { "point in a line", "[4, -5.5]", "[4]", "bad.yaml:63", "surfaces.bed.line_m[1]", "[4]", "[y, z]" },
  { "row of wrong length", "[10, 0.3, 0.25]", "[10, 0.3]", "bad.yaml:58", "hull.opening_table[1]", "[10, 0.3]",
    "[time_s, port_rad, starboard_rad]" },
};

const Bad bad_ranges[] = {
  { "not a number", "end_s: 2", "end_s: .nan", "bad.yaml:3", "time.end_s", "nan", "must be a number > 0" },
  { "infinite", "stiffness_n_per_m: 1.1e6", "stiffness_n_per_m: .inf", "bad.yaml:46",
    "geotextiles.bag.stiffness_n_per_m", "inf", "must be a number > 0" },
  { "infinite in a struct with its own check", "density_kg_per_m3: 1990", "density_kg_per_m3: .inf", "bad.yaml:12",
    "materials.sand.density_kg_per_m3", "inf", "must be a number > 0" },
  { "not a number in a point", "lower_m: [-4, -6]", "lower_m: [-4, .nan]", "bad.yaml:6", "grid.lower_m", "[-4, nan]",
    "two finite numbers" },
  { "not a number in a row", "[10, 0.3, 0.25]", "[10, .nan, 0.25]", "bad.yaml:58", "hull.opening_table[1]",
    "[10, nan, 0.25]", "three finite numbers" },
  { "zero", "end_s: 2", "end_s: 0", "bad.yaml:3", "time.end_s", "0", "must be a number > 0" },
  { "negative", "friction: 0.2", "friction: -0.2", "bad.yaml:55", "hull.friction", "-0.2", "must be a number >= 0" },
  { "above", "initial_stress: k0", "particles_per_cell: 5", "bad.yaml:28", "bodies.fill.particles_per_cell", "5",
    "in [1, 4]" },
  { "above an open end", "", "numerics:\n  max_travel_cells: 0.6\n", "bad.yaml:66", "numerics.max_travel_cells", "0.6",
    "in (0, 0.5]" },
  { "too few points", "line_m: [[-4, -5.5], [4, -5.5]]", "line_m: [[-4, -5.5]]", "bad.yaml:63", "surfaces.bed.line_m",
    "1 given", "at least 2 points" },
  { "empty name", "name: small", "name: ''", "bad.yaml:1", "name", "''", "text that is not empty" },
  { "name of a body", "  ball:", "  ball 2:", "bad.yaml:34", "bodies.ball 2", "", "a letter, then letters" },
  { "times not ascending", "[10, 0.3, 0.25]", "[0, 0.3, 0.25]", "bad.yaml:58", "hull.opening_table[1]",
    "[0, 0.3, 0.25]", "later than in the row before" },
};

const Bad bad_rules[] = {
  { "nothing to compute",
    small_scene.substr(small_scene.find("bodies:"), small_scene.find("hull:") - small_scene.find("bodies:")),
    "bodies: {}\n", "bad.yaml:24", "bodies", "none", "at least one body, or geotextiles at least one sheet" },
  { "grid upside down", "upper_m: [4, 1]", "upper_m: [4, -7]", "bad.yaml:7", "grid.upper_m", "[4, -7]",
    "must lie above grid.lower_m = [-4, -6]" },
  { "part of a cell", "upper_m: [4, 1]", "upper_m: [4.05, 1]", "bad.yaml:7", "grid.upper_m", "[4.05, 1]",
    "the extent in y must be a whole number of cells" },
  { "too many cells", "cell_size_m: 0.1", "cell_size_m: 0.0001", "bad.yaml:5", "grid.cell_size_m", "0.0001",
    "at most 5e+07" },
  { "unknown material", "material: sand", "material: snad", "bad.yaml:26", "bodies.fill.material", "snad",
    "must be a name in materials: rubber, sand" },
  { "two shapes", "disc: {", "box: { lower_m: [0, 0], upper_m: [1, 1] }\n      disc: {", "bad.yaml:36",
    "bodies.ball.shape", "box, disc", "exactly one of" },
  { "no shape", "{ hopper_fill: { area_m2: 3 } }", "{}", "bad.yaml:27", "bodies.fill.shape", "nothing",
    "exactly one of" },
  { "box inside out", "upper_m: [3, -4]", "upper_m: [1, -4]", "bad.yaml:32", "bodies.block.shape.box.upper_m",
    "[1, -4]", "above lower_m = [2, -5]" },
  { "body off the grid", "center_m: [-2, -4]", "center_m: [-3.6, -4]", "bad.yaml:36", "bodies.ball.shape",
    "[-4.1, -4.5] to [-3.1, -3.5]", "within the grid, [-4, -6] to [4, 1]" },
  { "crossed polygon", "[[-3, -5.5], [-2, -5.5], [-3, -5]]", "[[-3, -5.5], [-2, -5], [-2, -5.5], [-3, -5]]",
    "bad.yaml:41", "bodies.wedge.shape.polygon.vertices_m", "sides 0 and 2 meet", "only at the corner" },
  { "point twice", "[4, -5.5]]", "[4, -5.5], [4, -5.5]]", "bad.yaml:63", "surfaces.bed.line_m", "[4, -5.5]",
    "points 1 and 2 are the same" },
  { "second hopper filling", "disc: { center_m: [-2, -4], radius_m: 0.5 }", "hopper_fill: { area_m2: 1 }",
    "bad.yaml:27", "bodies.fill.shape.hopper_fill", "fill", "filled by ball already" },
  { "K0 below the active state", "initial_stress: k0", "initial_stress: k0\n    k0: 0.2", "bad.yaml:29",
    "bodies.fill.k0", "0.2", "in [0.2948, 3.392]" },
  { "encloses nothing", "encloses: fill", "encloses: full", "bad.yaml:44", "geotextiles.bag.encloses", "full",
    "must be a name in bodies: ball, block, fill, wedge" },
  { "lighter than itself", "computational_mass_kg_per_m2: 20", "computational_mass_kg_per_m2: 0.5", "bad.yaml:48",
    "geotextiles.bag.computational_mass_kg_per_m2", "0.5", ">= mass_kg_per_m2 = 0.84" },
  { "gauge below a segment", "segment_length_m: 0.1", "segment_length_m: 0.1\n    gauge_length_m: 0.05", "bad.yaml:51",
    "geotextiles.bag.gauge_length_m", "0.05", "at least segment_length_m = 0.1" },
  { "too few segments", "segment_length_m: 0.1", "segment_length_m: 4", "bad.yaml:50",
    "geotextiles.bag.segment_length_m", "4", "at most 3: the unstretched length of 9 m makes 3 segments" },
  { "gauge around the whole sheet", "segment_length_m: 0.1", "segment_length_m: 0.1\n    gauge_length_m: 9.1",
    "bad.yaml:51", "geotextiles.bag.gauge_length_m", "9.1", "at most the unstretched length, 9 m" },
  { "sheet too short", "encloses: fill\n    circumference_m: 9", "encloses: ball\n    circumference_m: 3",
    "bad.yaml:45", "geotextiles.bag.circumference_m", "3", "at least the outline of ball, 3.14159 m" },
  { "hull on the wrong side", "[0, -2.6]", "[-0.1, -2.6]", "bad.yaml:53", "hull.port_section_m[2]", "[-0.1, -2.6]",
    "the port half has y >= 0" },
  { "hull from the deck down", "[[1.5, -3], [0, -3], [0, -2.6], [1.5, -1], [1.5, 0]]",
    "[[1.5, 0], [1.5, -1], [0, -2.6], [0, -3], [1.5, -3]]", "bad.yaml:53", "hull.port_section_m",
    "[1.5, 0] to [1.5, -3]", "from the bottom up" },
  { "lip too round", "lip_radius_m: 0.1", "lip_radius_m: 0.5", "bad.yaml:54", "hull.lip_radius_m", "0.5",
    "must fit side 1" },
  { "table out of believable range", "[10, 0.3, 0.25]", "[10, 0.3, 0.8]", "bad.yaml:58", "hull.opening_table[1]", "0.8",
    "[-0.02, 0.7]" },
  { "name kept for the hull", "  bed:", "  hull_port:", "bad.yaml:62", "surfaces.hull_port", "", "kept for" },
};

INSTANTIATE_TEST_SUITE_P(Keys, BadScene, testing::ValuesIn(bad_keys));
INSTANTIATE_TEST_SUITE_P(Types, BadScene, testing::ValuesIn(bad_types));
INSTANTIATE_TEST_SUITE_P(Ranges, BadScene, testing::ValuesIn(bad_ranges));
INSTANTIATE_TEST_SUITE_P(Rules, BadScene, testing::ValuesIn(bad_rules));

struct BadAssignment {
  std::string assignment, key, value, allowed;
};

void PrintTo(const BadAssignment& bad, std::ostream* out)
{
  *out << bad.assignment;
}

class BadOverrides : public testing::TestWithParam<BadAssignment> {};

TEST_P(BadOverrides, AreRefusedInOneClearLine)
{
  const BadAssignment& bad = GetParam();
  try {
    parse_scene(small_scene, "good.yaml", { bad.assignment });
    FAIL() << "accepted";
  } catch (const InputError& error) {
    expect_error(error, "good.yaml --set", bad.key, bad.value, bad.allowed);
  }
}

const BadAssignment bad_overrides[] = {
  { "hull.friction", "'hull.friction'", "", "must be dotted.key=value" },
  { "=3", "'=3'", "", "must be dotted.key=value" },
  { "hull.friction=", "'hull.friction='", "", "must be dotted.key=value" },
  { "hull..friction=1", "'hull..friction=1'", "", "a name on each side of a dot" },
  { "hull.frction=1", "hull.frction", "1", "did you mean friction?" },
  { "hul.friction=1", "hul", "1", "did you mean hull?" },
  { "hull.friction.port=1", "hull.friction.port", "1", "hull.friction is a single value" },
  { "materials.clay.cohesion_pa=1", "materials.clay.cohesion_pa", "1",
    "the scene has no materials.clay; materials holds: sand, rubber" },
  { "bodies.fill.shape.disc.radius_m=1", "bodies.fill.shape.disc.radius_m", "1",
    "the scene has no bodies.fill.shape.disc" },
  { "hull.friction=rough", "hull.friction", "rough", "must be a number >= 0" },
  { "hull.friction=-1", "hull.friction", "-1", "must be a number >= 0" },
  { "hull.friction=.nan", "hull.friction", "nan", "must be a number >= 0" },
  { "hull.friction=[1", "hull.friction", "[1", "the value is not YAML" },
  { "hull.opening_table=[[0, 0]]", "hull.opening_table[0]", "[0, 0]", "three numbers" },
};

INSTANTIATE_TEST_SUITE_P(Overrides, BadOverrides, testing::ValuesIn(bad_overrides));

TEST(BadOverride, ThatBreaksARuleOnAnotherKeyIsNamedBesideThatKey)
{
  try {
    parse_scene(small_scene, "good.yaml", { "grid.cell_size_m=0.3" });
    FAIL() << "accepted";
  } catch (const InputError& error) {
    expect_error(error, "good.yaml:7 (with --set)", "grid.upper_m", "[4, 1]", "whole number of cells");
  }
}

class BadFile : public testing::Test {
protected:
  std::string write(const std::string& text)
  {
    const std::string path = testing::TempDir() + "geocontainer_mpm_" +
                             testing::UnitTest::GetInstance()->current_test_info()->name() + ".yaml";
    std::ofstream(path) << text;
    return path;
  }
  void expect(const std::string& path, const std::string& source, const std::string& allowed)
  {
    try {
      load_scene(path);
      FAIL() << "accepted";
    } catch (const InputError& error) {
      EXPECT_EQ(error.source(), source);
      EXPECT_NE(error.allowed().find(allowed), std::string::npos) << error.what();
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
  }
};

TEST_F(BadFile, ThatIsNotThere)
{
  expect("no/such.yaml", "no/such.yaml", "No such file");
}

TEST_F(BadFile, ThatIsAFolder)
{
  expect("/", "/", "is a directory");
}

TEST_F(BadFile, ThatIsEmpty)
{
  const std::string path = write("");
  expect(path, path, "one document");
}

TEST_F(BadFile, ThatIsNotYaml)
{
  const std::string path = write("name: x\ntime: [1, 2\ngrid: 3\n");
  expect(path, path + ":3:5", "cannot be parsed");
}

TEST_F(BadFile, ThatHoldsTwoDocuments)
{
  const std::string path = write("name: x\n---\nname: y\n");
  expect(path, path, "one document");
}

TEST_F(BadFile, ThatHoldsItself)
{
  const std::string path = write("name: &a [*a]\n");
  expect(path, path, "nested more than");
}

TEST(DescriptionValidate, ChecksADescriptionBuiltInCode)
{
  SceneDescription scene = parse_scene(small_scene, "");
  EXPECT_NO_THROW(scene.validate());
  scene.source = "code";
  scene.hull->friction = std::numeric_limits<double>::quiet_NaN();
  try {
    scene.validate();
    FAIL() << "accepted";
  } catch (const InputError& error) {
    expect_error(error, "code", "hull.friction", "nan", "must be a number >= 0");
  }
  scene.hull->friction = 0.2;
  scene.grid.faces[2] = static_cast<FaceCondition>(7);
  try {
    scene.validate();
    FAIL() << "accepted";
  } catch (const InputError& error) {
    expect_error(error, "code", "grid.faces.z_min", "7", "one of free, roller, fixed");
  }
}

}  // namespace
}  // namespace geocontainer_mpm::scene
