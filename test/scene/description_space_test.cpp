// Rules of scenes in three dimensions, each broken once.

#include <gtest/gtest.h>

#include "description_fixture.h"
#include "geocontainer_mpm/scene/description.h"

namespace geocontainer_mpm::scene {
namespace {

struct Broken {
  const std::string* scene;
  std::string override, key, value, allowed;
};

void PrintTo(const Broken& broken, std::ostream* out)
{
  *out << broken.override;
}

class BrokenSpace : public testing::TestWithParam<Broken> {};

TEST_P(BrokenSpace, IsToldInOneClearLine)
{
  const Broken& broken = GetParam();
  try {
    parse_scene(*broken.scene, "space.yaml", { broken.override });
    FAIL() << "accepted";
  } catch (const InputError& error) {
    expect_error(error, error.source(), broken.key, broken.value, broken.allowed);
  }
}

const Broken plane[] = {
  { &small_scene, "bodies.fill.along_m=[0, 1]", "bodies.fill.along_m", "[0, 1]", "no section `space`" },
  { &small_scene, "hull.along_m=[0, 1]", "hull.along_m", "[0, 1]", "no section `space`" },
  { &small_scene, "geotextiles.bag.end_slack=0.1", "geotextiles.bag.end_slack", "0.1", "no section `space`" },
  { &small_scene, "geotextiles.bag.strength_weft_n_per_m=1", "geotextiles.bag.strength_weft_n_per_m", "1",
    "no section `space`" },
};
INSTANTIATE_TEST_SUITE_P(Plane, BrokenSpace, testing::ValuesIn(plane));

const Broken space[] = {
  { &solid_scene, "space.along_m=[4, -4]", "space.along_m", "[4, -4]", "from below to" },
  { &solid_scene, "space.along_m=[-3.95, 4]", "space.along_m", "[-3.95, 4]", "whole number of cells" },
  { &solid_scene, "bodies.fill.along_m=[-5, 5]", "bodies.fill.along_m", "[-5, 5]", "within space.along_m" },
  { &solid_scene, "hull.along_m=[3, -3]", "hull.along_m", "[3, -3]", "from below to" },
  { &solid_scene,
    "geotextiles.bag.wrinkles={ region: { lower_m: [-1, -4], upper_m: [1, -2] }, number: 3, amplitude_m: 0.1 }",
    "geotextiles.bag.wrinkles", "", "plane strain alone" },
  { &solid_scene, "numerics.shape=gimp", "numerics.shape", "gimp", "bspline2 or linear_simplex" },
};
INSTANTIATE_TEST_SUITE_P(Space, BrokenSpace, testing::ValuesIn(space));

const Broken symmetry[] = {
  { &solid_scene, "space.along_m=[-3.8, 4]", "space.along_m", "[-3.8, 4]", "from -x to x" },
  { &solid_scene, "bodies.fill.along_m=[-2, 3]", "bodies.fill.along_m", "[-2, 3]", "from -x to x" },
  { &solid_scene, "grid.lower_m=[-4.2, -6]", "grid.lower_m", "[-4.2, -6]", "as far from y = 0" },
  { &solid_scene, "gravity_m_per_s2=[1, -9.81]", "gravity_m_per_s2", "[1, -9.81]", "without a part along y" },
  { &solid_scene, "bodies.fill.shape={ box: { lower_m: [0, -2], upper_m: [1, -1] } }", "bodies.fill.shape", "",
    "mirror image" },
  { &solid_scene, "surfaces.bed.line_m=[[-4, -5.5], [4, -5.4]]", "surfaces.bed.line_m", "", "mirror image" },
  { &solid_scene, "hull.opening_table=[[0, 0, 0], [1, 0.1, 0.2]]", "hull.opening_table", "0.1, 0.2", "both sides" },
  { &solid_scene, "probes={ push: { surface: hull_starboard } }", "probes.push.surface", "hull_starboard",
    "hull_port or hull_bulkhead_fore_port" },
};
INSTANTIATE_TEST_SUITE_P(Symmetry, BrokenSpace, testing::ValuesIn(symmetry));

TEST(Space, TheSameKeysAreRightWhereTheyBelong)
{
  EXPECT_EQ(parse_scene(solid_scene, "").dimensions(), 3);
  EXPECT_EQ(parse_scene(small_scene, "").dimensions(), 2);
  EXPECT_NO_THROW(parse_scene(solid_scene, "", { "space.symmetry=none", "bodies.fill.along_m=[-2, 3]" }));
  EXPECT_NO_THROW(parse_scene(solid_scene, "", { "probes={ push: { surface: hull_bulkhead_fore_port } }" }));
}

}  // namespace
}  // namespace geocontainer_mpm::scene
