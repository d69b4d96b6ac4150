#pragma once

#include <string>

#include "options.h"

namespace geocontainer_mpm::program {

/// Runs the scene; returns the exit status. Throws an InputError for bad input.
int run(const Options& options);

/// Prints the table of a summary written earlier; the same.
int show(const std::string& path);

}  // namespace geocontainer_mpm::program
