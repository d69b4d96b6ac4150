// Loads on a sheet: inside pressure, end forces, and their power; and the open sheet.

#include <gtest/gtest.h>

#include <numeric>

#include "fixture.h"
#include "geocontainer_mpm/geotextile/sheet.h"

namespace geocontainer_mpm::geotextile::testing {
namespace {

constexpr double stiffness = 1e5;

SheetParameters parameters(double length, double segment)
{
  SheetParameters p;
  p.unstretched_length = length;
  p.stiffness = stiffness;
  p.mass = 0.84;
  p.computational_mass = 20.0;
  p.segment_length = segment;
  p.gauge_length = 3.0 * segment;
  return p;
}

std::vector<Vec2> regular(int corners, double radius, const Vec2& centre, bool with_the_clock = false)
{
  std::vector<Vec2> points;
  for (int k = 0; k < corners; ++k) {
    const double angle = (with_the_clock ? -2.0 : 2.0) * pi * k / corners;
    points.emplace_back(centre + radius * Vec2(std::cos(angle), std::sin(angle)));
  }
  return points;
}

/// A slack closed sheet of any form: what acts on it are its loads alone.
Sheet crumpled(Chance& chance)
{
  const int corners = chance.whole(3, 30);
  const double side = 2.0 * std::sin(pi / corners);
  Sheet sheet({ regular(corners, 1.0, chance.vector<2>(2.0), chance.whole(0, 1) == 0), true },
              parameters(corners * side * 3.0, side));
  for (std::size_t i = 0; i < sheet.nodes().size(); ++i)
    set_vector<2>(sheet.nodes().position, i, sheet.node(i) + chance.vector<2>(0.3 * side));
  return sheet;
}

SheetLoad random_load(Chance& chance)
{
  SheetLoad load;
  load.pressure = chance(-1e3, 1e4);
  load.gradient = chance(0.0, 2e4);
  load.level = chance(-3.0, 3.0);
  return load;
}

Vec2 total(const Sheet& sheet)
{
  Vec2 sum = Vec2::Zero();
  for (std::size_t i = 0; i < sheet.nodes().size(); ++i)
    sum += vector_at<2>(sheet.nodes().force, i);
  return sum;
}

double size_of_forces(const Sheet& sheet)
{
  double sum = 0.0;
  for (std::size_t i = 0; i < sheet.nodes().size(); ++i)
    sum += vector_at<2>(sheet.nodes().force, i).norm();
  return sum;
}

/// Integral of the pressure over the area inside, J/m, from the moments of the polygon; the sense of its nodes counts.
double pressure_energy(const Sheet& sheet, const SheetLoad& load)
{
  double area = 0.0, moment = 0.0;
  for (std::size_t i = 0; i < sheet.segments(); ++i) {
    const Vec2 a = sheet.node(i), b = sheet.node(sheet.end_of(i));
    const double cross = a[0] * b[1] - a[1] * b[0];
    area += cross / 2.0;
    moment += (a[1] + b[1]) * cross / 6.0;
  }
  return (load.pressure + load.gradient * *load.level) * area - load.gradient * moment;
}

double sense_of(const Sheet& sheet)
{
  SheetLoad unit;
  unit.pressure = 1.0;
  unit.level = 0.0;
  return pressure_energy(sheet, unit) > 0.0 ? 1.0 : -1.0;
}

TEST(SheetLoad, ConstantPressureHasNoResultantAndNoMoment)
{
  EXPECT_TRUE(holds("constant", [](Chance& chance) {
    Sheet sheet = crumpled(chance);
    SheetLoad load;
    load.pressure = chance(10.0, 1e4);
    RC_ASSERT(sheet.update_forces(load));
    const double size = size_of_forces(sheet);
    RC_ASSERT(total(sheet).norm() < 1e-12 * size);
    double moment = 0.0;
    for (std::size_t i = 0; i < sheet.nodes().size(); ++i) {
      const Vec2 force = vector_at<2>(sheet.nodes().force, i), x = sheet.node(i);
      moment += x[0] * force[1] - x[1] * force[0];
    }
    RC_ASSERT(std::abs(moment) < 1e-11 * size);
  }));
}

TEST(SheetLoad, AGradientHangsTheWeightOfWhatIsInside)
{
  EXPECT_TRUE(holds("gradient", [](Chance& chance) {
    Sheet sheet = crumpled(chance);
    SheetLoad load = random_load(chance);
    if (chance.whole(0, 1) == 0)
      load.level.reset();  // the highest node
    sheet.update_forces(load);
    RC_ASSERT(apart(total(sheet), Vec2(0.0, -load.gradient * sheet.enclosed_area())) < 1e-11 * size_of_forces(sheet));
  }));
}

TEST(SheetLoad, IsTheSlopeOfThePressureOverTheAreaInside)
{
  EXPECT_TRUE(holds("virtual work", [](Chance& chance) {
    Sheet sheet = crumpled(chance);
    const SheetLoad load = random_load(chance);
    const double sense = sense_of(sheet), h = 1e-4;
    sheet.update_forces(load);
    const mpm::Particles<2> at = sheet.nodes();
    const double size = 1.0 + size_of_forces(sheet);
    for (std::size_t i = 0; i < sheet.nodes().size(); ++i)
      for (std::size_t d = 0; d < 2; ++d) {
        double difference = 0.0;
        for (const double sign : { -1.0, 1.0 }) {
          sheet.nodes().position[d][i] = at.position[d][i] + sign * h;
          difference += sense * sign * pressure_energy(sheet, load);
        }
        sheet.nodes().position[d][i] = at.position[d][i];
        // A cubic: the central difference is off by h^2 times a third of the gradient at most.
        RC_ASSERT(std::abs(at.force[d][i] - 0.5 * difference / h) < 1e-9 * size + load.gradient * h * h);
      }
  }));
}

TEST(SheetLoad, CylinderUnderPressureIsInEquilibriumWithPTimesR)
{
  const double radius = 1.5, pressure = 2e3;
  for (const int corners : { 12, 48, 192 }) {
    // A regular polygon balances p times the radius of its inscribed circle exactly; T = p R in the limit.
    const double side = 2.0 * radius * std::sin(pi / corners), inner = radius * std::cos(pi / corners);
    const double strain = pressure * inner / stiffness;
    Sheet sheet({ regular(corners, radius, { 0.3, -0.2 }, corners == 48), true },
                parameters(corners * side / (1.0 + strain), side));
    SheetLoad load;
    load.pressure = pressure;
    sheet.update_forces(load);
    for (std::size_t i = 0; i < sheet.nodes().size(); ++i)
      EXPECT_LT(vector_at<2>(sheet.nodes().force, i).norm(), 1e-9 * pressure * side);
    EXPECT_NEAR(sheet.tension()[0], pressure * radius, pressure * radius * 0.5 * std::pow(pi / corners, 2) * 1.01);
  }
}

TEST(SheetLoad, PowerIsThatOfTheLoadsAlone)
{
  EXPECT_TRUE(holds("power", [](Chance& chance) {
    Sheet slack = crumpled(chance);
    const SheetLoad load = random_load(chance);
    slack.update_forces(load);
    double power = 0.0, size = 1.0;
    for (std::size_t i = 0; i < slack.nodes().size(); ++i) {
      const Vec2 v = chance.vector<2>(1.0);
      set_vector<2>(slack.nodes().velocity, i, v);
      power += vector_at<2>(slack.nodes().force, i).dot(v);
      size += vector_at<2>(slack.nodes().force, i).norm();
    }
    RC_ASSERT(std::abs(slack.external_power() - power) < 1e-12 * size);
    slack.update_forces();
    RC_ASSERT(slack.external_power() == 0.0);

    Sheet taut({ { { 0.0, 0.0 }, { 1.0, 0.0 } }, false }, parameters(0.9, 0.1));
    SheetLoad pull;
    pull.start_force = chance.vector<2>(10.0);
    pull.end_force = chance.vector<2>(10.0);
    taut.update_forces(pull);
    const Vec2 at_start = chance.vector<2>(1.0), at_end = chance.vector<2>(1.0);
    set_vector<2>(taut.nodes().velocity, 0, at_start);
    set_vector<2>(taut.nodes().velocity, taut.nodes().size() - 1, at_end);
    RC_ASSERT(std::abs(taut.external_power() - pull.start_force.dot(at_start) - pull.end_force.dot(at_end)) < 1e-12);
  }));
}

TEST(OpenSheet, IsLaidFromEndToEndWithItsMass)
{
  EXPECT_TRUE(holds("laying", [](Chance& chance) {
    std::vector<Vec2> line{ chance.vector<2>(3.0) };
    double laid = 0.0;
    for (int k = chance.whole(1, 6); k > 0; --k) {
      line.emplace_back(line.back() + Vec2(chance(0.2, 1.0), chance(-1.0, 1.0)));
      laid += (line[line.size() - 1] - line[line.size() - 2]).norm();
    }
    const SheetParameters p = parameters(chance(0.8, 1.2) * laid, chance(0.05, 0.4));
    const Sheet sheet({ line, false }, p);
    const std::size_t n = sheet.segments();
    RC_ASSERT(n == static_cast<std::size_t>(std::max(1.0, std::round(laid / p.segment_length))));
    RC_ASSERT(sheet.nodes().size() == n + 1);
    RC_ASSERT(!sheet.closed());
    RC_ASSERT(sheet.enclosed_area() == 0.0);
    RC_ASSERT(apart(sheet.node(0), line.front()) < 1e-15);
    RC_ASSERT(apart(sheet.node(n), line.back()) < 1e-12);
    RC_ASSERT(sheet.length() < laid * (1.0 + 1e-12));
    const auto sum = [](const mpm::Column& column) { return std::accumulate(column.begin(), column.end(), 0.0); };
    RC_ASSERT(std::abs(sum(sheet.nodes().mass) - p.computational_mass * p.unstretched_length) < 1e-9);
    RC_ASSERT(std::abs(sum(sheet.nodes().weight_mass) - p.mass * p.unstretched_length) < 1e-9);
    RC_ASSERT(sheet.nodes().mass.front() == sheet.nodes().mass.back());
    if (n > 1)
      RC_ASSERT(std::abs(2.0 * sheet.nodes().mass[0] - sheet.nodes().mass[1]) < 1e-12);
  }));
}

TEST(OpenSheet, PullsItsEndsTogetherAndNothingElse)
{
  const double strain = 0.02, tension = stiffness * strain;
  Sheet sheet({ { { -1.0, 0.5 }, { 2.0, 0.5 } }, false }, parameters(3.0 / (1.0 + strain), 0.1));
  EXPECT_TRUE(sheet.update_forces());
  const std::size_t n = sheet.segments();
  for (std::size_t i = 0; i <= n; ++i) {
    const double pull = i == 0 ? tension : i == n ? -tension : 0.0;
    EXPECT_LT(apart(vector_at<2>(sheet.nodes().force, i), Vec2(pull, 0.0)), 1e-8 * tension) << i;
  }
  EXPECT_NEAR(sheet.elastic_energy(), 0.5 * stiffness * strain * strain * 3.0 / (1.0 + strain), 1e-9 * tension);

  SheetLoad load;  // the reactions: all in balance
  load.start_force = { -tension, 0.0 };
  load.end_force = { tension, 0.0 };
  sheet.update_forces(load);
  EXPECT_LT(size_of_forces(sheet), 1e-7 * tension);

  Sheet slack({ { { -1.0, 0.5 }, { 2.0, 0.5 } }, false }, parameters(3.1, 0.1));
  EXPECT_FALSE(slack.update_forces());
  EXPECT_TRUE(slack.update_forces(load));
  EXPECT_EQ(total(slack), Vec2::Zero());
}

TEST(OpenSheet, GaugeStopsAtItsEnds)
{
  // Ten segments of which the k-th is strained by k per cent, a gauge of three.
  Sheet sheet({ { { 0.0, 0.0 }, { 1.0, 0.0 } }, false }, parameters(1.0, 0.1));
  double x = 0.0;
  for (std::size_t i = 0; i < 10; ++i) {
    x += 0.1 * (1.0 + 0.01 * static_cast<double>(i + 1));
    set_vector<2>(sheet.nodes().position, i + 1, { x, 0.0 });
  }
  sheet.update_forces();
  std::vector<double> gauge;
  sheet.gauge_tension(gauge);
  ASSERT_EQ(gauge.size(), 10U);
  for (std::size_t i = 0; i < 10; ++i) {
    const double strain = i == 0 ? 0.015 : i == 9 ? 0.095 : 0.01 * static_cast<double>(i + 1);
    EXPECT_NEAR(gauge[i], stiffness * strain, 1e-9 * stiffness) << i;
  }
}

TEST(OpenSheet, CountsWhatIsTautOrNearlySo)
{
  Sheet sheet({ { { 0.0, 0.0 }, { 1.0, 0.0 } }, false }, parameters(1.0, 0.25));
  set_vector<2>(sheet.nodes().position, 4, { 0.9, 0.0 });
  sheet.update_forces();
  EXPECT_EQ(sheet.active_pieces(), 3U);  // the last is 40 % too short
}

}  // namespace
}  // namespace geocontainer_mpm::geotextile::testing
