// The bound on the largest frequency against dense eigenvalues of the same particles, segments and nodal masses.

#include <gtest/gtest.h>

#include "dense_stiffness.h"

namespace geocontainer_mpm::mpm::testing {
namespace {

template <class D>
class FrequencyBoundOf : public ::testing::Test {
};
using Dimensions = ::testing::Types<Dimension<2>, Dimension<3>>;
TYPED_TEST_SUITE(FrequencyBoundOf, Dimensions);

TYPED_TEST(FrequencyBoundOf, OneParticleIsExactWhereverItIs)
{
  constexpr int Dim = TypeParam::Dim;
  for (const Shape shape : { Shape::bspline2, Shape::linear_simplex, Shape::gimp }) {
    const Loss loss = loss_of<Dim>(shape, { 1, 1 }, 60);
    EXPECT_GE(loss.least, 1.0 - round_off);
    // In space Newton's steps stop above the eigenvalue of one particle; in the plane it is exact.
    EXPECT_LE(loss.most, Dim == 2 ? 1.0 + round_off : 1.02);
  }
}

TYPED_TEST(FrequencyBoundOf, NeverBelowTheTruthAndCloseAbove)
{
  constexpr int Dim = TypeParam::Dim;
  struct Row {
    Cloud cloud;
    double most_bspline, most_simplex;  // what the header's table says, rounded up
  };
  std::vector<Row> rows;
  if (Dim == 2)
    rows = { { { 5, 1 }, 1.30, 1.30 },      { { 4, 2 }, 1.40, 1.35 },           { { 4, 4 }, 1.40, 1.35 },
             { { 4, 2, 0.3 }, 1.40, 1.50 }, { { 5, 2, 0.5, 0.5 }, 1.40, 1.50 }, { { 5, 2, 0.5, 0.9 }, 1.30, 1.50 } };
  else
    rows = { { { 2, 1 }, 1.40, 1.35 }, { { 2, 2, 0.3, 0.2 }, 1.45, 1.50 } };
  for (const Row& row : rows)
    for (const Shape shape : { Shape::bspline2, Shape::linear_simplex, Shape::gimp }) {
      const Loss loss = loss_of<Dim>(shape, row.cloud, Dim == 2 ? 9 : 2);
      SCOPED_TRACE(::testing::Message() << "shape " << static_cast<int>(shape) << ", " << row.cloud.side
                                        << " a side, jitter " << row.cloud.jitter << ", missing " << row.cloud.missing
                                        << ": mean " << loss.mean);
      EXPECT_GE(loss.least, 1.0 - round_off);
      EXPECT_LE(loss.most, shape == Shape::linear_simplex ? row.most_simplex : row.most_bspline);
    }
}

TYPED_TEST(FrequencyBoundOf, SheetsOfAnyStiffnessAndSegmentsOfAnyLength)
{
  constexpr int Dim = TypeParam::Dim;
  for (const Shape shape : { Shape::bspline2, Shape::linear_simplex, Shape::gimp })
    for (const double ratio : { 1.0, 1e2, 1e5 })
      for (const double length : { 0.2, 1.0, 4.0 }) {
        if (Dim == 3 && length > 2.0)
          continue;  // longer than the grid
        const Cloud cloud{ Dim == 2 ? 4 : 2, Dim == 2 ? 2 : 1, 0.3, 0.2, ratio, length };
        const Loss loss = loss_of<Dim>(shape, cloud, Dim == 2 ? 6 : 2);
        SCOPED_TRACE(::testing::Message() << "ratio " << ratio << ", length " << length << ": mean " << loss.mean);
        EXPECT_GE(loss.least, 1.0 - round_off);
        EXPECT_LE(loss.most, 1.6);
      }
}

TYPED_TEST(FrequencyBoundOf, ViscosityIsBoundedLikeStiffness)
{
  constexpr int Dim = TypeParam::Dim;
  for (int seed = 0; seed < (Dim == 2 ? 10 : 2); ++seed) {
    Chance chance(static_cast<std::uint64_t>(seed));
    Setting<Dim> setting = make_setting<Dim>(chance, Shape::bspline2, 0.3, { Dim == 2 ? 4 : 1, 2, 0.3 });
    const double viscosity = chance(1.0, 1e3);
    setting.viscous = { -2.0 / 3.0 * viscosity, viscosity };
    const double truth = largest_eigenvalue(scaled_matrix(setting, setting.viscous, false));
    const double ratio = bound_of(setting).damping_rate / truth;
    EXPECT_GE(ratio, 1.0 - round_off);
    EXPECT_LE(ratio, 2.0);  // 1.41 in a step that viscosity alone limits
  }
}

TEST(FrequencyBound, OfWhatParticlesHoldIsSafeAndFiniteForAnyNodalMass)
{
  Discretisation method;
  method.update = UpdateOrder::musl;
  method.transfer = Transfer::flip;
  const std::vector<Cloud> clouds = { { 1, 1 }, { 3, 1 }, { 3, 2, 0.3, 0.2 }, { 3, 2, 0.3, 0.2, 30.0, 1.0 } };
  for (const Shape shape : { Shape::bspline2, Shape::linear_simplex, Shape::gimp })
    for (const Cloud& cloud : clouds)
      for (int seed = 0; seed < 8; ++seed) {
        Chance chance(static_cast<std::uint64_t>(seed));
        const Setting<2> setting = make_setting<2>(chance, shape, 0.3, cloud);
        const Eigen::MatrixXd k = scaled_matrix(setting, setting.elastic, true), p = kept(setting, Transfer::flip);
        const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(k);
        const Eigen::MatrixXd root = solver.eigenvectors() *
                                     solver.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal() *
                                     solver.eigenvectors().transpose();
        const double truth = largest_eigenvalue(root * p * root), bound = bound_of(setting, method).frequency_square;
        EXPECT_GE(bound, truth * (1.0 - round_off));
        if (cloud.sheet_ratio > 0.0)
          continue;
        // No velocity gradient is larger than the difference of two particles' velocities over h, in either direction.
        const double h = setting.grid.dx();
        double volume_per_mass = 0.0;
        for (std::size_t q = 0; q < setting.particles.size(); ++q)
          volume_per_mass = std::max(volume_per_mass, setting.particles.volume[q] / setting.particles.mass[q]);
        EXPECT_LE(bound, 16.0 * setting.elastic.constrained() * volume_per_mass / (h * h));
      }
}

TEST(FrequencyBound, NothingOnTheGridHasNoFrequency)
{
  Chance chance(1);
  Grid<2> grid = random_grid<2>(chance, 4);
  open(everything(grid), grid);
  FrequencyBound<2> bound;
  bound.begin(grid, {});
  const auto result = bound.bound();
  EXPECT_EQ(result.frequency_square, 0.0);
  EXPECT_EQ(result.damping_rate, 0.0);
}

// Amid a cell a B-spline's outer nodes feel exactly nothing, while neighbours give them mass.
TEST(FrequencyBound, OfParticlesAmidTheirCellsIsSafe)
{
  for (const int side : { 1, 3 })
    for (const int rows : { 1, 3 }) {
      Setting<2> setting{ Shape::bspline2, Grid<2>(Vec2(0, 0), Vec2(2, 2), 0.25, free_faces<2>()), {}, {}, {}, {}, {} };
      setting.elastic = elastic_moduli(1e6, 0.2);
      const double spacing = 0.25 / side;
      open(everything(setting.grid), setting.grid);
      setting.particles.resize(static_cast<std::size_t>(4 * side * rows));
      for (std::size_t p = 0; p < setting.particles.size(); ++p) {
        const Vec2 x(0.5 + spacing * (static_cast<double>(p % static_cast<std::size_t>(4 * side)) + 0.5),
                     0.5 + spacing * (static_cast<double>(p / static_cast<std::size_t>(4 * side)) + 0.5));
        set_vector<2>(setting.particles.position, p, x);
        setting.particles.volume[p] = spacing * spacing;
        setting.particles.mass[p] = 2000.0 * spacing * spacing;
        add_mass<2>(setting.shape, setting.particles, p, setting.grid);
      }
      const double truth = largest_eigenvalue(scaled_matrix(setting, setting.elastic, false));
      const double ratio = std::sqrt(bound_of(setting).frequency_square / truth);
      EXPECT_GE(ratio, 1.0 - round_off) << side << " a cell, " << rows << " rows";
      EXPECT_LE(ratio, 1.4);
    }
}

TEST(FrequencyBound, IsTheSameWhenAskedAgain)
{
  Chance chance(9);
  const Setting<2> setting = make_setting<2>(chance, Shape::bspline2, 0.3, { 5, 2, 0.5, 0.3, 100.0, 0.7 });
  FrequencyBound<2> bound;
  double first = 0.0;
  for (int k = 0; k < 3; ++k) {
    bound.begin(setting.grid, {});
    bound.add_body(setting.particles, setting.elastic);
    for (const Segment<2>& s : setting.segments)
      bound.add_segment(s.a, s.b, s.stiffness);
    const double value = bound.bound().frequency_square;
    EXPECT_EQ(value, k == 0 ? value : first);
    first = value;
  }
}

}  // namespace
}  // namespace geocontainer_mpm::mpm::testing
