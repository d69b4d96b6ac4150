#pragma once
/// The XDMF sidecar: a small XML file that tells ParaView where in the HDF5 file each frame's arrays are.

#include <cstddef>
#include <string>

#include "geocontainer_mpm/scene/frame.h"

namespace geocontainer_mpm::record {

/// The XML of one frame. `file_name` is the HDF5 file's name without its folder: the two travel together.
std::string xdmf_entry(const scene::Frame& frame, const std::string& frame_path, const std::string& file_name);

/// Keeps two files and exchanges their names: the one that readers see is complete at every instant, and a frame costs
/// the same however many went before. A failed or killed write leaves the visible file as it was.
class XdmfSidecar {
public:
  /// Creates `path` and `path` + `.next`. Throws std::system_error.
  explicit XdmfSidecar(const std::string& path);
  ~XdmfSidecar();
  XdmfSidecar(const XdmfSidecar&) = delete;
  XdmfSidecar& operator=(const XdmfSidecar&) = delete;

  /// Throws std::system_error; the sidecar must not be used after that.
  void append(const std::string& entry);

private:
  /// One of the two files.
  struct Side {
    explicit Side(const std::string& path);
    ~Side();
    Side(Side&& other) noexcept;
    Side& operator=(Side&& other) noexcept;

    int descriptor;
    std::size_t body_end;  ///< where the closing tags begin
  };

  void exchange_names();

  std::string path_, next_path_;
  Side shown_, next_;
  std::string missing_in_next_;  ///< the entry that only the shown file has
};

}  // namespace geocontainer_mpm::record
