// The sheet in space against the sheet in plane strain, and under pressure against the closed form; and its bound on
// the time step.

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>

#include "fixture.h"
#include "geocontainer_mpm/geotextile/membrane.h"
#include "geocontainer_mpm/geotextile/sheet.h"
#include "geocontainer_mpm/mpm/reach.h"

namespace geocontainer_mpm::geotextile::testing {
namespace {

constexpr double stiffness = 1e5;

SheetLayout circle(double radius, int corners = 2880)
{
  SheetLayout outline;
  outline.closed = true;
  for (int k = 0; k < corners; ++k)
    outline.points.emplace_back(radius * std::cos(2.0 * pi * k / corners), radius * std::sin(2.0 * pi * k / corners));
  return outline;
}

MembraneParameters parameters()
{
  MembraneParameters p;
  p.warp_stiffness = p.weft_stiffness = stiffness;
  p.mass = p.computational_mass = 1.0;
  p.gauge_length = 0.3;
  return p;
}

/// One explicit step of nodes on their own, held where `held` says so, with gravity and some damping.
template <int Dim>
void step(double dt, const std::vector<bool>& held, mpm::Particles<Dim>& nodes)
{
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (held[i])
      continue;
    for (std::size_t d = 0; d < Dim; ++d) {
      nodes.velocity[d][i] = 0.998 * (nodes.velocity[d][i] + dt * nodes.force[d][i] / nodes.mass[i]);
      nodes.position[d][i] += dt * nodes.velocity[d][i];
    }
    nodes.velocity[Dim - 1][i] -= dt * 9.81;
  }
}

/// The same sheet in plane strain and half a metre wide, laid between two points with 10 % of slack and a fuller half.
struct Strips {
  SheetLayout line{ { { 0.0, 0.0 }, { 1.0, 0.5 }, { 2.0, 0.4 } }, false, { 1.0, 1.2 } };
  Sheet sheet;
  Membrane membrane;
  std::size_t n, rows;

  Strips()
      : sheet(line, in_plane(1.1 * line.cloth_length()))
      , membrane(wrap(line, { 0.0, 0.5 }, {}, 0.1, { 1.1, 1.0, 1.0 }), parameters())
      , n(sheet.nodes().size())
      , rows(membrane.nodes().size() / n)
  {
  }
  static SheetParameters in_plane(double length)
  {
    SheetParameters p;
    p.unstretched_length = length;
    p.stiffness = stiffness;
    p.mass = p.computational_mass = 1.0;
    p.segment_length = p.gauge_length = 0.1;
    return p;
  }
  /// Largest difference of the tensions of triangles from those of their segments.
  double tensions_apart() const
  {
    double apart = 0.0;
    for (std::size_t t = 0; t < membrane.triangles().size(); ++t)
      apart = std::max(apart, std::abs(membrane.warp_tension()[t] - sheet.tension()[t / 2 % sheet.segments()]));
    return apart;
  }
};

TEST(MembraneEquilibrium, AStripPullsAsTheSheetInPlaneStrainWhateverItsShape)
{
  Strips s;
  ASSERT_EQ(s.rows * s.n, s.membrane.nodes().size());
  Chance chance(1);
  for (int k = 0; k < 100; ++k) {
    for (std::size_t i = 0; i < s.n; ++i) {
      const Vec2 x = s.sheet.node(i) + chance.vector<2>(0.05);
      set_vector<2>(s.sheet.nodes().position, i, x);
      for (std::size_t j = 0; j < s.rows; ++j)
        set_vector<3>(s.membrane.nodes().position, j * s.n + i, Vec3(0.1 * static_cast<double>(j), x[0], x[1]));
    }
    s.sheet.update_forces();
    s.membrane.update_forces();
    ASSERT_LT(s.tensions_apart(), 1e-12 * stiffness);
    for (std::size_t i = 0; i < s.membrane.nodes().size(); ++i) {
      const double width = i < s.n || i >= (s.rows - 1) * s.n ? 0.05 : 0.1;
      const Vec3 force = vector_at<3>(s.membrane.nodes().force, i);
      ASSERT_LT((force.tail<2>() - width * vector_at<2>(s.sheet.nodes().force, i % s.n)).norm(), 1e-12 * stiffness);
      ASSERT_LT(std::abs(force[0]), 1e-12 * stiffness);  // unstretched along x but for round-off
      ASSERT_NEAR(s.membrane.nodes().mass[i], width * s.sheet.nodes().mass[i % s.n], 1e-14);
    }
  }
}

TEST(MembraneEquilibrium, AStripHangsAsTheSheetInPlaneStrain)
{
  Strips s;
  std::vector<bool> held(s.membrane.nodes().size(), false);
  for (std::size_t j = 0; j < s.rows; ++j)
    held[j * s.n] = held[j * s.n + s.n - 1] = true;
  const double dt = 0.5 * 0.1 / std::sqrt(stiffness);
  // Until it hangs at rest: on the way there from slack round-off grows.
  for (int k = 0; k < 30000; ++k) {
    s.sheet.update_forces();
    s.membrane.update_forces();
    step<2>(dt, held, s.sheet.nodes());
    step<3>(dt, held, s.membrane.nodes());
  }
  EXPECT_GT(s.sheet.tension()[0], 1.0);
  EXPECT_LT(s.tensions_apart(), 1e-9 * stiffness);
  for (std::size_t i = 0; i < s.membrane.nodes().size(); ++i)
    EXPECT_LT((s.membrane.node(i).tail<2>() - s.sheet.node(i % s.n)).norm(), 1e-9);
}

/// Masses with which a time step of 1 is stable: half of the largest sum of a row of the stiffness (Gershgorin; the
/// dynamic relaxation of Underwood 1983).
std::vector<double> relaxation_masses(const TriangleMesh& mesh)
{
  std::vector<double> mass(mesh.points.size(), 0.0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle& nodes = mesh.triangles[t];
    std::array<double, 3> across;  // |grad N_k|
    for (std::size_t k = 0; k < 3; ++k)
      across[k] = 0.5 * (mesh.points[nodes[(k + 1) % 3]] - mesh.points[nodes[(k + 2) % 3]]).norm() / mesh.area(t);
    for (std::size_t k = 0; k < 3; ++k)
      mass[nodes[k]] += stiffness * mesh.area(t) * across[k] * (across[0] + across[1] + across[2]);
  }
  return mass;
}

/// Explicit steps, from rest again whenever the kinetic energy falls, until the largest force is small.
double relax(const MembraneLoad& load, const std::vector<double>& mass, double small, int most_steps,
             Membrane& membrane)
{
  mpm::Particles<3>& nodes = membrane.nodes();
  double last = 0.0, largest = 0.0;
  for (int k = 0; k < most_steps; ++k) {
    membrane.update_forces(load);
    double kinetic = 0.0;
    largest = 0.0;
    for (std::size_t i = 0; i < nodes.size(); ++i)
      for (std::size_t d = 0; d < 3; ++d) {
        double& v = nodes.velocity[d][i];
        v += nodes.force[d][i] / mass[i];
        kinetic += mass[i] * v * v;
        largest = std::max(largest, std::abs(nodes.force[d][i]));
      }
    if (largest < small)
      break;
    if (kinetic < last) {
      for (mpm::Column& column : nodes.velocity)
        std::fill(column.begin(), column.end(), 0.0);
      kinetic = 0.0;
    }
    last = kinetic;
    for (std::size_t d = 0; d < 3; ++d)
      for (std::size_t i = 0; i < nodes.size(); ++i)
        nodes.position[d][i] += nodes.velocity[d][i];
  }
  return largest;
}

/// Of a long cylinder of unstretched radius R and unstretched widths: T_hoop = p R s_hoop s_axial, T_axial = p R
/// s_hoop^2 / 2 with the stretches s = 1 + T / J; for small strains p R and p R / 2.
struct Vessel {
  double hoop = 0.0, axial = 0.0;
};
Vessel closed_form(double pressure, double radius)
{
  Vessel v;
  for (int k = 0; k < 200; ++k)
    v = { pressure * radius * (1.0 + v.hoop / stiffness) * (1.0 + v.axial / stiffness),
          0.5 * pressure * radius * std::pow(1.0 + v.hoop / stiffness, 2) };
  return v;
}

/// Over the closed form, in the middle third of the wall: mean over the cloth, and the worst triangle's hoop tension.
/// Axial tension is only right in the mean: an end is a square net, which pulls at the wall by a fifth more or less
/// from place to place, and no shear evens that out.
struct Middle {
  double hoop = 0.0, axial = 0.0, worst_hoop = 0.0;
};
Middle middle_of(const TriangleMesh& mesh, const Membrane& membrane, double length, const Vessel& exact)
{
  Middle m;
  double cloth = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const double x = mesh.points[mesh.triangles[t][0]][0];
    if (mesh.panel[t] != Panel::wall || std::abs(x - 0.5 * length) > length / 6.0)
      continue;
    const double hoop = membrane.warp_tension()[t] / exact.hoop;
    cloth += mesh.area(t);
    m.hoop += mesh.area(t) * hoop;
    m.axial += mesh.area(t) * membrane.weft_tension()[t] / exact.axial;
    m.worst_hoop = std::max(m.worst_hoop, std::abs(hoop - 1.0));
  }
  m.hoop /= cloth;
  m.axial /= cloth;
  return m;
}

TEST(MembraneEquilibrium, APressureVesselHasItsHoopAndAxialTension)
{
  const double radius = 1.0, length = 6.0, pressure = 0.02 * stiffness;
  const Vessel exact = closed_form(pressure, radius);
  MembraneLoad load;
  load.pressure = pressure;
  double last_error = 1.0;
  for (const int around : { 12, 24, 48 }) {
    const double segment = 2.0 * pi * radius / around, at_rest = 1e-5 * pressure * segment * segment;
    const TriangleMesh mesh = wrap(circle(radius), { 0.0, length }, { true, true }, segment);
    Membrane membrane(mesh, parameters());
    EXPECT_LT(relax(load, relaxation_masses(mesh), at_rest, 20000, membrane), at_rest);
    const Middle m = middle_of(mesh, membrane, length, exact);
    RecordProperty("hoop_" + std::to_string(around), std::to_string(m.hoop));
    RecordProperty("axial_" + std::to_string(around), std::to_string(m.axial));
    RecordProperty("worst_hoop_" + std::to_string(around), std::to_string(m.worst_hoop));
    const double error = std::max(m.worst_hoop, std::abs(m.axial - 1.0));
    EXPECT_LT(error, 0.35 * last_error) << around;  // second order in the segment's length
    last_error = error;
  }
  EXPECT_LT(last_error, 0.003);
}

TEST(MembraneEquilibrium, OnTheGridItComesToRestThereAtTheStepOfItsBound)
{
  const double radius = 1.0, length = 3.0, segment = 2.0 * pi * radius / 24.0;
  const TriangleMesh mesh = wrap(circle(radius), { 0.0, length }, { true, true }, segment);
  Membrane membrane(mesh, parameters());
  mpm::Particles<3>& nodes = membrane.nodes();
  const Vec3 room(1.0, 1.4, 1.4);
  mpm::Grid<3> grid(-room, room + Vec3(length, 0.0, 0.0), segment, mpm::testing::free_faces<3>());
  MembraneLoad load;
  load.pressure = 0.02 * stiffness;
  mpm::FrequencyBound<3> bound;
  double last = 0.0;
  for (int k = 0; k < 400; ++k) {
    membrane.update_forces(load);
    mpm::testing::open(mpm::testing::everything(grid), grid);
    mpm::testing::sheet_to_grid<3>(nodes, Vec3::Zero(), grid);
    bound.begin(grid, {});
    bound.add_mass(nodes);
    membrane.add_stiffness(bound);
    const double dt = mpm::stable_step(bound.bound().frequency_square, 0.0, {});
    mpm::testing::apply_forces(grid, 0.5 * (last + dt), 30.0);
    mpm::grid_to_particles<3>({}, grid, dt, mpm::Gather::motion, nodes, 0, nodes.size());
    last = dt;
  }
  double kinetic = 0.0;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    kinetic += 0.5 * nodes.mass[i] * vector_at<3>(nodes.velocity, i).squaredNorm();
  EXPECT_LT(kinetic, 1e-2 * membrane.elastic_energy());  // 0.26 of it at first
  const Middle m = middle_of(mesh, membrane, length, closed_form(load.pressure, radius));
  RecordProperty("hoop", std::to_string(m.hoop));
  RecordProperty("axial", std::to_string(m.axial));
  // Off the grid the same mesh is 0.7 % below; cells as long as the segments smear the force over the wall's curve.
  EXPECT_NEAR(m.hoop, 1.0, 0.02);
  EXPECT_NEAR(m.axial, 1.0, 0.02);
}

/// Square of the largest frequency of the membrane's tangent stiffness on the nodal masses of the grid, 1/s^2.
double largest_square(const TriangleMesh& mesh, const Membrane& membrane, const mpm::Grid<3>& grid)
{
  std::vector<Eigen::Index> row(grid.size(), -1);
  Eigen::Index count = 0;
  mpm::testing::for_each_node(grid, [&](std::size_t i, const std::array<int, 3>&) {
    if (mpm::testing::node_mass(grid, i) > 0.0)
      row[i] = 3 * count++;
  });
  // A row of B is what a piece feels in one direction, scaled by 1 / sqrt(m).
  const auto pieces = static_cast<Eigen::Index>(2 * mesh.triangles.size());
  Eigen::MatrixXd b = Eigen::MatrixXd::Zero(3 * pieces, 3 * count);
  Eigen::Index at = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t f = 0; f < 2; ++f) {
      const Triangle& nodes = mesh.triangles[t];
      const double tension = (f == 0 ? membrane.warp_tension() : membrane.weft_tension())[t];
      const double cloth = mesh.area(t) * mesh.fullness[t][0] * mesh.fullness[t][1];
      const Vec3 normal =
          (mesh.points[nodes[1]] - mesh.points[nodes[0]]).cross(mesh.points[nodes[2]] - mesh.points[nodes[0]]);
      std::array<double, 3> c;
      Vec3 g = Vec3::Zero();
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 side = mesh.points[nodes[(k + 2) % 3]] - mesh.points[nodes[(k + 1) % 3]];
        c[k] =
            normal.cross(side).dot(f == 0 ? mesh.warp[t] : mesh.weft[t]) / normal.squaredNorm() / mesh.fullness[t][f];
        g += c[k] * membrane.node(nodes[k]);
      }
      // J along the yarns and T / lambda across them, of what is taut.
      const Vec3 along = g.normalized();
      const Mat<3> root = (tension > 0.0 ? std::sqrt(cloth * stiffness) : 0.0) * along * along.transpose() +
                          std::sqrt(cloth * tension / g.norm()) * (Mat<3>::Identity() - along * along.transpose());
      for (std::size_t k = 0; k < 3; ++k)
        mpm::testing::for_each_stencil_node<3>(
            grid, membrane.node(nodes[k]), [&](std::size_t i, double w, const Vec3&, const Vec3&) {
              if (row[i] >= 0)
                b.block<3, 3>(at, row[i]) += c[k] * w / std::sqrt(mpm::testing::node_mass(grid, i)) * root;
            });
      at += 3;
    }
  // B B^T and B^T B have the same largest eigenvalue; the smaller of the two.
  const Eigen::MatrixXd square =
      b.rows() < b.cols() ? Eigen::MatrixXd(b * b.transpose()) : Eigen::MatrixXd(b.transpose() * b);
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(square, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
}

TEST(MembraneBound, IsAboveItsLargestFrequencyAndCloseToIt)
{
  double least = 1e9, most = 0.0;
  EXPECT_TRUE(mpm::testing::holds("bound", [&](Chance& chance) {
    const double segment = chance(0.5, 0.8), dx = segment / chance(0.6, 1.3);
    const double full = chance(0.92, 1.0);
    const TriangleMesh mesh = wrap(circle(0.5, 12), { -0.4, chance(0.2, 0.5) }, { true, chance.whole(0, 1) == 0 },
                                   segment, { full, full, full });
    Membrane membrane(mesh, parameters());
    for (std::size_t i = 0; i < mesh.points.size(); ++i)
      set_vector<3>(membrane.nodes().position, i, mesh.points[i] + chance.vector<3>(0.05 * segment));
    membrane.update_forces();
    const double wide = dx * std::ceil(0.8 / dx);
    const Vec3 shift = chance.vector<3>(dx);
    mpm::Grid<3> grid(Vec3::Constant(-wide - dx) + shift, Vec3::Constant(wide + dx) + shift, dx,
                      mpm::testing::free_faces<3>());
    mpm::testing::open(mpm::testing::everything(grid), grid);
    mpm::testing::sheet_to_grid<3>(membrane.nodes(), Vec3::Zero(), grid);
    mpm::FrequencyBound<3> bound;
    bound.begin(grid, {});
    bound.add_mass(membrane.nodes());
    membrane.add_stiffness(bound);
    const double ratio = std::sqrt(bound.bound().frequency_square / largest_square(mesh, membrane, grid));
    least = std::min(least, ratio);
    most = std::max(most, ratio);
    RC_ASSERT(ratio >= 1.0 - 1e-9);  // round-off of the dense solve
    RC_ASSERT(ratio <= 2.2);         // 1.98 was the largest of 3000
  }));
  RecordProperty("least", std::to_string(least));
  RecordProperty("most", std::to_string(most));
}

}  // namespace
}  // namespace geocontainer_mpm::geotextile::testing
