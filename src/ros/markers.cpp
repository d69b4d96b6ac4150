#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "geocontainer_mpm/ros/conversions.h"
#include "message_parts.h"
#include "outline.h"

namespace geocontainer_mpm::ros_bridge {
namespace {

using visualization_msgs::Marker;

constexpr double outline_width_m = 0.04;
constexpr float face_alpha = 0.3f;
const Eigen::Vector3f face_colour(0.7f, 0.75f, 0.82f), outline_colour(0.35f, 0.38f, 0.45f);
constexpr double legend_height_m = 0.32;
constexpr double legend_above_hinge_m = 2.4;

/// A point of a plane-strain section, drawn at x.
geometry_msgs::Point to_point_at(double x, const Vec3& section)
{
  return to_point(Vec3(x, section.y(), section.z()));
}

std_msgs::ColorRGBA to_colour(const Eigen::Vector3f& rgb, float alpha = 1.0f)
{
  std_msgs::ColorRGBA colour;
  colour.r = rgb.x();
  colour.g = rgb.y();
  colour.b = rgb.z();
  colour.a = alpha;
  return colour;
}

/// Points stay in the barge frame; the marker's own pose carries them into the view.
Marker make_marker(const std::string& name_space, int id, int type, const View& view)
{
  Marker marker;
  marker.header.frame_id = view.frame_id;
  marker.header.stamp = view.stamp;
  marker.ns = name_space;
  marker.id = id;
  marker.type = type;
  marker.action = Marker::ADD;
  const Eigen::Quaterniond rotation(view.pose.linear());
  marker.pose.orientation.w = rotation.w();
  marker.pose.orientation.x = rotation.x();
  marker.pose.orientation.y = rotation.y();
  marker.pose.orientation.z = rotation.z();
  marker.pose.position.x = view.pose.translation().x();
  marker.pose.position.y = view.pose.translation().y();
  marker.pose.position.z = view.pose.translation().z();
  marker.scale.x = marker.scale.y = marker.scale.z = 1.0;
  marker.color.a = 1.0f;
  return marker;
}

/// rviz lights nothing that has a colour per vertex: the shade of a lamp is put into the colour. Two edges span the
/// face.
float shade(const Vec3& edge, const Vec3& other_edge, const Vec3& to_lamp)
{
  const Vec3 normal = edge.cross(other_edge);
  return normal.isZero(0.0) ? 1.0f
                            : static_cast<float>(0.6 + 0.4 * std::abs(normal.normalized().dot(to_lamp.normalized())));
}

std_msgs::ColorRGBA colour_of_piece(const scene::GeotextileFrame& sheet, std::size_t piece, float shading)
{
  return to_colour(utilisation_colour(sheet.gauge_tension[piece] / sheet.seam_strength_n_per_m) * shading);
}

/// Triangles, each of the colour that `colour(index, shade)` gives.
template <typename Colour>
void add_faces(Marker& marker, const std::vector<Vec3>& position, const std::vector<scene::Triangle>& triangles,
               Colour colour)
{
  const Vec3 to_lamp(0.3, 0.4, 1.0);  // above, to port, a little ahead: ends and sides differ
  marker.points.reserve(3 * triangles.size());
  marker.colors.reserve(3 * triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const auto corner = [&](std::size_t k) -> const Vec3& { return position[triangles[i][k]]; };
    const float shading = shade(corner(1) - corner(0), corner(2) - corner(0), to_lamp);
    for (std::size_t k = 0; k < 3; ++k)
      marker.points.push_back(to_point(corner(k)));
    marker.colors.insert(marker.colors.end(), 3, colour(i, shading));
  }
}

Marker geotextile_surface(const scene::GeotextileFrame& sheet, int id, const View& view)
{
  Marker marker = make_marker("geotextile", id, Marker::TRIANGLE_LIST, view);
  add_faces(marker, sheet.node, sheet.triangles,
            [&](std::size_t i, float shading) { return colour_of_piece(sheet, i, shading); });
  return marker;
}

Marker geotextile_ribbon(const scene::GeotextileFrame& sheet, int id, const View& view)
{
  const Vec3 to_lamp(0.0, 0.4, 1.0);
  Marker marker = make_marker("geotextile", id, Marker::TRIANGLE_LIST, view);
  const std::size_t nodes = sheet.node.size();
  const std::size_t segments = sheet.gauge_tension.size();  // of an open sheet one less than nodes
  marker.points.reserve(6 * segments);
  marker.colors.reserve(6 * segments);
  for (std::size_t i = 0; i < segments; ++i) {
    const Vec3& from = sheet.node[i];
    const Vec3& to = sheet.node[(i + 1) % nodes];
    const std_msgs::ColorRGBA colour = colour_of_piece(sheet, i, shade(to - from, Vec3::UnitX(), to_lamp));
    const std::array<geometry_msgs::Point, 4> corners = { to_point_at(0.0, from), to_point_at(0.0, to),
                                                          to_point_at(-view.width_m, from),
                                                          to_point_at(-view.width_m, to) };
    for (const std::size_t corner : { 0u, 1u, 2u, 2u, 1u, 3u }) {
      marker.points.push_back(corners[corner]);
      marker.colors.push_back(colour);
    }
  }
  return marker;
}

Marker outline_marker(int id, const View& view)
{
  Marker marker = make_marker("boundary", id, Marker::LINE_LIST, view);
  marker.scale.x = outline_width_m;
  marker.color = to_colour(outline_colour);
  return marker;
}

/// See-through, as the hull is around the container. Shaded here: rviz leaves dark what is seen from behind.
Marker boundary_surface(const scene::BoundaryFrame& boundary, int id, const View& view)
{
  Marker marker = make_marker("boundary_surface", id, Marker::TRIANGLE_LIST, view);
  add_faces(marker, boundary.position, boundary.triangles,
            [](std::size_t, float shading) { return to_colour(face_colour * shading, face_alpha); });
  return marker;
}

Marker boundary_edges(const scene::BoundaryFrame& boundary, int id, const View& view)
{
  Marker marker = outline_marker(id, view);
  for (const auto& edge : sharp_edges(boundary))
    for (const std::uint32_t end : edge)
      marker.points.push_back(to_point(boundary.position[end]));
  return marker;
}

Marker boundary_outline(const scene::BoundaryFrame& boundary, int id, const View& view)
{
  Marker marker = outline_marker(id, view);
  const std::size_t count = boundary.position.size();
  const std::size_t pieces = boundary.closed ? count : count - 1;
  for (const double x : { 0.0, -view.width_m })
    for (std::size_t i = 0; i < pieces; ++i) {
      marker.points.push_back(to_point_at(x, boundary.position[i]));
      marker.points.push_back(to_point_at(x, boundary.position[(i + 1) % count]));
    }
  for (const std::size_t end : { std::size_t{ 0 }, boundary.position.size() - 1 }) {
    marker.points.push_back(to_point_at(0.0, boundary.position[end]));
    marker.points.push_back(to_point_at(-view.width_m, boundary.position[end]));
  }
  return marker;
}

std::string legend_text(const Progress& progress)
{
  const scene::StatusFrame& status = progress.status;
  const double seam_strength_n_per_m = progress.seam_strength_n_per_m;
  std::string text = fmt::format("{}   t = {:.1f} s   real time x {:.1f}", scene::to_string(status.outcome),
                                 progress.time_s, progress.real_time_factor);
  if (seam_strength_n_per_m > 0.0)
    text += fmt::format("\npeak tension {:.1f} kN/m at {:.1f} s ({:.0f} % of seam {:.0f} kN/m), now {:.1f} kN/m",
                        status.peak_tension_n_per_m / 1e3, status.peak_tension_time_s,
                        100.0 * status.peak_tension_n_per_m / seam_strength_n_per_m, seam_strength_n_per_m / 1e3,
                        status.current_tension_n_per_m / 1e3) +
            "\ncolour: use of the seam's strength, green 0, yellow 50 %, red 100 %";
  if (progress.state == RunState::stopped)
    text += "\nSTOPPED: " + progress.failure.reason;
  return text;
}

Marker legend(const Progress& progress, const View& view)
{
  Marker marker = make_marker("legend", 0, Marker::TEXT_VIEW_FACING, view);
  marker.pose.position.z += legend_above_hinge_m;
  marker.pose.orientation = geometry_msgs::Quaternion();
  marker.pose.orientation.w = 1.0;
  marker.scale.z = legend_height_m;
  marker.color = to_colour({ 1.0f, 1.0f, 1.0f });
  marker.text = legend_text(progress);
  return marker;
}

}  // namespace

Eigen::Vector3f utilisation_colour(double utilisation)
{
  if (utilisation > 1.0)
    return { 0.85f, 0.0f, 0.85f };
  const auto use = static_cast<float>(std::max(utilisation, 0.0));
  const Eigen::Vector3f green(0.15f, 0.65f, 0.3f), yellow(1.0f, 0.85f, 0.1f), red(0.85f, 0.1f, 0.1f);
  return use < 0.5f ? Eigen::Vector3f(green + (yellow - green) * (2.0f * use))
                    : Eigen::Vector3f(yellow + (red - yellow) * (2.0f * use - 1.0f));
}

visualization_msgs::MarkerArray to_markers(const scene::Frame& frame, const Progress& progress, const View& view)
{
  visualization_msgs::MarkerArray array;
  int id = 0;
  for (const scene::GeotextileFrame& sheet : frame.geotextile)
    array.markers.push_back(sheet.triangles.empty() ? geotextile_ribbon(sheet, id++, view)
                                                    : geotextile_surface(sheet, id++, view));
  id = 0;
  for (const scene::BoundaryFrame& boundary : frame.boundary) {
    if (!boundary.triangles.empty()) {
      array.markers.push_back(boundary_surface(boundary, id, view));
      array.markers.push_back(boundary_edges(boundary, id++, view));
    } else if (boundary.position.size() > 1) {
      array.markers.push_back(boundary_outline(boundary, id++, view));
    }
  }
  array.markers.push_back(legend(progress, view));
  return array;
}

}  // namespace geocontainer_mpm::ros_bridge
