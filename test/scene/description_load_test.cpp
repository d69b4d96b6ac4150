// Good scenes: what is read is what the file says, and what is written reads back.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "description_fixture.h"
#include "geocontainer_mpm/scene/description.h"

namespace geocontainer_mpm::scene {
namespace {

TEST(DescriptionLoad, ReadsEverySection)
{
  const SceneDescription scene = parse_scene(small_scene, "small.yaml");
  EXPECT_EQ(scene.source, "small.yaml");
  EXPECT_EQ(scene.name, "small");
  EXPECT_EQ(scene.time.end_s, 2.0);
  EXPECT_EQ(scene.grid.lower_m, Vec2(-4.0, -6.0));
  EXPECT_EQ(scene.grid.faces[0], FaceCondition::free);
  EXPECT_EQ(scene.grid.faces[1], FaceCondition::roller);
  EXPECT_EQ(scene.grid.faces[2], FaceCondition::fixed);
  EXPECT_EQ(scene.materials.at("sand").law, material::LawName::mohr_coulomb);
  EXPECT_EQ(scene.materials.at("sand").dilation_angle_deg, 2.0);
  EXPECT_EQ(scene.materials.at("rubber").young_modulus_pa, 1.0e5);
  EXPECT_EQ(scene.bodies.at("fill").initial_stress, InitialStress::k0);
  EXPECT_EQ(scene.bodies.at("fill").shape.hopper_fill->area_m2, 3.0);
  EXPECT_EQ(scene.bodies.at("block").shape.box->rotation_deg, 10.0);
  EXPECT_EQ(scene.bodies.at("block").initial_velocity_m_per_s, Vec2(0.5, 0.0));
  EXPECT_EQ(scene.bodies.at("ball").shape.disc->radius_m, 0.5);
  EXPECT_FALSE(scene.bodies.at("ball").shape.box);
  EXPECT_EQ(scene.bodies.at("wedge").shape.polygon->vertices_m.at(2), Vec2(-3.0, -5.0));
  EXPECT_EQ(scene.geotextiles.at("bag").encloses, "fill");
  ASSERT_TRUE(scene.hull);
  EXPECT_EQ(scene.hull->port_section_m.size(), 5u);
  EXPECT_EQ(scene.hull->opening_table.at(1).time_s, 10.0);
  EXPECT_EQ(scene.hull->opening_table.at(1).port_rad, 0.3);
  EXPECT_EQ(scene.hull->opening_table.at(1).starboard_rad, 0.25);
  EXPECT_EQ(scene.hull->signal.max_gap_s, 1.0);
  EXPECT_EQ(scene.surfaces.at("bed").line_m.at(1), Vec2(4.0, -5.5));
}

TEST(DescriptionLoad, LeavesOptionalKeysAtTheirDefaults)
{
  const SceneDescription scene = parse_scene(small_scene, "small.yaml");
  const SceneDescription fresh;
  EXPECT_EQ(scene.gravity_m_per_s2, fresh.gravity_m_per_s2);
  EXPECT_EQ(scene.time.output_interval_s, fresh.time.output_interval_s);
  EXPECT_EQ(scene.numerics.time_step_factor, fresh.numerics.time_step_factor);
  EXPECT_EQ(scene.geotextiles.at("bag").seam_efficiency, GeotextileDescription{}.seam_efficiency);
  EXPECT_EQ(scene.hull->signal.noise_rad, barge::OpeningSignalParameters{}.noise_rad);
}

TEST(DescriptionLoad, OverridesAnyKey)
{
  const SceneDescription scene = parse_scene(
      small_scene, "small.yaml",
      { "materials.sand.young_modulus_pa=5e6", "bodies.fill.shape.hopper_fill.area_m2=2.5",
        "hull.signal.max_gap_s=0.25", "hull.signal.noise_rad=0.01", "numerics.skip_resting=false",
        "grid.faces.y_min=fixed", "gravity_m_per_s2=[0, -1.62]", "name=moon",
        "bodies.ball.shape={box: {lower_m: [-2, -4], upper_m: [-1, -3]}}", "hull.friction=0.3", "hull.friction=0.4" });
  EXPECT_EQ(scene.materials.at("sand").young_modulus_pa, 5e6);
  EXPECT_EQ(scene.bodies.at("fill").shape.hopper_fill->area_m2, 2.5);
  EXPECT_EQ(scene.hull->signal.max_gap_s, 0.25);
  EXPECT_EQ(scene.hull->signal.noise_rad, 0.01);
  EXPECT_FALSE(scene.numerics.skip_resting.value());
  EXPECT_EQ(scene.grid.faces[0], FaceCondition::fixed);
  EXPECT_EQ(scene.gravity_m_per_s2, Vec2(0.0, -1.62));
  EXPECT_EQ(scene.name, "moon");
  EXPECT_TRUE(scene.bodies.at("ball").shape.box);
  EXPECT_FALSE(scene.bodies.at("ball").shape.disc);
  EXPECT_EQ(scene.hull->friction, 0.4) << "the last of two overrides of a key counts";
}

TEST(DescriptionLoad, OverrideOfAnAliasLeavesItsAnchorAlone)
{
  std::string text = small_scene;
  const std::string ball =
      "  ball:\n    material: rubber\n    shape:\n      disc: { center_m: [-2, -4], radius_m: 0.5 }\n";
  ASSERT_NE(text.find(ball), std::string::npos);
  text.replace(text.find(ball), ball.size(),
               "  ball: &ball\n    material: rubber\n    shape:\n      disc: { center_m: [-2, -4], radius_m: 0.5 }\n"
               "  twin: *ball\n");
  const SceneDescription scene = parse_scene(text, "alias.yaml", { "bodies.twin.shape.disc.radius_m=0.25" });
  EXPECT_EQ(scene.bodies.at("twin").shape.disc->radius_m, 0.25);
  EXPECT_EQ(scene.bodies.at("ball").shape.disc->radius_m, 0.5);
}

TEST(DescriptionLoad, WrittenSceneReadsBackToTheSameText)
{
  const SceneDescription scene =
      parse_scene(small_scene, "small.yaml",
                  { "materials.sand.poisson_ratio=0.30000000000000004", "time.end_s=1.2345678901234567e-3",
                    "description=\"a: 'b' \\\"c\\\" #d\"" });
  const std::string text = scene_text(scene);
  const SceneDescription again = parse_scene(text, "written.yaml");
  EXPECT_EQ(scene_text(again), text);
  EXPECT_EQ(again.materials.at("sand").poisson_ratio, 0.30000000000000004);
  EXPECT_EQ(again.time.end_s, 1.2345678901234567e-3);
  EXPECT_EQ(again.description, "a: 'b' \"c\" #d");
  EXPECT_EQ(again.bodies.at("wedge").shape.polygon->vertices_m, scene.bodies.at("wedge").shape.polygon->vertices_m);
  EXPECT_NE(text.find("seam_efficiency: 0.85"), std::string::npos) << "defaults are written out";
}

TEST(DescriptionLoad, EverySceneFileOfThePackageLoads)
{
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(source_dir + "/config/scenes")) {
    if (entry.path().extension() != ".yaml")
      continue;
    SCOPED_TRACE(entry.path());
    SceneDescription scene;
    ASSERT_NO_THROW(scene = load_scene(entry.path().string())) << "see the message";
    EXPECT_EQ(scene.name, entry.path().stem().string());
    EXPECT_FALSE(scene.description.empty());
    ++files;
  }
  EXPECT_GE(files, 4);
}

TEST(DescriptionLoad, ReleaseSceneRunsCoarseByOverride)
{
  const SceneDescription scene = load_scene(source_dir + "/config/scenes/release.yaml",
                                            { "grid.cell_size_m=0.2", "geotextiles.container.segment_length_m=0.2" });
  EXPECT_EQ(scene.grid.cell_size_m, 0.2);
}

}  // namespace
}  // namespace geocontainer_mpm::scene
