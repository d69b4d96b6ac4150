#pragma once
/// Files that are there as a whole or not at all.

#include <string>

namespace geocontainer_mpm::record {

/// Replaces the file at once: written beside it (`<path>.<process>.part`), handed to the disk, then renamed, so that a
/// reader sees the old text or the new one, never half, and so does whoever comes after a kill. A pipe or terminal is
/// written to as it is. Returns an empty string, or the system's words for what went wrong.
std::string replace_file(const std::string& path, const std::string& bytes);

}  // namespace geocontainer_mpm::record
