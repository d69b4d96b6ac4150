#pragma once

#include "options.h"

namespace geocontainer_mpm::program {

/// Runs an ensemble, on every rank of `mpirun`; the first one reports. Returns the exit status. Throws an InputError
/// for bad input, on the first rank alone.
int run_ensemble(const Options& options);

}  // namespace geocontainer_mpm::program
