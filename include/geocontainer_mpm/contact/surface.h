#pragma once
/// A rigid surface in plane strain: an open polyline whose free side is on the left walking along it (y to the right,
/// z up). Steel or bed is on the right.

#include <vector>

#include "geocontainer_mpm/mpm/types.h"

namespace geocontainer_mpm::contact {

/// Nearest point of a surface, seen from some point.
struct Nearest {
  double distance;  ///< signed, m: positive on the free side; infinite beyond the ends of the line
  Vec2 normal;      ///< of the surface there, unit, into the free side
};

class Surface {
public:
  /// At least two distinct vertices, m.
  explicit Surface(std::vector<Vec2> line);

  const std::vector<Vec2>& line() const { return line_; }
  Nearest nearest(const Vec2& point) const;

private:
  std::vector<Vec2> line_;
  std::vector<Vec2> tangent_;   ///< per segment, unit
  std::vector<double> length_;  ///< per segment, m
};

/// Unit normal on the left of direction `tangent`.
inline Vec2 left_normal(const Vec2& tangent)
{
  return { -tangent[1], tangent[0] };
}

/// Rotation about x through `pivot`: x = pivot + R(angle) (X - pivot), angle positive from y towards z. Stores no
/// history: any chain of angles ends in the exact rotation of the last.
struct RigidPose {
  double cosine = 1.0, sine = 0.0;
  Vec2 pivot = Vec2::Zero();

  static RigidPose rotation(double angle_rad, const Vec2& pivot);
  Vec2 turn(const Vec2& v) const { return { cosine * v[0] - sine * v[1], sine * v[0] + cosine * v[1] }; }
  Vec2 turn_back(const Vec2& v) const { return { cosine * v[0] + sine * v[1], cosine * v[1] - sine * v[0] }; }
  Vec2 apply(const Vec2& reference) const { return pivot + turn(reference - pivot); }
  Vec2 invert(const Vec2& current) const { return pivot + turn_back(current - pivot); }
};

}  // namespace geocontainer_mpm::contact
