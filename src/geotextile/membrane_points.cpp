/// The sheet as a layer of membrane points (York, Sulsky and Schreyer 1999, 2000); see sheet.h.

#include <algorithm>
#include <cmath>

#include "geocontainer_mpm/geotextile/sheet.h"

namespace geocontainer_mpm::geotextile {

/// A point stands for half of the segments beside it, stretched as these are laid.
void Sheet::lay_points()
{
  const std::size_t n = nodes_.size();
  piece_length_.assign(n, 0.0);
  stretch_.assign(n, 0.0);
  for (std::size_t i = 0; i < segments(); ++i)
    for (const std::size_t point : { i, end_of(i) }) {
      piece_length_[point] += 0.5 * rest_length_[i];
      stretch_[point] += 0.5 * (node(end_of(i)) - node(i)).norm();
    }
  for (std::size_t i = 0; i < n; ++i)
    stretch_[i] /= piece_length_[i];
  for (mpm::Column& column : tangent_)
    column.assign(n, 0.0);
  point_tension_.assign(n, 0.0);
}

/// Along the chord between the neighbours, at the end of an open sheet along its last segment. Where these are at one
/// place there is no direction and no force.
void Sheet::find_tangents()
{
  const std::size_t n = nodes_.size();
  const auto &y = nodes_.position[0], &z = nodes_.position[1];
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t before = i > 0 ? i - 1 : closed() ? n - 1 : i;
    const std::size_t after = i + 1 < n ? i + 1 : closed() ? 0 : i;
    const double along_y = y[after] - y[before], along_z = z[after] - z[before];
    const double chord = std::sqrt(along_y * along_y + along_z * along_z);
    tangent_[0][i] = chord > 0.0 ? along_y / chord : 0.0;
    tangent_[1][i] = chord > 0.0 ? along_z / chord : 0.0;
  }
}

/// Tension of every point from its stretch, and the stress that it is. Returns whether there is any.
bool Sheet::stress_points()
{
  bool acts = false;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const double tension = carried(i, stretch_[i] - 1.0, node(i)), t0 = tangent_[0][i], t1 = tangent_[1][i];
    point_tension_[i] = tension;
    nodes_.volume[i] = stretch_[i] * piece_length_[i];
    nodes_.stress[0][i] = tension * t0 * t0;
    nodes_.stress[1][i] = tension * t1 * t1;
    nodes_.stress[2][i] = tension * t0 * t1;
    acts = acts || tension > 0.0;
  }
  for (std::size_t i = 0; i < segments(); ++i)
    tension_[i] = 0.5 * (point_tension_[i] + point_tension_[end_of(i)]);
  return acts;
}

/// The rate at mid-step, with the tangent turned by half of the step: with the one at its start a sheet that swings
/// across itself by w' loses dt^2 (dw'/dt)^2 / 2 of its stretch in every step. A spin turns it as well and stretches
/// nothing. The exponential is exact for a rate that lasts over the step and cannot turn a length inside out.
void Sheet::update_stress(double dt)
{
  if (!strains_with_grid())
    return;
  const auto& l = nodes_.gradient;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const double t0 = tangent_[0][i], t1 = tangent_[1][i];
    const double m0 = t0 + 0.5 * dt * (l[0][i] * t0 + l[1][i] * t1), m1 = t1 + 0.5 * dt * (l[2][i] * t0 + l[3][i] * t1);
    const double square = m0 * m0 + m1 * m1;
    if (square > 0.0)
      stretch_[i] *= std::exp(dt * (m0 * m0 * l[0][i] + m0 * m1 * (l[1][i] + l[2][i]) + m1 * m1 * l[3][i]) / square);
  }
  find_tangents();
  stress_points();
}

double Sheet::stress_power() const
{
  double power = 0.0;
  if (!strains_with_grid())
    return power;
  const auto& l = nodes_.gradient;
  const auto& s = nodes_.stress;
  for (std::size_t i = 0; i < nodes_.size(); ++i)
    power += nodes_.volume[i] * (s[0][i] * l[0][i] + s[1][i] * l[3][i] + s[2][i] * (l[1][i] + l[2][i]));
  return power;
}

}  // namespace geocontainer_mpm::geotextile
