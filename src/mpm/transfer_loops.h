#pragma once
/// The loops over particles of one shape: every other choice is made here, outside them. Instantiated for bspline2 in
/// transfer_bspline.cpp, for linear_simplex in transfer_simplex.cpp and for gimp in transfer_gimp.cpp.

#include "transfer_bspline.h"
#include "transfer_simplex.h"

namespace geocontainer_mpm::mpm {

template <int Dim, Shape shape>
struct TransferLoops {
  static void body(const Discretisation& discretisation, const Particles<Dim>& particles, const Strips& strips,
                   const BodyTerms& terms, const Vec<Dim>& gravity, Grid<Dim>& grid, ThreadTeam& team);
  static void sheet(const Discretisation& discretisation, const Particles<Dim>& nodes, Part part,
                    const Vec<Dim>& gravity, Grid<Dim>& grid, bool stressed);
  static void gather(const Discretisation& discretisation, const Grid<Dim>& grid, double dt, Gather what,
                     Particles<Dim>& particles, std::size_t begin, std::size_t end);
};

template <int Dim, Shape shape, Part part, bool affine, Push push>
GEOCONTAINER_MPM_INLINE void scatter_one(const Particles<Dim>& particles, std::size_t p, const Vec<Dim>& gravity,
                                         const Extra& extra, Grid<Dim>& grid)
{
  if constexpr (shape != Shape::linear_simplex)
    scatter_bspline<Dim, shape, part, affine, push>(particles, p, gravity, extra, grid);
  else
    scatter_simplex<Dim, part, affine, push>(particles, p, gravity, extra, grid);
}

template <int Dim, Shape shape, Part part, bool affine, Push push>
void scatter_strips(const Particles<Dim>& particles, const Strips& strips, const Vec<Dim>& gravity, const Extra& extra,
                    Grid<Dim>& grid, ThreadTeam& team)
{
  for_each_in_strips(strips, team, [&](std::size_t p) {
    scatter_one<Dim, shape, part, affine, push>(particles, p, gravity, extra, grid);
  });
}

template <int Dim, Shape shape>
void TransferLoops<Dim, shape>::body(const Discretisation& discretisation, const Particles<Dim>& particles,
                                     const Strips& strips, const BodyTerms& terms, const Vec<Dim>& gravity,
                                     Grid<Dim>& grid, ThreadTeam& team)
{
  const bool affine = is_affine(discretisation.transfer);
  const auto scatter = [&](auto loops, const Extra& extra) { loops(particles, strips, gravity, extra, grid, team); };
  if (terms.part == Part::momentum) {
    scatter(affine ? scatter_strips<Dim, shape, Part::momentum, true, Push::nothing>
                   : scatter_strips<Dim, shape, Part::momentum, false, Push::nothing>,
            Extra{});
    return;
  }
  const Smoothing smoothing = discretisation.smoothing;
  const bool smoothed = smoothing != Smoothing::none;
  const bool damped = terms.damping.lambda != 0.0 || terms.damping.shear != 0.0;
  const bool all = terms.part == Part::all;
  if (!smoothed && !damped && !terms.external_force) {
    scatter(!all     ? scatter_strips<Dim, shape, Part::force, false, Push::stress>
            : affine ? scatter_strips<Dim, shape, Part::all, true, Push::stress>
                     : scatter_strips<Dim, shape, Part::all, false, Push::stress>,
            Extra{});
    return;
  }
  const Extra extra{ terms.external_force, terms.damping, smoothing,
                     smoothed ? smooth_stress<Dim, shape_of_points(shape)>(smoothing, particles, strips, terms.damping,
                                                                           grid, team)
                              : nullptr };
  scatter(!all     ? scatter_strips<Dim, shape, Part::force, false, Push::extra>
          : affine ? scatter_strips<Dim, shape, Part::all, true, Push::extra>
                   : scatter_strips<Dim, shape, Part::all, false, Push::extra>,
          extra);
}

template <int Dim, Shape shape, Part part, bool affine, Push push>
void scatter_sheet(const Particles<Dim>& nodes, const Vec<Dim>& gravity, Grid<Dim>& grid)
{
  const Extra stress_and_force{ true, {}, Smoothing::none, nullptr };
  for (std::size_t p = 0; p < nodes.size(); ++p)
    scatter_one<Dim, shape, part, affine, push>(nodes, p, gravity, stress_and_force, grid);
}

template <int Dim, Shape shape>
void TransferLoops<Dim, shape>::sheet(const Discretisation& discretisation, const Particles<Dim>& nodes, Part part,
                                      const Vec<Dim>& gravity, Grid<Dim>& grid, bool stressed)
{
  const bool affine = is_affine(discretisation.transfer);
  const auto scatter = [&](auto loop) { loop(nodes, gravity, grid); };
  switch (part) {
    case Part::all:
      if (stressed)
        scatter(affine ? scatter_sheet<Dim, shape, Part::all, true, Push::extra>
                       : scatter_sheet<Dim, shape, Part::all, false, Push::extra>);
      else
        scatter(affine ? scatter_sheet<Dim, shape, Part::all, true, Push::external>
                       : scatter_sheet<Dim, shape, Part::all, false, Push::external>);
      break;
    case Part::momentum:
      scatter(affine ? scatter_sheet<Dim, shape, Part::momentum, true, Push::nothing>
                     : scatter_sheet<Dim, shape, Part::momentum, false, Push::nothing>);
      break;
    case Part::force:
      scatter(stressed ? scatter_sheet<Dim, shape, Part::force, false, Push::extra>
                       : scatter_sheet<Dim, shape, Part::force, false, Push::external>);
      break;
  }
}

template <int Dim, Shape shape, Gather what, Transfer transfer>
void gather_range(const Grid<Dim>& grid, double dt, double flip_fraction, Particles<Dim>& particles, std::size_t begin,
                  std::size_t end)
{
  for (std::size_t p = begin; p < end; ++p)
    if constexpr (shape != Shape::linear_simplex)
      gather_bspline<Dim, shape, what, transfer>(grid, dt, flip_fraction, particles, p);
    else
      gather_simplex<Dim, what, transfer>(grid, dt, flip_fraction, particles, p);
}

template <int Dim, Shape shape>
void TransferLoops<Dim, shape>::gather(const Discretisation& discretisation, const Grid<Dim>& grid, double dt,
                                       Gather what, Particles<Dim>& particles, std::size_t begin, std::size_t end)
{
  const auto run = [&](auto loop) { loop(grid, dt, discretisation.flip_fraction, particles, begin, end); };
  const auto run_velocity = [&](auto apic, auto flip, auto aflip) {
    run(discretisation.transfer == Transfer::apic ? apic : discretisation.transfer == Transfer::flip ? flip : aflip);
  };
  switch (what) {
    case Gather::all:
      run_velocity(gather_range<Dim, shape, Gather::all, Transfer::apic>,
                   gather_range<Dim, shape, Gather::all, Transfer::flip>,
                   gather_range<Dim, shape, Gather::all, Transfer::aflip>);
      break;
    case Gather::motion:
      run_velocity(gather_range<Dim, shape, Gather::motion, Transfer::apic>,
                   gather_range<Dim, shape, Gather::motion, Transfer::flip>,
                   gather_range<Dim, shape, Gather::motion, Transfer::aflip>);
      break;
    case Gather::velocity:
      run_velocity(gather_range<Dim, shape, Gather::velocity, Transfer::apic>,
                   gather_range<Dim, shape, Gather::velocity, Transfer::flip>,
                   gather_range<Dim, shape, Gather::velocity, Transfer::aflip>);
      break;
    case Gather::gradient:
      run(gather_range<Dim, shape, Gather::gradient, Transfer::apic>);
      break;
    case Gather::position:
      run(gather_range<Dim, shape, Gather::position, Transfer::apic>);
      break;
  }
}

}  // namespace geocontainer_mpm::mpm
