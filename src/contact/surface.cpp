#include "geocontainer_mpm/contact/surface.h"

#include <cmath>
#include <limits>
#include <utility>

#include "geocontainer_mpm/error.h"

namespace geocontainer_mpm::contact {

Surface::Surface(std::vector<Vec2> line) : line_(std::move(line))
{
  if (line_.size() < 2)
    throw InputError("", "surface", std::to_string(line_.size()) + " vertices", "at least 2");
  for (std::size_t k = 0; k + 1 < line_.size(); ++k) {
    const Vec2 along = line_[k + 1] - line_[k];
    const double length = along.norm();
    if (!(length > 0.0))
      throw InputError("", "surface", "vertex " + std::to_string(k + 1), "neighbouring vertices must differ");
    length_.push_back(length);
    tangent_.push_back(along / length);
  }
}

Nearest Surface::nearest(const Vec2& point) const
{
  double best = std::numeric_limits<double>::infinity();
  Nearest result{ best, Vec2::Zero() };
  const std::size_t segments = length_.size();
  for (std::size_t k = 0; k < segments; ++k) {
    const Vec2 from_start = point - line_[k];
    const double along = from_start.dot(tangent_[k]);
    const double clamped = std::fmin(std::fmax(along, 0.0), length_[k]);
    const Vec2 apart = from_start - clamped * tangent_[k];
    const double square = apart.squaredNorm();
    if (square >= best)
      continue;
    best = square;
    // Beyond either end of the whole line there is nothing to touch.
    if ((k == 0 && along < 0.0) || (k + 1 == segments && along > length_[k])) {
      result = { std::numeric_limits<double>::infinity(), Vec2::Zero() };
      continue;
    }
    const Vec2 normal = left_normal(tangent_[k]);
    if (along == clamped) {
      result = { from_start.dot(normal), normal };
      continue;
    }
    // Nearest to a vertex: the sign comes from the mean of the two normals that meet there (Baerentzen 2005).
    const std::size_t other = along < 0.0 ? k - 1 : k + 1;
    const Vec2 mean = (normal + left_normal(tangent_[other])).normalized();
    const double distance = std::sqrt(square);
    const bool free_side = apart.dot(mean) >= 0.0;
    result = { free_side ? distance : -distance,
               distance > 0.0 ? Vec2(apart / (free_side ? distance : -distance)) : mean };
  }
  return result;
}

RigidPose RigidPose::rotation(double angle_rad, const Vec2& pivot)
{
  return { std::cos(angle_rad), std::sin(angle_rad), pivot };
}

}  // namespace geocontainer_mpm::contact
