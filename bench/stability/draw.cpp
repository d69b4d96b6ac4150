#include "draw.h"

#include <fmt/format.h>

#include <algorithm>

#include "families.h"

namespace geocontainer_mpm::stability {
namespace {

/// Particles times steps, an extra of 60 particles a step for what does not grow with them: about a second of CPU.
constexpr double usual_budget = 4e6;

}  // namespace

Drawing draw(std::uint64_t seed)
{
  Chance c(seed);
  Drawing drawing;
  drawing.budget = usual_budget;
  const double kind = c.between(0.0, 1.0);
  drawing.twice = c.one_in(8);
  const auto is = [&](const char* family, double up_to) {
    if (!drawing.family.empty() || kind >= up_to)
      return false;
    drawing.family = family;
    return true;
  };
  if (is("drop", 0.3))
    drawing.yaml = draw_drop(c);
  else if (is("release", 0.42))
    drawing.yaml = draw_release(c);
  else if (is("stack", 0.58))
    drawing.yaml = draw_stack(c);
  else if (is("sheet", 0.7))
    drawing.yaml = draw_sheet(c);
  else if (is("column", 0.8))
    drawing.yaml = draw_column(c);
  else if (is("bar", 0.89))
    drawing.yaml = draw_bar(c);
  else if (is("fluid", 0.97))
    drawing.yaml = draw_fluid(c);
  else if (is("rest", 1.0)) {
    const double steps = c.one_in(10) ? 1e6 : 4e4;
    drawing.yaml = draw_rest(c, steps);
    drawing.budget = std::max(usual_budget, 100.0 * steps);
    drawing.twice = false;
  }
  drawing.yaml = fmt::format("# stability {} (family {})\n", seed, drawing.family) + drawing.yaml;
  return drawing;
}

}  // namespace geocontainer_mpm::stability
