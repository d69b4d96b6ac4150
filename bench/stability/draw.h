#pragma once
/// Scenes by chance, as YAML: what a failure leaves behind is a scene file like any other.

#include <cstdint>
#include <string>

namespace geocontainer_mpm::stability {

struct Drawing {
  std::string family;  ///< release, drop, column, stack, sheet, bar, fluid, rest
  std::string yaml;
  /// Particles times steps that the run may take: about a second of CPU. What is not reached is not looked at.
  double budget = 0.0;
  bool twice = false;  ///< runs again after reset(), and on two threads: the same bits must come out
};

/// The scene of a seed: the same text on every machine and with every compiler.
Drawing draw(std::uint64_t seed);

}  // namespace geocontainer_mpm::stability
