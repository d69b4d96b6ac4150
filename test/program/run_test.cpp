/// Good runs: results, record, options; and what signals leave behind.

#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <thread>

#include "simulate_process.h"

namespace geocontainer_mpm::test {
namespace {

using Json = nlohmann::json;

const std::string block = scene_file("block_on_incline.yaml");
constexpr double interval_s = 0.05;  ///< time.output_interval_s of the block's scene

/// The block, held by friction, for longer than any test waits.
std::vector<std::string> endless(const TemporaryFolder& folder)
{
  return { block,
           "--set",
           "time.end_s=100000",
           "--set",
           "numerics.skip_resting=false",
           "--set",
           "surfaces.plane.friction=0.7",
           "--record",
           folder.file("out.h5"),
           "--summary",
           folder.file("out.json") };
}

/// Waits until the record has grown several times, i.e. frames were written.
void wait_for_frames(const std::string& record)
{
  namespace fs = std::filesystem;
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  std::uintmax_t size = 0;
  for (int growths = 0; growths < 5;) {
    ASSERT_LT(std::chrono::steady_clock::now(), deadline) << "no frames in " << record;
    std::error_code not_there;
    const std::uintmax_t now = fs::file_size(record, not_there);
    if (!not_there && now != size) {
      size = now;
      ++growths;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

void expect_regular_frames(const std::vector<double>& times)
{
  ASSERT_GE(times.size(), 2u);
  EXPECT_EQ(times.front(), 0.0);
  for (std::size_t i = 1; i + 1 < times.size(); ++i)  // the last one may be where the run was stopped
    EXPECT_NEAR(times[i] - times[i - 1], interval_s, 0.5 * interval_s);
  EXPECT_GT(times.back(), times[times.size() - 2]);
}

TEST(Simulate, CompletesARunAndReportsIt)
{
  const TemporaryFolder folder;
  const Result result = simulate(folder, { block, "--until", "0.2", "--threads", "1", "--record", folder.file("out.h5"),
                                           "--summary", folder.file("out.json") });
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.err, "") << "no progress bar where no terminal is";
  EXPECT_NE(result.out.find("block_on_incline: none"), std::string::npos) << result.out;

  const Json summary = Json::parse(read_text(folder.file("out.json")));
  for (const char* key : { "scene",
                           "particles",
                           "steps",
                           "simulated_time_s",
                           "wall_time_s",
                           "real_time_factor",
                           "threads",
                           "outcome",
                           "release_time_s",
                           "peak_tension_n_per_m",
                           "peak_tension_time_s",
                           "peak_tension_position_m",
                           "residual_tension_n_per_m",
                           "geotextile_elongation_max",
                           "container_centroid_m",
                           "container_width_m",
                           "container_height_m",
                           "energy",
                           "momentum_error",
                           "min_dt_s",
                           "max_dt_s",
                           "skipped",
                           "rejected_samples",
                           "gaps",
                           "digest",
                           "completed",
                           "stages",
                           "soil_volume_change" })
    EXPECT_TRUE(summary.contains(key)) << key;
  for (const char* key : { "kinetic", "elastic", "potential", "dissipated", "work_in", "relative_balance_error" })
    EXPECT_TRUE(summary.at("energy").at(key).is_number()) << key;
  EXPECT_EQ(summary.at("completed"), true);
  EXPECT_EQ(summary.at("outcome"), "none");
  EXPECT_EQ(summary.at("threads"), 1);
  EXPECT_TRUE(summary.at("peak_tension_n_per_m").is_null()) << "a scene without a geotextile";
  EXPECT_NEAR(summary.at("simulated_time_s").get<double>(), 0.2, 0.01);
  EXPECT_GT(summary.at("steps").get<int>(), 10);
  EXPECT_GT(summary.at("min_dt_s").get<double>(), 0.0);
  EXPECT_GE(summary.at("max_dt_s").get<double>(), summary.at("min_dt_s").get<double>());
  // 0.5 m2 of block; it has begun to slide.
  EXPECT_NEAR(summary.at("soil_volume_m2").get<double>(), 0.5, 0.01);
  EXPECT_LT(summary.at("container_centroid_m").at(1).get<double>(), 0.0);

  const std::vector<double> times = frame_times(folder.file("out.h5"));
  EXPECT_EQ(times.size(), 5u);
  expect_regular_frames(times);
  EXPECT_EQ(simulate(folder, { "--show", folder.file("out.json") }).out, result.out);
  for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
    EXPECT_NE(entry.path().extension(), ".part") << "the summary was not written at once";
}

TEST(Simulate, GivesTheSameStateAgainAndAnotherWithAnotherValue)
{
  const TemporaryFolder folder;
  const auto digest = [&](std::vector<std::string> more) {
    std::vector<std::string> arguments = { block, "--until", "0.05", "--summary", folder.file("out.json") };
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Result result = simulate(folder, arguments);
    EXPECT_EQ(result.status, 0) << result.err;
    return Json::parse(read_text(folder.file("out.json"))).at("digest").get<std::string>();
  };
  const std::string first = digest({ "--threads", "1" });
  EXPECT_EQ(first.size(), 16u);
  EXPECT_EQ(digest({ "--threads", "1" }), first);
  EXPECT_EQ(digest({ "--threads", "2" }), first);
  EXPECT_NE(digest({ "--set", "surfaces.plane.friction=0.5", "--threads", "1" }), first);
}

TEST(Simulate, CountsRejectedSamplesOfALogInsteadOfFailing)
{
  const TemporaryFolder folder;
  // Today's epoch, in the spreadsheet's manner: byte order mark, CR LF. One NaN, one duplicate, one out of range.
  const std::string log = folder.write("log.csv",
                                       "\xEF\xBB\xBFtime_s,port_rad,starboard_rad\r\n"
                                       "1750150800.000000001,0,0\r\n"
                                       "1750150800.05,nan,0\r\n"
                                       "1750150800.10,0,0\r\n"
                                       "1750150800.10,0,0\r\n"
                                       "1750150800.15,3.0,0\r\n"
                                       "1750150800.20,0,0\r\n");
  const Result result = simulate(
      folder, { scene_file("release.yaml"), "--angles", log, "--until", "0.05", "--set", "grid.cell_size_m=0.2",
                "--set", "geotextiles.container.segment_length_m=0.2", "--summary", folder.file("out.json") });
  ASSERT_EQ(result.status, 0) << result.err;
  const Json summary = Json::parse(read_text(folder.file("out.json")));
  EXPECT_EQ(summary.at("accepted_samples"), 3);
  EXPECT_EQ(summary.at("rejected_samples").at("non_finite"), 1);
  EXPECT_EQ(summary.at("rejected_samples").at("duplicate"), 1);
  EXPECT_EQ(summary.at("rejected_samples").at("out_of_range"), 1);
  EXPECT_EQ(summary.at("outcome"), "waiting");
}

#ifdef GEOCONTAINER_MPM_WITH_ROS
TEST(Simulate, SeesTheSameLogInABagAndInACsvFile)
{
  const TemporaryFolder folder;
  const auto summary = [&](const char* option, const char* log) {
    const Result result = simulate(
        folder, { scene_file("release.yaml"), option, std::string(GEOCONTAINER_MPM_SOURCE_DIR "/config/logs/") + log,
                  "--until", "12", "--set", "grid.cell_size_m=0.2", "--set",
                  "geotextiles.container.segment_length_m=0.2", "--summary", folder.file("out.json") });
    EXPECT_EQ(result.status, 0) << result.err;
    return Json::parse(read_text(folder.file("out.json")));
  };
  const Json bag = summary("--bag", "release.bag");
  const Json csv = summary("--angles", "release.csv");
  EXPECT_EQ(bag.at("outcome"), "releasing") << "the hull has begun to open";
  EXPECT_EQ(bag.at("digest"), csv.at("digest"));
  EXPECT_EQ(bag.at("rejected_samples"), csv.at("rejected_samples"));
  EXPECT_EQ(bag.at("gaps"), csv.at("gaps"));
}
#endif

TEST(Simulate, StopsWithStatus3WhereTheSolverHasTo)
{
  const TemporaryFolder folder;
  // A grid that ends below the block: material that leaves through a free face ends the run.
  const Result result = simulate(folder, { block, "--set", "grid.lower_m=[-1.5, -0.8]", "--record",
                                           folder.file("out.h5"), "--summary", folder.file("out.json") });
  EXPECT_EQ(result.status, 3) << result.err;
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  EXPECT_NE(result.err.find("block_on_incline.yaml: the solver stopped at"), std::string::npos) << result.err;
  EXPECT_EQ(Json::parse(read_text(folder.file("out.json"))).at("completed"), false);
  expect_regular_frames(frame_times(folder.file("out.h5")));
}

TEST(Simulate, AnswersHelpAndVersion)
{
  const TemporaryFolder folder;
  const Result help = simulate(folder, { "--help" });
  EXPECT_EQ(help.status, 0);
  EXPECT_NE(help.out.find("--angles LOG.csv"), std::string::npos) << help.out;
  const Result version = simulate(folder, { "--version" });
  EXPECT_EQ(version.status, 0);
  EXPECT_EQ(version.out.rfind("simulate ", 0), 0u) << version.out;
}

class SignalTest : public testing::TestWithParam<int> {};

TEST_P(SignalTest, ClosesRecordAndSummary)
{
  const TemporaryFolder folder;
  SimulateProcess process(folder.path(), endless(folder));
  wait_for_frames(folder.file("out.h5"));
  process.send(GetParam());
  const Result result = process.wait();
  EXPECT_EQ(result.status, 128 + GetParam()) << result.err;
  expect_regular_frames(frame_times(folder.file("out.h5")));
  const Json summary = Json::parse(read_text(folder.file("out.json")));
  EXPECT_EQ(summary.at("completed"), false);
  EXPECT_GT(summary.at("simulated_time_s").get<double>(), 0.0);
}

INSTANTIATE_TEST_SUITE_P(InterruptAndTerminate, SignalTest, testing::Values(SIGINT, SIGTERM),
                         [](const auto& test) { return test.param == SIGINT ? "SIGINT" : "SIGTERM"; });

TEST(Simulate, LeavesAReadableRecordWhenKilled)
{
  const TemporaryFolder folder;
  SimulateProcess process(folder.path(), endless(folder));
  wait_for_frames(folder.file("out.h5"));
  process.send(SIGKILL);
  EXPECT_EQ(process.wait().status, 1000 + SIGKILL);
  expect_regular_frames(frame_times(folder.file("out.h5")));
}

}  // namespace
}  // namespace geocontainer_mpm::test
