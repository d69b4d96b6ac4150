#pragma once
/// Frames of an invented release, without a solver: the right kind of numbers in every field, so that the record and
/// the pictures can be tried on them. Not physics.

#include "geocontainer_mpm/scene/frame.h"

namespace geocontainer_mpm::record {

/// `rings` sets the number of particles (3 rings (rings + 1) + 1); the run spans 0 to 40 s.
scene::Frame synthetic_frame(double time_s, int rings);

/// The same, lengthened to three dimensions: a container 8 m long with closed ends in a hull of 10 m.
scene::Frame synthetic_solid_frame(double time_s, int rings);

}  // namespace geocontainer_mpm::record
