// A sheet on the grid between anchors, in both formulations: a stretched string, a mass on a spring, a pendulum.

#include <gtest/gtest.h>

#include "fixture.h"
#include "geocontainer_mpm/contact/contact_solver.h"
#include "geocontainer_mpm/geotextile/sheet.h"

namespace geocontainer_mpm::geotextile::testing {
namespace {

class EitherFormulation : public ::testing::TestWithParam<Formulation> {};
INSTANTIATE_TEST_SUITE_P(Formulation, EitherFormulation,
                         ::testing::Values(Formulation::segments, Formulation::membrane_points));

/// Membrane points need several a cell, segments do not.
double spacing(Formulation formulation, double dx)
{
  return formulation == Formulation::segments ? dx : 0.25 * dx;
}

/// A sheet whose nodes `held` stay where they are.
struct Scene {
  Sheet sheet;
  mpm::Grid<2> grid;
  std::vector<std::size_t> held;
  Vec2 gravity = Vec2::Zero();
  std::vector<Vec2> places = {};
  double last = 0.0;
  contact::ContactSolver<2> solver{};
  contact::ContactImpulses<2> impulses{};

  void step(double dt)
  {
    if (places.empty())
      for (const std::size_t node : held)
        places.push_back(sheet.node(node));
    sheet.update_forces();
    mpm::testing::open(mpm::testing::everything(grid), grid);
    mpm::sheet_to_grid<2>({}, sheet.nodes(), mpm::Part::all, gravity, grid, sheet.strains_with_grid());
    const double kick = 0.5 * (last + dt);
    mpm::testing::apply_forces(grid, kick, 0.0);
    std::vector<contact::Anchor<2>> anchors;
    for (std::size_t k = 0; k < held.size(); ++k)
      anchors.push_back({ sheet.node(held[k]), places[k] });
    solver.solve({}, {}, anchors, kick, dt, grid, impulses);
    mpm::grid_to_particles<2>({}, grid, dt, mpm::Gather::all, sheet.nodes(), 0, sheet.nodes().size());
    sheet.update_stress(dt);
    last = dt;
  }
};

struct Swing {
  double frequency;  ///< 1/s
  double left;       ///< of the amplitude after half a period
};

/// Until `value` has passed through zero twice.
template <class Value>
Swing swing(Scene& scene, double dt, Value&& value)
{
  double time = 0.0, previous = 0.0, highest = 0.0, lowest = 0.0, crossed = 0.0;
  for (int crossings = 0; crossings < 2;) {
    scene.step(dt);
    time += dt;
    const double now = value(scene.sheet);
    highest = std::max(highest, now);
    lowest = std::min(lowest, now);
    if (previous * now < 0.0) {
      ++crossings;
      crossed = time - dt * now / (now - previous);
    }
    previous = now;
  }
  return { 1.0 / crossed, -lowest / highest };
}

TEST_P(EitherFormulation, StringSwingsAtItsFrequencyBetweenAnchors)
{
  // Segments are of second order: 1.6 % off at ten cells, 0.4 % at twenty, 0.1 % at forty. Membrane points are 0.13 %
  // off at forty: integration by single points adds an error that falls more slowly.
  double bound = 0.02;
  for (const int cells : { 10, 20, 40 }) {
    const double length = 2.0, dx = length / cells, mass = 1.0, strain = 0.01;
    SheetParameters p;
    p.formulation = GetParam();
    p.stiffness = 1e4;
    p.mass = p.computational_mass = mass * (1.0 + strain);  // so that the stretched string weighs 1 kg/m
    p.unstretched_length = length / (1.0 + strain);
    p.segment_length = p.gauge_length = spacing(GetParam(), dx);
    // Half a cell off the grid's lines.
    const Vec2 from(0.37 * dx, 0.21 * dx), to = from + Vec2(length, 0.0);
    Sheet sheet({ { from, to }, false }, p);
    const std::size_t n = sheet.segments();
    for (std::size_t i = 0; i <= n; ++i)
      sheet.nodes().velocity[1][i] = 0.02 * std::sin(pi * static_cast<double>(i) / static_cast<double>(n));
    Scene scene{ std::move(sheet),
                 mpm::Grid<2>({ -10.0 * dx, -10.0 * dx }, { length + 10.0 * dx, 10.0 * dx }, dx,
                              mpm::testing::free_faces<2>()),
                 { 0, n } };
    const Swing at = swing(scene, dx / std::sqrt(p.stiffness / mass),
                           [&](const Sheet& now) { return now.node(n / 2)[1] - from[1]; });
    EXPECT_NEAR(at.frequency / (std::sqrt(p.stiffness * strain / mass) / (2.0 * length)), 1.0, bound) << cells;
    EXPECT_NEAR(at.left, 1.0, bound) << cells;
    bound /= GetParam() == Formulation::segments ? 4.0 : 3.0;
  }
}

/// A mass of 50 kg/m at the lower end of a light sheet of 1 m, hanging from its upper end (York et al. 1999).
Scene weight_on_a_sheet(Formulation formulation, double stretch, double dx)
{
  SheetParameters p;
  p.formulation = formulation;
  p.stiffness = 1e4;
  p.mass = p.computational_mass = 0.05;
  p.unstretched_length = 1.0 / stretch;
  p.segment_length = p.gauge_length = spacing(formulation, dx);
  const Vec2 from(0.3 * dx, 0.4 * dx);
  Sheet sheet({ { from, from + Vec2(0.0, -1.0) }, false }, p);
  sheet.nodes().mass.back() = sheet.nodes().weight_mass.back() = 50.0;
  return { std::move(sheet), mpm::Grid<2>({ -0.5, -1.5 }, { 0.5, 0.5 }, dx, mpm::testing::free_faces<2>()), { 0 } };
}

TEST_P(EitherFormulation, MassOnASheetIsASpring)
{
  // Taut at 2 % by its weight; thrown down, it swings by 1 %. f = sqrt(J / (L0 m)) / (2 pi). Mass and anchor are as
  // wide as a spline, which shortens the spring: first order in dx.
  const double strain = 0.02;
  for (const double dx : { 0.1, 0.05 }) {
    Scene scene = weight_on_a_sheet(GetParam(), 1.0 + strain, dx);
    scene.gravity = { 0.0, -1e4 * strain / 50.0 };
    const double omega = std::sqrt(1e4 * (1.0 + strain) / 50.0);
    scene.sheet.nodes().velocity[1].back() = 0.01 * omega;
    const double start = scene.sheet.node(scene.sheet.segments())[1];
    const Swing at = swing(scene, 0.3 * dx / std::sqrt(1e4 / 0.05),
                           [&](const Sheet& now) { return now.node(now.segments())[1] - start; });
    EXPECT_NEAR(at.frequency * 2.0 * pi / omega, 1.0, 0.6 * dx) << dx;
    EXPECT_NEAR(at.left, 1.0, 0.03) << dx;
  }
}

TEST_P(EitherFormulation, MassOnASheetIsAPendulum)
{
  // f = sqrt(g / L) / (2 pi) for a swing of 0.03 rad; the width of mass and anchor as above.
  const double strain = 0.02, g = 1e4 * strain / 50.0, omega = std::sqrt(g);
  for (const double dx : { 0.1, 0.05 }) {
    Scene scene = weight_on_a_sheet(GetParam(), 1.0 + strain, dx);
    scene.gravity = { 0.0, -g };
    const std::size_t last = scene.sheet.segments();
    for (std::size_t i = 0; i <= last; ++i)
      scene.sheet.nodes().velocity[0][i] = 0.03 * omega * static_cast<double>(i) / static_cast<double>(last);
    const double start = scene.sheet.node(last)[0];
    const Swing at =
        swing(scene, 0.3 * dx / std::sqrt(1e4 / 0.05), [&](const Sheet& now) { return now.node(last)[0] - start; });
    EXPECT_NEAR(at.frequency * 2.0 * pi / omega, 1.0, 0.6 * dx) << dx;
    EXPECT_NEAR(at.left, 1.0, 0.05) << dx;
  }
}

}  // namespace
}  // namespace geocontainer_mpm::geotextile::testing
