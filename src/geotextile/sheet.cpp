#include "geocontainer_mpm/geotextile/sheet.h"

#include <algorithm>
#include <cmath>

#include "geocontainer_mpm/mpm/bspline.h"

namespace geocontainer_mpm::geotextile {
namespace {

/// Segments shorter than this part of their rest length are taken to stay slack over a step. A choice, not a bound: at
/// a hard landing a strain can change by more in a step, and the stiffness then counts from the next step on.
constexpr double slack_strain = -0.01;

}  // namespace

Sheet::Sheet(const SheetLayout& layout, const SheetParameters& parameters) : parameters_(parameters)
{
  const double least = layout.closed ? 3.0 : 1.0;
  const auto count =
      static_cast<std::size_t>(std::max(least, std::round(layout.cloth_length() / parameters.segment_length)));
  const std::vector<Vec2> points = divide(layout, count, layout.closed ? count : count + 1);
  const double rest = parameters.unstretched_length / static_cast<double>(count);
  nodes_.resize(points.size());
  rest_length_.assign(count, rest);
  tension_.assign(count, 0.0);
  strain_.assign(count, 0.0);
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
}

SheetSegment Sheet::segment(std::size_t i) const
{
  return { i, end_of(i), parameters_.stiffness / rest_length_[i], strain_[i] >= slack_strain };
}

bool Sheet::update_forces(const SheetLoad& load)
{
  const std::size_t n = segments();
  for (mpm::Column& column : nodes_.force)
    std::fill(column.begin(), column.end(), 0.0);
  bool acts = false;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t j = end_of(i);
    const double along_y = nodes_.position[0][j] - nodes_.position[0][i];
    const double along_z = nodes_.position[1][j] - nodes_.position[1][i];
    const double length = std::sqrt(along_y * along_y + along_z * along_z);
    const double strain = length / rest_length_[i] - 1.0;
    strain_[i] = strain;
    tension_[i] = strain > 0.0 ? parameters_.stiffness * strain : 0.0;
    if (tension_[i] <= 0.0)
      continue;
    acts = true;
    const double scale = tension_[i] / length;
    nodes_.force[0][i] += scale * along_y;
    nodes_.force[1][i] += scale * along_z;
    nodes_.force[0][j] -= scale * along_y;
    nodes_.force[1][j] -= scale * along_z;
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
  // All rest lengths are equal, so the window is a number of segments: the odd number nearest to the gauge length.
  const std::size_t n = segments();
  const auto half =
      static_cast<std::size_t>(std::max(0.0, std::round(0.5 * (parameters_.gauge_length / rest_length_[0] - 1.0))));
  const std::size_t reach = std::min(half, (n - 1) / 2);
  result.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    double sum = 0.0;
    std::size_t count = 0;
    for (std::size_t k = 0; k <= 2 * reach; ++k) {
      const std::size_t j = i + n - reach + k;  // n too large
      if (!closed() && (j < n || j >= 2 * n))
        continue;
      sum += tension_[j % n];
      ++count;
    }
    result[i] = sum / static_cast<double>(count);
  }
}

double Sheet::elastic_energy() const
{
  double energy = 0.0;
  for (std::size_t i = 0; i < segments(); ++i)
    energy += 0.5 * tension_[i] * tension_[i] / parameters_.stiffness * rest_length_[i];
  return energy;
}

double Sheet::largest_strain() const
{
  return *std::max_element(tension_.begin(), tension_.end()) / parameters_.stiffness;
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

Sheet::Difference Sheet::difference(std::size_t segment, const mpm::Grid<2>& grid) const
{
  const auto stencil = [&](std::size_t i) {
    return mpm::make_stencil<2>({ nodes_.position[0][i], nodes_.position[1][i] }, grid.origin(), grid.dx(),
                                grid.inverse_dx());
  };
  const mpm::Stencil<2> a = stencil(segment);
  const mpm::Stencil<2> b = stencil(end_of(segment));
  // The box around both stencils, cut at six nodes: ends three cells apart no longer share any.
  std::array<int, 2> base{}, size{};
  for (std::size_t d = 0; d < 2; ++d) {
    base[d] = std::min(a.base[d], b.base[d]);
    size[d] = std::min(6, std::max(a.base[d], b.base[d]) + 3 - base[d]);
  }
  const auto weight = [](const mpm::Stencil<2>& s, int row, int column) {
    const int i = row - s.base[0], j = column - s.base[1];
    return i >= 0 && i < 3 && j >= 0 && j < 3
               ? s.weight[0][static_cast<std::size_t>(i)] * s.weight[1][static_cast<std::size_t>(j)]
               : 0.0;
  };
  Difference result;
  result.count = 0;
  for (int row = base[0]; row < base[0] + size[0]; ++row)
    for (int column = base[1]; column < base[1] + size[1]; ++column) {
      result.node[result.count] = static_cast<std::uint32_t>(grid.index({ row, column }));
      result.magnitude[result.count++] = std::abs(weight(b, row, column) - weight(a, row, column));
    }
  return result;
}

double Sheet::frequency_bound(const mpm::Grid<2>& grid)
{
  // Irons and Treharne: omega^2 <= max over segments of the single segment's own, with the nodal mass m_i handed out in
  // proportion to k |dw_i|: omega_e^2 = sum_i |dw_i| (sum over segments of k |dw_i|) / m_i.
  nodal_stiffness_.resize(grid.size(), 0.0);
  differences_.clear();
  for (std::size_t i = 0; i < segments(); ++i) {
    if (strain_[i] < slack_strain)
      continue;
    differences_.push_back(difference(i, grid));
    const Difference& d = differences_.back();
    for (std::size_t k = 0; k < d.count; ++k)
      nodal_stiffness_[d.node[k]] += parameters_.stiffness / rest_length_[i] * d.magnitude[k];
  }
  double bound = 0.0;
  for (const Difference& d : differences_) {
    double square = 0.0;
    for (std::size_t k = 0; k < d.count; ++k) {
      const double mass = grid.nodes()[d.node[k]][mpm::Grid<2>::mass_slot];
      if (mass > 0.0)
        square += d.magnitude[k] * nodal_stiffness_[d.node[k]] / mass;
    }
    bound = std::max(bound, square);
  }
  for (const Difference& d : differences_)
    for (std::size_t k = 0; k < d.count; ++k)
      nodal_stiffness_[d.node[k]] = 0.0;
  return bound;
}

}  // namespace geocontainer_mpm::geotextile
