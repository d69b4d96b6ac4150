#pragma once
/// One battery for every shape and dimension.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "geocontainer_mpm/mpm/reach.h"
#include "random_cloud.h"

namespace geocontainer_mpm::mpm::testing {

template <int dimension, Shape which>
struct Kind {
  static constexpr int Dim = dimension;
  static constexpr Shape shape = which;
};
using Kinds = ::testing::Types<Kind<2, Shape::bspline2>, Kind<3, Shape::bspline2>, Kind<2, Shape::linear_simplex>,
                               Kind<3, Shape::linear_simplex>, Kind<2, Shape::gimp>, Kind<3, Shape::gimp>>;

inline Discretisation choice_of(Shape shape, Transfer transfer, double flip_fraction = 1.0)
{
  Discretisation choice;
  choice.shape = shape;
  choice.transfer = transfer;
  choice.flip_fraction = flip_fraction;
  return choice;
}

template <int Dim>
Vec<Dim> random_point(Chance& chance, const Grid<Dim>& grid)
{
  const Vec<Dim> lower = lower_of(grid), upper = upper_of(grid);
  Vec<Dim> x;
  for (int d = 0; d < Dim; ++d)
    // On grid lines and faces as often as not: that is where shapes may be wrong.
    x[d] = chance.whole(0, 1) == 0
               ? chance(lower[d], upper[d])
               : std::min(upper[d],
                          lower[d] + chance.whole(0, 2 * (grid.high_face(d) - grid.low_face(d))) * 0.5 * grid.dx());
  return x;
}

/// Edges from a third of a cell to more than one, which counts as one.
template <int Dim>
Vec<Dim> random_box(Chance& chance, const Grid<Dim>& grid)
{
  Vec<Dim> box;
  for (int d = 0; d < Dim; ++d)
    box[d] = chance(0.3, 1.3) * grid.dx();
  return box;
}

/// The cloud, with boxes of any size where the shape has them.
template <int Dim>
Particles<Dim> boxed(Chance& chance, Shape shape, const Grid<Dim>& grid, Particles<Dim> cloud)
{
  if (shape == Shape::gimp) {
    cloud.use_boxes();
    for (std::size_t p = 0; p < cloud.size(); ++p)
      set_vector<Dim>(cloud.box, p, random_box(chance, grid));
  }
  return cloud;
}

/// Box of a row; of points, nothing.
template <int Dim>
Vec<Dim> box_of(const Particles<Dim>& particles, std::size_t p)
{
  return particles.box[0].empty() ? Vec<Dim>::Zero() : vector_at<Dim>(particles.box, p);
}

/// Indices of the node in storage place `i`.
template <int Dim>
std::array<int, Dim> node_at(const Grid<Dim>& grid, std::size_t i)
{
  std::array<int, Dim> node;
  for (std::size_t d = Dim; d-- > 0; i /= static_cast<std::size_t>(grid.counts()[d]))
    node[d] = static_cast<int>(i % static_cast<std::size_t>(grid.counts()[d]));
  return node;
}

template <int Dim, class Visitor>
void visit_reach(Shape shape, const Grid<Dim>& grid, const Vec<Dim>& x, const Vec<Dim>& box, Visitor&& visit)
{
  Particles<Dim> one;
  one.resize(1);
  set_vector<Dim>(one.position, 0, x);
  if (shape == Shape::gimp && !box.isZero(0.0)) {
    one.use_boxes();
    set_vector<Dim>(one.box, 0, box);
  }
  const AnyReach<Dim> reach = reach_of<Dim>(shape, one, 0, Vec<Dim>::Zero(), grid);
  for (std::size_t k = 0; k < static_cast<std::size_t>(reach.count); ++k)
    visit(static_cast<std::size_t>(reach.node[k]), reach.weight[k], reach.gradient[k]);
}

/// sum w r r^T about the point: the inertia of its affine motion.
template <int Dim>
Mat<Dim> inertia_of(Shape shape, const Grid<Dim>& grid, const Vec<Dim>& x, const Vec<Dim>& box)
{
  Mat<Dim> sum = Mat<Dim>::Zero();
  visit_reach<Dim>(shape, grid, x, box, [&](std::size_t i, double w, const Vec<Dim>&) {
    const Vec<Dim> r = grid.coordinate(node_at(grid, i)) - x;
    sum += w * r * r.transpose();
  });
  return sum;
}

template <int Dim>
Vec<Dim> velocity_at(Shape shape, const Grid<Dim>& grid, const Vec<Dim>& x, const Vec<Dim>& box)
{
  Vec<Dim> sum = Vec<Dim>::Zero();
  visit_reach<Dim>(shape, grid, x, box,
                   [&](std::size_t i, double w, const Vec<Dim>&) { sum += w * node_vector(grid, i); });
  return sum;
}

inline Transfer any_transfer(Chance& chance)
{
  return static_cast<Transfer>(chance.whole(0, 2));
}

/// A cloud on every sort of place, faces and grid lines included.
template <int Dim>
Particles<Dim> awkward_cloud(Chance& chance, std::size_t count, const Grid<Dim>& grid)
{
  Particles<Dim> particles = random_cloud(chance, count, grid);
  for (std::size_t p = 0; p < count; ++p)
    set_vector<Dim>(particles.position, p, random_point(chance, grid));
  for (Column& column : particles.gradient)
    for (double& value : column)
      value = chance(-5.0, 5.0);
  return particles;
}

template <int Dim>
std::array<FaceCondition, 2 * Dim> any_faces(Chance& chance)
{
  std::array<FaceCondition, 2 * Dim> faces;
  for (FaceCondition& face : faces)
    face = static_cast<FaceCondition>(chance.whole(0, 2));
  return faces;
}

}  // namespace geocontainer_mpm::mpm::testing
