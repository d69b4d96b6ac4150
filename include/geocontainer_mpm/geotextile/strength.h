#pragma once
/// What a sheet and its seams bear, and how much of that is used.

#include <cstddef>
#include <string>
#include <vector>

namespace geocontainer_mpm::geotextile {

/// A seam runs across the plane of the slice: a point of the sheet. In space it has many pieces; one of them.
struct Seam {
  std::string name;
  std::size_t segment = 0;  ///< of the sheet, or triangle, in which it lies
  double efficiency = 1.0;  ///< its strength over the sheet's
};

/// Tension over strength, the largest along a sheet.
struct Utilisation {
  double sheet = 0.0;
  double seam = 0.0;
};

class Strength {
public:
  /// Sheet strength, N/m, and its seams. Where none is named, one of this efficiency may be anywhere.
  Strength(double sheet, double efficiency_anywhere, std::vector<Seam> seams = {});

  double sheet() const { return sheet_; }  ///< N/m
  double weakest_seam() const;             ///< N/m
  const std::vector<Seam>& seams() const { return seams_; }
  /// From the gauge tension of all segments, N/m.
  Utilisation utilisation(const std::vector<double>& gauge_tension) const;

private:
  double sheet_, efficiency_anywhere_;
  std::vector<Seam> seams_;
};

}  // namespace geocontainer_mpm::geotextile
