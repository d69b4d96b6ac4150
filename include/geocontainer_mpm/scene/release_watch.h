#pragma once
/// Watches a run: what became of the container, and the largest tension so far.

#include <array>
#include <optional>
#include <vector>

#include "geocontainer_mpm/barge/split_hull.h"
#include "geocontainer_mpm/scene/model.h"
#include "geocontainer_mpm/state_access.h"

namespace geocontainer_mpm::scene {

template <int Dim>
class ReleaseWatch {
public:
  explicit ReleaseWatch(const SceneDescription& scene);

  /// Looks at the model after a step, or while it rests; everything, hull included, has been still for `still_for_s`.
  void observe(const Model<Dim>& model, double time_s, const barge::OpeningAngles& opening, double still_for_s);

  StatusFrame status(const Model<Dim>& model) const;

private:
  friend struct geocontainer_mpm::StateAccess;

  void open_episodes(const Model<Dim>& model, double time_s);
  void measure(const ModelSheet<Dim>& what, double time_s, ContainerStatus& watched);
  void judge(const ModelSheet<Dim>& sheet, double time_s, const barge::OpeningAngles& opening, double still_for_s,
             ContainerStatus& watched) const;
  Outcome outcome() const;
  /// From the part that is computed to the whole: place, extent and volume.
  void complete(ContainerState& state) const;
  /// With its present place, extent and volume.
  ContainerStatus container(const Model<Dim>& model, std::size_t sheet) const;

  std::optional<barge::SplitHull> hull_;
  double hung_up_after_s_;
  Symmetry symmetry_;
  std::vector<ContainerStatus> watched_;  ///< in the order of the sheets, without what container() adds
  std::vector<bool> held_;                ///< bodies that had not started at the last look
  double initial_volume_ = -1.0;
  std::array<std::vector<double>, Dim - 1> gauge_;  ///< scratch
};

}  // namespace geocontainer_mpm::scene
