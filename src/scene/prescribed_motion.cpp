#include "geocontainer_mpm/scene/prescribed_motion.h"

namespace geocontainer_mpm::scene {

std::vector<HullPart> hull_parts(const SceneDescription& scene)
{
  using barge::HullHalf;
  std::vector<HullPart> parts;
  if (!scene.hull)
    return parts;
  parts.push_back({ "hull_port", HullHalf::port, HullPart::What::wall });
  if (scene.symmetry() == Symmetry::none)
    parts.push_back({ "hull_starboard", HullHalf::starboard, HullPart::What::wall });
  if (!scene.hull->along_m)
    return parts;
  const std::vector<HullPart> walls = parts;
  for (const HullPart& wall : walls) {
    const std::string side = wall.half == HullHalf::port ? "port" : "starboard";
    if (scene.symmetry() != Symmetry::quarter)
      parts.push_back({ "hull_bulkhead_aft_" + side, wall.half, HullPart::What::aft_bulkhead });
    parts.push_back({ "hull_bulkhead_fore_" + side, wall.half, HullPart::What::fore_bulkhead });
  }
  return parts;
}

PrescribedMotion::PrescribedMotion(const SceneDescription& scene)
{
  if (scene.hull)
    hull_.emplace(scene.hull->hinge_m, scene.hull->port_section_m, "hull");
  for (const HullPart& part : hull_parts(scene))
    halves_.push_back(part.half);
  for (const auto& [name, surface] : scene.surfaces)
    surfaces_.push_back(surface.motion.value_or(MotionDescription{}));
}

std::vector<contact::RigidPose> PrescribedMotion::poses(double time_s, const barge::OpeningAngles& opening) const
{
  std::vector<contact::RigidPose> result;
  for (const barge::HullHalf half : halves_)
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
  if (b < halves_.size())
    return halves_[b] == barge::HullHalf::port ? opening.port_rad : opening.starboard_rad;
  const TimeTable<3>& table = surfaces_[b - halves_.size()].table;
  return table.empty() ? 0.0 : value_at<3>(table, time_s)[2];
}

}  // namespace geocontainer_mpm::scene
