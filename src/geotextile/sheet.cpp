#include "geocontainer_mpm/geotextile/sheet.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace geocontainer_mpm::geotextile {
namespace {

/// Segments shorter than this part of their rest length are taken to stay slack over a step. A choice, not a bound: at
/// a hard landing a strain can change by more in a step, and the stiffness then counts from the next step on.
constexpr double slack_strain = -0.01;

}  // namespace

Sheet::Sheet(const SheetLayout& layout, const SheetParameters& parameters)
    : parameters_(parameters), law_(parameters.stiffness, parameters.force_strain)
{
  const double least = layout.closed ? 3.0 : 1.0;
  const auto count =
      static_cast<std::size_t>(std::max(least, std::round(layout.cloth_length() / parameters.segment_length)));
  const std::vector<Vec2> points = divide(layout, count, layout.closed ? count : count + 1);
  const double rest = parameters.unstretched_length / static_cast<double>(count);
  nodes_.resize(points.size());
  rest_length_.assign(count, rest);
  tension_.assign(count, 0.0);
  piece_length_.assign(count, rest);
  for (mpm::Column& column : external_)
    column.assign(points.size(), 0.0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool at_end = !layout.closed && (i == 0 || i + 1 == points.size());
    const double share = at_end ? 0.5 * rest : rest;
    nodes_.position[0][i] = points[i][0];
    nodes_.position[1][i] = points[i][1];
    nodes_.mass[i] = parameters.computational_mass * share;
    nodes_.weight_mass[i] = parameters.mass * share;
  }
  if (layout.closed)
    outwards_ = twice_signed_area() >= 0.0 ? 1.0 : -1.0;
  if (strains_with_grid())
    lay_points();
  strain_.assign(piece_length_.size(), 0.0);
  rupture_strain_.assign(piece_length_.size(),
                         parameters.rupture_strain.value_or(std::numeric_limits<double>::infinity()));
  broken_.assign(piece_length_.size(), 0);
}

void Sheet::tear_at(std::size_t segment, double tension)
{
  const double strain = law_.strain(tension);
  rupture_strain_[segment] = std::min(rupture_strain_[segment], strain);
  if (strains_with_grid())
    rupture_strain_[end_of(segment)] = std::min(rupture_strain_[end_of(segment)], strain);
}

/// Tension of a piece at its new strain, N/m. Where it breaks, what was stored in it and half of the last step's work,
/// the half that was done before, are gone.
double Sheet::carried(std::size_t piece, double strain, const Vec2& place)
{
  if (broken_[piece])
    return 0.0;
  const double before = strain_[piece];
  strain_[piece] = strain;
  if (strain < rupture_strain_[piece])
    return law_.force(strain);
  nodes_.dissipated[piece] =
      piece_length_[piece] * (law_.energy(before) + 0.5 * law_.force(before) * (strain - before));
  broken_[piece] = 1;
  if (ruptures_++ == 0)
    rupture_place_ = place;
  return 0.0;
}

bool Sheet::is_active(std::size_t piece) const
{
  return strain_[piece] >= slack_strain && !broken_[piece];
}

std::size_t Sheet::active_pieces() const
{
  std::size_t active = 0;
  for (std::size_t i = 0; i < strain_.size(); ++i)
    active += is_active(i) ? 1 : 0;
  return active;
}

void Sheet::add_stiffness(mpm::FrequencyBound<2>& bound) const
{
  for (std::size_t i = 0; i < strain_.size(); ++i) {
    if (!is_active(i))
      continue;
    if (strains_with_grid())
      bound.add_fibre(node(i), { tangent_[0][i], tangent_[1][i] },
                      law_.steepest() * stretch_[i] * stretch_[i] * piece_length_[i]);
    else
      bound.add_segment(node(i), node(end_of(i)), law_.steepest() / rest_length_[i]);
  }
}

/// Tension of every segment from the nodes' positions, and what it pulls at the nodes.
bool Sheet::pull_with_segments()
{
  const std::size_t n = segments();
  bool acts = false;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t j = end_of(i);
    const double along_y = nodes_.position[0][j] - nodes_.position[0][i];
    const double along_z = nodes_.position[1][j] - nodes_.position[1][i];
    const double length = std::sqrt(along_y * along_y + along_z * along_z);
    tension_[i] = carried(i, length / rest_length_[i] - 1.0, 0.5 * (node(i) + node(j)));
    if (tension_[i] <= 0.0)
      continue;
    acts = true;
    const double scale = tension_[i] / length;
    nodes_.force[0][i] += scale * along_y;
    nodes_.force[1][i] += scale * along_z;
    nodes_.force[0][j] -= scale * along_y;
    nodes_.force[1][j] -= scale * along_z;
  }
  return acts;
}

bool Sheet::update_forces(const SheetLoad& load)
{
  for (mpm::Column& column : nodes_.force)
    std::fill(column.begin(), column.end(), 0.0);
  bool acts = false;
  if (strains_with_grid()) {
    find_tangents();
    acts = stress_points();
  } else {
    acts = pull_with_segments();
  }
  for (mpm::Column& column : external_)
    std::fill(column.begin(), column.end(), 0.0);
  if (closed())
    add_pressure(load);
  else
    for (std::size_t d = 0; d < 2; ++d) {
      external_[d].front() += load.start_force[static_cast<Eigen::Index>(d)];
      external_[d].back() += load.end_force[static_cast<Eigen::Index>(d)];
    }
  for (std::size_t d = 0; d < 2; ++d)
    for (std::size_t i = 0; i < nodes_.size(); ++i)
      if (external_[d][i] != 0.0) {
        acts = true;
        nodes_.force[d][i] += external_[d][i];
      }
  return acts;
}

void Sheet::add_pressure(const SheetLoad& load)
{
  if (load.pressure == 0.0 && load.gradient == 0.0)
    return;
  const mpm::Column &y = nodes_.position[0], &z = nodes_.position[1];
  const double level = load.level ? *load.level : *std::max_element(z.begin(), z.end());
  for (std::size_t i = 0; i < segments(); ++i) {
    // Virtual work of p = (1 - s) pa + s pb on dx = (1 - s) da + s db over the segment, s from 0 to 1: what the ends
    // get is the exact derivative of the integral of p over the area inside with respect to their positions.
    const std::size_t j = end_of(i);
    const double out_y = outwards_ * (z[j] - z[i]), out_z = outwards_ * (y[i] - y[j]);  // length times outer normal
    const double pa = load.pressure + load.gradient * (level - z[i]);
    const double pb = load.pressure + load.gradient * (level - z[j]);
    const double share_a = (2.0 * pa + pb) / 6.0, share_b = (pa + 2.0 * pb) / 6.0;
    external_[0][i] += share_a * out_y;
    external_[1][i] += share_a * out_z;
    external_[0][j] += share_b * out_y;
    external_[1][j] += share_b * out_z;
  }
}

double Sheet::external_power() const
{
  double power = 0.0;
  for (std::size_t d = 0; d < 2; ++d)
    for (std::size_t i = 0; i < nodes_.size(); ++i)
      power += external_[d][i] * nodes_.velocity[d][i];
  return power;
}

double Sheet::tension_power() const
{
  double power = 0.0;
  for (std::size_t d = 0; d < 2; ++d)
    for (std::size_t i = 0; i < nodes_.size(); ++i)
      power -= (nodes_.force[d][i] - external_[d][i]) * nodes_.velocity[d][i];
  return power;
}

void Sheet::gauge_tension(std::vector<double>& result) const
{
  // All rest lengths are equal: the window is a whole number of segments on either side, and a part of one more.
  const std::size_t n = segments(), most = (n - 1) / 2;
  const double half = std::max(0.0, 0.5 * (parameters_.gauge_length / rest_length_[0] - 1.0));
  const std::size_t whole = std::min(static_cast<std::size_t>(half), most);
  const double part = whole < most ? half - static_cast<double>(whole) : 0.0;
  const std::size_t reach = part > 0.0 ? whole + 1 : whole;
  result.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    double sum = 0.0, length = 0.0;
    for (std::size_t k = 0; k <= 2 * reach; ++k) {
      const std::size_t j = i + n - reach + k;  // n too large
      if (!closed() && (j < n || j >= 2 * n))
        continue;
      const double share = part > 0.0 && (k == 0 || k == 2 * reach) ? part : 1.0;
      sum += share * tension_[j % n];
      length += share;
    }
    result[i] = sum / length;
  }
}

double Sheet::elastic_energy() const
{
  double energy = 0.0;
  for (std::size_t i = 0; i < strain_.size(); ++i)
    if (!broken_[i])
      energy += law_.energy(strain_[i]) * piece_length_[i];
  return energy;
}

double Sheet::rupture_energy() const
{
  double energy = 0.0;
  for (const double lost : nodes_.dissipated)
    energy += lost;
  return energy;
}

double Sheet::largest_strain() const
{
  return std::max(0.0, *std::max_element(strain_.begin(), strain_.end()));
}

double Sheet::length() const
{
  double sum = 0.0;
  for (std::size_t i = 0; i < segments(); ++i)
    sum += (node(end_of(i)) - node(i)).norm();
  return sum;
}

double Sheet::twice_signed_area() const
{
  double twice = 0.0;
  for (std::size_t i = 0; i < segments(); ++i) {
    const Vec2 a = node(i), b = node(end_of(i));
    twice += a[0] * b[1] - a[1] * b[0];
  }
  return twice;
}

double Sheet::enclosed_area() const
{
  return closed() ? 0.5 * std::abs(twice_signed_area()) : 0.0;
}

}  // namespace geocontainer_mpm::geotextile
