#pragma once
/// Force of a geotextile over its strain, per unit width: linear, or a table as a tensile test gives it.

#include <vector>

namespace geocontainer_mpm::geotextile {

struct ForceStrainRow {
  double strain = 0.0;  ///< lengthening over unstretched length
  double force = 0.0;   ///< N/m
};

/// Elastic in tension; a sheet that is shorter than its own length is slack or wrinkled and carries nothing (tension
/// field theory, Wagner 1929). Linear between the rows of a table, beyond the last one with the slope before it.
class ForceStrain {
public:
  /// With an empty table linear, J = stiffness (N/m). A table begins with (0, 0) and ascends strictly in both columns.
  explicit ForceStrain(double stiffness, const std::vector<ForceStrainRow>& table = {});

  double force(double strain) const  ///< N/m
  {
    if (strain <= 0.0)
      return 0.0;
    const Knot& from = knot_below(strain);
    return from.force + from.slope * (strain - from.strain);
  }
  double energy(double strain) const;            ///< exact integral of the force over the strain, J/m^2
  double strain(double force) const;             ///< that gives this force, >= 0 N/m
  double steepest() const { return steepest_; }  ///< largest slope, N/m: no tangent or secant is steeper

private:
  struct Knot {
    double strain, force, slope, energy;
  };
  const Knot& knot_below(double strain) const
  {
    std::size_t k = knots_.size() - 1;
    while (k > 0 && knots_[k].strain > strain)
      --k;
    return knots_[k];
  }

  std::vector<Knot> knots_;
  double steepest_ = 0.0;
};

}  // namespace geocontainer_mpm::geotextile
