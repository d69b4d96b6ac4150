/// A run that is saved, thrown away and loaded goes on bit for bit, whatever is in the scene.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <sstream>

#include "geocontainer_mpm/error.h"
#include "geocontainer_mpm/record/checkpoint.h"

namespace geocontainer_mpm::record {
namespace {

using scene::Advance;
using scene::SceneDescription;
using scene::Simulation;

class CheckpointFile {
public:
  CheckpointFile() : path_(testing::TempDir() + "checkpoint_XXXXXX")
  {
    const int file = mkstemp(path_.data());
    EXPECT_GE(file, 0);
    close(file);
  }
  ~CheckpointFile() { std::filesystem::remove(path_); }
  CheckpointFile(const CheckpointFile&) = delete;
  CheckpointFile& operator=(const CheckpointFile&) = delete;

  const std::string& path() const { return path_; }

private:
  std::string path_;
};

/// All that a run says of itself, but for what clocks on the wall say.
std::string all_of(const Simulation& simulation)
{
  auto summary = nlohmann::ordered_json::parse(scene::summary_json(simulation, 1.0, 1));
  summary.erase("stages");
  return summary.dump(1);
}

std::string frame_of(const Simulation& simulation)
{
  const scene::Frame frame = simulation.frame();
  std::ostringstream text;
  text << std::hexfloat << frame.time_s << " " << frame.stamp_ns << " " << frame.step << " " << frame.dt_s;
  for (const scene::BoundaryFrame& boundary : frame.boundary)
    text << " " << boundary.angle_rad << " " << boundary.force.transpose();
  for (const scene::GeotextileFrame& sheet : frame.geotextile)
    for (const double tension : sheet.gauge_tension)
      text << " " << tension;
  for (const scene::ProbeFrame& probe : frame.probes)
    for (const double time_s : probe.time_s)
      text << " " << time_s;
  return text.str();
}

/// Until so many steps are done, the end, or what is known of the opening runs out.
Advance run_to_step(Simulation& simulation, std::uint64_t step)
{
  Advance now = Advance::stepped;
  while (simulation.counters().steps < step && now != Advance::finished && now != Advance::stopped &&
         now != Advance::waiting)
    now = simulation.advance(1);
  return now;
}

struct Case {
  const char* name;
  const char* file;  ///< below the sources
  std::vector<std::string> overrides;
  std::uint64_t steps;                              ///< that are looked at
  std::function<bool(const Simulation&)> happened;  ///< what the case is for, at the end
};

void PrintTo(const Case& one, std::ostream* out)
{
  *out << one.name;
}

std::vector<std::string> coarse(std::vector<std::string> more)
{
  std::vector<std::string> overrides = { "grid.cell_size_m=0.4", "grid.upper_m=[6, 0.8]",
                                         "geotextiles.container.segment_length_m=0.4",
                                         "hull.opening_table=[[0, 0, 0], [0.2, 0, 0], [1.2, 0.365, 0.365]]" };
  overrides.insert(overrides.end(), more.begin(), more.end());
  return overrides;
}

bool moved(const Simulation& simulation)
{
  return simulation.status().outcome == scene::Outcome::releasing && simulation.status().peak_tension_n_per_m > 0.0;
}

const std::vector<Case>& cases()
{
  static const std::vector<Case> all = {
    { "bonded", "config/scenes/release.yaml",
      coarse({ "probes.tension={geotextile: {name: container}}", "probes.hull={surface: hull_port}",
               "probes.sand={body: sand}", "time.probe_interval_s=0.03" }),
      400, moved },
    { "frictional", "config/scenes/release.yaml",
      coarse({ "geotextiles.container.interface=frictional", "geotextiles.container.interface_friction=0.4" }), 400,
      moved },
    { "water", "config/scenes/release_water.yaml", coarse({}), 400,
      [](const Simulation& s) { return moved(s) && s.water()->drag_impulse.norm() > 0.0; } },
    { "frictional_in_water", "config/scenes/release_water.yaml",
      coarse({ "geotextiles.container.interface=frictional", "geotextiles.container.interface_friction=0.4" }), 400,
      moved },
    { "membrane_points", "config/scenes/release.yaml",
      coarse({ "geotextiles.container.formulation=membrane_points", "geotextiles.container.segment_length_m=0.2" }),
      400, moved },
    { "rupture_with_seams", "config/scenes/release.yaml",
      coarse({ "geotextiles.container.rupture_strain=0.02", "geotextiles.container.seams={keel: {along: 0.5}}" }), 640,
      [](const Simulation& s) { return s.status().ruptures > 0; } },
    { "two_containers",
      "config/scenes/two_containers.yaml",
      { "grid.cell_size_m=0.2", "geotextiles.lower.segment_length_m=0.2", "geotextiles.upper.segment_length_m=0.2",
        "bodies.upper_sand.held_until_s=0.1", "geotextiles.lower.interface=frictional",
        "geotextiles.lower.interface_friction=0.5" },
      700,
      [](const Simulation& s) { return s.status().containers.at(0).episodes.size() == 1; } },
    { "half_in_space",
      "config/scenes/release_3d.yaml",
      { "grid.cell_size_m=0.5", "grid.upper_m=[7, 1]", "geotextiles.container.segment_length_m=0.5",
        "space={along_m: [-2, 2], x_min: roller, x_max: roller, symmetry: half}", "bodies.sand.along_m=[-1.5, 1.5]",
        "hull.along_m=[-1.5, 1.5]", "hull.opening_table=[[0, 0, 0], [0.1, 0, 0], [1.1, 0.365, 0.365]]",
        "geotextiles.container.rupture_strain=0.01" },
      250,
      [](const Simulation& s) { return s.status().peak_tension_n_per_m > 0.0; } },
    { "triangles_consistent_mass",
      "config/scenes/verification/vibrating_bar.yaml",
      { "numerics.shape=linear_simplex", "numerics.transfer=flip", "numerics.mass=consistent", "numerics.update=usf" },
      90,
      [](const Simulation& s) { return s.counters().steps == 90; } },
    { "tractions",
      "config/scenes/verification/pressurised_cylinder.yaml",
      {},
      200,
      [](const Simulation& s) { return s.counters().steps == 200; } },
    { "held_ends",
      "config/scenes/verification/stretched_string.yaml",
      {},
      200,
      [](const Simulation& s) { return s.counters().steps == 200; } },
    { "manufactured_gimp",
      "config/scenes/verification/vortex.yaml",
      { "numerics.shape=gimp" },
      60,
      [](const Simulation& s) { return s.counters().steps == 60; } },
    { "fluid",
      "config/scenes/verification/fluid_column.yaml",
      {},
      200,
      [](const Simulation& s) { return s.counters().steps == 200; } },
  };
  return all;
}

class CheckpointOf : public testing::TestWithParam<Case> {};

/// Saved at instants that are no outputs, in the midst of what is remembered from step to step. Looked at where the
/// reference run is after as many steps, in every figure of the summary, the digest and what a frame has besides.
TEST_P(CheckpointOf, EndsWhereTheUndisturbedRunEnds)
{
  const Case& one = GetParam();
  const SceneDescription description =
      scene::load_scene(std::string(GEOCONTAINER_MPM_SOURCE_DIR) + "/" + one.file, one.overrides);
  Simulation reference(description, 1);
  reference.use_scene_opening();
  const std::vector<double> parts = { 0.0, 0.13, 0.37, 0.5, 0.71, 0.93 };
  std::vector<CheckpointFile> files(parts.size());
  for (std::size_t i = 0; i < parts.size(); ++i) {
    run_to_step(reference, 1 + static_cast<std::uint64_t>(parts[i] * static_cast<double>(one.steps)));
    ASSERT_EQ(save_checkpoint(reference, opening_hash({}), files[i].path()), "");
  }
  run_to_step(reference, one.steps);
  ASSERT_EQ(reference.counters().steps, one.steps);
  ASSERT_TRUE(one.happened(reference)) << all_of(reference);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    SCOPED_TRACE(fmt::format("saved at {} of the steps", parts[i]));
    Simulation resumed = load_checkpoint(files[i].path(), description, opening_hash({}), 2);
    EXPECT_LT(resumed.counters().steps, one.steps);
    EXPECT_GT(resumed.counters().steps + 64, parts[i] * static_cast<double>(one.steps)) << "not far back";
    run_to_step(resumed, one.steps);
    ASSERT_EQ(all_of(resumed), all_of(reference));
    ASSERT_EQ(frame_of(resumed), frame_of(reference));
  }
  // What reset() goes back to is in the file as well.
  Simulation resumed = load_checkpoint(files.back().path(), description, opening_hash({}), 1);
  reference.reset();
  resumed.reset();
  for (Simulation* again : { &reference, &resumed }) {
    again->use_scene_opening();
    run_to_step(*again, 40);
  }
  EXPECT_EQ(all_of(resumed), all_of(reference));
}

INSTANTIATE_TEST_SUITE_P(Scenes, CheckpointOf, testing::ValuesIn(cases()),
                         [](const auto& test) { return std::string(test.param.name); });

SceneDescription coarse_release(std::vector<std::string> more = {})
{
  return scene::load_scene(GEOCONTAINER_MPM_SOURCE_DIR "/config/scenes/release.yaml", coarse(std::move(more)));
}

/// A log with noise, a gap and a spike, of which the first part is known when the run is saved.
std::vector<barge::OpeningSample> noisy_log()
{
  std::vector<barge::OpeningSample> samples;
  for (int i = 0; i < 60; ++i) {
    const double time_s = 0.05 * i, angle = std::min(0.365, 0.08 * std::max(0.0, time_s - 0.4));
    if (i < 22 || i > 34)
      samples.push_back({ 1'750'000'000'000'000'000 + i * 50'000'000LL,
                          { angle + 0.001 * (i % 3), i == 15 ? 0.6 : angle + 0.0015 * (i % 2) } });
  }
  return samples;
}

TEST(Checkpoint, TakesTheOpeningSignalAlongInTheMiddleOfALog)
{
  const SceneDescription description = coarse_release({ "time.end_s=2.4" });
  const std::vector<barge::OpeningSample> log = noisy_log();
  Simulation undisturbed(description, 1);
  Simulation live(description, 1);
  const std::size_t known = 30;  // within the first samples after the gap
  for (std::size_t i = 0; i < log.size(); ++i) {
    undisturbed.opening().add(log[i]);
    if (i < known)
      live.opening().add(log[i]);
  }
  undisturbed.opening().finish();
  run_to_step(undisturbed, 100000);

  run_to_step(live, 1);
  while (live.advance() != Advance::waiting) {
  }
  const CheckpointFile file;
  ASSERT_EQ(save_checkpoint(live, 0, file.path()), "");
  Simulation resumed = load_checkpoint(file.path(), description, std::nullopt, 1);
  EXPECT_EQ(resumed.opening().last_accepted().stamp_ns, live.opening().last_accepted().stamp_ns);
  for (Simulation* one : { &live, &resumed }) {
    for (std::size_t i = known; i < log.size(); ++i)
      one->opening().add(log[i]);
    one->opening().finish();
    EXPECT_EQ(run_to_step(*one, 100000), Advance::finished);
    EXPECT_EQ(one->digest(), undisturbed.digest());
    EXPECT_EQ(all_of(*one), all_of(undisturbed));
  }
}

TEST(Checkpoint, TakesStepsThatGoWrongAsTheUndisturbedRunDoes)
{
  const SceneDescription description = scene::parse_scene(R"(
name: thrown_block
gravity_m_per_s2: [0, 0]
time: { end_s: 2, output_interval_s: 0.1 }
grid: { cell_size_m: 0.1, lower_m: [0, 0], upper_m: [1, 1], faces: { y_min: free, y_max: free, z_min: free, z_max: free } }
materials:
  block: { law: linear_elastic, density_kg_per_m3: 1000, young_modulus_pa: 1.0e5, poisson_ratio: 0.3 }
bodies:
  block:
    material: block
    shape: { box: { lower_m: [0.1, 0.4], upper_m: [0.3, 0.6] } }
    initial_velocity_m_per_s: [1, 0]
numerics: { max_halvings: 3 }
)",
                                                          "thrown_block");
  Simulation undisturbed(description, 1);
  undisturbed.use_scene_opening();
  const CheckpointFile file;
  Advance now = Advance::stepped;
  while (undisturbed.counters().retries < 2 && now != Advance::stopped)
    now = undisturbed.advance(1);
  ASSERT_NE(now, Advance::stopped);
  ASSERT_EQ(save_checkpoint(undisturbed, 0, file.path()), "");
  Simulation resumed = load_checkpoint(file.path(), description, 0, 1);
  EXPECT_EQ(run_to_step(undisturbed, 100000), Advance::stopped);
  EXPECT_EQ(run_to_step(resumed, 100000), Advance::stopped);
  EXPECT_EQ(resumed.failure().reason, undisturbed.failure().reason);
  EXPECT_EQ(resumed.failure().time_s, undisturbed.failure().time_s);
  EXPECT_EQ(all_of(resumed), all_of(undisturbed));
}

TEST(Checkpoint, GoesOnBeyondAnEndThatIsAnOutputInstant)
{
  const CheckpointFile file;
  Simulation part(coarse_release({ "time.end_s=0.5" }), 1);
  part.use_scene_opening();
  run_to_step(part, 100000);
  ASSERT_EQ(save_checkpoint(part, 0, file.path()), "");
  const SceneDescription longer = coarse_release({ "time.end_s=0.9" });
  Simulation whole(longer, 1);
  whole.use_scene_opening();
  run_to_step(whole, 100000);
  Simulation resumed = load_checkpoint(file.path(), longer, 0, 1);
  EXPECT_EQ(resumed.time_s(), 0.5);
  run_to_step(resumed, 100000);
  EXPECT_EQ(all_of(resumed), all_of(whole));
}

/// The words of the error, or nothing.
std::string refusal(const std::string& path, const SceneDescription& scene, std::optional<std::uint64_t> opening)
{
  try {
    load_checkpoint(path, scene, opening, 1);
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    return error.what();
  }
  return {};
}

void write(const std::string& path, const std::string& bytes)
{
  std::ofstream(path, std::ios::binary) << bytes;
}

class RefusedCheckpoint : public testing::Test {
protected:
  RefusedCheckpoint() : scene_(coarse_release({ "time.end_s=0.25" })), simulation_(scene_, 1)
  {
    simulation_.use_scene_opening();
    run_to_step(simulation_, 5);
    EXPECT_EQ(save_checkpoint(simulation_, 7, file_.path()), "");
    std::ostringstream text;
    text << std::ifstream(file_.path(), std::ios::binary).rdbuf();
    bytes_ = text.str();
  }
  void expect_refused(const SceneDescription& scene, std::optional<std::uint64_t> opening, const std::string& words)
  {
    const std::string text = refusal(file_.path(), scene, opening);
    EXPECT_NE(text.find(words), std::string::npos) << text;
    EXPECT_NE(text.find(file_.path()), std::string::npos) << text;
  }

  SceneDescription scene_;
  Simulation simulation_;
  CheckpointFile file_;
  std::string bytes_;
};

TEST_F(RefusedCheckpoint, IsOfAnotherSceneOrLog)
{
  EXPECT_EQ(refusal(file_.path(), scene_, 7), "");
  expect_refused(scene_, 8, "is of another log of opening angles: hash 0000000000000007 there, 0000000000000008 now");
  expect_refused(coarse_release({ "hull.friction=0.3", "time.end_s=0.25" }), 7,
                 "is of another scene: 'friction: 0.2' there, 'friction: 0.3' now");
  expect_refused(coarse_release({ "time.end_s=0.5" }), 7, "between two output instants");
  // A run that was to end on an output instant may end elsewhere, but not before it was saved.
  const SceneDescription even = coarse_release({ "time.end_s=0.3" });
  Simulation ended(even, 1);
  ended.use_scene_opening();
  run_to_step(ended, 100000);
  EXPECT_EQ(save_checkpoint(ended, 7, file_.path()), "");
  expect_refused(coarse_release({ "time.end_s=0.1" }), 7, "after the end of the scene at 0.1 s");
}

TEST_F(RefusedCheckpoint, IsCutShortDamagedOrForeign)
{
  for (const double part : { 0.0, 0.3, 0.999 }) {
    write(file_.path(), bytes_.substr(0, static_cast<std::size_t>(part * static_cast<double>(bytes_.size()))));
    expect_refused(scene_, 7, part > 0.0 ? "is no checkpoint, or cut short" : "not an HDF5 file");
  }
  std::string damaged = bytes_;
  damaged[bytes_.size() / 2] ^= 1;
  write(file_.path(), damaged);
  expect_refused(scene_, 7, "is damaged");
  write(file_.path(), "time_s,port_rad,starboard_rad\n0,0,0\n");
  expect_refused(scene_, 7, "not an HDF5 file");
  std::filesystem::remove(file_.path());
  expect_refused(scene_, 7, "cannot be read");
}

TEST(Checkpoint, SaysWhatKeepsItFromBeingWritten)
{
  Simulation fresh(coarse_release(), 1);
  const CheckpointFile file;
  EXPECT_NE(save_checkpoint(fresh, 0, file.path()).find("has not begun"), std::string::npos);
  fresh.use_scene_opening();
  run_to_step(fresh, 1);
  EXPECT_NE(save_checkpoint(fresh, 0, "/nowhere/at/all.h5"), "");
  EXPECT_NE(save_checkpoint(fresh, 0, "/dev/full"), "");
}

}  // namespace
}  // namespace geocontainer_mpm::record
