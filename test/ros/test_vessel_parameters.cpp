/// Parameters and diagnostics of the vessel link, and its figures from a message: no master.
#include <gtest/gtest.h>

#include <limits>

#include "geocontainer_mpm/error.h"
#include "geocontainer_mpm/ros/vessel_link.h"

namespace geocontainer_mpm::ros_bridge {
namespace {

using diagnostic_msgs::DiagnosticStatus;
using XmlRpc::XmlRpcValue;

std::string refusal_of(const XmlRpcValue& tree)
{
  try {
    parse_vessel_parameters(tree, "/link");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(VesselParameters, NothingIsOpenedUnlessConfigured)
{
  const VesselLinkParameters parameters = parse_vessel_parameters(XmlRpcValue(), "/link");
  EXPECT_FALSE(parameters.signalk.enabled);
  EXPECT_TRUE(parameters.nmea.empty());
  EXPECT_EQ(parameters.hull_angles, AngleSource::none);
  EXPECT_EQ(parameters.signalk.server.host, "127.0.0.1");
  EXPECT_EQ(VesselNmeaPort().port.address, "127.0.0.1");
}

TEST(VesselParameters, SayWhatIsWrong)
{
  XmlRpcValue tree;
  tree["signalk"]["enabled"] = true;
  tree["signalk"]["host"] = std::string("10.0.0.1");
  EXPECT_EQ(refusal_of(tree), "");
  ::setenv("VESSEL_LINK_TEST_TOKEN", "abc.def", 1);
  tree["signalk"]["token_environment"] = std::string("VESSEL_LINK_TEST_TOKEN");
  EXPECT_NE(refusal_of(tree).find("over TLS only"), std::string::npos);
  EXPECT_EQ(refusal_of(tree).find("abc.def"), std::string::npos);
  tree["signalk"]["token_in_clear"] = true;
  EXPECT_EQ(refusal_of(tree), "");
  tree["signalk"]["utilisation_alarm"] = 0.5;  // below the warning
  EXPECT_NE(refusal_of(tree).find("~signalk/utilisation_alarm"), std::string::npos);
}

TEST(VesselParameters, AnglesDoNotComeFromWhatIsSent)
{
  XmlRpcValue tree;
  tree["hull_angles"] = std::string("signalk");
  tree["signalk"]["enabled"] = true;
  tree["signalk"]["port_path"] = std::string("cargo.geocontainer.hull.port.opening");
  tree["signalk"]["starboard_path"] = std::string("steering.starboard");
  EXPECT_NE(refusal_of(tree).find("~signalk/port_path"), std::string::npos);
  tree["signalk"]["port_path"] = std::string("steering.port");
  EXPECT_EQ(refusal_of(tree), "");
}

TEST(VesselFigures, AreThoseOfTheMessage)
{
  ReleaseStatus status;
  status.header.stamp = ros::Time(1'700'000'000, 123'000'000);
  status.outcome = ReleaseStatus::HUNG_UP;
  status.message = "stands still";
  status.port = 0.25;
  status.peak_utilisation = 0.5;
  status.centroid.z = -1.5;
  status.release_time = ros::Duration(-1.0);
  const vessel::ReleaseFigures figures = to_figures(status);
  EXPECT_EQ(vessel::format_utc(figures.stamp), "2023-11-14T22:13:20.123Z");
  EXPECT_EQ(figures.port_rad, 0.25);
  EXPECT_EQ(figures.centroid_m[2], -1.5);
  EXPECT_EQ(vessel::release_notice(figures).state, "alarm");
  EXPECT_TRUE(vessel::release_notice(figures).sound);
  std::size_t found = 0;
  for (const vessel::PathValue& value : vessel::to_values(vessel::release_figures(), figures, "c")) {
    EXPECT_EQ(value.stamp, figures.stamp);
    if (value.path == "c.release.state")
      found += value.value == vessel::Value(std::string("hung_up")) ? 1 : 0;
    if (value.path == "c.release.time")
      found += value.value == vessel::Value() ? 1 : 0;
    if (value.path == "c.utilisation.peak")
      found += value.value == vessel::Value(0.5) ? 1 : 0;
  }
  EXPECT_EQ(found, 3U);
}

TEST(VesselFigures, OfForecastAndEnsemble)
{
  ReleaseForecast forecast;
  forecast.header.stamp = ros::Time(1'700'000'000, 0);
  forecast.age = 0.5;
  forecast.stamps = { ros::Time(1'700'000'000, 0), ros::Time(1'700'000'010, 0), ros::Time(1'700'000'020, 0) };
  forecast.tension = { 1e3, 5e4, 2e3 };
  forecast.peak_tension = { 3e3, 5e4, 5e4 };
  forecast.utilisation = { 0.015, 0.25, 0.25 };
  vessel::ForecastFigures figures = to_figures(forecast);
  EXPECT_FALSE(figures.release);
  EXPECT_EQ(figures.peak_tension_n_per_m, 5e4);
  EXPECT_EQ(figures.peak_utilisation, 0.25);
  EXPECT_EQ(figures.curve["time"], (std::vector<double>{ 1.7e9, 1.7e9 + 10.0, 1.7e9 + 20.0 }));
  EXPECT_EQ(figures.curve["tension"], forecast.tension);
  forecast.release_time = ros::Time(1'700'000'012, 0);
  figures = to_figures(forecast);
  EXPECT_EQ(vessel::format_utc(*figures.release), "2023-11-14T22:13:32.000Z");
  EXPECT_NEAR(figures.until_release_s, 11.5, 1e-9);
  // None yet, or lists that do not belong together: no curve, and nothing else is lost.
  forecast.tension.pop_back();
  EXPECT_TRUE(to_figures(forecast).curve.empty());

  ReleaseEnsemble ensemble;
  ensemble.release_delay.p90 = std::numeric_limits<double>::infinity();
  ensemble.advice = ReleaseEnsemble::RATE;
  ensemble.advised_rate = 0.01;
  std::size_t found = 0;
  for (const vessel::PathValue& value : vessel::to_values(vessel::ensemble_figures(), to_figures(ensemble), "c")) {
    if (value.path == "c.ensemble.release.p90")
      found += value.value == vessel::Value() ? 1 : 0;
    if (value.path == "c.advice.rate")
      found += value.value == vessel::Value(0.01) ? 1 : 0;
  }
  EXPECT_EQ(found, 2U);
}

TEST(VesselFigures, TheSectionIsInTheBargesFrame)
{
  GeotextileForces forces;
  forces.nodes.resize(3);
  forces.nodes[1].y = 2.0;
  forces.nodes[2].z = -1.0;
  forces.utilisation = { 0.1, 0.2, 0.3 };
  Eigen::Isometry3d to_barge = Eigen::Isometry3d::Identity();
  to_barge.translation() << 100.0, 1.0, -0.5;
  vessel::SectionFigures section = to_section(forces, to_barge);
  EXPECT_EQ(section.outline["y"], (std::vector<double>{ 1.0, 3.0, 1.0 }));
  EXPECT_EQ(section.outline["z"], (std::vector<double>{ -0.5, -0.5, -1.5 }));
  EXPECT_EQ(section.outline["utilisation"], forces.utilisation);
}

TEST(VesselParameters, TheSectionIsAsInTheScene)
{
  XmlRpcValue tree;
  EXPECT_EQ(parse_vessel_parameters(tree, "/link").signalk.section.columns().count("bed"), 0U);
  tree["signalk"]["section"]["port_section_m"][0][0] = 0;
  tree["signalk"]["section"]["port_section_m"][0][1] = -4.5;
  EXPECT_NE(refusal_of(tree).find("~signalk/section/port_section_m"), std::string::npos);  // one point
  tree["signalk"]["section"]["port_section_m"][1][0] = 2.5;
  tree["signalk"]["section"]["port_section_m"][1][1] = 0;
  tree["signalk"]["section"]["bed_z_m"] = -9.3;
  vessel::Columns columns = parse_vessel_parameters(tree, "/link").signalk.section.columns();
  EXPECT_EQ(columns["y"], (std::vector<double>{ 0.0, 2.5 }));
  EXPECT_EQ(columns["z"], (std::vector<double>{ -4.5, 0.0 }));
  EXPECT_EQ(columns["bed"], std::vector<double>{ -9.3 });
  tree["signalk"]["section"]["port_section_m"][1][1] = std::string("deck");
  EXPECT_NE(refusal_of(tree).find("deck"), std::string::npos);
}

TEST(VesselDiagnostics, WarnOfWhatIsNewAndOfWhatLasts)
{
  vessel::SignalKHealth health;
  health.state = vessel::LinkState::open;
  health.confirmation = vessel::Confirmation::unconfirmed;
  health.oldest_unconfirmed = "a.b";
  diagnostic_updater::DiagnosticStatusWrapper status;
  describe_signalk(health, health, status);
  EXPECT_EQ(status.level, DiagnosticStatus::WARN);
  EXPECT_NE(status.message.find("a.b"), std::string::npos);
  health.confirmation = vessel::Confirmation::confirmed;
  describe_signalk(health, health, status);
  EXPECT_EQ(status.level, DiagnosticStatus::OK);

  vessel::NmeaPortHealth before, now;
  now.counts.add(vessel::NmeaFault::bad_checksum);
  describe_nmea_port(now, before, vessel::NmeaTransport::udp, 1, status);
  EXPECT_EQ(status.level, DiagnosticStatus::WARN);
  describe_nmea_port(now, now, vessel::NmeaTransport::udp, 1, status);
  EXPECT_EQ(status.level, DiagnosticStatus::OK);
}

}  // namespace
}  // namespace geocontainer_mpm::ros_bridge
