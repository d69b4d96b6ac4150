#include "geocontainer_mpm/geotextile/strength.h"

#include <algorithm>
#include <utility>

namespace geocontainer_mpm::geotextile {

Strength::Strength(double sheet, double efficiency_anywhere, std::vector<Seam> seams)
    : sheet_(sheet), efficiency_anywhere_(efficiency_anywhere), seams_(std::move(seams))
{
}

double Strength::weakest_seam() const
{
  if (seams_.empty())
    return sheet_ * efficiency_anywhere_;
  double least = 1.0;
  for (const Seam& seam : seams_)
    least = std::min(least, seam.efficiency);
  return sheet_ * least;
}

Utilisation Strength::utilisation(const std::vector<double>& gauge_tension) const
{
  const double largest = *std::max_element(gauge_tension.begin(), gauge_tension.end());
  Utilisation used;
  used.sheet = largest / sheet_;
  if (seams_.empty())
    used.seam = largest / (sheet_ * efficiency_anywhere_);
  for (const Seam& seam : seams_)
    used.seam = std::max(used.seam, gauge_tension[seam.segment] / (sheet_ * seam.efficiency));
  return used;
}

}  // namespace geocontainer_mpm::geotextile
