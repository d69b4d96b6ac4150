#pragma once
/// A rigid surface's section: a polyline in the y-z plane, open or closed, whose free side is on the left walking along
/// it (y to the right, z up). Steel or bed is on the right: a closed line is a solid with the sense of a clock's hands,
/// and a hole (a drum, say) against it. Motion of rigid bodies is in that plane as well, in three dimensions too.

#include <cstddef>
#include <vector>

#include "geocontainer_mpm/mpm/types.h"

namespace geocontainer_mpm::contact {

/// Nearest point of a surface, seen from some point.
template <int Dim>
struct Nearest {
  double distance;  ///< signed, m: positive on the free side; infinite beyond the ends of an open line
  Vec<Dim> normal;  ///< of the surface there, unit, into the free side
};

/// The vector with another part in the section.
template <class V>
Vec<V::SizeAtCompileTime> with_section(const Eigen::MatrixBase<V>& v, const Vec2& section)
{
  Vec<V::SizeAtCompileTime> result = v;
  result.template tail<2>() = section;
  return result;
}

class Surface {
public:
  /// At least two vertices, m, and neighbours distinct; closed: at least three, the last joined to the first.
  explicit Surface(std::vector<Vec2> line, bool closed = false);

  const std::vector<Vec2>& line() const { return line_; }
  bool closed() const { return closed_; }
  std::size_t segments() const { return length_.size(); }
  Nearest<2> nearest(const Vec2& point) const;

private:
  /// Consecutive segments and the box around them: what is further than the best so far is not looked at.
  struct Chunk {
    std::size_t begin, end;
    Vec2 lower, upper;
  };
  void look_at(const Chunk& chunk, const Vec2& point, double& best, Nearest<2>& result) const;

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
/// towards z. Stores no history: any chain of motions ends in the exact pose of the last. What it moves is given in the
/// section or in space; in space x stays as it is.
struct RigidPose {
  double cosine = 1.0, sine = 0.0;
  Vec2 pivot = Vec2::Zero();  ///< in the reference position, m
  Vec2 shift = Vec2::Zero();  ///< m

  static RigidPose rotation(double angle_rad, const Vec2& pivot);
  static RigidPose motion(double angle_rad, const Vec2& pivot, const Vec2& shift);
  Vec2 turn(const Vec2& v) const { return { cosine * v[0] - sine * v[1], sine * v[0] + cosine * v[1] }; }
  Vec2 turn_back(const Vec2& v) const { return { cosine * v[0] + sine * v[1], cosine * v[1] - sine * v[0] }; }
  Vec2 apply(const Vec2& reference) const { return pivot + turn(Vec2(reference - pivot)) + shift; }
  Vec2 invert(const Vec2& current) const { return pivot + turn_back(Vec2(current - pivot - shift)); }

  template <class V>
  auto turn(const Eigen::MatrixBase<V>& v) const
  {
    return with_section(v, turn(in_section(v)));
  }
  template <class V>
  auto turn_back(const Eigen::MatrixBase<V>& v) const
  {
    return with_section(v, turn_back(in_section(v)));
  }
  template <class V>
  auto apply(const Eigen::MatrixBase<V>& reference) const
  {
    return with_section(reference, apply(in_section(reference)));
  }
  template <class V>
  auto invert(const Eigen::MatrixBase<V>& current) const
  {
    return with_section(current, invert(in_section(current)));
  }
};

}  // namespace geocontainer_mpm::contact
