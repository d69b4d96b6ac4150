#pragma once
/// Where the rigid surfaces of a scene are: hull halves by the opening angles, the others by their own tables.

#include <optional>
#include <string>
#include <vector>

#include "geocontainer_mpm/barge/split_hull.h"
#include "geocontainer_mpm/contact/surface.h"
#include "geocontainer_mpm/scene/description.h"

namespace geocontainer_mpm::scene {

/// A rigid part of the hull.
struct HullPart {
  enum class What { wall, aft_bulkhead, fore_bulkhead };
  std::string name;
  barge::HullHalf half;  ///< it moves with
  What what;
};

/// The parts of a scene's hull that are computed: port wall first, then starboard's, then bulkheads; none without hull.
std::vector<HullPart> hull_parts(const SceneDescription& scene);

class PrescribedMotion {
public:
  explicit PrescribedMotion(const SceneDescription& scene);

  /// In the order of Model::boundaries(): parts of the hull, then the surfaces by name.
  std::vector<contact::RigidPose> poses(double time_s, const barge::OpeningAngles& opening) const;
  /// Rotation of boundary body `b` about its pivot; of a part of the hull: opening positive, rad.
  double angle(std::size_t b, double time_s, const barge::OpeningAngles& opening) const;

private:
  std::optional<barge::SplitHull> hull_;
  std::vector<barge::HullHalf> halves_;      ///< of the parts of the hull
  std::vector<MotionDescription> surfaces_;  ///< an empty table: stands still
};

}  // namespace geocontainer_mpm::scene
