#include "principal_return.h"

#include <algorithm>
#include <cmath>

#include "angle.h"

namespace geocontainer_mpm::material {

PrincipalReturn::PrincipalReturn(const Parameters& parameters, const Elasticity& elasticity) : elasticity_(elasticity)
{
  const double sin_friction = std::sin(radians(parameters.friction_angle_deg));
  const double sin_dilation = std::sin(radians(parameters.dilation_angle_deg));
  slope_ = (1.0 + sin_friction) / (1.0 - sin_friction);
  dilation_slope_ = (1.0 + sin_dilation) / (1.0 - sin_dilation);
  strength_ = 2.0 * parameters.cohesion_pa * std::sqrt(slope_);
  cutoff_ = std::min(parameters.tension_cutoff_pa, strength_ / (slope_ - 1.0));
  corner_ = std::min(slope_ * cutoff_ - strength_, cutoff_);

  f13_ = flow(dilation_slope_, 0.0, -1.0);
  f12_ = flow(dilation_slope_, -1.0, 0.0);
  f23_ = flow(0.0, dilation_slope_, -1.0);
  // Two planes meet on an edge and are mirror images of each other there: the system [own other; other own].
  const double own = slope_ * f13_.d1 - f13_.d3;
  const auto invert = [own](double other, double& inverse_own, double& inverse_other) {
    const double det = own * own - other * other;
    inverse_own = own / det;
    inverse_other = -other / det;
  };
  plane_ = 1.0 / own;
  invert(slope_ * f23_.d1 - f23_.d3, edge12_own_, edge12_other_);
  invert(slope_ * f12_.d1 - f12_.d3, edge23_own_, edge23_other_);
}

PrincipalReturn::Flow PrincipalReturn::flow(double strain1, double strain2, double strain3) const
{
  const double mean = elasticity_.lambda * (strain1 + strain2 + strain3), two_g = 2.0 * elasticity_.shear;
  return { mean + two_g * strain1, mean + two_g * strain2, mean + two_g * strain3 };
}

// To the plane, or to one of its two edges where the plane's own return would leave the sector s1 >= s2 >= s3. A trial
// stress that belongs to one edge never leaves across the other, so that leaving across both means beyond the apex,
// which the caller finds out by the cut-off.
Principal PrincipalReturn::to_shear_surface(const Principal& trial) const
{
  const double excess = shear_excess(trial.s1, trial.s3);
  const double m = excess * plane_;
  const Principal on_plane{ trial.s1 - m * f13_.d1, trial.s2 - m * f13_.d2, trial.s3 - m * f13_.d3 };
  if (on_plane.s1 < on_plane.s2) {
    const double other = shear_excess(trial.s2, trial.s3);
    const double m13 = edge12_own_ * excess + edge12_other_ * other;
    const double m23 = edge12_other_ * excess + edge12_own_ * other;
    const double s3 = trial.s3 - m13 * f13_.d3 - m23 * f23_.d3;
    const double s1 = (s3 + strength_) / slope_;
    return { s1, s1, s3 };
  }
  if (on_plane.s2 < on_plane.s3) {
    const double other = shear_excess(trial.s1, trial.s2);
    const double m13 = edge23_own_ * excess + edge23_other_ * other;
    const double m12 = edge23_other_ * excess + edge23_own_ * other;
    const double s1 = trial.s1 - m13 * f13_.d1 - m12 * f12_.d1;
    const double s3 = slope_ * s1 - strength_;
    return { s1, s3, s3 };
  }
  return on_plane;
}

Principal PrincipalReturn::plastic_strain(const Principal& trial, const Principal& stress) const
{
  const double d1 = trial.s1 - stress.s1, d2 = trial.s2 - stress.s2, d3 = trial.s3 - stress.s3;
  const double per_2g = 0.5 / elasticity_.shear;
  const double mean = per_2g * elasticity_.lambda / (3.0 * elasticity_.bulk) * (d1 + d2 + d3);
  return { per_2g * d1 - mean, per_2g * d2 - mean, per_2g * d3 - mean };
}

Returned PrincipalReturn::to_cutoff(const Principal& trial) const
{
  const double lambda = elasticity_.lambda, constrained = elasticity_.constrained;
  const double one = (trial.s1 - cutoff_) / constrained;
  if (trial.s2 - lambda * one <= cutoff_)
    return { { cutoff_, trial.s2 - lambda * one, trial.s3 - lambda * one }, one };
  const double two = (trial.s1 + trial.s2 - 2.0 * cutoff_) / (constrained + lambda);  // of both multipliers together
  if (trial.s3 - lambda * two <= cutoff_)
    return { { cutoff_, cutoff_, trial.s3 - lambda * two }, two };
  return to_apex(trial);
}

// All of the plastic volume strain at the apex is opening, the dilation's share too: nothing holds the grains there.
Returned PrincipalReturn::to_apex(const Principal& trial) const
{
  const double sum = trial.s1 + trial.s2 + trial.s3 - 3.0 * cutoff_;
  return { { cutoff_, cutoff_, cutoff_ }, std::max(0.0, sum / (3.0 * elasticity_.bulk)) };
}

// Yield plane and cut-off together: a line along s2 between two points. The share of the cut-off in the plastic strain
// follows from its components, because the shear planes strain s3 (and s2) by -1 for every k_psi that they strain s1
// (and s2).
Returned PrincipalReturn::to_corner(const Principal& trial) const
{
  const double lambda = elasticity_.lambda, constrained = elasticity_.constrained;
  const double r1 = trial.s1 - cutoff_, r3 = trial.s3 - corner_;
  const double det = f13_.d1 * lambda - f13_.d3 * constrained;
  const double shear = (r1 * lambda - r3 * constrained) / det;
  const double tension = (f13_.d1 * r3 - f13_.d3 * r1) / det;
  const double s2 = std::clamp(trial.s2 - shear * f13_.d2 - tension * lambda, corner_, cutoff_);
  const Principal stress{ cutoff_, s2, corner_ };
  const Principal strain = plastic_strain(trial, stress);
  const double opening = s2 == cutoff_ ? strain.s1 + strain.s2 + dilation_slope_ * strain.s3
                                       : strain.s1 + dilation_slope_ * (strain.s2 + strain.s3);
  return { stress, std::max(0.0, opening) };
}

// Each region of trial stresses returns to one face, line or point, and the regions tile the space: whichever of the
// shear surface alone and the cut-off alone gives an admissible stress is the answer, else it is where they meet.
// With the cut-off as high as it may be (always so in cohesionless sand) the cut-off has only the apex left.
Returned PrincipalReturn::map(const Principal& trial) const
{
  if (shear_excess(trial.s1, trial.s3) > 0.0) {
    const Principal sheared = to_shear_surface(trial);
    if (sheared.s1 <= cutoff_ && sheared.s2 >= sheared.s3)
      return { sheared, 0.0 };
  }
  if (corner_ == cutoff_)
    return to_apex(trial);
  const Returned torn = to_cutoff(trial);
  if (shear_excess(torn.stress.s1, torn.stress.s3) <= 0.0)
    return torn;
  return to_corner(trial);
}

}  // namespace geocontainer_mpm::material
