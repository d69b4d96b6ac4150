#pragma once
/// Watches a run: what became of the container, and the largest tension so far.

#include <array>
#include <optional>
#include <vector>

#include "geocontainer_mpm/barge/split_hull.h"
#include "geocontainer_mpm/scene/model.h"

namespace geocontainer_mpm::scene {

template <int Dim>
class ReleaseWatch {
public:
  explicit ReleaseWatch(const SceneDescription& scene);

  /// Looks at the model after a step, or while it rests; everything, hull included, has been still for `still_for_s`.
  void observe(const Model<Dim>& model, double time_s, const barge::OpeningAngles& opening, double still_for_s);

  StatusFrame status(const Model<Dim>& model) const;

private:
  /// What is known of one sheet.
  struct Watched {
    Outcome outcome = Outcome::none;
    double release_time_s = -1.0;
    double peak = 0.0, peak_time_s = 0.0, current = 0.0, elongation = 0.0;
    Vec3 peak_position = Vec3::Zero();
    geotextile::Utilisation used;  ///< largest so far
    std::size_t ruptures = 0;
    double rupture_time_s = -1.0;
    Vec3 rupture_position = Vec3::Zero();
    double initial_volume = 0.0;  ///< of the body inside, m^2
    std::vector<TensionEpisode> episodes;
  };

  void open_episodes(const Model<Dim>& model, double time_s);
  void measure(const ModelSheet<Dim>& what, double time_s, Watched& watched);
  void judge(const ModelSheet<Dim>& sheet, double time_s, const barge::OpeningAngles& opening, double still_for_s,
             Watched& watched) const;
  Outcome outcome() const;
  ContainerStatus container(const Model<Dim>& model, std::size_t sheet) const;

  std::optional<barge::SplitHull> hull_;
  double hung_up_after_s_;
  std::vector<Watched> watched_;  ///< in the order of the sheets
  std::vector<bool> held_;        ///< bodies that had not started at the last look
  double initial_volume_ = -1.0;
  std::array<std::vector<double>, Dim - 1> gauge_;  ///< scratch
};

/// Fills the bodies, sheets and boundaries (in their reference pose) of a frame.
template <int Dim>
void fill_frame(const Model<Dim>& model, const SceneDescription& scene, const std::vector<Vec<Dim>>& boundary_force,
                Frame& frame);

}  // namespace geocontainer_mpm::scene
