/// Every bad input ends with status 2 and one line on stderr that names what is wrong.

#include <gtest/gtest.h>

#include <algorithm>

#include "simulate_process.h"

namespace geocontainer_mpm::test {
namespace {

const std::string block = scene_file("block_on_incline.yaml");
const std::string release = scene_file("release.yaml");

/// Arguments and files in which FOLDER stands for the folder of the test.
struct BadInput {
  std::string name;
  std::vector<std::string> arguments;
  std::vector<std::string> named;  ///< what the line has to name
  std::string file, text;          ///< written first, if `file` is not empty
};

std::string in_folder(std::string text, const TemporaryFolder& folder)
{
  const std::string mark = "FOLDER";
  for (std::size_t at = text.find(mark); at != std::string::npos; at = text.find(mark, at))
    text.replace(at, mark.size(), folder.path().string());
  return text;
}

class BadInputTest : public testing::TestWithParam<BadInput> {};

TEST_P(BadInputTest, EndsWithStatus2AndOneLineThatNamesIt)
{
  const TemporaryFolder folder;
  const BadInput& bad = GetParam();
  if (!bad.file.empty())
    folder.write(bad.file, bad.text);
  std::vector<std::string> arguments;
  for (const std::string& argument : bad.arguments)
    arguments.push_back(in_folder(argument, folder));

  const Result result = simulate(folder, arguments);

  EXPECT_EQ(result.status, 2) << result.out << result.err;
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  EXPECT_EQ(result.out, "");
  for (const std::string& word : bad.named)
    EXPECT_NE(result.err.find(in_folder(word, folder)), std::string::npos)
        << "'" << word << "' is not named in: " << result.err;
}

BadInput csv(const std::string& name, const std::string& text, const std::vector<std::string>& named)
{
  return { name, { release, "--angles", "FOLDER/log.csv" }, named, "log.csv", text };
}

BadInput scene_text(const std::string& name, const std::string& text, const std::vector<std::string>& named)
{
  return { name, { "FOLDER/scene.yaml" }, named, "scene.yaml", text };
}

BadInput set(const std::string& name, const std::string& assignment, const std::vector<std::string>& named)
{
  return { name, { block, "--set", assignment }, named, "", "" };
}

const std::string header = "time_s,port_rad,starboard_rad\n";

INSTANTIATE_TEST_SUITE_P(
    CommandLine, BadInputTest,
    testing::Values(
        BadInput{ "no_scene", {}, { "SCENE.yaml" }, "", "" },
        BadInput{ "unknown_option", { block, "--fast" }, { "--fast" }, "", "" },
        BadInput{ "second_scene", { block, "other.yaml" }, { "other.yaml" }, "", "" },
        BadInput{ "threads_zero", { block, "--threads", "0" }, { "--threads", "0", "1" }, "", "" },
        BadInput{ "threads_negative", { block, "--threads=-2" }, { "--threads", "-2" }, "", "" },
        BadInput{ "threads_text", { block, "--threads", "many" }, { "--threads", "many" }, "", "" },
        BadInput{ "threads_fraction", { block, "--threads", "1.5" }, { "--threads", "1.5" }, "", "" },
        BadInput{ "until_text", { block, "--until", "noon" }, { "--until", "noon" }, "", "" },
        BadInput{ "until_zero", { block, "--until", "0" }, { "--until", "> 0" }, "", "" },
        BadInput{ "until_nan", { block, "--until", "nan" }, { "--until", "nan" }, "", "" },
        BadInput{ "until_infinite", { block, "--until", "inf" }, { "--until", "inf" }, "", "" },
        BadInput{ "value_missing", { block, "--record" }, { "--record" }, "", "" },
        BadInput{ "bag_and_angles", { release, "--bag", "a", "--angles", "b" }, { "--bag", "--angles" }, "", "" },
        BadInput{ "topic_without_bag", { release, "--opening-topic", "a" }, { "--opening-topic", "--bag" }, "", "" },
        BadInput{ "log_without_hull",
                  { block, "--angles", "FOLDER/log.csv" },
                  { "block_on_incline.yaml", "hull" },
                  "log.csv",
                  header + "0,0,0\n" },
        BadInput{
            "record_in_no_folder", { block, "--record", "FOLDER/no/out.h5" }, { "--record", "FOLDER/no" }, "", "" },
        BadInput{ "record_is_folder", { block, "--record", "FOLDER" }, { "--record", "directory" }, "", "" },
        BadInput{ "summary_in_no_folder",
                  { block, "--summary", "FOLDER/no/out.json" },
                  { "--summary", "FOLDER/no" },
                  "",
                  "" },
        BadInput{ "summary_is_record",
                  { block, "--summary", "FOLDER/a", "--record", "FOLDER/a" },
                  { "--summary", "--record" },
                  "",
                  "" }),
    [](const auto& test) { return test.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Scene, BadInputTest,
    testing::Values(
        BadInput{ "missing_file", { "FOLDER/none.yaml" }, { "FOLDER/none.yaml" }, "", "" },
        BadInput{ "folder", { "FOLDER" }, { "FOLDER" }, "", "" }, scene_text("empty", "", { "FOLDER/scene.yaml" }),
        scene_text("no_yaml", "a: [1, 2\nb: }", { "FOLDER/scene.yaml" }),
        scene_text("unknown_top_key", read_text(block) + "\nfriction: 1\n", { "FOLDER/scene.yaml", "friction" }),
        scene_text("key_twice", read_text(block) + "\ntime: { end_s: 1 }\n", { "FOLDER/scene.yaml", "time", "twice" }),
        set("unknown_key", "surfaces.plane.frction=0.3", { "surfaces.plane.frction" }),
        set("unknown_material", "materials.clay.poisson_ratio=0.3", { "materials.clay" }),
        set("no_assignment", "surfaces.plane.friction", { "surfaces.plane.friction" }),
        set("negative", "surfaces.plane.friction=-0.3", { "surfaces.plane.friction", "-0.3" }),
        set("not_a_number", "time.end_s=.nan", { "time.end_s", "nan" }),
        set("text_for_number", "materials.block.young_modulus_pa=stiff",
            { "materials.block.young_modulus_pa", "stiff" }),
        set("out_of_range", "materials.block.poisson_ratio=0.5", { "materials.block.poisson_ratio", "0.5", "0.49" }),
        set("unknown_law", "materials.block.law=clay", { "materials.block.law", "clay", "linear_elastic" }),
        set("number_for_list", "gravity_m_per_s2=9.81", { "gravity_m_per_s2", "9.81" })),
    [](const auto& test) { return test.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Angles, BadInputTest,
    testing::Values(
        BadInput{
            "missing_file", { release, "--angles", "FOLDER/none.csv" }, { "--angles", "FOLDER/none.csv" }, "", "" },
        BadInput{ "folder", { release, "--angles", "FOLDER" }, { "--angles", "directory" }, "", "" },
        csv("empty", "", { "log.csv:1", "time_s,port_rad,starboard_rad" }),
        csv("no_header", "0,0,0\n1,0,0\n", { "log.csv:1", "0,0,0", "time_s,port_rad,starboard_rad" }),
        csv("columns_swapped", "time_s,starboard_rad,port_rad\n0,0,0\n", { "log.csv:1", "header" }),
        csv("no_sample", header, { "log.csv", "no sample" }),
        csv("text", header + "0,0,0\n0.05,zero,0\n", { "log.csv:3", "port_rad", "zero" }),
        csv("number_with_tail", header + "0,0,0deg\n", { "log.csv:2", "starboard_rad", "0deg" }),
        csv("empty_field", header + "0,,0\n", { "log.csv:2", "port_rad" }),
        csv("field_missing", header + "0,0\n", { "log.csv:2", "starboard_rad", "2 fields" }),
        csv("field_too_many", header + "0,0,0,0\n", { "log.csv:2", "4 fields" }),
        csv("semicolons", header + "0;0;0\n", { "log.csv:2", "0;0;0" }),
        csv("time_not_finite", header + "nan,0,0\n", { "log.csv:2", "time_s", "nan" }),
        csv("time_overflow", header + "1e300,0,0\n", { "log.csv:2", "time_s", "1e300" }),
        csv("nothing_believable", header + "0,nan,0\n1,9,9\n", { "log.csv", "2 samples" })),
    [](const auto& test) { return test.param.name; });

#ifdef GEOCONTAINER_MPM_WITH_ROS
BadInput bag(const std::string& name, const std::string& content, const std::vector<std::string>& more,
             const std::vector<std::string>& named)
{
  std::vector<std::string> arguments = { release, "--bag", "FOLDER/log.bag" };
  arguments.insert(arguments.end(), more.begin(), more.end());
  return { name, arguments, named, "log.bag", content };
}

const std::string good_bag = read_text(GEOCONTAINER_MPM_SOURCE_DIR "/config/logs/release.bag");

INSTANTIATE_TEST_SUITE_P(
    Bag, BadInputTest,
    testing::Values(
        BadInput{ "missing_file", { release, "--bag", "FOLDER/none.bag" }, { "--bag", "FOLDER/none.bag" }, "", "" },
        BadInput{ "folder", { release, "--bag", "FOLDER" }, { "--bag", "FOLDER" }, "", "" },
        bag("empty", "", {}, { "--bag", "log.bag" }), bag("no_bag", "time,angle\n", {}, { "--bag", "log.bag" }),
        bag("cut_off", good_bag.substr(0, good_bag.size() / 2), {}, { "--bag", "log.bag" }),
        bag("unknown_topic", good_bag, { "--opening-topic", "opening" }, { "log.bag", "opening", "hull_opening" }),
        bag("topic_of_other_type", good_bag, { "--opening-topic", "tf" }, { "log.bag", "/tf", "tf2_msgs/TFMessage" })),
    [](const auto& test) { return test.param.name; });
#else
INSTANTIATE_TEST_SUITE_P(
    Bag, BadInputTest,
    testing::Values(BadInput{
        "without_ros", { release, "--bag", "log.bag" }, { "--bag", "built without ROS" }, "", "" }),
    [](const auto& test) { return test.param.name; });
#endif

INSTANTIATE_TEST_SUITE_P(
    Show, BadInputTest,
    testing::Values(BadInput{ "missing_file", { "--show", "FOLDER/a" }, { "--show", "FOLDER/a" }, "", "" },
                    BadInput{ "folder", { "--show", "FOLDER" }, { "--show", "FOLDER" }, "", "" },
                    BadInput{ "no_summary", { "--show", "FOLDER/a" }, { "--show", "no summary" }, "a", "{}" }),
    [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace geocontainer_mpm::test
