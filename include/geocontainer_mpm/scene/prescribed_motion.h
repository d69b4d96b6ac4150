#pragma once
/// Where the rigid surfaces of a scene are: hull halves by the opening angles, the others by their own tables.

#include <optional>
#include <vector>

#include "geocontainer_mpm/barge/split_hull.h"
#include "geocontainer_mpm/contact/surface.h"
#include "geocontainer_mpm/scene/description.h"

namespace geocontainer_mpm::scene {

class PrescribedMotion {
public:
  explicit PrescribedMotion(const SceneDescription& scene);

  /// In the order of Model::boundaries(): hull_port, hull_starboard, then the surfaces by name.
  std::vector<contact::RigidPose> poses(double time_s, const barge::OpeningAngles& opening) const;
  /// Rotation of boundary body `b` about its pivot; of a hull half: opening positive, rad.
  double angle(std::size_t b, double time_s, const barge::OpeningAngles& opening) const;

private:
  std::optional<barge::SplitHull> hull_;
  std::vector<MotionDescription> surfaces_;  ///< an empty table: stands still
};

}  // namespace geocontainer_mpm::scene
