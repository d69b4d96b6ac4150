// Rules that tie several keys of a scene together, each broken once: the error names key, value and what is allowed.

#include <gtest/gtest.h>

#include "description_fixture.h"
#include "geocontainer_mpm/error.h"
#include "geocontainer_mpm/scene/description.h"

namespace geocontainer_mpm::scene {
namespace {

/// One change of the full scene and the error that it must end in. `allowed` is a part of what is allowed.
struct Broken {
  const char* what;
  std::string from, to;  ///< replaced in the text; `from` empty: appended
  std::string key, value, allowed;
};

void PrintTo(const Broken& broken, std::ostream* out)
{
  *out << broken.what;
}

class BrokenRule : public testing::TestWithParam<Broken> {};

TEST_P(BrokenRule, IsToldInOneClearLine)
{
  const Broken& broken = GetParam();
  try {
    parse_scene(changed(full_scene, broken.from, broken.to), "rule.yaml");
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(error.source().compare(0, 9, "rule.yaml"), 0) << error.what();
    expect_error(error, error.source(), broken.key, broken.value, broken.allowed);
  }
}

const Broken tables[] = {
  { "times not ascending", "table: [[-1, 0], [1, 1]]", "table: [[1, 0], [1, 1]]", "tractions.load.table[1]", "[1, 1]",
    "later than in the row before" },
  { "time not finite", "table: [[-1, 0], [1, 1]]", "table: [[.nan, 0], [1, 1]]", "tractions.load.table[0]", "[nan, 0]",
    "2 finite numbers" },
  { "value not finite", "table: [[-1, 0], [1, 1]]", "table: [[-1, .inf], [1, 1]]", "tractions.load.table[0]",
    "[-1, inf]", "2 finite numbers" },
  { "row too short", "velocity_table: [[0, 0, 0]", "velocity_table: [[0, 0]", "supports.shaker.velocity_table[0]",
    "[0, 0]", "[time_s, v_y, v_z]: 3 numbers" },
  { "text in a row", "table: [[-1, 0], [1, 1]]", "table: [[-1, off], [1, 1]]", "tractions.load.table[0]", "[-1, off]",
    "[time_s, factor]: 2 numbers" },
  { "no list", "table: [[-1, 0], [1, 1]]", "table: 1", "tractions.load.table", "1", "a list of rows [time_s, factor]" },
  { "motion without a row", "table: [[0, 0, 0, 0], [2, 0, 0.1, 0.05]]", "table: []", "surfaces.bed.motion.table",
    "0 given", "a list of at least 1 rows" },
  { "motion without a table", "motion: { pivot_m: [0, -5.5], table: [[0, 0, 0, 0], [2, 0, 0.1, 0.05]] }", "motion: {}",
    "surfaces.bed.motion.table", "", "missing" },
  { "gravity given twice", "", "gravity_table: [[0, 0, -9.81]]\n", "gravity_m_per_s2", "[0, 0]",
    "applies only to a scene without `gravity_table`" },
};

const Broken methods[] = {
  { "consistent mass needs flip", "shape: linear_simplex\n  transfer: flip\n  flip_fraction: 0.95\n  mass: lumped",
    "shape: bspline2\n  transfer: apic\n  mass: consistent", "numerics.mass", "consistent",
    "needs numerics.transfer flip" },
  { "consistent mass where something touches", "mass: lumped", "mass: consistent", "numerics.mass", "consistent",
    "must be lumped in a scene with a hull" },
  { "apic on triangles", "transfer: flip\n  flip_fraction: 0.95", "transfer: apic", "numerics.transfer", "apic",
    "must be flip with numerics.shape linear_simplex" },
  { "fraction of what is not flip", "transfer: flip", "transfer: apic", "numerics.flip_fraction", "0.95",
    "applies only to transfer `flip`" },
  { "fraction above 1", "flip_fraction: 0.95", "flip_fraction: 1.1", "numerics.flip_fraction", "1.1", "in [0, 1]" },
  { "too many halvings", "max_halvings: 4", "max_halvings: 21", "numerics.max_halvings", "21", "in [0, 20]" },
  { "no energy jump", "energy_jump: 0.05", "energy_jump: 0", "numerics.energy_jump", "0", "> 0" },
  { "no probe interval", "probe_interval_s: 0.05", "probe_interval_s: 0", "time.probe_interval_s", "0", "> 0" },
};

const Broken bodies[] = {
  { "ring inside out", "outer_radius_m: 1.25", "outer_radius_m: 0.7", "bodies.whirl.shape.ring.outer_radius_m", "0.7",
    "above inner_radius_m = 0.75" },
  { "ring off the grid", "ring: { center_m: [-2, -4]", "ring: { center_m: [-3, -4]", "bodies.whirl.shape",
    "[-4.25, -5.25] to [-1.75, -2.75]", "within the grid" },
  { "fluid with Young's modulus", "bulk_modulus_pa: 1.0e6", "bulk_modulus_pa: 1.0e6\n    young_modulus_pa: 1.0e6",
    "materials.slurry.young_modulus_pa", "1.0e6", "applies only to a law that is not a fluid's" },
  { "fluid without viscosity", "    viscosity_pa_s: 0.5\n", "", "materials.slurry.viscosity_pa_s", "", "missing" },
  { "yield stress of a Newtonian fluid", "law: bingham", "law: newtonian", "materials.slurry.yield_stress_pa", "20",
    "applies only to law `bingham`" },
  { "bulk modulus of a solid", "law: neo_hookean", "law: neo_hookean\n    bulk_modulus_pa: 1.0e6",
    "materials.rubber.bulk_modulus_pa", "1.0e6", "applies only to law `newtonian` or `bingham`" },
  { "negative damping", "stiffness_damping_s: 1.0e-4", "stiffness_damping_s: -1", "materials.sand.stiffness_damping_s",
    "-1", "at least 0 s" },
  { "K0 of a fluid", "initial_stress: hydrostatic", "initial_stress: k0", "bodies.drop.initial_stress", "k0",
    "needs law linear_elastic or mohr_coulomb, is bingham" },
  { "hydrostatic sand", "initial_stress: k0\n    k0: 0.46", "initial_stress: hydrostatic", "bodies.fill.initial_stress",
    "hydrostatic", "needs law newtonian or bingham, is mohr_coulomb" },
  { "depth across gravity", "gravity_m_per_s2: [0, 0]", "gravity_m_per_s2: [1, -9.81]", "bodies.drop.initial_stress",
    "hydrostatic", "needs gravity along -z, is [1, -9.81]" },
  { "K0 without a stress", "initial_stress: hydrostatic", "k0: 0.5", "bodies.drop.k0", "0.5",
    "applies only to initial_stress `k0` or `gravity`" },
  { "name of a field", "velocity_field: fluid", "velocity_field: 2nd", "bodies.drop.velocity_field", "2nd",
    "a letter, then letters" },
};

const Broken manufactured[] = {
  { "held at first", "origin_m: [2.5, -4.5] }\n", "origin_m: [2.5, -4.5] }\n    held_until_s: 1\n",
    "bodies.square.held_until_s", "1", "must be 0" },
  { "of another law", "law: neo_hookean", "law: hencky", "bodies.square.manufactured", "", "needs law neo_hookean" },
  { "under gravity", "gravity_m_per_s2: [0, 0]", "gravity_m_per_s2: [0, -1]", "bodies.square.manufactured", "",
    "gravity_m_per_s2 [0, 0]" },
  { "under a table of gravity", "gravity_m_per_s2: [0, 0]", "gravity_table: [[0, 0, 0]]", "bodies.square.manufactured",
    "", "no gravity_table" },
  { "square elsewhere", "amplitude: 0.06, origin_m: [2.5, -4.5]", "amplitude: 0.06, origin_m: [2.4, -4.5]",
    "bodies.square.manufactured.solution", "axis_aligned", "shape box with lower_m = origin_m = [2.4, -4.5]" },
  { "square turned", "rotation_deg: 0,", "rotation_deg: 1,", "bodies.square.manufactured.solution", "axis_aligned",
    "shape box" },
  { "square inside out", "amplitude: 0.06", "amplitude: 0.32", "bodies.square.manufactured.amplitude", "0.32",
    "below 1 / pi" },
  { "ring of another size", "inner_radius_m: 0.75", "inner_radius_m: 0.7", "bodies.whirl.manufactured.solution",
    "vortex", "shape ring with center_m = origin_m = [-2, -4], inner_radius_m = 0.75" },
  { "ring elsewhere", "solution: vortex, origin_m: [-2, -4]", "solution: vortex", "bodies.whirl.manufactured.solution",
    "vortex", "origin_m = [0, 0]" },
  { "vortex in a disc", "ring: { center_m: [-2, -4], inner_radius_m: 0.75, outer_radius_m: 1.25 }",
    "disc: { center_m: [-2, -4], radius_m: 1 }", "bodies.whirl.manufactured.solution", "vortex", "shape ring" },
};

const Broken sheets[] = {
  { "two paths", "circle: { center_m: [0, -5], radius_m: 0.15 }",
    "circle: { center_m: [0, -5], radius_m: 0.15 }\n    line: { points_m: [[0, -5], [1, -5], [1, -4]], closed: true }",
    "geotextiles.tube", "line, circle", "exactly one of encloses, line, circle" },
  { "no path", "    circle: { center_m: [0, -5], radius_m: 0.15 }\n", "", "geotextiles.tube", "nothing",
    "exactly one of encloses, line, circle" },
  { "two lengths", "pretension_n_per_m: 100", "pretension_n_per_m: 100\n    slack: 0.1", "geotextiles.tube",
    "slack, pretension_n_per_m", "at most one of circumference_m, slack, pretension_n_per_m" },
  { "negative slack", "slack: 0.02", "slack: -0.1", "geotextiles.cable.slack", "-0.1", ">= 0" },
  { "shorter than its path", "slack: 0.02", "circumference_m: 1.9", "geotextiles.cable.circumference_m", "1.9",
    "at least the length of the path, 2.03961 m; a tighter sheet is given by pretension_n_per_m" },
  { "path off the grid", "[1, -5]], closed: false", "[5, -5]], closed: false", "geotextiles.cable.line.points_m",
    "[-1, -5.2] to [5, -5]", "within the grid" },
  { "circle off the grid", "circle: { center_m: [0, -5]", "circle: { center_m: [0, -6]", "geotextiles.tube.circle",
    "[-0.15, -6.15] to [0.15, -5.85]", "within the grid" },
  { "path crosses itself", "[1, -5]], closed: false", "[1, -5], [1, -5.3], [-1, -5]], closed: false",
    "geotextiles.cable.line.points_m", "sides 0 and 3 meet", "only at the corner" },
  { "start of a closed sheet", "points_m: [[-1, -5], [0, -5.2], [1, -5]], closed: false",
    "points_m: [[-1, -5], [0, -5.2]], closed: true", "geotextiles.cable.start", "a map of keys",
    "applies only to an open `line`" },
  { "closed path of two points", "circle: { center_m: [0, -5], radius_m: 0.15 }",
    "line: { points_m: [[0, -5], [1, -5]], closed: true }", "geotextiles.tube.line.points_m", "2 given",
    "at least 3 points" },
  { "end of a closed sheet", "pretension_n_per_m: 100", "pretension_n_per_m: 100\n    end: { held: true }",
    "geotextiles.tube.end", "a map of keys", "applies only to an open `line`" },
  { "motion of a free end", "end: { held: false,", "end: { motion_table: [[0, 0, 0]],",
    "geotextiles.cable.end.motion_table", "[[0, 0, 0]]", "applies only to a held end" },
  { "force on a held end", "start: { held: true,", "start: { held: true, force_n_per_m: [1, 0],",
    "geotextiles.cable.start.force_n_per_m", "[1, 0]", "applies only to an end that is not held" },
  { "end that jumps", "motion_table: [[0, 0, 0], [1, 0.1, -0.1]]", "motion_table: [[-1, 0, 0], [1, 0.1, -0.1]]",
    "geotextiles.cable.start.motion_table", "[0.05, -0.05] at time 0", "[0, 0] at time 0" },
  { "pressure in an open sheet", "slack: 0.02", "slack: 0.02\n    inside_pressure: { pressure_pa: 1 }",
    "geotextiles.cable.inside_pressure", "a map of keys", "applies only to a closed sheet" },
  { "lighter the deeper", "gradient_pa_per_m: 9810", "gradient_pa_per_m: -1",
    "geotextiles.tube.inside_pressure.gradient_pa_per_m", "-1", ">= 0" },
  { "field of an enclosing sheet", "circumference_m: 9", "circumference_m: 9\n    velocity_field: cable",
    "geotextiles.bag.velocity_field", "cable", "applies only to a free sheet" },
  { "velocity of an enclosing sheet", "circumference_m: 9", "circumference_m: 9\n    initial_velocity_m_per_s: [0, 1]",
    "geotextiles.bag.initial_velocity_m_per_s", "[0, 1]", "applies only to a free sheet" },
  { "table of force from elsewhere", "[[0, 0], [0.05, 3e4]", "[[0, 1], [0.05, 3e4]",
    "geotextiles.cable.force_strain_table[0]", "[0, 1]", "must be [0, 0]" },
  { "table of force that falls", "[0.15, 1.2e5]]", "[0.15, 2e4]]", "geotextiles.cable.force_strain_table[2]",
    "[0.15, 20000]", "greater than in the row before" },
  { "table of force with one row", "[[0, 0], [0.05, 3e4], [0.15, 1.2e5]]", "[[0, 0]]",
    "geotextiles.cable.force_strain_table", "1 given", "two rows or more" },
  { "neither stiffness nor table", "stiffness_n_per_m: 1.1e6\n", "force_strain_table: []\n",
    "geotextiles.bag.stiffness_n_per_m", "", "missing; must be a number > 0" },
  { "laid beyond its rupture", "rupture_strain: 0.12", "rupture_strain: 0.0005", "geotextiles.tube.rupture_strain",
    "0.0005", "more than the strain of pretension_n_per_m, 0.001" },
  { "laid beyond its seam's strength", "efficiency: 0.25, tears", "efficiency: 0.001, tears",
    "geotextiles.tube.seams.overlap.tears", "true", "its strength, 100 N/m, must be more than pretension_n_per_m" },
  { "too few membrane points", "segment_length_m: 0.05", "segment_length_m: 0.06", "geotextiles.bag.segment_length_m",
    "0.06", "at most 0.05, half a cell, for membrane_points" },
  { "seam at two places", "right: { along: 0.25 }", "right: { along: 0.25, at_m: [0, -5] }",
    "geotextiles.bag.seams.right", "at_m, along", "exactly one of at_m, along" },
  { "seam nowhere", "right: { along: 0.25 }", "right: { efficiency: 0.25 }", "geotextiles.bag.seams.right", "nothing",
    "exactly one of at_m, along" },
  { "seam off the grid", "at_m: [-0.5, -5]", "at_m: [-0.5, -50]", "geotextiles.bag.seams.left.at_m", "[-0.5, -50]",
    "within the grid" },
  { "interface in a shared field", "circumference_m: 9",
    "circumference_m: 9\n    interface: frictional\n    interface_friction: 0.3", "geotextiles.bag.interface",
    "frictional", "needs the velocity field common for fill and this sheet alone" },
  { "interface of a free sheet", "slack: 0.02", "slack: 0.02\n    interface: bonded", "geotextiles.cable.interface",
    "bonded", "applies only to a sheet that encloses a body" },
  { "friction of a bonded sheet", "    interface: frictional\n", "", "geotextiles.skin.interface_friction", "0.3",
    "applies only to interface `frictional`" },
  { "wrinkles upside down", "region: { lower_m: [-2.3, -4.6]", "region: { lower_m: [-2.3, -4.1]",
    "geotextiles.skin.wrinkles.region.upper_m", "[-1.7, -4.2]", "not lie below lower_m = [-2.3, -4.1]" },
};

const Broken boundaries[] = {
  { "closed line of two points",
    "line_m: [[-4, -5.5], [0, -5.6], [4, -5.5]]\n    closed: false\n    corner_radius_m: 0.2",
    "line_m: [[-4, -5.5], [4, -5.5]]\n    closed: true", "surfaces.bed.line_m", "2 given", "at least 3 points" },
  { "rounded closed line", "closed: false\n    corner_radius_m", "closed: true\n    corner_radius_m",
    "surfaces.bed.corner_radius_m", "0.2", "applies only to an open line" },
  { "rounding that does not fit", "corner_radius_m: 0.2", "corner_radius_m: 200", "surfaces.bed.corner_radius_m", "200",
    "must fit side 0 of line_m: at most 160" },
};

const Broken loads[] = {
  { "region upside down", "region: { lower_m: [3.8, -6]", "region: { lower_m: [4.1, -6]",
    "supports.shaker.region.upper_m", "[4, 1]", "not lie below lower_m = [4.1, -6]" },
  { "support between nodes", "region: { lower_m: [3.8, -6], upper_m: [4, 1] }",
    "region: { lower_m: [3.82, -6], upper_m: [3.88, 1] }", "supports.shaker.region", "[3.82, -6] to [3.88, 1]",
    "nodes of the grid, which stand every 0.1 m" },
  { "support beyond the grid", "region: { lower_m: [3.8, -6], upper_m: [4, 1] }",
    "region: { lower_m: [4.1, -6], upper_m: [5, 1] }", "supports.shaker.region", "[4.1, -6] to [5, 1]",
    "from [-4, -6] to [4, 1]" },
  { "support of nothing", "holds_y: true", "holds_y: false", "supports.shaker", "holds_y and holds_z false",
    "at least one direction" },
  { "velocity not held", "[1, 0.2, 0]]", "[1, 0.2, 0.3]]", "supports.shaker.velocity_table[1]", "0.3",
    "must be 0 in z, which holds_z leaves free" },
  { "traction on nothing", "body: wedge", "body: edge", "tractions.load.body", "edge",
    "must be a name in bodies: drop, fill, square, wedge, whirl" },
  { "traction of nothing", "traction_pa: [10, 0]\n    pressure_pa: 100", "traction_pa: [0, 0]", "tractions.load",
    "traction_pa and pressure_pa 0", "must give a traction_pa or a pressure_pa" },
  { "traction on a line", "upper_m: [-2, -5.4]", "upper_m: [-2, -5.6]", "tractions.load.region.upper_m", "[-2, -5.6]",
    "above lower_m = [-3, -5.6]" },
  { "traction beside the body", "lower_m: [-3, -5.6], upper_m: [-2, -5.4]", "lower_m: [0, 0], upper_m: [1, 1]",
    "tractions.load.region", "[0, 0] to [1, 1]", "must meet wedge, which spans [-3, -5.5] to [-2, -5.3]" },
};

const Broken contacts[] = {
  { "missing pair", "  both: { between: [cable, fluid], friction: 0.1 }\n", "", "contacts",
    "nothing between cable and fluid", "each pair of the velocity fields cable, common, fluid once" },
  { "unknown field", "between: [cable, fluid]", "between: [cable, water]", "contacts.both.between", "water",
    "velocity fields of bodies and sheets: cable, common, fluid" },
  { "field with itself", "between: [cable, fluid]", "between: [cable, cable]", "contacts.both.between",
    "[\"cable\", \"cable\"]", "two different" },
  { "pair named twice", "between: [cable, fluid]", "between: [fluid, common]", "contacts.wet.between",
    "[\"common\", \"fluid\"]", "named by both already" },
  { "three fields", "between: [cable, fluid]", "between: [cable, fluid, common]", "contacts.both.between", "3 given",
    "a list of 2 texts" },
  { "negative friction", "between: [cable, fluid], friction: 0.1", "between: [cable, fluid], friction: -0.1",
    "contacts.both.friction", "-0.1", ">= 0" },
};

const Broken probes[] = {
  { "two kinds", "mean: { body: fill }", "mean: { body: fill, surface: bed }", "probes.mean", "body, surface",
    "exactly one of point, body, section, geotextile, surface, manufactured" },
  { "no kind", "mean: { body: fill }", "mean: {}", "probes.mean", "nothing", "exactly one of point" },
  { "no such body", "mean: { body: fill }", "mean: { body: full }", "probes.mean.body", "full",
    "must be a name in bodies" },
  { "point of no body", "point: { body: square,", "point: { body: squire,", "probes.top.point.body", "squire",
    "must be a name in bodies" },
  { "point off the grid", "at_m: [3, -3.6]", "at_m: [3, 3]", "probes.top.point.at_m", "[3, 3]", "within the grid" },
  { "point beside its body", "at_m: [3, -3.6]", "at_m: [3, -3.4]", "probes.top.point.at_m", "[3, -3.4]",
    "must lie in square, which spans [2.5, -4.5] to [3.5, -3.5]" },
  { "cut without length", "to_m: [4, -4]", "to_m: [2, -4]", "probes.cut.section.to_m", "[2, -4]",
    "differ from from_m" },
  { "cut off the grid", "from_m: [2, -4], to_m: [4, -4]", "from_m: [5, -4], to_m: [6, -4]", "probes.cut.section",
    "[5, -4] to [6, -4]", "must cut the grid" },
  { "no such sheet", "geotextile: { name: cable,", "geotextile: { name: rope,", "probes.pull.geotextile.name", "rope",
    "must be a name in geotextiles: bag, cable, skin, tube" },
  { "sheet's point off the grid", "at_m: [0, -5.2]", "at_m: [0, -7]", "probes.pull.geotextile.at_m", "[0, -7]",
    "within the grid" },
  { "no such surface", "surface: hull_port", "surface: hull_left", "probes.push.surface", "hull_left",
    "must be a name in surfaces: bed; or hull_port or hull_starboard" },
  { "no solution", "manufactured: whirl", "manufactured: wedge", "probes.error.manufactured", "wedge",
    "a body with the section manufactured" },
};

INSTANTIATE_TEST_SUITE_P(Tables, BrokenRule, testing::ValuesIn(tables));
INSTANTIATE_TEST_SUITE_P(Methods, BrokenRule, testing::ValuesIn(methods));
INSTANTIATE_TEST_SUITE_P(Bodies, BrokenRule, testing::ValuesIn(bodies));
INSTANTIATE_TEST_SUITE_P(Manufactured, BrokenRule, testing::ValuesIn(manufactured));
INSTANTIATE_TEST_SUITE_P(Sheets, BrokenRule, testing::ValuesIn(sheets));
INSTANTIATE_TEST_SUITE_P(Boundaries, BrokenRule, testing::ValuesIn(boundaries));
INSTANTIATE_TEST_SUITE_P(Loads, BrokenRule, testing::ValuesIn(loads));
INSTANTIATE_TEST_SUITE_P(Contacts, BrokenRule, testing::ValuesIn(contacts));
INSTANTIATE_TEST_SUITE_P(Probes, BrokenRule, testing::ValuesIn(probes));

/// The error of a scene with these overrides: key, value and what is allowed.
void expect_refused(const std::vector<std::string>& overrides, const std::string& key, const std::string& value,
                    const std::string& allowed)
{
  try {
    parse_scene(full_scene, "rule.yaml", overrides);
    ADD_FAILURE() << "accepted";
  } catch (const InputError& error) {
    expect_error(error, error.source(), key, value, allowed);
  }
}

TEST(DescriptionRule, ASheetHasAtLeastOneSegmentOpenAndThreeClosed)
{
  const std::vector<std::string> open{ "geotextiles.cable.slack=0", "geotextiles.cable.gauge_length_m=2.0396" };
  const auto with = [](std::vector<std::string> overrides, const std::string& more) {
    overrides.push_back(more);
    return overrides;
  };
  EXPECT_NO_THROW(parse_scene(full_scene, "", with(open, "geotextiles.cable.segment_length_m=2.0396")));
  expect_refused(with(open, "geotextiles.cable.segment_length_m=2.1"), "geotextiles.cable.segment_length_m", "2.1",
                 "at most 2.03961: the unstretched length of 2.03961 m makes 1 segment or more");
  // 2 pi 0.15 m under 100 N/m at 1e5 N/m.
  expect_refused({ "geotextiles.tube.segment_length_m=0.32" }, "geotextiles.tube.segment_length_m", "0.32",
                 "at most 0.313845: the unstretched length of 0.941536 m makes 3 segments or more");
  expect_refused({ "geotextiles.tube.gauge_length_m=0.95" }, "geotextiles.tube.gauge_length_m", "0.95",
                 "at most the unstretched length, 0.941536 m");
}

TEST(DescriptionRule, AManufacturedBodyStartsWithItsSolutionsVelocity)
{
  expect_refused({ "bodies.square.initial_velocity_m_per_s=[1, 0]" }, "bodies.square.initial_velocity_m_per_s",
                 "[1, 0]", "starts with the solution's velocity");
}

TEST(DescriptionRule, OneVelocityFieldTouchesNoOther)
{
  try {
    parse_scene(small_scene + "contacts:\n  dry: { between: [common, common], friction: 0 }\n", "one.yaml");
    FAIL() << "accepted";
  } catch (const InputError& error) {
    expect_error(error, "one.yaml:66", "contacts.dry", "", "bodies and sheets move in one velocity field, common");
  }
}

TEST(DescriptionRule, ASupportMayBeALineOfNodes)
{
  EXPECT_NO_THROW(parse_scene(full_scene, "", { "supports.shaker.region={ lower_m: [3.9, -6], upper_m: [3.9, 1] }" }));
  EXPECT_NO_THROW(parse_scene(full_scene, "", { "supports.shaker.region={ lower_m: [4, 1], upper_m: [4, 1] }" }));
}

TEST(DescriptionRule, HullHalvesCanBeProbedOnlyWhereThereIsAHull)
{
  std::string text = small_scene.substr(0, small_scene.find("bodies:")) +
                     "bodies:\n  ball: { material: rubber, shape: { disc: { center_m: [-2, -4], radius_m: 0.5 } } }\n" +
                     "probes:\n  push: { surface: hull_port }\n";
  try {
    parse_scene(text, "no_hull.yaml");
    FAIL() << "accepted";
  } catch (const InputError& error) {
    expect_error(error, "no_hull.yaml:27", "probes.push.surface", "hull_port", "must be a name in surfaces: none");
  }
}

TEST(DescriptionRule, ADescriptionBuiltInCodeIsHeldToWhatApplies)
{
  SceneDescription scene = parse_scene(full_scene, "");
  scene.geotextiles.at("cable").inside_pressure.emplace().pressure_pa = 1.0;
  try {
    scene.validate();
    FAIL() << "accepted";
  } catch (const InputError& error) {
    expect_error(error, "", "geotextiles.cable.inside_pressure", "", "applies only to a closed sheet");
  }
}

}  // namespace
}  // namespace geocontainer_mpm::scene
