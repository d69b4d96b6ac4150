#pragma once
/// What the command line says is to be computed: a scene, and how its hull opens.

#include <string>
#include <vector>

#include "geocontainer_mpm/barge/opening_signal.h"
#include "geocontainer_mpm/scene/simulation.h"
#include "options.h"

namespace geocontainer_mpm::program {

/// The scene with these overrides, `key=value`, and the cap of its end.
scene::SceneDescription load_case(const Options& options, const std::vector<std::string>& overrides);

/// Samples of the log; none where the scene's own opening is used.
std::vector<barge::OpeningSample> read_log(const Options& options);

/// Gives a fresh simulation its whole opening. Throws an InputError where no sample of a log is believable.
void open_hull(const Options& options, const std::vector<barge::OpeningSample>& samples, scene::Simulation& simulation);

}  // namespace geocontainer_mpm::program
