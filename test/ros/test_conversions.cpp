#include <gtest/gtest.h>
#include <sensor_msgs/point_cloud2_iterator.h>

#include <cmath>
#include <limits>

#include "geocontainer_mpm/ros/conversions.h"

namespace geocontainer_mpm::ros_bridge {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

scene::Frame small_frame()
{
  scene::Frame frame;
  frame.time_s = 2.5;
  scene::SoilFrame soil;
  soil.name = "sand";
  for (int i = 0; i < 5; ++i) {
    soil.position.emplace_back(0.0, 0.1 * i, -1.0 - i);
    soil.velocity.emplace_back(0.0, 3.0, -4.0);
    soil.stress.push_back({ -600.0 * i, -1000.0 * i, -2000.0 * i, 0.0, 0.0, 50.0 });
    soil.volume.push_back(0.01);
  }
  frame.soil.push_back(soil);
  scene::GeotextileFrame sheet;
  sheet.name = "container";
  sheet.node = { { 0.0, -1.0, -2.0 }, { 0.0, 1.0, -2.0 }, { 0.0, 0.0, -1.0 } };
  sheet.velocity.assign(3, Vec3::Zero());
  sheet.tension = { 1e3, 2e3, 3e3 };
  sheet.gauge_tension = { 1e4, 2e4, 3e4 };
  sheet.gauge_length_m = 0.5;
  sheet.strength_n_per_m = 2e5;
  sheet.seam_strength_n_per_m = 1e5;
  frame.geotextile.push_back(sheet);
  scene::BoundaryFrame bed;
  bed.name = "bed";
  bed.position = { { 0.0, -6.0, -9.3 }, { 0.0, 0.0, -9.3 }, { 0.0, 6.0, -9.3 } };
  frame.boundary.push_back(bed);
  return frame;
}

Progress small_progress()
{
  Progress progress;
  progress.state = RunState::running;
  progress.time_s = 2.5;
  progress.opening = { 0.1, 0.12 };
  progress.seam_strength_n_per_m = 1e5;
  progress.status.outcome = scene::Outcome::releasing;
  progress.status.peak_tension_n_per_m = 3e4;
  progress.status.peak_tension_time_s = 1.25;
  progress.status.peak_tension_position_m = Vec3(0.0, 1.0, -2.0);
  progress.lag_s = 0.4;
  progress.real_time_factor = 3.0;
  return progress;
}

/// Barge turned by 90 degrees about z and lifted by 10 m: port becomes -x of the world.
View turned_view()
{
  View view;
  view.frame_id = "map";
  view.stamp = ros::Time(100, 5);
  view.width_m = 4.0;
  view.pose = Eigen::Translation3d(0.0, 0.0, 10.0) * Eigen::AngleAxisd(M_PI / 2.0, Eigen::Vector3d::UnitZ());
  return view;
}

TEST(Conversions, ContainerShapeIsTheSheetInTheViewsFrame)
{
  const geometry_msgs::PolygonStamped shape = to_container_shape(small_frame().geotextile[0], turned_view());
  EXPECT_EQ(shape.header.frame_id, "map");
  EXPECT_EQ(shape.header.stamp, ros::Time(100, 5));
  ASSERT_EQ(shape.polygon.points.size(), 3u);
  EXPECT_NEAR(shape.polygon.points[1].x, -1.0, 1e-6);
  EXPECT_NEAR(shape.polygon.points[1].y, 0.0, 1e-6);
  EXPECT_NEAR(shape.polygon.points[1].z, 8.0, 1e-6);
}

TEST(Conversions, ForcesCarryGaugeTensionAndItsShareOfTheSeam)
{
  const GeotextileForces forces = to_geotextile_forces(small_frame().geotextile[0], View());
  EXPECT_EQ(forces.name, "container");
  EXPECT_EQ(forces.tension, (std::vector<double>{ 1e4, 2e4, 3e4 }));
  ASSERT_EQ(forces.utilisation.size(), 3u);
  EXPECT_DOUBLE_EQ(forces.utilisation[2], 0.3);
  EXPECT_DOUBLE_EQ(forces.nodes[0].y, -1.0);
  EXPECT_DOUBLE_EQ(forces.nodes[0].z, -2.0);
  EXPECT_DOUBLE_EQ(forces.nodes[0].x, 0.0);
}

TEST(Conversions, SoilCloudHasSpeedAndMeanStressOfEveryStridethParticle)
{
  const sensor_msgs::PointCloud2 cloud = to_soil_cloud(small_frame(), turned_view(), 2);
  ASSERT_EQ(cloud.width * cloud.height, 3u);  // particles 0, 2 and 4
  sensor_msgs::PointCloud2ConstIterator<float> x(cloud, "x"), z(cloud, "z"), speed(cloud, "speed"),
      mean_stress(cloud, "mean_stress");
  ++x, ++z, ++speed, ++mean_stress;
  EXPECT_NEAR(*x, -0.2, 1e-6);
  EXPECT_NEAR(*z, 10.0 - 3.0, 1e-6);
  EXPECT_NEAR(*speed, 5.0, 1e-6);
  EXPECT_NEAR(*mean_stress, -(2000.0 + 4000.0 + 1200.0) / 3.0, 1e-3);
}

TEST(Conversions, StatusSaysOutcomeTimesAndUtilisation)
{
  Progress progress = small_progress();
  ReleaseStatus status = to_release_status(progress, {}, turned_view());
  EXPECT_EQ(status.outcome, ReleaseStatus::RELEASING);
  EXPECT_LT(status.release_time.toSec(), 0.0);
  EXPECT_NEAR(status.peak_tension_time.toSec(), 1.25, 1e-9);
  EXPECT_NEAR(status.peak_tension_position.x, -1.0, 1e-12);
  EXPECT_NEAR(status.peak_tension_position.z, 8.0, 1e-12);
  EXPECT_DOUBLE_EQ(status.peak_utilisation, 0.3);
  EXPECT_DOUBLE_EQ(status.starboard, 0.12);
  EXPECT_DOUBLE_EQ(status.lag, 0.4);
  EXPECT_FALSE(status.stopped);

  progress.state = RunState::stopped;
  progress.failure = { "a particle left the grid", Vec3(0.0, 1.5, -2.0), 2.4 };
  status = to_release_status(progress, {}, View());
  EXPECT_TRUE(status.stopped);
  EXPECT_NE(status.message.find("at y 1.500 m, z -2.000 m: a particle left the grid"), std::string::npos);
  EXPECT_EQ(status.message.find('\n'), std::string::npos);
}

TEST(Conversions, StatusCarriesTheAlarms)
{
  AlarmReport report;
  report.replay = true;
  report.alarms.resize(1);
  alarm::Alarm& alarm = report.alarms.front();
  alarm = { "lag", "s", alarm::Level::warn, alarm::Level::alarm, true, 12'500'000'000, 4.0, 2.0, "late" };
  const ReleaseStatus status = to_release_status({}, report, View());
  ASSERT_EQ(status.alarms.size(), 1u);
  EXPECT_TRUE(status.replay);
  EXPECT_EQ(status.alarms[0].name, "lag");
  EXPECT_EQ(status.alarms[0].level, ReleaseAlarm::WARN);
  EXPECT_EQ(status.alarms[0].latched, ReleaseAlarm::ALARM);
  EXPECT_TRUE(status.alarms[0].acknowledged);
  EXPECT_EQ(status.alarms[0].since, ros::Time(12.5));
  EXPECT_EQ(status.alarms[0].value, 4.0);
  EXPECT_EQ(status.alarms[0].unit, "s");
  EXPECT_EQ(status.alarms[0].lead_time, 2.0);
  EXPECT_EQ(status.alarms[0].message, "late");
  EXPECT_EQ(first_non_finite(report), "");
  alarm.value = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(first_non_finite(report), "alarm lag");
}

TEST(Conversions, EveryOutcomeHasItsNumberOnTheWire)
{
  const std::pair<scene::Outcome, int> outcomes[] = { { scene::Outcome::waiting, ReleaseStatus::WAITING },
                                                      { scene::Outcome::releasing, ReleaseStatus::RELEASING },
                                                      { scene::Outcome::released, ReleaseStatus::RELEASED },
                                                      { scene::Outcome::hung_up, ReleaseStatus::HUNG_UP },
                                                      { scene::Outcome::none, ReleaseStatus::NONE } };
  for (const auto& [outcome, number] : outcomes) {
    Progress progress = small_progress();
    progress.status.outcome = outcome;
    EXPECT_EQ(to_release_status(progress, {}, View()).outcome, number);
  }
}

TEST(Conversions, JointStatesOpenBothHalvesPositive)
{
  const sensor_msgs::JointState state = to_hull_joint_states({ 0.2, 0.3 }, ros::Time(7, 0));
  EXPECT_EQ(state.name, (std::vector<std::string>{ "hull_port_joint", "hull_starboard_joint" }));
  EXPECT_EQ(state.position, (std::vector<double>{ 0.2, 0.3 }));
  EXPECT_EQ(state.header.stamp, ros::Time(7, 0));
}

TEST(Conversions, MarkersKeepIdsCountsAndLifetimeWhileTheContainerMoves)
{
  scene::Frame frame = small_frame();
  const visualization_msgs::MarkerArray first = to_markers(frame, small_progress(), turned_view());
  for (Vec3& node : frame.geotextile[0].node)
    node *= 1.7;
  frame.geotextile[0].gauge_tension = { 9e4, 2e5, 0.0 };
  const visualization_msgs::MarkerArray second = to_markers(frame, small_progress(), View());
  ASSERT_EQ(first.markers.size(), 3u);  // ribbon, bed, legend
  ASSERT_EQ(second.markers.size(), first.markers.size());
  for (std::size_t i = 0; i < first.markers.size(); ++i) {
    EXPECT_EQ(first.markers[i].ns, second.markers[i].ns);
    EXPECT_EQ(first.markers[i].id, second.markers[i].id);
    EXPECT_EQ(first.markers[i].points.size(), second.markers[i].points.size());
    EXPECT_EQ(first.markers[i].lifetime, ros::Duration(0));
    EXPECT_EQ(first.markers[i].header.frame_id, "map");
  }
  const visualization_msgs::Marker& ribbon = first.markers[0];
  EXPECT_EQ(ribbon.type, visualization_msgs::Marker::TRIANGLE_LIST);
  EXPECT_EQ(ribbon.points.size(), 18u);  // 3 segments of 2 triangles
  EXPECT_EQ(ribbon.colors.size(), ribbon.points.size());
  for (const auto& point : ribbon.points)
    EXPECT_TRUE(point.x == 0.0 || point.x == -4.0);
}

TEST(Conversions, AnOpenSheetsEndsAreNotJoined)
{
  scene::Frame frame = small_frame();
  scene::GeotextileFrame& sheet = frame.geotextile[0];
  sheet.closed = false;
  sheet.tension.pop_back();
  sheet.gauge_tension.pop_back();
  const geometry_msgs::PolygonStamped shape = to_container_shape(sheet, View());
  ASSERT_EQ(shape.polygon.points.size(), 4u);  // there: nodes 0, 1, 2; back over node 1
  EXPECT_EQ(shape.polygon.points[3].y, shape.polygon.points[1].y);
  EXPECT_EQ(shape.polygon.points[3].z, shape.polygon.points[1].z);
  EXPECT_EQ(to_geotextile_forces(sheet, View()).utilisation.size(), 2u);
  const visualization_msgs::MarkerArray array = to_markers(frame, small_progress(), View());
  EXPECT_EQ(array.markers[0].points.size(), 12u);  // 2 segments of 2 triangles
}

TEST(Conversions, AClosedSurfacesOutlineIsClosed)
{
  scene::Frame frame = small_frame();
  const std::size_t open = to_markers(frame, small_progress(), View()).markers[1].points.size();
  frame.boundary[0].closed = true;
  const std::size_t closed = to_markers(frame, small_progress(), View()).markers[1].points.size();
  EXPECT_EQ(closed, open + 4u);  // one more piece at both ends of the slice
}

TEST(Conversions, LegendNamesPeakTensionOutcomeAndRealTimeFactor)
{
  const visualization_msgs::MarkerArray array = to_markers(small_frame(), small_progress(), View());
  const visualization_msgs::Marker& legend = array.markers.back();
  EXPECT_EQ(legend.type, visualization_msgs::Marker::TEXT_VIEW_FACING);
  EXPECT_NE(legend.text.find("releasing"), std::string::npos);
  EXPECT_NE(legend.text.find("30.0 kN/m"), std::string::npos);
  EXPECT_NE(legend.text.find("real time x 3.0"), std::string::npos);
}

TEST(Conversions, ColourGoesFromGreenToRedAndStandsOutBeyondFailure)
{
  const Eigen::Vector3f none = utilisation_colour(0.0), full = utilisation_colour(1.0), over = utilisation_colour(1.01);
  EXPECT_GT(none.y(), none.x());
  EXPECT_GT(full.x(), 5.0f * full.y());
  EXPECT_GT(over.z(), 0.5f);
  for (double use = -0.5; use < 2.0; use += 0.05) {
    EXPECT_GE(utilisation_colour(use).minCoeff(), 0.0f);
    EXPECT_LE(utilisation_colour(use).maxCoeff(), 1.0f);
  }
}

TEST(Conversions, WhatIsNotFiniteIsNamed)
{
  EXPECT_EQ(first_non_finite(small_frame()), "");
  EXPECT_EQ(first_non_finite(small_progress()), "");

  scene::Frame frame = small_frame();
  frame.soil[0].stress[3][2] = nan;
  EXPECT_EQ(first_non_finite(frame), "sand stress");
  frame = small_frame();
  frame.soil[0].velocity[4].y() = std::numeric_limits<double>::infinity();
  EXPECT_EQ(first_non_finite(frame), "sand velocity");
  frame = small_frame();
  frame.soil[0].position[0].x() = nan;
  EXPECT_EQ(first_non_finite(frame), "sand position");
  frame = small_frame();
  frame.geotextile[0].node[1].y() = nan;
  EXPECT_EQ(first_non_finite(frame), "container node");
  frame = small_frame();
  frame.geotextile[0].gauge_tension[1] = nan;
  EXPECT_EQ(first_non_finite(frame), "container tension");
  frame = small_frame();
  frame.boundary[0].position[2].y() = nan;
  EXPECT_EQ(first_non_finite(frame), "bed position");

  Progress progress = small_progress();
  progress.opening.starboard_rad = nan;
  EXPECT_EQ(first_non_finite(progress), "opening");
  progress = small_progress();
  progress.status.centroid_m.y() = nan;
  EXPECT_EQ(first_non_finite(progress), "status");
}

/// A pyramid of sheet with its square open at the bottom, 4 m long from x = -1 m, and a hull of two flat triangles
/// with a third at right angles.
scene::Frame solid_frame()
{
  scene::Frame frame;
  frame.status.dimensions = 3;
  scene::GeotextileFrame sheet;
  sheet.name = "container";
  sheet.node = {
    { -1.0, -1.0, -2.0 }, { 3.0, -1.0, -2.0 }, { 3.0, 1.0, -2.0 }, { -1.0, 1.0, -2.0 }, { 1.0, 0.0, 0.0 }
  };
  sheet.velocity.assign(5, Vec3::Zero());
  sheet.triangles = { { 0, 1, 4 }, { 1, 2, 4 }, { 2, 3, 4 }, { 3, 0, 4 } };
  sheet.tension = { 1e3, 2e3, 3e3, 4e3 };
  sheet.gauge_tension = { 1e4, 2e4, 3e4, 4e4 };
  sheet.gauge_length_m = 0.5;
  sheet.strength_n_per_m = 2e5;
  sheet.seam_strength_n_per_m = 1e5;
  frame.geotextile.push_back(sheet);
  scene::BoundaryFrame hull;
  hull.name = "hull_port";
  hull.position = { { 0.0, 2.0, 0.0 }, { 4.0, 2.0, 0.0 }, { 4.0, 0.0, -3.0 }, { 0.0, 0.0, -3.0 }, { 0.0, 2.0, -3.0 } };
  hull.triangles = { { 0, 1, 2 }, { 0, 2, 3 }, { 0, 3, 4 } };
  frame.boundary.push_back(hull);
  scene::SoilFrame soil;
  soil.name = "sand";
  soil.position = { { 2.0, 0.5, -1.0 } };
  soil.velocity = { { 1.0, 2.0, 2.0 } };
  soil.stress = { { -1.0, -2.0, -3.0, 40.0, 50.0, 60.0 } };
  soil.volume = { 0.001 };
  frame.soil.push_back(soil);
  return frame;
}

TEST(Conversions, AThreeDimensionalSheetAndHullAreTriangles)
{
  scene::Frame frame = solid_frame();
  const visualization_msgs::MarkerArray array = to_markers(frame, small_progress(), View());
  ASSERT_EQ(array.markers.size(), 4u);  // sheet, faces and edges of the hull, legend
  const visualization_msgs::Marker &sheet = array.markers[0], &faces = array.markers[1], &edges = array.markers[2];
  EXPECT_EQ(sheet.type, visualization_msgs::Marker::TRIANGLE_LIST);
  ASSERT_EQ(sheet.points.size(), 12u);
  ASSERT_EQ(sheet.colors.size(), 12u);
  EXPECT_EQ(sheet.points[5].x, 1.0);  // apex, last corner of the second triangle
  EXPECT_EQ(sheet.points[3].x, 3.0);
  EXPECT_EQ(sheet.points[3].y, -1.0);
  // Green to yellow: the share of red grows with tension, whatever the shade. Each triangle has one colour.
  const auto warmth = [&](std::size_t i) { return sheet.colors[i].r / sheet.colors[i].g; };
  EXPECT_LT(warmth(0), warmth(3));
  EXPECT_LT(warmth(6), warmth(9));
  EXPECT_EQ(warmth(9), warmth(11));
  EXPECT_EQ(faces.type, visualization_msgs::Marker::TRIANGLE_LIST);
  EXPECT_EQ(faces.points.size(), 9u);
  ASSERT_EQ(faces.colors.size(), 9u);
  EXPECT_LT(faces.colors[0].a, 0.5f);  // the container is seen through it
  EXPECT_EQ(edges.type, visualization_msgs::Marker::LINE_LIST);
  EXPECT_EQ(edges.points.size(), 2 * 6u);  // five of the rim and the bend; not the diagonal of the flat face
  EXPECT_NE(faces.ns + std::to_string(faces.id), edges.ns + std::to_string(edges.id));

  for (Vec3& node : frame.geotextile[0].node)
    node.z() -= 3.0 + node.x();
  for (Vec3& x : frame.boundary[0].position)
    x = Eigen::AngleAxisd(0.3, Vec3::UnitX()) * x;
  const visualization_msgs::MarkerArray later = to_markers(frame, small_progress(), View());
  for (std::size_t i = 0; i + 1 < array.markers.size(); ++i)
    EXPECT_EQ(array.markers[i].points.size(), later.markers[i].points.size()) << i;
}

TEST(Conversions, AThreeDimensionalContainersShapeIsItsSectionMidships)
{
  // At x = 0, a metre from the pyramid's end, the apex 2 m high being 2 m from it: a triangle cut off at half the
  // height, open at the bottom, so there and back over what is between its ends.
  const scene::Frame frame = solid_frame();
  const geometry_msgs::PolygonStamped shape = to_container_shape(frame.geotextile[0], View());
  ASSERT_EQ(shape.polygon.points.size(), 6u);  // two at the rim, two on the slanted edges; two of them once more
  double top = -10.0, left = 10.0, right = -10.0;
  for (const geometry_msgs::Point32& point : shape.polygon.points) {
    EXPECT_NEAR(point.x, 0.0, 1e-6);
    top = std::max<double>(top, point.z);
    left = std::min<double>(left, point.y);
    right = std::max<double>(right, point.y);
  }
  EXPECT_NEAR(top, -1.0, 1e-6);
  EXPECT_NEAR(left, -1.0, 1e-6);
  EXPECT_NEAR(right, 1.0, 1e-6);

  // Closed at the bottom it is a ring of five: the bottom's diagonal is cut as well.
  scene::GeotextileFrame closed = frame.geotextile[0];
  closed.triangles.push_back({ 0, 2, 1 });
  closed.triangles.push_back({ 0, 3, 2 });
  EXPECT_EQ(to_container_shape(closed, View()).polygon.points.size(), 5u);

  // Half a model, of which nothing is ahead of midships: the section nearest to it.
  for (Vec3& node : closed.node)
    node.x() -= 3.0;
  const geometry_msgs::PolygonStamped half = to_container_shape(closed, View());
  ASSERT_GE(half.polygon.points.size(), 4u);
  for (const geometry_msgs::Point32& point : half.polygon.points)
    EXPECT_NEAR(point.x, -0.004, 1e-6);  // a thousandth of the length inside
}

TEST(Conversions, ThreeDimensionalForcesAndSoilHaveTheirPlaceAlongTheBarge)
{
  const scene::Frame frame = solid_frame();
  const GeotextileForces forces = to_geotextile_forces(frame.geotextile[0], View());
  ASSERT_EQ(forces.triangles.size(), 3 * forces.tension.size());
  EXPECT_EQ(forces.triangles[4], 2u);
  EXPECT_EQ(forces.nodes[2].x, 3.0);
  EXPECT_DOUBLE_EQ(forces.utilisation[3], 0.4);
  EXPECT_TRUE(to_geotextile_forces(small_frame().geotextile[0], View()).triangles.empty());

  const sensor_msgs::PointCloud2 cloud = to_soil_cloud(frame, View(), 1);
  EXPECT_FLOAT_EQ(*sensor_msgs::PointCloud2ConstIterator<float>(cloud, "x"), 2.0f);
  EXPECT_FLOAT_EQ(*sensor_msgs::PointCloud2ConstIterator<float>(cloud, "speed"), 3.0f);
  EXPECT_FLOAT_EQ(*sensor_msgs::PointCloud2ConstIterator<float>(cloud, "mean_stress"), -2.0f);

  Progress progress = small_progress();
  progress.state = RunState::stopped;
  progress.status.dimensions = 3;
  progress.failure = { "gone", Vec3(4.0, 1.5, -2.0), 2.4 };
  EXPECT_NE(status_sentence(progress).find("at x 4.000 m, y 1.500 m, z -2.000 m: gone"), std::string::npos);
}

TEST(Conversions, JointStatesIn)
{
  sensor_msgs::JointState message;
  message.header.stamp = ros::Time(12, 34);
  message.name = { "crane", "hull_starboard_joint", "hull_port_joint" };
  message.position = { 9.0, 0.2, 0.1 };
  const auto sample = to_sample(message, OpeningJoints());
  ASSERT_TRUE(sample);
  EXPECT_EQ(sample->stamp_ns, 12'000'000'034);
  EXPECT_EQ(sample->angles.port_rad, 0.1);
  EXPECT_EQ(sample->angles.starboard_rad, 0.2);

  message.position.pop_back();  // a name without its position: rejected and counted as not finite
  EXPECT_TRUE(std::isnan(to_sample(message, OpeningJoints())->angles.port_rad));
  message.name = { "crane" };
  message.position = { 9.0 };
  EXPECT_FALSE(to_sample(message, OpeningJoints()));
}

TEST(Conversions, StampsBeforeTheFirstSampleAreTheCallers)
{
  EXPECT_EQ(to_time(0, ros::Time(3, 4)), ros::Time(3, 4));
  EXPECT_EQ(to_time(1'750'150'800'000'000'007, ros::Time()), ros::Time(1'750'150'800, 7));
}

}  // namespace
}  // namespace geocontainer_mpm::ros_bridge
