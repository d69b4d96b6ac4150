#include <gtest/gtest.h>

#include <limits>

#include "geocontainer_mpm/error.h"
#include "geocontainer_mpm/ros/parameters.h"

namespace geocontainer_mpm::ros_bridge {
namespace {

using XmlRpc::XmlRpcValue;

XmlRpcValue minimal()
{
  XmlRpcValue tree;
  tree["scene"] = "release.yaml";
  return tree;
}

/// The one line with which these parameters are refused; empty when they are not.
std::string refusal(const XmlRpcValue& tree)
{
  try {
    parse_parameters(tree, "/release_node");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

template <typename Value>
std::string refusal(const char* key, const Value& value)
{
  XmlRpcValue tree = minimal();
  tree[key] = value;
  return refusal(tree);
}

bool contains(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}

TEST(Parameters, AreReadAndTheRestKeepsItsDefault)
{
  XmlRpcValue tree = minimal();
  tree["threads"] = 3;
  tree["publish_rate_hz"] = 5;  // a whole number is a number
  tree["max_future_s"] = 2.5;
  tree["autostart"] = false;
  tree["port_joint"] = "left";
  tree["scene_overrides"][0] = "hull.friction=0.3";
  tree["scene_overrides"][1] = "time.end_s=5";
  const NodeParameters parameters = parse_parameters(tree, "/node");
  EXPECT_EQ(parameters.scene, "release.yaml");
  EXPECT_EQ(parameters.threads, 3);
  EXPECT_EQ(parameters.publish_rate_hz, 5.0);
  EXPECT_EQ(parameters.max_future_s, 2.5);
  EXPECT_FALSE(parameters.autostart);
  EXPECT_EQ(parameters.joints.port, "left");
  EXPECT_EQ(parameters.joints.starboard, "hull_starboard_joint");
  EXPECT_EQ(parameters.scene_overrides, (std::vector<std::string>{ "hull.friction=0.3", "time.end_s=5" }));
  EXPECT_EQ(parameters.fixed_frame, "map");
}

TEST(Parameters, MissingSceneIsNamed)
{
  EXPECT_TRUE(contains(refusal(XmlRpcValue()), "/release_node: ~scene"));
  EXPECT_TRUE(contains(refusal("scene", ""), "~scene"));
}

TEST(Parameters, MisspeltIsRefusedWithWhatIsKnown)
{
  const std::string line = refusal("thread", 2);
  EXPECT_TRUE(contains(line, "~thread = ")) << line;
  EXPECT_TRUE(contains(line, "transport_patience_s")) << line;
  EXPECT_EQ(line.find('\n'), std::string::npos);
}

TEST(Parameters, WrongTypeRangeOrNotFiniteIsNamedWithItsValue)
{
  EXPECT_TRUE(contains(refusal("threads", 0), "~threads"));
  EXPECT_TRUE(contains(refusal("threads", 2.0), "~threads"));
  EXPECT_TRUE(contains(refusal("threads", "many"), "~threads = many"));
  EXPECT_TRUE(contains(refusal("autostart", 1), "~autostart"));
  EXPECT_TRUE(contains(refusal("scene", 5), "~scene"));
  EXPECT_TRUE(contains(refusal("publish_rate_hz", 0.0), "~publish_rate_hz"));
  EXPECT_TRUE(contains(refusal("publish_rate_hz", std::numeric_limits<double>::quiet_NaN()), "~publish_rate_hz"));
  EXPECT_TRUE(contains(refusal("max_future_s", std::numeric_limits<double>::infinity()), "~max_future_s"));
  EXPECT_TRUE(contains(refusal("time_jump_back_s", -1.0), "~time_jump_back_s"));
  EXPECT_TRUE(contains(refusal("display_width_m", -3), "~display_width_m"));
  EXPECT_TRUE(contains(refusal("soil_stride", 0), "~soil_stride"));
  EXPECT_TRUE(contains(refusal("scene_overrides", "hull.friction=0.3"), "~scene_overrides"));
  EXPECT_TRUE(contains(refusal("fixed_frame", ""), "~fixed_frame"));
  EXPECT_EQ(refusal("transport_patience_s", 0), "");  // closed at 0
}

TEST(Parameters, EqualJointNamesAreRefused)
{
  EXPECT_TRUE(contains(refusal("starboard_joint", "hull_port_joint"), "~starboard_joint"));
}

TEST(Parameters, FoldersThatAreNotThereAreRefused)
{
  EXPECT_TRUE(contains(refusal("save_directory", "/no/such/folder"), "~save_directory = /no/such/folder"));
  EXPECT_TRUE(contains(refusal("record", "/no/such/folder/r.h5"), "~record"));
}

TEST(Parameters, OfForecastsAreReadFromTheirDictionaries)
{
  XmlRpcValue tree = minimal();
  EXPECT_FALSE(parse_parameters(tree, "/node").forecast.enabled);
  tree["forecast"]["enabled"] = true;
  tree["forecast"]["horizon_s"] = 30.0;
  tree["forecast"]["ensemble"]["members"] = 8;
  tree["forecast"]["ensemble"]["distributions"] = "soil.yaml";
  tree["forecast"]["ensemble"]["scene_overrides"][0] = "grid.cell_size_m=0.4";
  tree["forecast"]["advice"]["enabled"] = true;
  tree["forecast"]["advice"]["utilisation_limit"] = 0.7;
  const ForecastParameters forecast = parse_parameters(tree, "/node").forecast;
  EXPECT_TRUE(forecast.enabled);
  EXPECT_EQ(forecast.settings.reach.horizon_s, 30.0);
  EXPECT_EQ(forecast.members, 8);
  EXPECT_EQ(forecast.ensemble_overrides, std::vector<std::string>{ "grid.cell_size_m=0.4" });
  EXPECT_EQ(forecast.advice.utilisation_limit, 0.7);
}

TEST(Parameters, OfForecastsThatDoNotFitAreNamedWithTheirDictionary)
{
  const auto with = [](const char* key, const XmlRpcValue& value) {
    XmlRpcValue tree = minimal();
    tree["forecast"][key] = value;
    return refusal(tree);
  };
  EXPECT_TRUE(contains(with("horizon_s", XmlRpcValue(0.0)), "~forecast/horizon_s"));
  EXPECT_TRUE(contains(with("horizon", XmlRpcValue(30.0)), "horizon_s"));  // what is known
  XmlRpcValue advice;
  advice["enabled"] = true;
  EXPECT_TRUE(contains(with("advice", advice), "~forecast/advice/enabled"));
  advice["enabled"] = false;
  advice["slowest_rad_per_s"] = 0.5;
  EXPECT_TRUE(contains(with("advice", advice), "~forecast/advice/slowest_rad_per_s"));
  XmlRpcValue ensemble;
  ensemble["members"] = 4;
  EXPECT_TRUE(contains(with("ensemble", ensemble), "~forecast/ensemble/distributions"));
}

TEST(Parameters, AlarmsAreADictionaryOfTheirOwn)
{
  XmlRpcValue tree = minimal();
  tree["alarms"]["lag_warn_s"] = 1;
  tree["alarms"]["lopsided_alarm_rad"] = 0.2;
  const AlarmParameters alarms = parse_parameters(tree, "/node").alarms;
  EXPECT_EQ(alarms.lag_s.warn, 1.0);
  EXPECT_EQ(alarms.lopsided_rad.alarm, 0.2);
  EXPECT_EQ(alarms.utilisation.alarm, 1.0);
  const auto refused = [](const char* key, double value) {
    XmlRpcValue one = minimal();
    one["alarms"][key] = value;
    return refusal(one);
  };
  EXPECT_TRUE(contains(refused("lag_alarm_s", 2.0), "~alarms/lag_alarm_s")) << refused("lag_alarm_s", 2.0);
  EXPECT_TRUE(contains(refused("lag_alarm_s", 2.0), "must be greater than lag_warn_s"));
  EXPECT_TRUE(contains(refused("band", 1.0), "~alarms/band"));
  EXPECT_TRUE(contains(refused("lag_warn", 2.0), "~alarms/lag_warn"));
}

TEST(Parameters, TheCheckpointGoesIntoAFolderThatIsThere)
{
  EXPECT_TRUE(contains(refusal("checkpoint", "/no/such/folder/state.h5"), "~checkpoint"));
  EXPECT_TRUE(contains(refusal("checkpoint_period_s", 0.0), "~checkpoint_period_s"));
}

}  // namespace
}  // namespace geocontainer_mpm::ros_bridge
