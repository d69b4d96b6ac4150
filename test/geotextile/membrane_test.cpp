// The sheet in space: its law, forces, energy, mass and loads, on crumpled and on regular meshes.

#include "geocontainer_mpm/geotextile/membrane.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>

#include "fixture.h"
#include "geocontainer_mpm/error.h"

namespace geocontainer_mpm::geotextile::testing {
namespace {

MembraneParameters parameters()
{
  MembraneParameters p;
  p.warp_stiffness = 1.1e6;
  p.weft_stiffness = 0.4e6;
  p.mass = 0.84;
  p.computational_mass = 20.0;
  p.gauge_length = 0.5;
  return p;
}

SheetLayout polygon(int corners, double radius)
{
  SheetLayout outline;
  outline.closed = true;
  for (int k = 0; k < corners; ++k)
    outline.points.emplace_back(radius * std::cos(2.0 * pi * k / corners), radius * std::sin(2.0 * pi * k / corners));
  return outline;
}

constexpr double spacing = 0.4;

TriangleMesh container(Chance& chance)
{
  const Fullness fullness{ chance(0.9, 1.1), chance(0.9, 1.1), chance(0.9, 1.1) };
  return wrap(polygon(chance.whole(5, 12), 1.0), { -1.0, chance(-0.2, 1.0) }, { true, true }, spacing, fullness);
}

/// One triangle with yarns in any directions.
TriangleMesh single(Chance& chance)
{
  TriangleMesh mesh;
  Vec3 along;
  do {
    mesh.points = { chance.vector<3>(1.0), chance.vector<3>(1.0), chance.vector<3>(1.0) };
    mesh.triangles = { { 0, 1, 2 } };
    along = mesh.points[1] - mesh.points[0];
  } while (mesh.area(0) < 0.05);
  const Vec3 normal = along.cross(mesh.points[2] - mesh.points[0]).normalized();
  for (std::vector<Vec3>* yarns : { &mesh.warp, &mesh.weft })
    yarns->emplace_back(Eigen::AngleAxisd(chance(0.0, 2.0 * pi), normal) * along.normalized());
  mesh.fullness = { { chance(0.9, 1.1), chance(0.9, 1.1) } };
  return mesh;
}

void crumple(Chance& chance, double size, Membrane& membrane)
{
  for (std::size_t i = 0; i < membrane.nodes().size(); ++i) {
    set_vector<3>(membrane.nodes().position, i, membrane.node(i) + chance.vector<3>(size));
    set_vector<3>(membrane.nodes().velocity, i, chance.vector<3>(1.0));
  }
}

Membrane crumpled(Chance& chance)
{
  Membrane membrane(chance.whole(0, 1) == 0 ? single(chance) : container(chance), parameters());
  crumple(chance, 0.3 * spacing, membrane);
  membrane.update_forces();
  return membrane;
}

double largest(const std::vector<double>& values)
{
  return *std::max_element(values.begin(), values.end());
}

TEST(Membrane, ARigidMotionCostsNothing)
{
  EXPECT_TRUE(holds("rigid", [](Chance& chance) {
    const TriangleMesh mesh =
        chance.whole(0, 1) == 0 ? single(chance) : wrap(polygon(9, 1.0), { 0.0, 1.0 }, { true, true }, spacing);
    TriangleMesh laid = mesh;
    laid.fullness.clear();
    Membrane membrane(laid, parameters());
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(chance(0.0, 6.0), chance.vector<3>(1.0).normalized()).toRotationMatrix();
    const Vec3 shift = chance.vector<3>(10.0);
    for (std::size_t i = 0; i < membrane.nodes().size(); ++i)
      set_vector<3>(membrane.nodes().position, i, turn * membrane.node(i) + shift);
    membrane.update_forces();
    RC_ASSERT(membrane.largest_strain() < 1e-13);  // round-off of positions of 10 m
    RC_ASSERT(membrane.elastic_energy() < 1e-18);
    for (const mpm::Column& column : membrane.nodes().force)
      for (const double force : column)
        RC_ASSERT(std::abs(force) < 1e-13 * 1e7);
  }));
}

TEST(Membrane, AnyEvenStretchAndShearIsThatOfItsYarns)
{
  EXPECT_TRUE(holds("affine", [](Chance& chance) {
    const TriangleMesh mesh = chance.whole(0, 1) == 0 ? single(chance) : container(chance);
    Membrane membrane(mesh, parameters());
    const Mat<3> gradient = Mat<3>::Identity() + chance.matrix<3>(0.2);
    for (std::size_t i = 0; i < membrane.nodes().size(); ++i)
      set_vector<3>(membrane.nodes().position, i, gradient * membrane.node(i));
    membrane.update_forces();
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const double warp = 1.1e6 * ((gradient * mesh.warp[t]).norm() / mesh.fullness[t][0] - 1.0);
      const double weft = 0.4e6 * ((gradient * mesh.weft[t]).norm() / mesh.fullness[t][1] - 1.0);
      RC_ASSERT(std::abs(membrane.warp_tension()[t] - std::max(0.0, warp)) < 1e-12 * 1.1e6);
      RC_ASSERT(std::abs(membrane.weft_tension()[t] - std::max(0.0, weft)) < 1e-12 * 1.1e6);
      RC_ASSERT(membrane.tension()[t] == std::max(membrane.warp_tension()[t], membrane.weft_tension()[t]));
    }
  }));
}

TEST(Membrane, ForcesSumToZeroWithoutAMoment)
{
  EXPECT_TRUE(holds("resultants", [](Chance& chance) {
    const Membrane membrane = crumpled(chance);
    Vec3 sum = Vec3::Zero(), moment = Vec3::Zero();
    double size = 1e-300;
    for (std::size_t i = 0; i < membrane.nodes().size(); ++i) {
      const Vec3 force = vector_at<3>(membrane.nodes().force, i);
      sum += force;
      moment += membrane.node(i).cross(force);
      size += force.norm();
    }
    RC_ASSERT(sum.norm() < 1e-12 * size);
    RC_ASSERT(moment.norm() < 1e-12 * size);
  }));
}

TEST(Membrane, ForcesAreTheSlopeOfItsEnergy)
{
  EXPECT_TRUE(holds("energy", [](Chance& chance) {
    Membrane membrane = crumpled(chance);
    const mpm::Particles<3> at = membrane.nodes();
    const double power = membrane.tension_power(), h = 1e-6;
    const double tension = std::max(1.1e3, largest(membrane.tension()));
    double rate = 0.0;
    for (std::size_t i = 0; i < at.size(); ++i)
      for (std::size_t d = 0; d < 3; ++d) {
        double difference = 0.0;
        for (const double sign : { -1.0, 1.0 }) {
          membrane.nodes().position[d][i] = at.position[d][i] + sign * h;
          membrane.update_forces();
          difference += sign * membrane.elastic_energy();
        }
        membrane.nodes().position[d][i] = at.position[d][i];
        const double slope = 0.5 * difference / h;
        // The energy's curvature jumps where yarns fall slack: J times h at most for each, in some ten triangles.
        RC_ASSERT(std::abs(at.force[d][i] + slope) < 1e-5 * tension + 20.0 * 1.1e6 * h);
        rate -= at.force[d][i] * at.velocity[d][i];
      }
    RC_ASSERT(std::abs(rate - power) < 1e-10 * (1.0 + std::abs(power)));
  }));
}

TEST(Membrane, PullsAStripAlongItsYarnsAlone)
{
  // 2 m along x, 1 m around: flat in y.
  const SheetLayout line{ { { 0.0, 0.0 }, { 1.0, 0.0 } }, false };
  const double strain = 0.03;
  for (const bool along_weft : { false, true }) {
    Membrane strip(wrap(line, { 0.0, 2.0 }, {}, 0.25), parameters());
    const std::size_t d = along_weft ? 0 : 1;
    for (double& x : strip.nodes().position[d])
      x *= 1.0 + strain;
    for (double& across : strip.nodes().position[1 - d])
      across *= 0.7;  // it may narrow as it likes
    ASSERT_TRUE(strip.update_forces());
    const double j = along_weft ? 0.4e6 : 1.1e6, width = along_weft ? 1.0 : 2.0;
    const std::vector<double>&pulled = along_weft ? strip.weft_tension() : strip.warp_tension(),
          &slack = along_weft ? strip.warp_tension() : strip.weft_tension();
    for (std::size_t t = 0; t < pulled.size(); ++t) {
      EXPECT_NEAR(pulled[t], j * strain, 1e-9 * j);
      EXPECT_EQ(slack[t], 0.0);
    }
    double end_force = 0.0;
    const double end = (1.0 + strain) * (along_weft ? 2.0 : 1.0);
    for (std::size_t i = 0; i < strip.nodes().size(); ++i)
      if (strip.nodes().position[d][i] > end - 1e-9)
        end_force += strip.nodes().force[d][i];
    EXPECT_NEAR(end_force, -j * strain * width, 1e-9 * j);  // tension is per unstretched width
    EXPECT_NEAR(strip.elastic_energy(), 0.5 * j * strain * strain * 2.0, 1e-9 * j);
    EXPECT_NEAR(strip.largest_strain(), strain, 1e-12);
    EXPECT_NEAR(strip.area(), 2.0 * (1.0 + strain) * 0.7, 1e-12);
    EXPECT_EQ(2 * strip.active_pieces(), 2 * strip.triangles().size());  // one family of two
  }
}

TEST(Membrane, FollowsATableInEachDirection)
{
  MembraneParameters p = parameters();
  p.warp_force_strain = { { 0.0, 0.0 }, { 0.05, 30e3 }, { 0.15, 120e3 } };
  p.weft_force_strain = { { 0.0, 0.0 }, { 0.11, 110e3 } };
  const SheetLayout line{ { { 0.0, 0.0 }, { 1.0, 0.0 } }, false };
  Membrane strip(wrap(line, { 0.0, 2.0 }, {}, 0.25), p);
  for (std::size_t d : { 0, 1 })
    for (double& x : strip.nodes().position[d])
      x *= 1.1;
  strip.update_forces();
  EXPECT_NEAR(strip.warp_tension()[3], 75e3, 1e-6);
  EXPECT_NEAR(strip.weft_tension()[3], 100e3, 1e-6);
  EXPECT_NEAR(strip.elastic_energy(), 2.0 * (0.5 * 30e3 * 0.05 + 52.5e3 * 0.05 + 0.5 * 100e3 * 0.1), 1e-6);
}

TEST(Membrane, CarriesNothingWhileSlack)
{
  Membrane slack(wrap(polygon(20, 1.0), { 0.0, 2.0 }, { true, true }, spacing, { 1.02, 1.02, 1.02 }), parameters());
  EXPECT_FALSE(slack.update_forces());
  for (const mpm::Column& column : slack.nodes().force)
    EXPECT_EQ(column, mpm::Column(slack.nodes().size(), 0.0));
  EXPECT_EQ(largest(slack.tension()), 0.0);
  EXPECT_EQ(slack.elastic_energy(), 0.0);
  EXPECT_EQ(slack.largest_strain(), 0.0);
  EXPECT_EQ(slack.active_pieces(), 0U);
}

TEST(Membrane, HasTheMassOfItsClothEvenlyOnARegularMesh)
{
  const Fullness fullness{ 1.2, 1.1, 1.0 };
  const Membrane open(wrap(polygon(24, 1.0), { 0.0, 2.0 }, {}, 0.25, fullness), parameters());
  const double side = 2.0 * std::sin(pi / 24.0), cloth = 24.0 * side * 2.0 * 1.2 * 1.1;
  const auto sum = [](const mpm::Column& column) { return std::accumulate(column.begin(), column.end(), 0.0); };
  EXPECT_NEAR(sum(open.nodes().mass), 20.0 * cloth, 1e-10);
  EXPECT_NEAR(sum(open.nodes().weight_mass), 0.84 * cloth, 1e-10);
  const double inner = 20.0 * cloth / 25.0 / 8.0;  // 25 around, corners cut; 8 rows
  for (std::size_t i = 0; i < open.nodes().size(); ++i) {
    const bool at_end = i < 25 || i >= 25 * 8;
    EXPECT_NEAR(open.nodes().mass[i], at_end ? 0.5 * inner : inner, 0.02 * inner) << i;
  }
}

/// Integral of the pressure over the volume inside, J: the flux of (0, 0, P(z)), P' = p.
double pressure_energy(const Membrane& membrane, const MembraneLoad& load)
{
  const auto potential = [&](double z) {
    return (load.pressure + load.gradient * *load.level) * z - 0.5 * load.gradient * z * z;
  };
  double energy = 0.0;
  for (const Triangle& t : membrane.triangles()) {
    const Vec3 a = membrane.node(t[0]), b = membrane.node(t[1]), c = membrane.node(t[2]);
    const double projected = 0.5 * (b - a).cross(c - a)[2];  // middles of sides are exact for a parabola
    for (const double z : { 0.5 * (a[2] + b[2]), 0.5 * (b[2] + c[2]), 0.5 * (c[2] + a[2]) })
      energy += projected * potential(z) / 3.0;
  }
  return energy;
}

TEST(Membrane, PressureIsTheSlopeOfItsWork)
{
  EXPECT_TRUE(holds("pressure", [](Chance& chance) {
    TriangleMesh mesh = container(chance);
    for (auto& full : mesh.fullness)
      full = { 3.0, 3.0 };  // slack: loads alone act
    Membrane membrane(mesh, parameters());
    crumple(chance, 0.3 * spacing, membrane);
    MembraneLoad load;
    load.pressure = chance(-1e3, 1e4);
    load.gradient = chance(0.0, 2e4);
    load.level = chance(-3.0, 3.0);
    RC_ASSERT(membrane.update_forces(load));
    const mpm::Particles<3> at = membrane.nodes();
    const double power = membrane.external_power(), h = 1e-5;
    double rate = 0.0;
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < at.size(); ++i)
      for (std::size_t d = 0; d < 3; ++d) {
        double difference = 0.0;
        for (const double sign : { -1.0, 1.0 }) {
          membrane.nodes().position[d][i] = at.position[d][i] + sign * h;
          difference += sign * pressure_energy(membrane, load);
        }
        membrane.nodes().position[d][i] = at.position[d][i];
        RC_ASSERT(std::abs(at.force[d][i] - 0.5 * difference / h) < 1e-4);
        rate += at.force[d][i] * at.velocity[d][i];
        sum[static_cast<Eigen::Index>(d)] += at.force[d][i];
      }
    RC_ASSERT(std::abs(power - rate) < 1e-9 * (1.0 + std::abs(rate)));
    RC_ASSERT(membrane.tension_power() == 0.0);
    // A gradient hangs the weight of what is inside; a constant pressure has no resultant.
    RC_ASSERT(apart(sum, Vec3(0.0, 0.0, -load.gradient * membrane.enclosed_volume())) < 1e-8);
  }));
}

TEST(Membrane, AnOpenSheetHasNoInside)
{
  TriangleMesh mesh = wrap(polygon(12, 1.0), { 0.0, 1.0 }, {}, spacing, { 1.1, 1.1, 1.0 });
  mesh.closed = false;
  Membrane open(mesh, parameters());
  MembraneLoad load;
  load.pressure = 1e3;
  EXPECT_FALSE(open.update_forces(load));
  EXPECT_EQ(open.enclosed_volume(), 0.0);
}

TEST(Membrane, BreaksOnceAndLosesWhatWasStored)
{
  MembraneParameters p = parameters();
  p.rupture_strain = 0.1;
  const SheetLayout line{ { { 0.0, 0.0 }, { 1.0, 0.0 } }, false };
  Membrane strip(wrap(line, { 0.0, 0.25 }, {}, 0.25), p);
  const auto stretch_last = [&](double strain) {  // the last quad around, in two triangles
    for (const std::size_t i : { 4, 9 })
      strip.nodes().position[1][i] = 0.75 + 0.25 * (1.0 + strain);
    strip.update_forces();
  };
  stretch_last(0.09);
  const double stored = strip.elastic_energy();
  EXPECT_EQ(strip.ruptures(), 0U);
  stretch_last(0.11);
  EXPECT_EQ(strip.ruptures(), 2U);
  EXPECT_EQ(strip.elastic_energy(), 0.0);
  EXPECT_NEAR(strip.rupture_energy(), stored + 0.5 * 1.1e6 * 0.09 * 0.02 * 0.0625, 1e-9);
  EXPECT_NEAR(strip.rupture_place()[1], 0.75 + 0.25 * 1.11 / 3.0, 1e-12);
  stretch_last(0.05);
  EXPECT_EQ(largest(strip.warp_tension()), 0.0);
  strip.nodes().position[0][9] = strip.nodes().position[0][8] = 0.26;  // its other yarns are whole
  strip.update_forces();
  EXPECT_GT(largest(strip.weft_tension()), 0.0);
  EXPECT_EQ(strip.ruptures(), 2U);
}

TEST(Membrane, GaugeIsAMeanOverItsLengthWithinAPanel)
{
  MembraneParameters p = parameters();
  p.gauge_length = 0.5;
  // Much wider than high: upper and lower sides are nearer than the gauge reaches.
  const SheetLayout flat{ { { 0.0, 0.0 }, { 2.0, 0.0 }, { 2.0, 0.1 }, { 0.0, 0.1 } }, true };
  const TriangleMesh mesh = wrap(flat, { 0.0, 2.0 }, { true, true }, 0.1);
  Membrane membrane(mesh, p);
  std::vector<double> warp, weft;
  for (std::size_t d = 0; d < 3; ++d)
    for (double& x : membrane.nodes().position[d])
      x *= 1.02;
  membrane.update_forces();
  membrane.gauge_tension(warp, weft);
  ASSERT_EQ(warp.size(), mesh.triangles.size());
  for (std::size_t t = 0; t < warp.size(); ++t) {
    EXPECT_NEAR(warp[t], 0.02 * 1.1e6, 1e-6);
    EXPECT_NEAR(weft[t], 0.02 * 0.4e6, 1e-6);
  }
  // One node of the lower side pulled down: what feels it is within the gauge of its triangles, and not above.
  const Vec3 place(1.0, 1.0, 0.0);
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
    set_vector<3>(membrane.nodes().position, i,
                  (mesh.points[i] - place).norm() < 1e-9 ? Vec3(1.0, 1.0, -0.05) : mesh.points[i]);
  membrane.update_forces();
  membrane.gauge_tension(warp, weft);
  // Half the gauge from the middle of a triangle's box, a sixth of a side off its own; triangles at the node reach a
  // side further.
  const double reach = 0.25 + 0.1 + 0.1 / 6.0 + 1e-9;
  double raw_sum = 0.0, mean_sum = 0.0;
  int touched = 0;
  for (std::size_t t = 0; t < warp.size(); ++t) {
    raw_sum += membrane.warp_tension()[t];
    mean_sum += warp[t];
    if (!(warp[t] > 1e-6))
      continue;
    ++touched;
    const auto& [a, b, c] = mesh.triangles[t];
    const Vec3 middle = (mesh.points[a] + mesh.points[b] + mesh.points[c]) / 3.0;
    EXPECT_LT((middle - place).lpNorm<Eigen::Infinity>(), reach);
    EXPECT_LT(middle[2], 1e-9);
  }
  EXPECT_GT(raw_sum, 0.0);
  EXPECT_NEAR(mean_sum, raw_sum, 0.03 * raw_sum);  // windows of triangles of two kinds differ a little in number
  const double reached = touched * 0.005;          // by the gauge's square around triangles at that node
  EXPECT_GT(reached, 0.5 * 0.5);
  EXPECT_LT(reached, 4.0 * reach * reach);
}

TEST(Membrane, RefusesATriangleWithoutArea)
{
  TriangleMesh mesh;
  mesh.points = { { 0.0, 0.0, 0.0 }, { 1.0, 0.0, 0.0 }, { 2.0, 0.0, 0.0 } };
  mesh.triangles = { { 0, 1, 2 } };
  mesh.warp = { Vec3::UnitX() };
  mesh.weft = { Vec3::UnitY() };
  EXPECT_THROW(Membrane(mesh, parameters()), InputError);
}

}  // namespace
}  // namespace geocontainer_mpm::geotextile::testing
