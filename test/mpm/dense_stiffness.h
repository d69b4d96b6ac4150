#pragma once
/// Particles, segments and nodal masses on a grid, their stiffness as a dense matrix, and the bound that is to hold for
/// it.

#include "geocontainer_mpm/mpm/frequency_bound.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "geocontainer_mpm/mpm/reach.h"
#include "random_cloud.h"

namespace geocontainer_mpm::mpm::testing {

template <int Dim>
struct Segment {
  Vec<Dim> a, b;
  double stiffness;  // N/m
};

/// What hangs on a grid of its own.
template <int Dim>
struct Setting {
  Shape shape;
  Grid<Dim> grid;
  Particles<Dim> particles;
  Moduli elastic, viscous;
  std::vector<Segment<Dim>> segments;
  Particles<Dim> sheet_nodes;
};

/// Adds weight * mass of a row to the nodes.
template <int Dim>
void add_mass(Shape shape, const Particles<Dim>& particles, std::size_t p, Grid<Dim>& grid)
{
  const AnyReach<Dim> reach = reach_of<Dim>(shape, particles, p, Vec<Dim>::Zero(), grid);
  for (std::size_t k = 0; k < static_cast<std::size_t>(reach.count); ++k)
    grid.nodes()[reach.node[k]][Grid<Dim>::mass_slot] += reach.weight[k] * particles.mass[p];
}

inline Moduli elastic_moduli(double young, double poisson)
{
  return { young * poisson / (1.0 + poisson) / (1.0 - 2.0 * poisson), 0.5 * young / (1.0 + poisson) };
}

struct Cloud {
  int cells, side;             // of the cube of material; particles a cell in each direction
  double jitter = 0.0;         // of a particle's spacing, to either side
  double missing = 0.0;        // part of the particles that is not there
  double sheet_ratio = 0.0;    // J over M h; 0: no sheet
  double segment_cells = 1.0;  // length of its segments
};

/// Cells of the largest cloud, and room around it for sheets.
template <int Dim>
constexpr int grid_cells = Dim == 2 ? 14 : 7;

template <int Dim>
Setting<Dim> make_setting(Chance& chance, Shape shape, double poisson, const Cloud& cloud)
{
  Setting<Dim> setting{ shape, random_grid<Dim>(chance, grid_cells<Dim>), {}, {}, {}, {}, {} };
  Grid<Dim>& grid = setting.grid;
  const double h = grid.dx(), spacing = h / cloud.side;
  setting.elastic = elastic_moduli(chance(1e5, 1e8), poisson);
  const double density = chance(500.0, 3000.0);
  Vec<Dim> corner = lower_of(grid);
  for (int d = 0; d < Dim; ++d)
    corner[d] += 0.5 * h * (grid_cells<Dim> - cloud.cells) + chance(0.0, 1.0) * h;
  std::vector<Vec<Dim>> place;
  const int side = cloud.cells * cloud.side;
  for (int k = 0; k < static_cast<int>(std::pow(side, Dim) + 0.5); ++k) {
    Vec<Dim> x = corner;
    for (int d = 0, rest = k; d < Dim; ++d, rest /= side)
      x[d] += spacing * (rest % side + 0.5 + chance(-cloud.jitter, cloud.jitter));
    if (place.empty() || chance(0.0, 1.0) >= cloud.missing)
      place.push_back(x);
  }
  setting.particles.resize(place.size());
  open(everything(grid), grid);
  Vec<Dim> middle = Vec<Dim>::Zero();
  for (std::size_t p = 0; p < place.size(); ++p) {
    set_vector<Dim>(setting.particles.position, p, place[p]);
    setting.particles.volume[p] = std::pow(spacing, Dim);
    setting.particles.mass[p] = density * setting.particles.volume[p] * chance(0.8, 1.2);
    middle += place[p] / static_cast<double>(place.size());
  }
  if (shape == Shape::gimp)
    setting.particles.use_boxes();
  for (std::size_t p = 0; p < place.size(); ++p)
    add_mass<Dim>(shape, setting.particles, p, grid);
  if (cloud.sheet_ratio > 0.0) {  // a straight chain across the cloud, a little longer than it
    const double length = cloud.segment_cells * h;
    const int count = std::max(1, static_cast<int>((cloud.cells + 1) * h / length));
    const Vec<Dim> step = length * chance.vector<Dim>(1.0).normalized();
    setting.sheet_nodes.resize(static_cast<std::size_t>(2 * count));  // two halves where segments meet
    for (int s = 0; s < count; ++s) {
      const Vec<Dim> a = middle + (s - 0.5 * count) * step, b = a + step;
      const double scale = std::pow(h, Dim - 2);  // per width in the plane
      setting.segments.push_back({ a, b, cloud.sheet_ratio * setting.elastic.constrained() * h * scale / length });
      for (int e = 0; e < 2; ++e) {
        const auto node = static_cast<std::size_t>(2 * s + e);
        setting.sheet_nodes.mass[node] = 0.01 * density * std::pow(h, Dim - 1) * length;
        set_vector<Dim>(setting.sheet_nodes.position, node, e == 0 ? a : b);
        add_mass<Dim>(shape, setting.sheet_nodes, node, grid);
      }
    }
  }
  return setting;
}

/// M^-1/2 K M^-1/2 of particles with the given moduli, and of segments along their directions.
template <int Dim>
Eigen::MatrixXd scaled_matrix(const Setting<Dim>& setting, const Moduli& moduli, bool with_segments)
{
  const Grid<Dim>& grid = setting.grid;
  std::vector<Eigen::Index> row(grid.size(), -1);
  Eigen::Index count = 0;
  for_each_node(grid, [&](std::size_t i, const std::array<int, Dim>&) {
    if (node_mass(grid, i) > 0.0)
      row[i] = Dim * count++;
  });
  Eigen::MatrixXd k = Eigen::MatrixXd::Zero(Dim * count, Dim * count);
  const auto add = [&](std::size_t i, std::size_t j, const Mat<Dim>& block) {
    if (row[i] >= 0 && row[j] >= 0)
      k.template block<Dim, Dim>(row[i], row[j]) += block / std::sqrt(node_mass(grid, i) * node_mass(grid, j));
  };
  for (std::size_t p = 0; p < setting.particles.size(); ++p) {
    const AnyReach<Dim> reach = reach_of<Dim>(setting.shape, setting.particles, p, Vec<Dim>::Zero(), grid);
    for (std::size_t i = 0; i < static_cast<std::size_t>(reach.count); ++i)
      for (std::size_t j = 0; j < static_cast<std::size_t>(reach.count); ++j) {
        const Vec<Dim>&a = reach.gradient[i], &b = reach.gradient[j];
        const Mat<Dim> block = moduli.lame * a * b.transpose() + moduli.shear * b * a.transpose() +
                               moduli.shear * a.dot(b) * Mat<Dim>::Identity();
        add(reach.node[i], reach.node[j], setting.particles.volume[p] * block);
      }
  }
  for (const Segment<Dim>& segment : setting.segments) {
    if (!with_segments)
      break;
    const Vec<Dim> n = (segment.b - segment.a).normalized();
    std::vector<std::pair<std::size_t, double>> change;
    for (const auto& [end, sign] : { std::pair(segment.a, -1.0), std::pair(segment.b, 1.0) }) {
      const AnyReach<Dim> reach = reach_of<Dim>(setting.shape, end, grid);
      for (std::size_t i = 0; i < static_cast<std::size_t>(reach.count); ++i)
        change.emplace_back(reach.node[i], sign * reach.weight[i]);
    }
    for (const auto& [i, wi] : change)
      for (const auto& [j, wj] : change)
        add(i, j, segment.stiffness * wi * wj * n * n.transpose());
  }
  return k;
}

inline double largest_eigenvalue(const Eigen::MatrixXd& symmetric)
{
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(symmetric, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
}

template <int Dim>
FrequencyBound<Dim> filled(const Setting<Dim>& setting, Discretisation method)
{
  method.shape = setting.shape;
  FrequencyBound<Dim> bound;
  bound.begin(setting.grid, method);
  bound.add_body(setting.particles, setting.elastic, setting.viscous);
  bound.add_mass(setting.sheet_nodes);
  for (const Segment<Dim>& s : setting.segments)
    bound.add_segment(s.a, s.b, s.stiffness);
  return bound;
}

template <int Dim>
typename FrequencyBound<Dim>::Result bound_of(const Setting<Dim>& setting, const Discretisation& method = {})
{
  return filled(setting, method).bound();
}

/// sqrt(bound / truth) over seeds and Poisson's ratios: what is lost in the step.
struct Loss {
  double least = 1e9, mean = 0.0, most = 0.0;
};

template <int Dim>
Loss loss_of(Shape shape, const Cloud& cloud, int seeds)
{
  Loss loss;
  for (int seed = 0; seed < seeds; ++seed) {
    Chance chance(static_cast<std::uint64_t>(1000 + seed));
    const double poisson[] = { 0.0, 0.3, 0.45 };
    const Setting<Dim> setting = make_setting<Dim>(chance, shape, poisson[seed % 3], cloud);
    const double truth = largest_eigenvalue(scaled_matrix(setting, setting.elastic, true));
    const double ratio = std::sqrt(bound_of(setting).frequency_square / truth);
    loss.least = std::min(loss.least, ratio);
    loss.mean += ratio / seeds;
    loss.most = std::max(loss.most, ratio);
  }
  return loss;
}

/// Eigenvalues of nodes with almost no mass come out of a dense solve with the round-off of the largest entries.
inline constexpr double round_off = 1e-6;

/// The particles' mass matrix (flip), or what an affine transfer keeps, scaled like scaled_matrix().
inline Eigen::MatrixXd kept(const Setting<2>& setting, Transfer transfer)
{
  const Grid<2>& grid = setting.grid;
  std::vector<Eigen::Index> row(grid.size(), -1);
  std::vector<Vec<2>> place(grid.size());
  Eigen::Index count = 0;
  for_each_node(grid, [&](std::size_t i, const std::array<int, 2>& node) {
    place[i] = grid.coordinate(node);
    if (node_mass(grid, i) > 0.0)
      row[i] = 2 * count++;
  });
  Eigen::MatrixXd p = Eigen::MatrixXd::Zero(2 * count, 2 * count);
  const auto add = [&](const Particles<2>& set, std::size_t q) {
    const Vec<2> x = vector_at<2>(set.position, q);
    const double mass = set.mass[q];
    const AnyReach<2> reach = reach_of<2>(setting.shape, set, q, Vec<2>::Zero(), grid);
    // About the point, by direction; of points on linear elements no affine transfer is asked.
    Vec<2> inertia = Vec<2>::Zero();
    for (std::size_t i = 0; i < static_cast<std::size_t>(reach.count); ++i)
      inertia += reach.weight[i] * (place[reach.node[i]] - x).cwiseAbs2();
    for (std::size_t i = 0; i < static_cast<std::size_t>(reach.count); ++i)
      for (std::size_t j = 0; j < static_cast<std::size_t>(reach.count); ++j) {
        const std::size_t a = reach.node[i], b = reach.node[j];
        if (row[a] < 0 || row[b] < 0)
          continue;
        double same = reach.weight[i] * reach.weight[j];
        if (transfer == Transfer::apic)
          same *= 1.0 + (place[a] - x).cwiseQuotient(inertia).dot(place[b] - x);
        p.block<2, 2>(row[a], row[b]) +=
            mass * same / std::sqrt(node_mass(grid, a) * node_mass(grid, b)) * Mat<2>::Identity();
      }
  };
  for (const Particles<2>* set : { &setting.particles, &setting.sheet_nodes })
    for (std::size_t q = 0; q < set->size(); ++q)
      add(*set, q);
  return p;
}

}  // namespace geocontainer_mpm::mpm::testing
