#pragma once
/// Return mapping of Mohr-Coulomb with a Rankine tension cut-off, in sorted principal stresses.

#include "elasticity.h"

namespace geocontainer_mpm::material {

/// Principal stresses, largest (most tensile) first, Pa.
struct Principal {
  double s1, s2, s3;
};

struct Returned {
  Principal stress;
  double opening;  ///< volumetric plastic strain by the tension cut-off, >= 0
};

/// Yield: k s1 - s3 <= 2 c sqrt(k), k = (1 + sin phi) / (1 - sin phi), and s1 <= T. Plastic flow: along
/// (k_psi, 0, -1) with the dilation angle psi, and normal to the cut-off. All surfaces are planes and the elasticity is
/// linear, so the return (backward Euler) is exact once the active planes are known; those are found from where the
/// trial stress lies, as in Clausen, Damkilde & Andersen (2006) and de Souza Neto, Peric & Owen (2008), ch. 8.
class PrincipalReturn {
public:
  PrincipalReturn(const Parameters& parameters, const Elasticity& elasticity);

  double shear_excess(double s1, double s3) const { return slope_ * s1 - s3 - strength_; }  ///< > 0: beyond yield, Pa
  double tension_excess(double s1) const { return s1 - cutoff_; }  ///< > 0: beyond the cut-off, Pa
  double slope() const { return slope_; }                          ///< k
  double strength() const { return strength_; }                    ///< 2 c sqrt(k): unconfined compressive strength, Pa
  double cutoff() const { return cutoff_; }                        ///< T, Pa

  /// `trial` is sorted and beyond yield or cut-off.
  Returned map(const Principal& trial) const;

  /// A bound of n . (C : (a n^T)) . a of the elastic and of every plastic tangent C over unit vectors a and n, Pa.
  double constrained_tangent() const;

private:
  struct Flow {
    double d1, d2, d3;  ///< stress taken off per unit multiplier, Pa
  };
  Flow flow(double strain1, double strain2, double strain3) const;
  Principal to_shear_surface(const Principal& trial) const;
  Returned to_cutoff(const Principal& trial) const;
  Returned to_apex(const Principal& trial) const;
  Returned to_corner(const Principal& trial) const;
  Principal plastic_strain(const Principal& trial, const Principal& stress) const;

  Elasticity elasticity_;
  double slope_, strength_, cutoff_;
  double dilation_slope_;  ///< k of the dilation angle
  double corner_;          ///< s3 where yield plane and cut-off meet, Pa
  Flow f13_, f12_, f23_;   ///< flow of the plane through s1 and s3, and of its neighbours in the other sectors
  double plane_;           ///< 1 / (gradient of the plane . its flow)
  double edge12_own_, edge12_other_;  ///< inverse of the symmetric-by-exchange 2x2 system on the edge s1 = s2
  double edge23_own_, edge23_other_;  ///< and on the edge s2 = s3
};

}  // namespace geocontainer_mpm::material
