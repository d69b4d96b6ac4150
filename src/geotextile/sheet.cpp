#include "geocontainer_mpm/geotextile/sheet.h"

#include <algorithm>
#include <cmath>

#include "geocontainer_mpm/mpm/bspline.h"

namespace geocontainer_mpm::geotextile {
namespace {

double perimeter(const std::vector<Vec2>& outline)
{
  double length = 0.0;
  for (std::size_t i = 0; i < outline.size(); ++i)
    length += (outline[(i + 1) % outline.size()] - outline[i]).norm();
  return length;
}

/// `count` points evenly spaced along the closed outline, the first at its first vertex.
std::vector<Vec2> resample(const std::vector<Vec2>& outline, std::size_t count)
{
  const double step = perimeter(outline) / static_cast<double>(count);
  std::vector<Vec2> points;
  double passed = 0.0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2 along = outline[(i + 1) % outline.size()] - outline[i];
    const double length = along.norm();
    while (points.size() < count && static_cast<double>(points.size()) * step <= passed + length)
      points.emplace_back(outline[i] + (static_cast<double>(points.size()) * step - passed) / length * along);
    passed += length;
  }
  return points;
}

/// Weight differences w(b) - w(a) of two neighbouring points over the nodes that either reaches: at most 5 x 5 while
/// the points are less than two cells apart.
struct DifferencePatch {
  std::array<int, 2> base;
  std::array<std::array<double, 6>, 6> value;
  std::array<int, 2> size;
};

DifferencePatch difference(const mpm::Stencil<2>& a, const mpm::Stencil<2>& b)
{
  DifferencePatch patch{};
  for (std::size_t d = 0; d < 2; ++d) {
    patch.base[d] = std::min(a.base[d], b.base[d]);
    patch.size[d] = std::min(6, std::max(a.base[d], b.base[d]) + 3 - patch.base[d]);
  }
  const auto add = [&patch](const mpm::Stencil<2>& s, double sign) {
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const int row = s.base[0] + i - patch.base[0], column = s.base[1] + j - patch.base[1];
        if (row < 6 && column < 6)
          patch.value[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)] +=
              sign * s.weight[0][i] * s.weight[1][j];
      }
  };
  add(b, 1.0);
  add(a, -1.0);
  return patch;
}

}  // namespace

Sheet::Sheet(const std::vector<Vec2>& outline, const SheetParameters& parameters) : parameters_(parameters)
{
  const double laid = perimeter(outline);
  const auto count = static_cast<std::size_t>(std::max(3.0, std::round(laid / parameters.segment_length)));
  const std::vector<Vec2> points = resample(outline, count);
  const double rest = parameters.circumference / static_cast<double>(count);
  nodes_.resize(count);
  rest_length_.assign(count, rest);
  tension_.assign(count, 0.0);
  for (std::size_t i = 0; i < count; ++i) {
    nodes_.position[0][i] = points[i][0];
    nodes_.position[1][i] = points[i][1];
    nodes_.mass[i] = parameters.computational_mass * rest;
    nodes_.weight_mass[i] = parameters.mass * rest;
  }
}

bool Sheet::update_forces()
{
  const std::size_t n = segments();
  for (mpm::Column& column : nodes_.force)
    std::fill(column.begin(), column.end(), 0.0);
  bool taut = false;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t j = i + 1 < n ? i + 1 : 0;
    const double along_y = nodes_.position[0][j] - nodes_.position[0][i];
    const double along_z = nodes_.position[1][j] - nodes_.position[1][i];
    const double length = std::sqrt(along_y * along_y + along_z * along_z);
    const double strain = length / rest_length_[i] - 1.0;
    tension_[i] = strain > 0.0 ? parameters_.stiffness * strain : 0.0;
    if (tension_[i] <= 0.0)
      continue;
    taut = true;
    const double scale = tension_[i] / length;
    nodes_.force[0][i] += scale * along_y;
    nodes_.force[1][i] += scale * along_z;
    nodes_.force[0][j] -= scale * along_y;
    nodes_.force[1][j] -= scale * along_z;
  }
  return taut;
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
    for (std::size_t k = 0; k <= 2 * reach; ++k)
      sum += tension_[(i + n - reach + k) % n];
    result[i] = sum / static_cast<double>(2 * reach + 1);
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

double Sheet::enclosed_area() const
{
  double twice = 0.0;
  for (std::size_t i = 0; i < segments(); ++i) {
    const Vec2 a = node(i), b = node((i + 1) % segments());
    twice += a[0] * b[1] - a[1] * b[0];
  }
  return 0.5 * std::abs(twice);
}

double Sheet::frequency_bound(const mpm::Grid<2>& grid)
{
  // Irons and Treharne: omega^2 <= max over segments of the single segment's own, with the nodal mass m_i handed out in
  // proportion to k |dw_i|: omega_e^2 = sum_i |dw_i| (sum over segments of k |dw_i|) / m_i.
  const std::size_t n = segments();
  nodal_stiffness_.resize(grid.size(), 0.0);
  const auto stencil = [&](std::size_t i) {
    return mpm::make_stencil<2>({ nodes_.position[0][i], nodes_.position[1][i] }, grid.origin(), grid.dx(),
                                grid.inverse_dx());
  };
  const auto for_each = [&](auto&& visit) {
    mpm::Stencil<2> from = stencil(0);
    for (std::size_t i = 0; i < n; ++i) {
      const mpm::Stencil<2> to = stencil(i + 1 < n ? i + 1 : 0);
      const DifferencePatch patch = difference(from, to);
      for (int row = 0; row < patch.size[0]; ++row)
        for (int column = 0; column < patch.size[1]; ++column)
          visit(i, grid.index({ patch.base[0] + row, patch.base[1] + column }),
                std::abs(patch.value[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)]));
      from = to;
    }
  };
  for_each([&](std::size_t i, std::size_t node, double dw) {
    nodal_stiffness_[node] += parameters_.stiffness / rest_length_[i] * dw;
  });
  double bound = 0.0, current = 0.0;
  std::size_t segment = 0;
  for_each([&](std::size_t i, std::size_t node, double dw) {
    if (i != segment) {
      bound = std::max(bound, current);
      current = 0.0;
      segment = i;
    }
    const double mass = grid.nodes()[node][mpm::Grid<2>::mass_slot];
    if (mass > 0.0)
      current += dw * nodal_stiffness_[node] / mass;
  });
  bound = std::max(bound, current);
  for_each([&](std::size_t, std::size_t node, double) { nodal_stiffness_[node] = 0.0; });
  return bound;
}

}  // namespace geocontainer_mpm::geotextile
