#pragma once
/// What a scene can make of speed: a step after which a particle is much faster has gone wrong. Energy cannot tell:
/// what a single grain takes when it is thrown out of a node with next to no mass is nothing beside what its body has.

#include "geocontainer_mpm/scene/model.h"

namespace geocontainer_mpm::scene {

/// Contact works penetration off at up to 0.05 m/s (approach.h), on both sides: what a scene may do by itself, m/s.
constexpr double push_out_speed = 0.1;

/// Of all but rigid surfaces, m/s: the sum of the speeds at the start, of what stress at the start can set free, of a
/// fall through the whole grid, of loads, and of what is led. Infinite where the body force of a manufactured solution
/// drives. `model`: at the start, settled.
template <int Dim>
double explained_speed(const SceneDescription& scene, const Model<Dim>& model);

/// Of the fastest point of rigid surfaces in a step, m/s.
template <int Dim>
double fastest_wall(const Model<Dim>& model, const StepInput& step);

}  // namespace geocontainer_mpm::scene
