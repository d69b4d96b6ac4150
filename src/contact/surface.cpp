#include "geocontainer_mpm/contact/surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "geocontainer_mpm/error.h"

namespace geocontainer_mpm::contact {
namespace {

/// Up to `few_segments` a line is looked at in one go; a longer one in chunks of `chunk_segments`.
constexpr std::size_t few_segments = 16, chunk_segments = 8;

}  // namespace

Surface::Surface(std::vector<Vec2> line, bool closed) : line_(std::move(line)), closed_(closed)
{
  const std::size_t least = closed ? 3 : 2;
  if (line_.size() < least)
    throw InputError("", "surface", std::to_string(line_.size()) + " vertices", "at least " + std::to_string(least));
  const std::size_t segments = closed ? line_.size() : line_.size() - 1;
  for (std::size_t k = 0; k < segments; ++k) {
    const std::size_t next = k + 1 < line_.size() ? k + 1 : 0;
    const Vec2 along = line_[next] - line_[k];
    const double length = along.norm();
    if (!(length > 0.0))
      throw InputError("", "surface", "vertex " + std::to_string(next), "neighbouring vertices must differ");
    length_.push_back(length);
    tangent_.push_back(along / length);
  }
  const std::size_t size = segments > few_segments ? chunk_segments : segments;
  for (std::size_t begin = 0; begin < segments; begin += size) {
    Chunk chunk{ begin, std::min(begin + size, segments), line_[begin], line_[begin] };
    for (std::size_t k = begin + 1; k <= chunk.end; ++k) {
      const Vec2& vertex = line_[k < line_.size() ? k : 0];
      chunk.lower = chunk.lower.cwiseMin(vertex);
      chunk.upper = chunk.upper.cwiseMax(vertex);
    }
    chunks_.push_back(chunk);
  }
}

Nearest<2> Surface::nearest(const Vec2& point) const
{
  double best = std::numeric_limits<double>::infinity();
  Nearest<2> result{ best, Vec2::Zero() };
  if (chunks_.size() == 1) {
    look_at(chunks_.front(), point, best, result);
    return result;
  }
  const auto square_to = [&point](const Chunk& chunk) {
    return (chunk.lower - point).cwiseMax(point - chunk.upper).cwiseMax(0.0).squaredNorm();
  };
  std::size_t first = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t c = 0; c < chunks_.size(); ++c) {
    const double square = square_to(chunks_[c]);
    if (square < least) {
      least = square;
      first = c;
    }
  }
  look_at(chunks_[first], point, best, result);
  for (std::size_t c = 0; c < chunks_.size(); ++c)
    if (c != first && square_to(chunks_[c]) <= best)
      look_at(chunks_[c], point, best, result);
  return result;
}

void Surface::look_at(const Chunk& chunk, const Vec2& point, double& best, Nearest<2>& result) const
{
  const std::size_t segments = length_.size();
  for (std::size_t k = chunk.begin; k < chunk.end; ++k) {
    const Vec2 from_start = point - line_[k];
    const double along = from_start.dot(tangent_[k]);
    const double clamped = std::fmin(std::fmax(along, 0.0), length_[k]);
    const Vec2 apart = from_start - clamped * tangent_[k];
    const double square = apart.squaredNorm();
    if (square >= best)
      continue;
    best = square;
    // Beyond either end of an open line there is nothing to touch.
    if (!closed_ && ((k == 0 && along < 0.0) || (k + 1 == segments && along > length_[k]))) {
      result = { std::numeric_limits<double>::infinity(), Vec2::Zero() };
      continue;
    }
    const Vec2 normal = left_normal(tangent_[k]);
    if (along == clamped) {
      result = { from_start.dot(normal), normal };
      continue;
    }
    // Nearest to a vertex: the sign comes from the mean of the two normals that meet there (Baerentzen 2005).
    const std::size_t other = along < 0.0 ? (k + segments - 1) % segments : (k + 1) % segments;
    const Vec2 mean = (normal + left_normal(tangent_[other])).normalized();
    const double distance = std::sqrt(square);
    const bool free_side = apart.dot(mean) >= 0.0;
    result = { free_side ? distance : -distance,
               distance > 0.0 ? Vec2(apart / (free_side ? distance : -distance)) : mean };
  }
}

RigidPose RigidPose::rotation(double angle_rad, const Vec2& pivot)
{
  return motion(angle_rad, pivot, Vec2::Zero());
}

RigidPose RigidPose::motion(double angle_rad, const Vec2& pivot, const Vec2& shift)
{
  return { std::cos(angle_rad), std::sin(angle_rad), pivot, shift };
}

}  // namespace geocontainer_mpm::contact
