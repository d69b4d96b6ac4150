#pragma once
/// The whole state of a run in one HDF5 file, from which it goes on as if it had never been away: bit for bit.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "geocontainer_mpm/barge/opening_signal.h"
#include "geocontainer_mpm/scene/simulation.h"

namespace geocontainer_mpm::record {

/// Of a log of opening angles, by which a checkpoint knows it again; of none (the scene's own opening) one of its own.
std::uint64_t opening_hash(const std::vector<barge::OpeningSample>& samples);

/// Writes the last state that the run has found right: at rest and where a frame is due the present one, else at most a
/// few dozen steps back. The file is replaced at once (written beside it as `<path>.<process>.part`, then renamed), so
/// that whatever happens there is a whole one. Returns an empty string, or what went wrong; never throws. A run that
/// has not reached its first frame has nothing to save yet.
///
/// HDF5's C library keeps state for the whole process: see Recorder about threads.
std::string save_checkpoint(const scene::Simulation& simulation, std::uint64_t opening, const std::string& path);

/// The file's bytes, for who has to write them elsewhere (replace_file() in whole_file.h); empty where there is nothing
/// to save yet. Throws std::exception when HDF5 fails.
std::string checkpoint_bytes(const scene::Simulation& simulation, std::uint64_t opening);

/// The run as it was saved, opening signal included. `scene` must be the checkpoint's, but for another `time.end_s`
/// that is not before the saved state; where the old end lies between two output instants it must be the same, since
/// the steps before it depend on it. `opening`: the log's hash, which must be the checkpoint's too; not given: not
/// looked at, for a log that goes on. The number of threads may be another. Does not settle the scene again.
///
/// Throws InputError, one sentence, for a file that is not there, is no checkpoint or not a whole one, and for one of
/// another version, scene or log.
scene::Simulation load_checkpoint(const std::string& path, const scene::SceneDescription& scene,
                                  std::optional<std::uint64_t> opening, int threads);

}  // namespace geocontainer_mpm::record
