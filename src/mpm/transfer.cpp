#include "geocontainer_mpm/mpm/transfer.h"

#include "transfer_loops.h"

namespace geocontainer_mpm::mpm {

extern template struct TransferLoops<2, Shape::bspline2>;
extern template struct TransferLoops<3, Shape::bspline2>;
extern template struct TransferLoops<2, Shape::linear_simplex>;
extern template struct TransferLoops<3, Shape::linear_simplex>;
extern template struct TransferLoops<2, Shape::gimp>;
extern template struct TransferLoops<3, Shape::gimp>;

namespace {

/// Calls `run(loops)` with the loops for a set of particles.
template <int Dim, class Run>
void with_loops(Shape shape, const Particles<Dim>& particles, Run&& run)
{
  switch (shape_of(shape, particles)) {
    case Shape::bspline2:
      return run(TransferLoops<Dim, Shape::bspline2>());
    case Shape::linear_simplex:
      return run(TransferLoops<Dim, Shape::linear_simplex>());
    case Shape::gimp:
      return run(TransferLoops<Dim, Shape::gimp>());
  }
}

}  // namespace

template <int Dim>
void body_to_grid(const Discretisation& discretisation, const Particles<Dim>& particles, const Strips& strips,
                  const BodyTerms& terms, const Vec<Dim>& gravity, Grid<Dim>& grid, ThreadTeam& team)
{
  with_loops(discretisation.shape, particles,
             [&](auto loops) { loops.body(discretisation, particles, strips, terms, gravity, grid, team); });
}

template <int Dim>
void sheet_to_grid(const Discretisation& discretisation, const Particles<Dim>& nodes, Part part,
                   const Vec<Dim>& gravity, Grid<Dim>& grid, bool stressed)
{
  with_loops(discretisation.shape, nodes,
             [&](auto loops) { loops.sheet(discretisation, nodes, part, gravity, grid, stressed); });
}

template <int Dim>
void grid_to_particles(const Discretisation& discretisation, const Grid<Dim>& grid, double dt, Gather what,
                       Particles<Dim>& particles, std::size_t begin, std::size_t end)
{
  with_loops(discretisation.shape, particles,
             [&](auto loops) { loops.gather(discretisation, grid, dt, what, particles, begin, end); });
}

template <int Dim>
void add_surface_force(Shape shape, const Particles<Dim>& particles, std::size_t p, const Vec<Dim>& arm,
                       const Vec<Dim>& force, Grid<Dim>& grid)
{
  const AnyReach<Dim> inside = reach_of<Dim>(shape, particles, p, -arm, grid),
                      here = reach_of<Dim>(shape, particles, p, Vec<Dim>::Zero(), grid);
  for (std::size_t k = 0; k < static_cast<std::size_t>(inside.count); ++k)
    grid.forces()[inside.node[k]].matrix().template head<Dim>() += inside.weight[k] * force;
  for (std::size_t k = 0; k < static_cast<std::size_t>(here.count); ++k)
    grid.forces()[here.node[k]].matrix().template head<Dim>() += 2.0 * arm.dot(here.gradient[k]) * force;
}

template void body_to_grid(const Discretisation&, const Particles<2>&, const Strips&, const BodyTerms&, const Vec<2>&,
                           Grid<2>&, ThreadTeam&);
template void body_to_grid(const Discretisation&, const Particles<3>&, const Strips&, const BodyTerms&, const Vec<3>&,
                           Grid<3>&, ThreadTeam&);
template void sheet_to_grid(const Discretisation&, const Particles<2>&, Part, const Vec<2>&, Grid<2>&, bool);
template void sheet_to_grid(const Discretisation&, const Particles<3>&, Part, const Vec<3>&, Grid<3>&, bool);
template void grid_to_particles(const Discretisation&, const Grid<2>&, double, Gather, Particles<2>&, std::size_t,
                                std::size_t);
template void grid_to_particles(const Discretisation&, const Grid<3>&, double, Gather, Particles<3>&, std::size_t,
                                std::size_t);
template void add_surface_force(Shape, const Particles<2>&, std::size_t, const Vec<2>&, const Vec<2>&, Grid<2>&);
template void add_surface_force(Shape, const Particles<3>&, std::size_t, const Vec<3>&, const Vec<3>&, Grid<3>&);

}  // namespace geocontainer_mpm::mpm
