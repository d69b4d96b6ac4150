#pragma once
/// Writes frames to an HDF5 file (one group a frame) and an XDMF sidecar that ParaView 5.11 opens. docs/record.md has
/// the layout.

#include <cstddef>
#include <memory>
#include <string>

#include "geocontainer_mpm/scene/frame.h"

namespace geocontainer_mpm::record {

/// HDF5's C library keeps state for the whole process and is not thread-safe as packaged: use all recorders of a
/// process from one thread at a time.
class Recorder {
public:
  /// Creates (overwrites) `path` and `<path without .h5>.xdmf`. `scene_name` goes into the file's attributes,
  /// `scene_text` (the YAML with its overrides) into its data set `scene`. Throws InputError when a file cannot be
  /// created.
  Recorder(const std::string& path, const std::string& scene_name, const std::string& scene_text);
  ~Recorder();
  Recorder(Recorder&&) noexcept;
  Recorder& operator=(Recorder&&) noexcept;

  /// Appends one frame and hands it to the operating system, so that a run killed at any later instant leaves a file
  /// that opens and holds it. Returns an empty string, or what went wrong (disk full, ...); never throws. After a
  /// failure nothing more is written and every call returns the same sentence; the frames before it stay readable.
  std::string write(const scene::Frame& frame);

  /// Frames that a reader finds.
  std::size_t frames() const;

private:
  struct File;
  std::unique_ptr<File> file_;
};

}  // namespace geocontainer_mpm::record
