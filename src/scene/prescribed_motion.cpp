#include "geocontainer_mpm/scene/prescribed_motion.h"

namespace geocontainer_mpm::scene {

PrescribedMotion::PrescribedMotion(const SceneDescription& scene)
{
  if (scene.hull)
    hull_.emplace(scene.hull->hinge_m, scene.hull->port_section_m, "hull");
  for (const auto& [name, surface] : scene.surfaces)
    surfaces_.push_back(surface.motion.value_or(MotionDescription{}));
}

std::vector<contact::RigidPose> PrescribedMotion::poses(double time_s, const barge::OpeningAngles& opening) const
{
  std::vector<contact::RigidPose> result;
  if (hull_)
    for (const barge::HullHalf half : { barge::HullHalf::port, barge::HullHalf::starboard })
      result.push_back(hull_->pose(half, opening));
  for (const MotionDescription& motion : surfaces_) {
    if (motion.table.empty()) {
      result.emplace_back();
      continue;
    }
    const auto [y, z, angle] = value_at<3>(motion.table, time_s);
    result.push_back(contact::RigidPose::motion(angle, motion.pivot_m, Vec2(y, z)));
  }
  return result;
}

double PrescribedMotion::angle(std::size_t b, double time_s, const barge::OpeningAngles& opening) const
{
  const std::size_t halves = hull_ ? 2 : 0;
  if (b < halves)
    return b == 0 ? opening.port_rad : opening.starboard_rad;
  const TimeTable<3>& table = surfaces_[b - halves].table;
  return table.empty() ? 0.0 : value_at<3>(table, time_s)[2];
}

}  // namespace geocontainer_mpm::scene
