#pragma once

namespace geocontainer_mpm::program {

inline constexpr int exit_completed = 0;
inline constexpr int exit_bad_input = 2;  ///< also a named output that cannot be written
inline constexpr int exit_solver_stopped = 3;
inline constexpr int exit_signal_base = 128;  ///< plus the number of the signal, as shells have it

}  // namespace geocontainer_mpm::program
