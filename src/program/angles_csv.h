#pragma once
/// Opening angles from a CSV file with the header `time_s,port_rad,starboard_rad`.

#include <string>
#include <vector>

#include "geocontainer_mpm/barge/opening_signal.h"

namespace geocontainer_mpm::program {

/// Samples in the order of the file. Whatever is not a table of numbers throws an InputError naming file:line and
/// column; numbers that make no sense as a measurement (non-finite, too fast, ...) are left to the opening signal.
std::vector<barge::OpeningSample> read_angles_csv(const std::string& path);

}  // namespace geocontainer_mpm::program
