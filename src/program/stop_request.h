#pragma once
/// SIGINT and SIGTERM ask a run to stop after its current step. A second one ends the process at once.

#include <atomic>
#include <csignal>

namespace geocontainer_mpm::program {

class StopRequest {
public:
  StopRequest()
  {
    struct sigaction action = {};
    action.sa_handler = [](int signal) { received = signal; };
    action.sa_flags = static_cast<int>(SA_RESETHAND);
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
  }

  /// Number of the signal, 0 while there was none.
  int signal() const { return received; }

private:
  static inline std::atomic<int> received{
    0
  };  ///< a handler can reach nothing but a static; members' threads look too
  static_assert(std::atomic<int>::is_always_lock_free);
};

}  // namespace geocontainer_mpm::program
