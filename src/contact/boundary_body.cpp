#include "geocontainer_mpm/contact/boundary_body.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace geocontainer_mpm::contact {

BoundaryBody::BoundaryBody(std::string name, Surface surface, double friction, double spacing)
    : name_(std::move(name)), surface_(std::move(surface)), friction_(friction)
{
  // Particles sit at the middle of equal pieces of each segment, so that every one has one clear normal.
  const std::vector<Vec2>& line = surface_.line();
  reference_lower_ = reference_upper_ = line.front();
  for (const Vec2& vertex : line) {
    reference_lower_ = reference_lower_.cwiseMin(vertex);
    reference_upper_ = reference_upper_.cwiseMax(vertex);
  }
  for (std::size_t k = 0; k < surface_.segments(); ++k) {
    const Vec2 along = line[k + 1 < line.size() ? k + 1 : 0] - line[k];
    const int pieces = std::max(1, static_cast<int>(std::ceil(along.norm() / spacing - 1e-9)));
    for (int i = 0; i < pieces; ++i) {
      reference_.push_back(line[k] + (i + 0.5) / pieces * along);
      normal_.push_back(left_normal(along.normalized()));
    }
  }
}

void BoundaryBody::set_motion(const RigidPose& start, const RigidPose& end, double dt)
{
  start_ = start;
  end_ = end;
  inverse_dt_ = dt > 0.0 ? 1.0 / dt : 0.0;
}

Nearest BoundaryBody::nearest(const Vec2& point) const
{
  Nearest result = surface_.nearest(start_.invert(point));
  result.normal = start_.turn(result.normal);
  return result;
}

}  // namespace geocontainer_mpm::contact
