#pragma once
/// From a model to what everybody downstream sees of it.

#include <vector>

#include "geocontainer_mpm/scene/frame.h"
#include "geocontainer_mpm/scene/model.h"

namespace geocontainer_mpm::scene {

/// Fills the bodies, sheets and boundaries (in their reference pose) of a frame.
template <int Dim>
void fill_frame(const Model<Dim>& model, const SceneDescription& scene, const std::vector<Vec<Dim>>& boundary_force,
                Frame& frame);

}  // namespace geocontainer_mpm::scene
