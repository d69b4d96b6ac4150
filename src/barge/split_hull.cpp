#include "geocontainer_mpm/barge/split_hull.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

#include "geocontainer_mpm/error.h"

namespace geocontainer_mpm::barge {
namespace {

/// A corner that was rounded may end as far beyond the plane of symmetry, m.
constexpr double round_off_m = 1e-9;

std::string text(double value)
{
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.6g", value);
  return buffer;
}

std::string text(const Vec2& point)
{
  return "[" + text(point[0]) + ", " + text(point[1]) + "]";
}

double cross(const Vec2& a, const Vec2& b)
{
  return a[0] * b[1] - a[1] * b[0];
}

}  // namespace

SplitHull::SplitHull(const Vec2& hinge_m, std::vector<Vec2> port_section_m, const std::string& key_prefix)
    : hinge_m_(hinge_m), port_(std::move(port_section_m))
{
  const std::string key = key_prefix + ".port_section_m";
  if (!hinge_m_.allFinite())
    throw InputError("", key_prefix + ".hinge_m", text(hinge_m_), "must be finite");
  if (port_.size() < 2)
    throw InputError("", key, std::to_string(port_.size()) + " points", "needs at least 2 points");
  for (std::size_t i = 0; i < port_.size(); ++i) {
    const std::string name = key + "[" + std::to_string(i) + "]";
    if (!port_[i].allFinite() || port_[i][0] < -round_off_m)
      throw InputError("", name, text(port_[i]), "must be finite with y >= 0 (port)");
    if (i > 0 && port_[i] == port_[i - 1])
      throw InputError("", name, text(port_[i]), "must differ from the point before");
  }
  // The mirror plane is y = 0, where the halves meet, whatever the hinge's y.
  starboard_.reserve(port_.size());
  for (auto point = port_.rbegin(); point != port_.rend(); ++point)
    starboard_.emplace_back(-(*point)[0], (*point)[1]);
}

const std::vector<Vec2>& SplitHull::closed_section_m(HullHalf half) const
{
  return half == HullHalf::port ? port_ : starboard_;
}

contact::RigidPose SplitHull::pose(HullHalf half, double opening_rad) const
{
  return half == HullHalf::port ? contact::RigidPose::rotation(opening_rad, hinge_m_)
                                : contact::RigidPose::rotation(-opening_rad, Vec2(-hinge_m_[0], hinge_m_[1]));
}

contact::RigidPose SplitHull::pose(HullHalf half, const OpeningAngles& opening) const
{
  return pose(half, half == HullHalf::port ? opening.port_rad : opening.starboard_rad);
}

std::vector<Vec2> SplitHull::section_m(HullHalf half, const OpeningAngles& opening) const
{
  const contact::RigidPose turned = pose(half, opening);
  std::vector<Vec2> section = closed_section_m(half);
  for (Vec2& point : section)
    point = turned.apply(point);
  return section;
}

double SplitHull::slot_width_m(const OpeningAngles& opening) const
{
  double port_y = std::numeric_limits<double>::infinity();
  double starboard_y = -std::numeric_limits<double>::infinity();
  const contact::RigidPose port = pose(HullHalf::port, opening);
  const contact::RigidPose starboard = pose(HullHalf::starboard, opening);
  for (const Vec2& point : port_)
    port_y = std::min(port_y, port.apply(point)[0]);
  for (const Vec2& point : starboard_)
    starboard_y = std::max(starboard_y, starboard.apply(point)[0]);
  return port_y - starboard_y;
}

double SplitHull::lowest_level_m(const OpeningAngles& opening) const
{
  double level = std::numeric_limits<double>::infinity();
  for (const HullHalf half : { HullHalf::port, HullHalf::starboard }) {
    const contact::RigidPose turned = pose(half, opening);
    for (const Vec2& point : closed_section_m(half))
      level = std::min(level, turned.apply(point)[1]);
  }
  return level;
}

namespace {

// The arc that replaces one corner.
struct Corner {
  Vec2 vertex, in, out;    // unit directions before and after
  double turn_rad = 0.0;   // positive to the left
  double tangent_m = 0.0;  // from the vertex to where the arc begins and ends
};

Corner corner_at(const std::vector<Vec2>& line_m, std::size_t i, double radius_m, const std::string& key)
{
  constexpr double straight_rad = 1e-9;
  constexpr double turned_back_rad = 3.1;
  Corner corner;
  corner.vertex = line_m[i];
  corner.in = (line_m[i] - line_m[i - 1]).normalized();
  corner.out = (line_m[i + 1] - line_m[i]).normalized();
  corner.turn_rad = std::atan2(cross(corner.in, corner.out), corner.in.dot(corner.out));
  if (std::abs(corner.turn_rad) > turned_back_rad)
    throw InputError("", key, text(radius_m),
                     "no corner may turn back on itself, as the one at " + text(corner.vertex) + " does");
  if (std::abs(corner.turn_rad) > straight_rad)
    corner.tangent_m = radius_m * std::tan(0.5 * std::abs(corner.turn_rad));
  return corner;
}

void append_arc(std::vector<Vec2>& line_m, const Corner& corner, double radius_m, double max_turn_rad)
{
  const double side = corner.turn_rad > 0.0 ? 1.0 : -1.0;
  const Vec2 start = corner.vertex - corner.tangent_m * corner.in;
  const Vec2 center = start + side * radius_m * Vec2(-corner.in[1], corner.in[0]);
  const int chords = std::max(1, static_cast<int>(std::ceil(std::abs(corner.turn_rad) / max_turn_rad)));
  for (int k = 0; k <= chords; ++k)
    line_m.push_back(contact::RigidPose::rotation(corner.turn_rad * k / chords, center).apply(start));
}

}  // namespace

std::vector<Vec2> round_corners(const std::vector<Vec2>& line_m, double radius_m, double max_turn_rad,
                                const std::string& key)
{
  if (!(radius_m >= 0.0 && std::isfinite(radius_m)))
    throw InputError("", key, text(radius_m), "must be finite and >= 0 m");
  if (!(max_turn_rad > 0.0))
    throw InputError("", key, text(radius_m), "the chords of its arcs must turn by more than 0 rad");
  if (line_m.size() < 3 || radius_m == 0.0)
    return line_m;

  std::vector<Vec2> rounded{ line_m.front() };
  double tangent_before_m = 0.0;
  for (std::size_t i = 1; i + 1 < line_m.size(); ++i) {
    const Corner corner = corner_at(line_m, i, radius_m, key);
    const double tangent_after_m = i + 2 < line_m.size() ? corner_at(line_m, i + 1, radius_m, key).tangent_m : 0.0;
    const double room_m = std::min((line_m[i] - line_m[i - 1]).norm() - tangent_before_m,
                                   (line_m[i + 1] - line_m[i]).norm() - tangent_after_m);
    if (corner.tangent_m > room_m)
      throw InputError("", key, text(radius_m),
                       "the arc at corner " + text(corner.vertex) + " needs " + text(corner.tangent_m) +
                           " m of both its sides, which have " + text(std::max(room_m, 0.0)) +
                           " m left; reduce the radius or move the points apart");
    if (corner.tangent_m > 0.0)
      append_arc(rounded, corner, radius_m, max_turn_rad);
    else
      rounded.push_back(corner.vertex);
    tangent_before_m = corner.tangent_m;
  }
  rounded.push_back(line_m.back());
  // Two arcs, or an arc and an end, that meet exactly leave a point twice.
  const auto same = [radius_m](const Vec2& a, const Vec2& b) { return (a - b).norm() < 1e-12 * (1.0 + radius_m); };
  rounded.erase(std::unique(rounded.begin(), rounded.end(), same), rounded.end());
  return rounded;
}

}  // namespace geocontainer_mpm::barge
