#pragma once
/// A rigid surface in plane strain: a polyline, open or closed, whose free side is on the left walking along it (y to
/// the right, z up). Steel or bed is on the right: a closed line is a solid with the sense of a clock's hands, and a
/// hole (a drum, say) against it.

#include <cstddef>
#include <vector>

#include "geocontainer_mpm/mpm/types.h"

namespace geocontainer_mpm::contact {

/// Nearest point of a surface, seen from some point.
struct Nearest {
  double distance;  ///< signed, m: positive on the free side; infinite beyond the ends of an open line
  Vec2 normal;      ///< of the surface there, unit, into the free side
};

class Surface {
public:
  /// At least two vertices, m, and neighbours distinct; closed: at least three, the last joined to the first.
  explicit Surface(std::vector<Vec2> line, bool closed = false);

  const std::vector<Vec2>& line() const { return line_; }
  bool closed() const { return closed_; }
  std::size_t segments() const { return length_.size(); }
  Nearest nearest(const Vec2& point) const;

private:
  /// Consecutive segments and the box around them: what is further than the best so far is not looked at.
  struct Chunk {
    std::size_t begin, end;
    Vec2 lower, upper;
  };
  void look_at(const Chunk& chunk, const Vec2& point, double& best, Nearest& result) const;

  std::vector<Vec2> line_;
  bool closed_;
  std::vector<Vec2> tangent_;   ///< per segment, unit
  std::vector<double> length_;  ///< per segment, m
  std::vector<Chunk> chunks_;
};

/// Unit normal on the left of direction `tangent`.
inline Vec2 left_normal(const Vec2& tangent)
{
  return { -tangent[1], tangent[0] };
}

/// Rotation about x through `pivot`, then a shift: x = pivot + R(angle) (X - pivot) + shift, angle positive from y
/// towards z. Stores no history: any chain of motions ends in the exact pose of the last.
struct RigidPose {
  double cosine = 1.0, sine = 0.0;
  Vec2 pivot = Vec2::Zero();  ///< in the reference position, m
  Vec2 shift = Vec2::Zero();  ///< m

  static RigidPose rotation(double angle_rad, const Vec2& pivot);
  static RigidPose motion(double angle_rad, const Vec2& pivot, const Vec2& shift);
  Vec2 turn(const Vec2& v) const { return { cosine * v[0] - sine * v[1], sine * v[0] + cosine * v[1] }; }
  Vec2 turn_back(const Vec2& v) const { return { cosine * v[0] + sine * v[1], cosine * v[1] - sine * v[0] }; }
  Vec2 apply(const Vec2& reference) const { return pivot + turn(reference - pivot) + shift; }
  Vec2 invert(const Vec2& current) const { return pivot + turn_back(current - pivot - shift); }
};

}  // namespace geocontainer_mpm::contact
