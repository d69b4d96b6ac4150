#pragma once
/// Watches a run: what became of the container, and the largest tension so far.

#include <optional>
#include <vector>

#include "geocontainer_mpm/barge/split_hull.h"
#include "geocontainer_mpm/scene/model.h"

namespace geocontainer_mpm::scene {

class ReleaseWatch {
public:
  explicit ReleaseWatch(const SceneDescription& scene);

  /// Looks at the model after a step, or while it rests; everything, hull included, has been still for `still_for_s`.
  void observe(const Model& model, double time_s, const barge::OpeningAngles& opening, double still_for_s);

  StatusFrame status(const Model& model) const;

private:
  void judge(const Model& model, double time_s, const barge::OpeningAngles& opening, double still_for_s);

  std::optional<barge::SplitHull> hull_;
  double hung_up_after_s_;
  Outcome outcome_ = Outcome::none;
  double release_time_s_ = -1.0;
  double peak_ = 0.0, peak_time_s_ = 0.0, current_ = 0.0, elongation_ = 0.0;
  Vec2 peak_position_ = Vec2::Zero();
  double initial_volume_ = -1.0;
  geotextile::Utilisation utilisation_;
  std::size_t ruptures_ = 0;
  double rupture_time_s_ = -1.0;
  Vec2 rupture_position_ = Vec2::Zero();
  std::vector<double> gauge_;  ///< scratch
};

/// Fills the bodies, sheets and boundaries (in their reference pose) of a frame.
void fill_frame(const Model& model, const SceneDescription& scene, const std::vector<Vec2>& boundary_force,
                Frame& frame);

}  // namespace geocontainer_mpm::scene
