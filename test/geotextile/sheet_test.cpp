// The sheet: geometry, tension, forces, gauge length, and its bound on the time step.

#include "geocontainer_mpm/geotextile/sheet.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <numeric>

#include "fixture.h"

namespace geocontainer_mpm::geotextile::testing {
namespace {

constexpr double radius = 2.0;
constexpr double stiffness = 1.1e6;

std::vector<Vec2> regular(std::size_t corners)
{
  std::vector<Vec2> outline;
  for (std::size_t k = 0; k < corners; ++k) {
    const double angle = 2.0 * pi * static_cast<double>(k) / static_cast<double>(corners);
    outline.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return outline;
}

double side(std::size_t corners)
{
  return 2.0 * radius * std::sin(pi / static_cast<double>(corners));
}

/// Regular polygon with one segment a side, stretched by `strain` (slack if negative).
Sheet ring(std::size_t corners, double strain, double gauge_length = 0.0,
           Formulation formulation = Formulation::segments)
{
  SheetParameters p;
  p.formulation = formulation;
  p.segment_length = side(corners);
  p.unstretched_length = static_cast<double>(corners) * side(corners) / (1.0 + strain);
  p.stiffness = stiffness;
  p.mass = 0.84;
  p.computational_mass = 20.0;
  p.gauge_length = std::max(gauge_length, side(corners));
  return Sheet({ regular(corners), true }, p);
}

/// A ring whose nodes have been moved anyhow: some segments taut, some slack.
Sheet crumpled(Chance& chance)
{
  const auto corners = static_cast<std::size_t>(chance.whole(3, 40));
  Sheet sheet = ring(corners, chance(-0.2, 0.2));
  for (std::size_t i = 0; i < corners; ++i)
    set_vector<2>(sheet.nodes().position, i, sheet.node(i) + chance.vector<2>(0.3 * side(corners)));
  sheet.update_forces();
  return sheet;
}

TEST(Sheet, IsLaidEvenlyAroundItsOutlineWithItsMass)
{
  EXPECT_TRUE(holds("laying", [](Chance& chance) {
    // An outline whose corners have nothing to do with the segments.
    std::vector<Vec2> outline;
    const int corners = chance.whole(3, 12);
    for (int k = 0; k < corners; ++k) {
      const double angle = 2.0 * pi * (k + chance(0.0, 0.8)) / corners, r = chance(0.5, 3.0);
      outline.emplace_back(r * std::cos(angle), r * std::sin(angle));
    }
    SheetParameters p;
    p.segment_length = chance(0.05, 0.5);
    p.unstretched_length = chance(10.0, 30.0);
    p.stiffness = stiffness;
    p.mass = chance(0.2, 1.5);
    p.computational_mass = chance(2.0, 30.0);
    p.gauge_length = 0.5;
    const Sheet sheet({ outline, true }, p);
    double laid = 0.0;
    for (std::size_t k = 0; k < outline.size(); ++k)
      laid += (outline[(k + 1) % outline.size()] - outline[k]).norm();
    const std::size_t n = sheet.segments();
    RC_ASSERT(n == sheet.nodes().size());
    RC_ASSERT(n == static_cast<std::size_t>(std::max(3.0, std::round(laid / p.segment_length))));
    const double spacing = laid / static_cast<double>(n);
    for (std::size_t i = 0; i < n; ++i) {
      RC_ASSERT((sheet.node((i + 1) % n) - sheet.node(i)).norm() < spacing * (1.0 + 1e-9));  // a corner cuts short
      double distance = 1e9;
      for (std::size_t k = 0; k < outline.size(); ++k) {
        const Vec2 along = outline[(k + 1) % outline.size()] - outline[k], from = sheet.node(i) - outline[k];
        distance =
            std::min(distance, (from - std::clamp(from.dot(along) / along.squaredNorm(), 0.0, 1.0) * along).norm());
      }
      RC_ASSERT(distance < 1e-9);
    }
    const auto sum = [](const mpm::Column& column) { return std::accumulate(column.begin(), column.end(), 0.0); };
    RC_ASSERT(std::abs(sum(sheet.nodes().mass) - p.computational_mass * p.unstretched_length) < 1e-9);
    RC_ASSERT(std::abs(sum(sheet.nodes().weight_mass) - p.mass * p.unstretched_length) < 1e-9);
  }));
}

TEST(Sheet, CarriesNothingWhileSlack)
{
  Sheet sheet = ring(64, -0.01);
  EXPECT_FALSE(sheet.update_forces());
  for (const mpm::Column& column : sheet.nodes().force)
    EXPECT_EQ(column, mpm::Column(64, 0.0));
  EXPECT_EQ(sheet.tension(), std::vector<double>(64, 0.0));
  EXPECT_EQ(sheet.elastic_energy(), 0.0);
  EXPECT_EQ(sheet.largest_strain(), 0.0);
}

TEST(Sheet, LetsGoOfItsForcesWhenItFallsSlack)
{
  Sheet sheet = ring(16, 0.05);
  ASSERT_TRUE(sheet.update_forces());
  for (std::size_t i = 0; i < 16; ++i)
    set_vector<2>(sheet.nodes().position, i, 0.5 * sheet.node(i));
  EXPECT_FALSE(sheet.update_forces());
  for (const mpm::Column& column : sheet.nodes().force)
    EXPECT_EQ(column, mpm::Column(16, 0.0));
}

TEST(Sheet, TautCylinderPressesInwardsByTensionOverRadius)
{
  const double strain = 0.03, tension = stiffness * strain;
  double last_error = 1.0;
  for (const std::size_t n : { 16U, 64U, 256U }) {
    Sheet sheet = ring(n, strain);
    EXPECT_TRUE(sheet.update_forces());
    EXPECT_NEAR(sheet.largest_strain(), strain, 1e-12);
    double error = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      EXPECT_NEAR(sheet.tension()[i], tension, 1e-9 * tension);
      const Vec2 force = vector_at<2>(sheet.nodes().force, i), inwards = -sheet.node(i).normalized();
      EXPECT_NEAR(force.dot(inwards), 2.0 * tension * std::sin(pi / static_cast<double>(n)), 1e-9 * tension);
      EXPECT_NEAR(force.dot(Vec2(-inwards[1], inwards[0])), 0.0, 1e-9 * tension);
      const double arc = 2.0 * pi * radius / static_cast<double>(n);
      error = std::max(error, std::abs(force.dot(inwards) / arc / (tension / radius) - 1.0));
    }
    EXPECT_LT(error, 0.1 * last_error);  // second order in the segment's length
    last_error = error;
    EXPECT_NEAR(sheet.elastic_energy(),
                0.5 * stiffness * strain * strain * static_cast<double>(n) * side(n) / (1.0 + strain),
                1e-9 * sheet.elastic_energy());
  }
}

TEST(Sheet, ForcesSumToZeroWithoutAMoment)
{
  EXPECT_TRUE(holds("resultants", [](Chance& chance) {
    const Sheet sheet = crumpled(chance);
    Vec2 sum = Vec2::Zero();
    double moment = 0.0, size = 1e-300;
    for (std::size_t i = 0; i < sheet.segments(); ++i) {
      const Vec2 force = vector_at<2>(sheet.nodes().force, i), x = sheet.node(i);
      sum += force;
      moment += x[0] * force[1] - x[1] * force[0];
      size += force.norm();
    }
    RC_ASSERT(sum.norm() < 1e-12 * size);
    RC_ASSERT(std::abs(moment) < 1e-12 * size * radius);
  }));
}

TEST(Sheet, ForcesAreTheSlopeOfItsEnergy)
{
  EXPECT_TRUE(holds("energy", [](Chance& chance) {
    Sheet sheet = crumpled(chance);
    const mpm::Particles<2> at = sheet.nodes();
    const double h = 1e-6;
    double largest = stiffness * 1e-3;
    for (double tension : sheet.tension())
      largest = std::max(largest, tension);
    for (std::size_t i = 0; i < sheet.segments(); ++i)
      for (std::size_t d = 0; d < 2; ++d) {
        double difference = 0.0;
        for (const double sign : { -1.0, 1.0 }) {
          sheet.nodes().position[d][i] = at.position[d][i] + sign * h;
          sheet.update_forces();
          difference += sign * sheet.elastic_energy();
        }
        sheet.nodes().position[d][i] = at.position[d][i];
        // The energy's curvature jumps where a segment falls slack: an error of J / l0 times h at most.
        RC_ASSERT(std::abs(at.force[d][i] + 0.5 * difference / h) <
                  1e-5 * largest + 2.0 * stiffness / side(sheet.segments()) * h);
      }
  }));
}

TEST(Sheet, GaugeKeepsAConstantAndAveragesTheRest)
{
  std::vector<double> gauge;
  for (const double length : { 0.0, 0.5, 1.0, 5.0, 50.0 }) {
    Sheet even = ring(120, 0.02, length);
    even.update_forces();
    even.gauge_tension(gauge);
    ASSERT_EQ(gauge.size(), 120U);
    for (double tension : gauge)
      EXPECT_NEAR(tension, 0.02 * stiffness, 1e-6);

    // Every second node turned along the circle: long and short segments in turn.
    Sheet uneven = ring(120, 0.05, length);
    const double turn = 0.01 * 2.0 * pi / 120.0;
    for (std::size_t i = 0; i < 120; i += 2)
      set_vector<2>(uneven.nodes().position, i, uneven.node(i) + turn * Vec2(-uneven.node(i)[1], uneven.node(i)[0]));
    uneven.update_forces();
    uneven.gauge_tension(gauge);
    const double mean = std::accumulate(uneven.tension().begin(), uneven.tension().end(), 0.0) / 120.0;
    const double swing = std::abs(uneven.tension()[0] - mean);
    ASSERT_GT(swing, 1e-3 * mean);
    // Of an odd number of segments, one is left over when pairs cancel.
    const double segments = std::max(1.0, std::min(119.0, length / side(120) - 2.0));
    for (double tension : gauge)
      EXPECT_LE(std::abs(tension - mean), swing / segments * (1.0 + 1e-9));
    EXPECT_NEAR(std::accumulate(gauge.begin(), gauge.end(), 0.0) / 120.0, mean, 1e-9 * mean);
  }
}

TEST(Sheet, GaugeOfOnePeakIsAsWideAsTheGauge)
{
  const double length = 0.5;
  Sheet sheet = ring(120, -0.001, length);
  set_vector<2>(sheet.nodes().position, 7,
                sheet.node(7) + 0.02 * Vec2(-sheet.node(7)[1], sheet.node(7)[0]).normalized());
  sheet.update_forces();
  std::vector<double> gauge;
  ASSERT_EQ(std::count_if(sheet.tension().begin(), sheet.tension().end(), [](double t) { return t > 0.0; }), 1);
  sheet.gauge_tension(gauge);
  const auto wide = std::count_if(gauge.begin(), gauge.end(), [](double t) { return t > 0.0; });
  EXPECT_EQ(wide % 2, 1);
  EXPECT_NEAR(static_cast<double>(wide) * side(120), length, side(120));
}

TEST(Sheet, EnclosesTheAreaOfItsPolygonWhereverItIs)
{
  Sheet sheet = ring(50, 0.0);
  const double area = 0.5 * 50.0 * radius * radius * std::sin(2.0 * pi / 50.0);
  EXPECT_NEAR(sheet.enclosed_area(), area, 1e-12);
  for (std::size_t i = 0; i < 50; ++i)
    set_vector<2>(sheet.nodes().position, i, Vec2(-100.0, 30.0) - sheet.node(i));
  EXPECT_NEAR(sheet.enclosed_area(), area, 1e-9);
  for (std::size_t i = 0; i < 50; ++i) {
    const Vec2 x = sheet.node(i);
    set_vector<2>(sheet.nodes().position, i, Vec2(x[1], x[0]));  // the other sense
  }
  EXPECT_NEAR(sheet.enclosed_area(), area, 1e-9);
}

/// Square of the largest frequency of the sheet's tangent stiffness on the nodal masses of the grid, 1/s^2.
double largest_square(const Sheet& sheet, const mpm::Grid<2>& grid)
{
  std::vector<std::size_t> node;
  std::vector<Eigen::Index> row(grid.size(), -1);
  mpm::testing::for_each_node(grid, [&](std::size_t i, const std::array<int, 2>&) {
    if (mpm::testing::node_mass(grid, i) > 0.0) {
      row[i] = static_cast<Eigen::Index>(2 * node.size());
      node.push_back(i);
    }
  });
  // Irrelevant nodes are left out: a row of the matrix B is what one piece feels, scaled by 1 / sqrt(m).
  const auto n = static_cast<Eigen::Index>(sheet.segments());
  Eigen::MatrixXd along = Eigen::MatrixXd::Zero(2 * n, static_cast<Eigen::Index>(2 * node.size()));
  const double rest = sheet.nodes().mass[0] / 20.0;
  const auto add = [&](Eigen::Index at, double factor, const Vec2& point, const Vec2& direction, auto&& shape) {
    mpm::testing::for_each_stencil_node<2>(
        grid, point, [&](std::size_t i, double w, const Vec2&, const Vec2& gradient) {
          if (row[i] >= 0)
            for (Eigen::Index d = 0; d < 2; ++d)
              along(at, row[i] + d) +=
                  factor * shape(w, gradient) / std::sqrt(mpm::testing::node_mass(grid, i)) * direction[d];
        });
  };
  for (Eigen::Index s = 0; s < n; ++s) {
    const auto a = static_cast<std::size_t>(s), b = (a + 1) % sheet.segments();
    if (sheet.strains_with_grid()) {
      const Vec2 t = (sheet.node(b) - sheet.node((a + sheet.segments() - 1) % sheet.segments())).normalized();
      const double length = sheet.nodes().volume[a];
      add(s, sheet.tension()[a] > 0.0 ? std::sqrt(stiffness * length * length / rest) : 0.0, sheet.node(a), t,
          [&](double, const Vec2& gradient) { return t.dot(gradient); });
      continue;
    }
    const Vec2 chord = sheet.node(b) - sheet.node(a), t = chord.normalized(), across(-t[1], t[0]);
    const double axial = sheet.tension()[a] > 0.0 ? stiffness / rest : 0.0,
                 geometric = sheet.tension()[a] / chord.norm();
    for (const auto& [point, sign] : { std::pair(sheet.node(b), 1.0), std::pair(sheet.node(a), -1.0) }) {
      const auto weight = [](double w, const Vec2&) { return w; };
      add(2 * s, sign * std::sqrt(axial), point, t, weight);
      add(2 * s + 1, sign * std::sqrt(geometric), point, across, weight);
    }
  }
  // B M^-1 B^T has the frequencies of M^-1 B^T B and is the smaller of the two.
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(along * along.transpose(), Eigen::EigenvaluesOnly)
      .eigenvalues()
      .maxCoeff();
}

double bound_of(const Sheet& sheet, const mpm::Grid<2>& grid)
{
  mpm::FrequencyBound<2> bound;
  bound.begin(grid, {});
  bound.add_mass(sheet.nodes());
  sheet.add_stiffness(bound);
  return bound.bound().frequency_square;
}

class EitherSheet : public ::testing::TestWithParam<Formulation> {};
INSTANTIATE_TEST_SUITE_P(Formulation, EitherSheet,
                         ::testing::Values(Formulation::segments, Formulation::membrane_points));

TEST_P(EitherSheet, BoundsItsLargestFrequency)
{
  double least = 1e9, most = 0.0;
  for (int seed = 0; seed < 24; ++seed) {
    Chance chance(static_cast<std::uint64_t>(seed));
    const auto corners = static_cast<std::size_t>(chance.whole(12, 80));
    Sheet sheet = ring(corners, chance(0.005, 0.1), 0.0, GetParam());
    const double dx = side(corners) / chance(0.5, 1.3);  // segments of half a cell to somewhat more than one
    const double wide = dx * std::ceil(1.2 * radius / dx);
    const Vec2 shift = chance.vector<2>(dx);
    mpm::Grid<2> grid(Vec2::Constant(-wide) + shift, Vec2::Constant(wide) + shift, dx, mpm::testing::free_faces<2>());
    for (std::size_t i = 0; i < corners; ++i)
      set_vector<2>(sheet.nodes().position, i, sheet.node(i) + chance.vector<2>(1e-3 * side(corners)));
    sheet.update_forces();
    mpm::testing::open(mpm::testing::everything(grid), grid);
    mpm::sheet_to_grid<2>({}, sheet.nodes(), mpm::Part::all, Vec2::Zero(), grid);
    if (seed % 3 == 0) {  // and with sand about
      mpm::Particles<2> sand =
          mpm::testing::random_cloud<2>(chance, 500, Vec2::Constant(-0.7 * radius), Vec2::Constant(0.7 * radius));
      mpm::sheet_to_grid<2>({}, sand, mpm::Part::all, Vec2::Zero(), grid);
    }
    const double ratio = std::sqrt(bound_of(sheet, grid) / largest_square(sheet, grid));
    least = std::min(least, ratio);
    most = std::max(most, ratio);
  }
  EXPECT_GE(least, 1.0);
  EXPECT_LE(most, 2.0);
  RecordProperty("least", std::to_string(least));
  RecordProperty("most", std::to_string(most));
}

TEST_P(EitherSheet, BoundsNothingWhileSlackAndItsWholeStiffnessBeforeItTightens)
{
  mpm::Grid<2> grid(Vec2::Constant(-2.5), Vec2::Constant(2.5), 0.1, mpm::testing::free_faces<2>());
  const auto bound = [&](double strain) {
    Sheet sheet = ring(120, strain, 0.0, GetParam());
    sheet.update_forces();
    mpm::testing::open(mpm::testing::everything(grid), grid);
    mpm::sheet_to_grid<2>({}, sheet.nodes(), mpm::Part::all, Vec2::Zero(), grid);
    return bound_of(sheet, grid);
  };
  EXPECT_EQ(bound(-0.05), 0.0);
  // Stiffness over mass of a piece goes with (1 + strain)^2: J / l0 over l0, or J (1 + strain)^2 l0 over l0.
  EXPECT_NEAR(bound(-0.001) / bound(0.001), std::pow(0.999 / 1.001, 2), 1e-9);
}

}  // namespace
}  // namespace geocontainer_mpm::geotextile::testing
