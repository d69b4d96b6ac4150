#include "geocontainer_mpm/mpm/frequency_bound.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>

#include "geocontainer_mpm/mpm/bspline.h"
#include "geocontainer_mpm/mpm/reach.h"

namespace geocontainer_mpm::mpm {
namespace {

/// Lighter nodes take no part in the motion (see grid_update.cpp).
constexpr double massless = 1e-300;

template <Shape shape>
using ShapeTag = std::integral_constant<Shape, shape>;

/// Gradients of one particle's weights, component by component, so that loops over the nodes become vector code.
template <int Dim, Shape shape>
struct Gradients {
  static constexpr std::size_t count = shape == Shape::linear_simplex ? Dim + 1 : most_nodes<Dim>;
  std::array<std::uint32_t, count> node;
  std::array<std::array<double, count>, Dim> component;  ///< 1/m
  std::array<double, count> size;                        ///< sum of the components' magnitudes, 1/m
};

template <int Dim, Shape shape>
Gradients<Dim, shape> gradients(const Particles<Dim>& particles, std::size_t p, const Grid<Dim>& grid, ShapeTag<shape>)
{
  const Stencil<Dim> s = stencil_of<Dim, shape>(particles, p, grid);
  Gradients<Dim, shape> g;
  std::size_t k = 0;
  if constexpr (Dim == 2) {
    std::size_t row = grid.index(s.base);
    for (std::size_t i = 0; i < 3; ++i, row += static_cast<std::size_t>(grid.counts()[1]))
      for (std::size_t j = 0; j < 3; ++j, ++k) {
        g.node[k] = static_cast<std::uint32_t>(row + j);
        g.component[0][k] = s.gradient[0][i] * s.weight[1][j];
        g.component[1][k] = s.weight[0][i] * s.gradient[1][j];
      }
  } else {
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) {
        const std::size_t row =
            grid.index({ s.base[0] + static_cast<int>(i), s.base[1] + static_cast<int>(j), s.base[2] });
        const double gw = s.gradient[0][i] * s.weight[1][j], wg = s.weight[0][i] * s.gradient[1][j];
        const double ww = s.weight[0][i] * s.weight[1][j];
        for (std::size_t l = 0; l < 3; ++l, ++k) {
          g.node[k] = static_cast<std::uint32_t>(row + l);
          g.component[0][k] = gw * s.weight[2][l];
          g.component[1][k] = wg * s.weight[2][l];
          g.component[2][k] = ww * s.gradient[2][l];
        }
      }
  }
  for (k = 0; k < g.count; ++k) {
    g.size[k] = std::abs(g.component[0][k]);
    for (std::size_t d = 1; d < Dim; ++d)
      g.size[k] += std::abs(g.component[d][k]);
  }
  return g;
}

template <int Dim>
Gradients<Dim, Shape::linear_simplex> gradients(const Particles<Dim>& particles, std::size_t p, const Grid<Dim>& grid,
                                                ShapeTag<Shape::linear_simplex>)
{
  Vec<Dim> x;
  for (std::size_t d = 0; d < Dim; ++d)
    x[static_cast<Eigen::Index>(d)] = particles.position[d][p];
  const Reach<Dim, Dim + 1> reach = simplex_reach<Dim>(x, grid);
  Gradients<Dim, Shape::linear_simplex> g;
  g.node = reach.node;
  for (std::size_t k = 0; k < g.count; ++k) {
    g.size[k] = 0.0;
    for (std::size_t d = 0; d < Dim; ++d) {
      g.component[d][k] = reach.gradient[k][static_cast<Eigen::Index>(d)];
      g.size[k] += std::abs(g.component[d][k]);
    }
  }
  return g;
}

/// Calls `visit(node, weight)` for all that a point reaches: what reach_of() gives, without its gradients, which take
/// most of its time.
template <int Dim, class Visitor>
void visit_weights(Shape shape, const Vec<Dim>& point, const Grid<Dim>& grid, Visitor&& visit)
{
  if (shape == Shape::linear_simplex) {
    const Reach<Dim, Dim + 1> reach = simplex_reach<Dim>(point, grid);
    for (std::size_t k = 0; k < Dim + 1; ++k)
      visit(reach.node[k], reach.weight[k]);
    return;
  }
  std::array<double, Dim> x;
  for (std::size_t d = 0; d < Dim; ++d)
    x[d] = point[static_cast<Eigen::Index>(d)];
  const Stencil<Dim> s = make_stencil<Dim>(x, grid.origin(), grid.dx(), grid.inverse_dx());
  std::array<int, Dim> at = s.base;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      at[0] = s.base[0] + static_cast<int>(i);
      at[1] = s.base[1] + static_cast<int>(j);
      const double weight = s.weight[0][i] * s.weight[1][j];
      const std::size_t row = grid.index(at);
      if constexpr (Dim == 2)
        visit(static_cast<std::uint32_t>(row), weight);
      else
        for (std::size_t l = 0; l < 3; ++l)
          visit(static_cast<std::uint32_t>(row + l), weight * s.weight[2][l]);
    }
}

/// The largest eigenvalue of D^(1/2) T D^(1/2) from above, for a matrix A with these invariants; see the header. Its
/// part of normal strains, N = A^(1/2) D_n A^(1/2), has the characteristic polynomial
///     x^2 - M e1 x + (M^2 - lambda^2) e2                                             in the plane,
///     x^3 - M e1 x^2 + (M^2 - lambda^2) e2 x - (M - lambda)^2 (M + 2 lambda) e3      in space.
template <int Dim>
double largest_eigenvalue(double e1, double e2, double e3, const Moduli& moduli)
{
  constexpr double n = Dim;
  const double m = moduli.constrained(), lame = moduli.lame;
  const double c1 = m * e1, c2 = (m - lame) * (m + lame) * e2;
  // From trace and norm (Wolkowicz and Styan 1980): exact in the plane, above it in space.
  double x = c1 / n + std::sqrt(std::max(0.0, (n - 1.0) / n * ((1.0 - 1.0 / n) * c1 * c1 - 2.0 * c2)));
  if constexpr (Dim == 3) {
    // Beyond its largest root a cubic with real roots is convex, so Newton's steps stay above that root.
    const double c3 = (m - lame) * (m - lame) * (m + 2.0 * lame) * e3;
    for (int step = 0; step < 3; ++step) {
      const double value = ((x - c1) * x + c2) * x - c3, slope = (3.0 * x - 2.0 * c1) * x + c2;
      if (!(slope > 0.0) || !(value > 0.0))
        break;
      x -= value / slope;
    }
  }
  // Shears, G (alpha_i + alpha_j), are below 2 G alpha_max, and that below x unless lambda is negative.
  return lame < 0.0 ? std::max(x, moduli.shear * e1) : x;
}

/// Sum of grad w_i grad w_i^T share_i, by its invariants.
template <int Dim, Shape shape>
double largest_eigenvalue(const Gradients<Dim, shape>& g, const std::array<double, Gradients<Dim, shape>::count>& share,
                          const Moduli& moduli)
{
  const auto entry = [&](std::size_t a, std::size_t b) {
    double sum = 0.0;
    for (std::size_t k = 0; k < g.count; ++k)
      sum += g.component[a][k] * g.component[b][k] * share[k];
    return sum;
  };
  const double xx = entry(0, 0), yy = entry(1, 1), xy = entry(0, 1);
  if constexpr (Dim == 2) {
    return largest_eigenvalue<2>(xx + yy, xx * yy - xy * xy, 0.0, moduli);
  } else {
    const double zz = entry(2, 2), xz = entry(0, 2), yz = entry(1, 2);
    const double minor_x = yy * zz - yz * yz, minor_y = xx * zz - xz * xz, minor_z = xx * yy - xy * xy;
    const double determinant = xx * minor_x - xy * (xy * zz - xz * yz) + xz * (xy * yz - xz * yy);
    return largest_eigenvalue<3>(xx + yy + zz, minor_x + minor_y + minor_z, determinant, moduli);
  }
}

/// What the rounds need of an element: its s_i^e / x_e on the nodes, and its own frequency square times x_e for nodal
/// values S_i / m_i.
template <int Dim, Shape shape>
struct ParticleElement {
  Gradients<Dim, shape> g;
  const Moduli& moduli;
  double volume, inverse_dx;

  void scatter(double x, std::vector<double>& nodal) const
  {
    const double factor = x * volume * moduli.constrained() * inverse_dx;
    for (std::size_t k = 0; k < g.count; ++k)
      nodal[g.node[k]] += factor * g.size[k];
  }
  double eigenvalue(const std::vector<double>& nodal) const
  {
    std::array<double, Gradients<Dim, shape>::count> share;
    for (std::size_t k = 0; k < g.count; ++k)
      share[k] = nodal[g.node[k]];
    for (std::size_t k = 0; k < g.count; ++k)  // a node without gradient, of a particle amid its cell, has no share
      share[k] = g.size[k] > 0.0 ? share[k] / g.size[k] : 0.0;
    return largest_eigenvalue(g, share, moduli) / (moduli.constrained() * inverse_dx);
  }
};

}  // namespace

double stable_step(double frequency_square, double damping_rate, const Discretisation& method)
{
  const double room = method.update == UpdateOrder::usl   ? 0.5
                      : feels_what_particles_hold(method) ? 0.5 * (1.0 + method.flip_fraction)
                                                          : 1.0;
  // The positive root of omega^2 dt^2 / 4 + c dt / 2 = room, written without cancellation.
  const double half_rate = 0.5 * damping_rate;
  return 2.0 * room / (half_rate + std::sqrt(half_rate * half_rate + room * frequency_square));
}

template <int Dim>
void FrequencyBound<Dim>::begin(const Grid<Dim>& grid, const Discretisation& method)
{
  grid_ = &grid;
  method_ = method;
  bodies_.clear();
  segments_.clear();
  segment_nodes_.clear();
  for (std::vector<double>* nodal : { &first_, &second_, &held_ })
    nodal->resize(grid.size());
  slot_.resize(grid.size());
}

template <int Dim>
void FrequencyBound<Dim>::add_body(const Particles<Dim>& particles, const Moduli& elastic, const Moduli& viscous)
{
  bodies_.push_back({ &particles, elastic, viscous });
}

template <int Dim>
void FrequencyBound<Dim>::add_mass(const Particles<Dim>& particles)
{
  bodies_.push_back({ &particles, {}, {} });
}

template <int Dim>
void FrequencyBound<Dim>::add_segment(const Vec<Dim>& a, const Vec<Dim>& b, double stiffness)
{
  const std::array<SpanPoint, 2> ends{ { { a, -1.0 }, { b, 1.0 } } };
  add_span(ends.data(), ends.size(), stiffness);
}

template <int Dim>
void FrequencyBound<Dim>::add_span(const SpanPoint* points, std::size_t count, double stiffness)
{
  const std::size_t first = segment_nodes_.size();
  for (const SpanPoint* point = points; point < points + count; ++point)
    visit_weights<Dim>(method_.shape, point->place, *grid_, [&](std::uint32_t node, double weight) {
      std::uint32_t& slot = slot_[node];
      if (slot == 0) {
        segment_nodes_.push_back({ node, 0.0 });
        slot = static_cast<std::uint32_t>(segment_nodes_.size() - first);
      }
      segment_nodes_[first + slot - 1].change += point->coefficient * weight;
    });
  for (std::size_t at = first; at < segment_nodes_.size(); ++at) {
    segment_nodes_[at].change = std::abs(segment_nodes_[at].change);
    slot_[segment_nodes_[at].node] = 0;
  }
  segments_.push_back({ stiffness, first, segment_nodes_.size() - first });
}

template <int Dim>
void FrequencyBound<Dim>::add_fibre(const Vec<Dim>& x, const Vec<Dim>& along, double stiffness)
{
  const AnyReach<Dim> reach = reach_of<Dim>(method_.shape, x, *grid_);
  const std::size_t first = segment_nodes_.size();
  for (std::size_t k = 0; k < static_cast<std::size_t>(reach.count); ++k)
    segment_nodes_.push_back({ reach.node[k], std::abs(along.dot(reach.gradient[k])) });
  segments_.push_back({ stiffness, first, segment_nodes_.size() - first });
}

template <int Dim>
struct FrequencyBound<Dim>::SegmentElement {
  const SegmentNode *first, *last;
  double stiffness;

  void scatter(double x, std::vector<double>& nodal) const
  {
    for (const SegmentNode* n = first; n < last; ++n)
      nodal[n->node] += x * stiffness * n->change;
  }
  double eigenvalue(const std::vector<double>& nodal) const
  {
    double sum = 0.0;
    for (const SegmentNode* n = first; n < last; ++n)
      sum += n->change * nodal[n->node];
    return sum;
  }
};

template <int Dim>
template <class Visitor>
void FrequencyBound<Dim>::for_each_element(bool viscous, Visitor&& visit) const
{
  std::size_t number = 0;
  for (const Body& body : bodies_) {
    const Moduli& moduli = viscous ? body.viscous : body.elastic;
    if (!(moduli.constrained() > 0.0))
      continue;
    const Particles<Dim>& particles = *body.particles;
    const auto look = [&](auto shape) {
      for (std::size_t p = 0; p < particles.size(); ++p, ++number)
        visit(number, ParticleElement<Dim, decltype(shape)::value>{ gradients<Dim>(particles, p, *grid_, shape), moduli,
                                                                    particles.volume[p], grid_->inverse_dx() });
    };
    switch (shape_of(method_.shape, particles)) {
      case Shape::bspline2:
        look(ShapeTag<Shape::bspline2>());
        break;
      case Shape::linear_simplex:
        look(ShapeTag<Shape::linear_simplex>());
        break;
      case Shape::gimp:
        look(ShapeTag<Shape::gimp>());
        break;
    }
  }
  if (viscous)  // sheets are elastic
    return;
  for (const Segment& s : segments_)
    visit(number++, SegmentElement{ &segment_nodes_[s.first], &segment_nodes_[s.first] + s.count, s.stiffness });
}

template <int Dim>
template <class Visitor>
void FrequencyBound<Dim>::for_each_node(Visitor&& visit) const
{
  const Window<Dim>& window = grid_->window();
  for (int slowest = window.begin[0]; slowest < window.end[0]; ++slowest)
    grid_->visit_rows(slowest, [&](std::size_t first, const std::array<int, Dim>&, int length) {
      for (std::size_t i = first; i < first + static_cast<std::size_t>(length); ++i)
        visit(i);
    });
}

template <int Dim>
void FrequencyBound<Dim>::divide_by_mass(std::vector<double>& nodal)
{
  for_each_node([&](std::size_t i) {
    const double mass = grid_->nodes()[i][Grid<Dim>::mass_slot];
    nodal[i] = mass > massless ? nodal[i] / mass : 0.0;
  });
  if (feels_what_particles_hold(method_))
    keep_what_particles_hold(nodal);
}

template <int Dim>
void FrequencyBound<Dim>::keep_what_particles_hold(std::vector<double>& nodal)
{
  for_each_node([&](std::size_t i) { held_[i] = 0.0; });
  for (const Body& body : bodies_)
    for (std::size_t p = 0; p < body.particles->size(); ++p)
      visit_reach_of<Dim>(method_.shape, *body.particles, p, *grid_, [&](const auto& reach) {
        double mean = 0.0;
        for (std::size_t k = 0; k < static_cast<std::size_t>(reach.count); ++k)
          mean += reach.weight[k] * nodal[reach.node[k]];
        for (std::size_t k = 0; k < static_cast<std::size_t>(reach.count); ++k)
          held_[reach.node[k]] += body.particles->mass[p] * reach.weight[k] * mean;
      });
  for_each_node([&](std::size_t i) {
    const double mass = grid_->nodes()[i][Grid<Dim>::mass_slot];
    nodal[i] = mass > massless ? held_[i] / mass : 0.0;
  });
}

template <int Dim>
double FrequencyBound<Dim>::rounds(bool viscous)
{
  for_each_node([&](std::size_t i) { first_[i] = second_[i] = 0.0; });
  for_each_element(viscous, [&](std::size_t, const auto& element) { element.scatter(1.0, first_); });
  divide_by_mass(first_);
  for_each_element(viscous, [&](std::size_t e, const auto& element) {
    own_[e] = element.eigenvalue(first_);
    element.scatter(own_[e], second_);
  });
  divide_by_mass(second_);
  double largest = 0.0;
  for_each_element(viscous, [&](std::size_t e, const auto& element) {
    const double eigenvalue = element.eigenvalue(second_);
    // Zero only for what no node with mass reaches.
    if (own_[e] > 0.0 && eigenvalue > largest * own_[e])
      largest = eigenvalue / own_[e];
  });
  return largest;
}

template <int Dim>
typename FrequencyBound<Dim>::Result FrequencyBound<Dim>::bound()
{
  std::size_t elements = segments_.size();
  bool any_viscous = false;
  for (const Body& body : bodies_) {
    elements += body.particles->size();
    any_viscous = any_viscous || body.viscous.constrained() > 0.0;
  }
  own_.resize(elements);

  Result result;
  if (any_viscous)
    result.damping_rate = rounds(true);
  result.frequency_square = rounds(false);
  return result;
}

template class FrequencyBound<2>;
template class FrequencyBound<3>;

}  // namespace geocontainer_mpm::mpm
