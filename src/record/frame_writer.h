#pragma once
/// One frame as an HDF5 group. docs/record.md has the layout.

#include <cstddef>
#include <string>

#include "geocontainer_mpm/scene/frame.h"
#include "hdf5_handle.h"

namespace geocontainer_mpm::record {

/// Writes `frame` as a group that no link leads to yet: nobody who opens the file meets it half written.
/// Throws Hdf5Error.
Handle write_unlinked_frame(hid_t file, const scene::Frame& frame);

/// More bytes than the frame's group can take in the file.
std::size_t room_for(const scene::Frame& frame);

/// A text attribute of fixed length. Variable-length text would live in heaps that HDF5 shares between frames and
/// changes in place.
void write_text_attribute(hid_t object, const char* name, const std::string& text);

/// A text as a scalar data set: for texts beyond the 64 KiB that an attribute may hold.
void write_text(hid_t parent, const char* name, const std::string& text);

}  // namespace geocontainer_mpm::record
