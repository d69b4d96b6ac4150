#pragma once
/// Random surfaces and small material on a grid, for the tests of contact.

#include <cmath>
#include <vector>

#include "../mpm/random_cloud.h"
#include "geocontainer_mpm/contact/contact_solver.h"
#include "geocontainer_mpm/mpm/grid_update.h"

namespace geocontainer_mpm::contact::testing {

using mpm::testing::apart;
using mpm::testing::Chance;
using mpm::testing::holds;
using mpm::testing::set_vector;
using mpm::testing::vector_at;

inline constexpr double pi = 3.14159265358979323846;

/// Profile of ground from left to right, hills and valleys, slopes up to 63 degrees; the free side is above.
inline std::vector<Vec2> random_ground(Chance& chance, int segments)
{
  std::vector<Vec2> line{ { chance(-2.0, 2.0), chance(-2.0, 2.0) } };
  for (int k = 0; k < segments; ++k) {
    const double run = chance(0.2, 1.0);
    line.emplace_back(line.back()[0] + run, line.back()[1] + run * chance(-2.0, 2.0));
  }
  return line;
}

inline double height_at(const std::vector<Vec2>& ground, double y)
{
  std::size_t k = 0;
  while (k + 2 < ground.size() && y > ground[k + 1][0])
    ++k;
  const double part = (y - ground[k][0]) / (ground[k + 1][0] - ground[k][0]);
  return ground[k][1] + part * (ground[k + 1][1] - ground[k][1]);
}

/// Distance to a polyline, ends included, and whether the nearest point is an end. Written down on its own.
struct Brute {
  double distance;
  bool at_end;
};
inline Brute brute_nearest(const std::vector<Vec2>& line, const Vec2& x)
{
  Brute best{ 1e300, false };
  for (std::size_t k = 0; k + 1 < line.size(); ++k) {
    const Vec2 along = line[k + 1] - line[k];
    const double t = std::min(1.0, std::max(0.0, (x - line[k]).dot(along) / along.squaredNorm()));
    const double distance = (x - line[k] - t * along).norm();
    if (distance < best.distance)
      best = { distance, (k == 0 && t == 0.0) || (k + 2 == line.size() && t == 1.0) };
  }
  return best;
}

/// Material on a grid, its velocities updated by the forces of a step: what a solver is given.
template <int Dim>
struct PatchIn {
  mpm::Grid<Dim> grid;
  mpm::Particles<Dim> points;

  explicit PatchIn(const std::vector<Vec<Dim>>& at, double half_edge = 1.0)
      : grid(Vec<Dim>::Constant(-half_edge), Vec<Dim>::Constant(half_edge), 0.1, mpm::testing::free_faces<Dim>())
  {
    points.resize(at.size());
    for (std::size_t p = 0; p < at.size(); ++p) {
      set_vector<Dim>(points.position, p, at[p]);
      points.mass[p] = points.weight_mass[p] = 3.0;
    }
  }
  std::size_t size() const { return points.size(); }
  Vec<Dim> at(std::size_t p) const { return vector_at<Dim>(points.position, p); }
  void set_velocity(std::size_t p, const Vec<Dim>& v) { set_vector<Dim>(points.velocity, p, v); }
  void set_velocity(const Vec<Dim>& v)
  {
    for (std::size_t p = 0; p < size(); ++p)
      set_velocity(p, v);
  }
  void to_grid(const Vec<Dim>& gravity = Vec<Dim>::Zero(), double kick = 0.0)
  {
    mpm::testing::open(mpm::testing::everything(grid), grid);
    mpm::sheet_to_grid<Dim>({}, points, mpm::Part::all, gravity, grid);
    mpm::testing::apply_forces(grid, kick, 0.0);
  }
  Vec<Dim> velocity_at(const Vec<Dim>& x) const { return mpm::testing::interpolated<Dim>(grid, x); }
  Vec<Dim> momentum() const
  {
    Vec<Dim> sum = Vec<Dim>::Zero();
    mpm::testing::for_each_node(grid, [&](std::size_t i, const std::array<int, Dim>&) {
      sum += mpm::testing::node_mass(grid, i) * mpm::testing::node_vector(grid, i);
    });
    return sum;
  }
  double kinetic() const
  {
    double sum = 0.0;
    mpm::testing::for_each_node(grid, [&](std::size_t i, const std::array<int, Dim>&) {
      sum += 0.5 * mpm::testing::node_mass(grid, i) * mpm::testing::node_vector(grid, i).squaredNorm();
    });
    return sum;
  }
};
using Patch = PatchIn<2>;

/// A straight wall through `point`, long enough, whose free side is where `normal` looks; at rest.
inline BoundaryBody<2> wall(const Vec2& point, const Vec2& normal, double friction)
{
  const Vec2 tangent(normal[1], -normal[0]);
  BoundaryBody<2> body("wall", Surface({ point - 3.0 * tangent, point + 3.0 * tangent }), friction, 0.05);
  body.set_motion({}, {}, 1e-3);
  return body;
}

/// The same in space, along x.
inline BoundaryBody<3> long_wall(const Vec2& point, const Vec2& normal, double friction)
{
  const Vec2 tangent(normal[1], -normal[0]);
  BoundaryBody<3> body("wall", Surface({ point - 3.0 * tangent, point + 3.0 * tangent }), Along{ -3.0, 3.0 }, friction,
                       0.5);
  body.set_motion({}, {}, 1e-3);
  return body;
}

}  // namespace geocontainer_mpm::contact::testing
