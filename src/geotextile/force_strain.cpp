#include "geocontainer_mpm/geotextile/force_strain.h"

#include <algorithm>

namespace geocontainer_mpm::geotextile {

ForceStrain::ForceStrain(double stiffness, const std::vector<ForceStrainRow>& table)
{
  if (table.empty())
    knots_.push_back({ 0.0, 0.0, stiffness, 0.0 });
  double energy = 0.0;
  for (std::size_t i = 0; i + 1 < table.size(); ++i) {
    const double width = table[i + 1].strain - table[i].strain;
    knots_.push_back({ table[i].strain, table[i].force, (table[i + 1].force - table[i].force) / width, energy });
    energy += 0.5 * (table[i].force + table[i + 1].force) * width;
  }
  for (const Knot& knot : knots_)
    steepest_ = std::max(steepest_, knot.slope);
}

double ForceStrain::energy(double strain) const
{
  if (strain <= 0.0)
    return 0.0;
  const Knot& from = knot_below(strain);
  const double further = strain - from.strain;
  return from.energy + (from.force + 0.5 * from.slope * further) * further;
}

double ForceStrain::strain(double force) const
{
  std::size_t k = knots_.size() - 1;
  while (k > 0 && knots_[k].force > force)
    --k;
  return knots_[k].strain + (force - knots_[k].force) / knots_[k].slope;
}

}  // namespace geocontainer_mpm::geotextile
