#pragma once
/// Runs a drawn scene and says what became of it.

#include <string>

#include "draw.h"

namespace geocontainer_mpm::stability {

enum class Class {
  survived,  ///< ran to its end, or through its budget, and every look found it sound
  stopped,   ///< the solver ended the run and said why
  failed     ///< it went on with nonsense, threw, or gave other bits the second time
};
const char* to_string(Class what);

struct Verdict {
  Class what = Class::survived;
  std::string reason;  ///< empty for survived
  double time_s = 0.0, end_s = 0.0;
  unsigned long long steps = 0, particles = 0, retries = 0;
  double balance_error = 0.0;  ///< relative, at the end
  /// The most that particles gained and nobody paid for, and that went without an account, over what was there at the
  /// start or changed hands at most.
  double gained = 0.0, lost = 0.0;
};

Verdict judge(const Drawing& drawing);

}  // namespace geocontainer_mpm::stability
