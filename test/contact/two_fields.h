#pragma once
/// Two bodies, each with its own velocity field, stepped as a model steps them: for the tests of contact between
/// fields.

#include <memory>

#include "contact_input.h"
#include "geocontainer_mpm/contact/field_contact.h"
#include "geocontainer_mpm/material/law.h"
#include "geocontainer_mpm/material/parameters.h"

namespace geocontainer_mpm::contact::testing {

/// A body and its grid. Without a law it is dust: no stress.
struct Field {
  mpm::Grid<2> grid;
  mpm::Particles<2> particles;
  std::vector<ContactPoints<2>> points;
  std::shared_ptr<const material::Law<2>> law;
  Vec2 gravity = Vec2::Zero();

  Field(const mpm::Grid<2>& lattice, const std::vector<Vec2>& at, double spacing, double density) : grid(lattice)
  {
    particles.resize(at.size());
    for (std::size_t p = 0; p < at.size(); ++p) {
      set_vector<2>(particles.position, p, at[p]);
      particles.volume[p] = particles.initial_volume[p] = spacing * spacing;
      particles.mass[p] = particles.weight_mass[p] = density * spacing * spacing;
    }
    points = { { &particles, spacing > 0.0 } };
  }
  Field(const Field&) = delete;
  Field& operator=(const Field&) = delete;

  ContactField side() { return { &grid, &points }; }
  void set_velocity(const Vec2& v)
  {
    for (std::size_t p = 0; p < particles.size(); ++p)
      set_vector<2>(particles.velocity, p, v);
  }
  void to_grid(double kick)
  {
    mpm::testing::scatter_body<2>(particles, gravity, grid);
    mpm::testing::apply_forces(grid, kick, 0.0);
  }
  void from_grid(double dt)
  {
    mpm::grid_to_particles<2>({}, grid, dt, mpm::Gather::all, particles, 0, particles.size());
    if (law)
      law->update(particles.batch(), dt, 0, particles.size());
  }
  Vec2 momentum() const
  {
    return sum([](double m, const Vec2& v) { return Vec2(m * v); });
  }
  double kinetic() const
  {
    return sum([](double m, const Vec2& v) { return Vec2(0.5 * m * v.squaredNorm(), 0.0); })[0];
  }
  Vec2 mean(const std::array<mpm::Column, 2>& columns) const
  {
    Vec2 total = Vec2::Zero();
    for (std::size_t p = 0; p < particles.size(); ++p)
      total += vector_at<2>(columns, p);
    return total / static_cast<double>(particles.size());
  }

private:
  template <class Term>
  Vec2 sum(Term&& term) const
  {
    Vec2 total = Vec2::Zero();
    mpm::testing::for_each_node(grid, [&](std::size_t i, const std::array<int, 2>&) {
      total += term(mpm::testing::node_mass(grid, i), mpm::testing::node_vector(grid, i));
    });
    return total;
  }
};

/// A step of both. `last`: length of the step before, s.
inline ContactSums<2> step(Field& a, Field& b, FieldContact& contact, double friction, double last, double dt)
{
  a.to_grid(0.5 * (last + dt));
  b.to_grid(0.5 * (last + dt));
  const ContactSums<2> sums = contact.solve(a.side(), b.side(), friction, 0.5 * (last + dt), dt);
  a.from_grid(dt);
  b.from_grid(dt);
  return sums;
}

/// A lattice of points in a box of `columns` by `rows`, its lower left corner at `corner`, turned by `pose`.
inline std::vector<Vec2> block(const Vec2& corner, int columns, int rows, double spacing, const RigidPose& pose = {})
{
  std::vector<Vec2> points;
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < rows; ++j)
      points.push_back(pose.apply(corner + spacing * Vec2(i + 0.5, j + 0.5)));
  return points;
}

inline mpm::Grid<2> lattice(double half, double dx)
{
  return mpm::Grid<2>(Vec2::Constant(-half), Vec2::Constant(half), dx, mpm::testing::free_faces<2>());
}

}  // namespace geocontainer_mpm::contact::testing
