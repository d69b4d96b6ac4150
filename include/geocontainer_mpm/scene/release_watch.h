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
  void open_episodes(const Model& model, double time_s);
  void measure(const ModelSheet& what, double time_s, ContainerStatus& watched);
  void judge(const ModelSheet& sheet, double time_s, const barge::OpeningAngles& opening, double still_for_s,
             ContainerStatus& watched) const;
  Outcome outcome() const;
  /// With its present place, extent and volume.
  ContainerStatus container(const Model& model, std::size_t sheet) const;

  std::optional<barge::SplitHull> hull_;
  double hung_up_after_s_;
  std::vector<ContainerStatus> watched_;  ///< in the order of the sheets, without what container() adds
  std::vector<bool> held_;                ///< bodies that had not started at the last look
  double initial_volume_ = -1.0;
  std::vector<double> gauge_;  ///< scratch
};

/// Fills the bodies, sheets and boundaries (in their reference pose) of a frame.
void fill_frame(const Model& model, const SceneDescription& scene, const std::vector<Vec2>& boundary_force,
                Frame& frame);

}  // namespace geocontainer_mpm::scene
