#pragma once
/// What a run leaves on disk: the streamed record, and the files of ~save.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "geocontainer_mpm/record/recorder.h"
#include "geocontainer_mpm/scene/frame.h"
#include "geocontainer_mpm/scene/simulation.h"

namespace geocontainer_mpm::ros_bridge {

/// Streams frames to `path`; the n-th run (n > 1) to `<path without extension>_run<n><extension>`, so that a loop or a
/// reset never overwrites what came before.
class RunRecord {
public:
  /// An empty path records nothing.
  RunRecord(std::string path, std::string scene_name, std::string scene_text);

  void write(const scene::Frame& frame);  ///< keeps each instant once
  void begin_run(std::uint64_t run);      ///< closes the file of the run before; the next frame opens a new one

  /// A number from which on no file of a run is there yet, so that a node that begins anew overwrites nothing; 1
  /// without a record.
  std::uint64_t free_run() const;

  std::string path() const { return path_.empty() ? path_ : path_of(run_); }
  const std::string& error() const { return error_; }
  std::uint64_t frames() const { return recorder_ ? recorder_->frames() : 0; }
  const std::string& scene_name() const { return scene_name_; }
  const std::string& scene_text() const { return scene_text_; }

private:
  std::string path_of(std::uint64_t run) const;

  std::string path_, scene_name_, scene_text_;
  std::unique_ptr<record::Recorder> recorder_;
  std::uint64_t run_ = 1;
  double last_time_s_ = -1.0;
  std::string error_;
};

/// The scene file with its overrides, for the record's attributes.
std::string scene_text(const std::string& scene_path, const std::vector<std::string>& overrides);

/// Writes the present state as `<stem>.h5` and the summary as `<stem>.json`. Returns an empty string or what failed.
std::string save_state(const scene::Simulation& simulation, const RunRecord& record, const std::string& stem,
                       double wall_time_s, int threads);

/// Digest as the diagnostics, the summary and the tests write it: 16 hexadecimal digits.
std::string digest_text(std::uint64_t digest);

}  // namespace geocontainer_mpm::ros_bridge
