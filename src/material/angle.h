#pragma once

namespace geocontainer_mpm::material {

/// Scenes give soil angles in degrees, as soil mechanics does; everything inside is in radians.
inline double radians(double degrees)
{
  return degrees * (3.14159265358979323846 / 180.0);
}

}  // namespace geocontainer_mpm::material
