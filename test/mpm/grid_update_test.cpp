// The momentum equation on the grid: what forces, damping and faces do to velocities, energy and momentum.

#include <gtest/gtest.h>

#include "geocontainer_mpm/mpm/grid_update.h"
#include "random_cloud.h"

namespace geocontainer_mpm::mpm::testing {
namespace {

template <class D>
class Update : public ::testing::Test {
};
using Dimensions = ::testing::Types<Dimension<2>, Dimension<3>>;
TYPED_TEST_SUITE(Update, Dimensions);

constexpr int cells = 5;
constexpr std::size_t count = 60;

template <int Dim>
double kinetic(const Grid<Dim>& grid, bool node_is_velocity)
{
  double sum = 0.0;
  for_each_node(grid, [&](std::size_t i, const std::array<int, Dim>&) {
    const double m = node_mass(grid, i);
    if (m > 0.0)
      sum += 0.5 * (node_is_velocity ? m : 1.0 / m) * node_vector(grid, i).squaredNorm();
  });
  return sum;
}

template <int Dim>
struct Momenta {
  Vec<Dim> momentum = Vec<Dim>::Zero(), force = Vec<Dim>::Zero();
};
template <int Dim>
Momenta<Dim> before_update(const Grid<Dim>& grid)
{
  Momenta<Dim> sum;
  for_each_node(grid, [&](std::size_t i, const std::array<int, Dim>&) {
    sum.momentum += node_vector(grid, i);
    sum.force += node_force(grid, i);
  });
  return sum;
}

TYPED_TEST(Update, BooksEnergyAndMomentumOfForcesAndDamping)
{
  constexpr int Dim = TypeParam::Dim;
  EXPECT_TRUE(holds("bookkeeping", [](Chance& chance) {
    Grid<Dim> undamped = random_grid<Dim>(chance, cells);
    Particles<Dim> particles = random_cloud(chance, count, undamped);
    scatter_body<Dim>(particles, chance.vector<Dim>(10.0), undamped);
    Grid<Dim> damped = undamped;
    const Momenta<Dim> before = before_update(undamped);
    const double kinetic_before = kinetic(undamped, false);
    const double kick = chance(1e-4, 1e-2), damping = chance(0.0, 1.5) / kick;

    const MotionSums<Dim> free = apply_forces(undamped, kick, 0.0);
    const double scale = 1.0 + kinetic_before + free.kinetic_after;
    RC_ASSERT(!free.touches_faces);
    RC_ASSERT(free.damped == 0.0);
    RC_ASSERT(std::abs(free.kinetic_before - kinetic_before) < 1e-12 * scale);
    RC_ASSERT(std::abs(free.kinetic_after - kinetic(undamped, true)) < 1e-12 * scale);
    RC_ASSERT(apart(free.momentum_before, before.momentum) < 1e-12 * scale);
    RC_ASSERT(apart(free.momentum_after, before.momentum + kick * before.force) < 1e-12 * scale);

    const double keep = std::max(0.0, 1.0 - damping * kick);
    const MotionSums<Dim> less = apply_forces(damped, kick, damping);
    RC_ASSERT(std::abs(less.kinetic_after + less.damped - free.kinetic_after) < 1e-12 * scale);
    RC_ASSERT(std::abs(less.kinetic_after - keep * keep * free.kinetic_after) < 1e-12 * scale);
    RC_ASSERT(apart(less.momentum_after, keep * free.momentum_after) < 1e-12 * scale);
    RC_ASSERT(std::abs(less.kinetic_after - kinetic(damped, true)) < 1e-12 * scale);
  }));
}

TYPED_TEST(Update, GivesTheSameBitsWithAnyNumberOfThreads)
{
  constexpr int Dim = TypeParam::Dim;
  EXPECT_TRUE(holds("threads", [](Chance& chance) {
    std::array<FaceCondition, 2 * Dim> faces;
    for (FaceCondition& face : faces)
      face = static_cast<FaceCondition>(chance.whole(0, 2));
    std::array<int, Dim> size;
    size.fill(cells);
    size[0] = chance.whole(1, 40);  // blocks of rows that threads share
    Grid<Dim> start = random_grid<Dim>(chance, size, faces);
    Particles<Dim> particles = random_cloud(chance, count, start);
    scatter_body<Dim>(particles, chance.vector<Dim>(10.0), start);
    Grid<Dim> one = start;
    const MotionSums<Dim> sums = apply_forces(one, 1e-3, 2.0);
    for (const int threads : { 2, 3 }) {
      Grid<Dim> grid = start;
      ThreadTeam team(threads);
      const MotionSums<Dim> again = GridUpdate<Dim>().apply_forces({}, grid, 1e-3, 2.0, team);
      RC_ASSERT(again.kinetic_before == sums.kinetic_before);
      RC_ASSERT(again.kinetic_after == sums.kinetic_after);
      RC_ASSERT(again.damped == sums.damped);
      RC_ASSERT(again.momentum_before == sums.momentum_before);
      RC_ASSERT(again.momentum_after == sums.momentum_after);
      for_each_node(grid, [&](std::size_t i, const std::array<int, Dim>&) {
        RC_ASSERT((grid.nodes()[i] == one.nodes()[i]).all());
      });
    }
  }));
}

/// One face of a grid and what lies behind it as a mirror.
template <int Dim>
struct Face {
  int d, side;
  FaceCondition condition;
  double sign(int component) const { return condition == FaceCondition::fixed || component == d ? -1.0 : 1.0; }
};

template <int Dim>
Face<Dim> random_face(Chance& chance)
{
  return { chance.whole(0, Dim - 1), chance.whole(0, 1),
           chance.whole(0, 1) == 0 ? FaceCondition::roller : FaceCondition::fixed };
}

TYPED_TEST(Update, HoldsTheMaterialOnAFaceAndNothingElse)
{
  constexpr int Dim = TypeParam::Dim;
  EXPECT_TRUE(holds("face", [](Chance& chance) {
    std::array<FaceCondition, 2 * Dim> faces;
    for (FaceCondition& face : faces)
      face = static_cast<FaceCondition>(chance.whole(0, 2));
    std::array<int, Dim> size;
    size.fill(3);
    Grid<Dim> grid = random_grid<Dim>(chance, size, faces);
    Particles<Dim> particles = random_cloud(chance, count, grid);
    scatter_body<Dim>(particles, chance.vector<Dim>(10.0), grid);
    const MotionSums<Dim> sums = apply_forces(grid, 1e-3, 0.0);
    bool any = false;
    for (FaceCondition face : faces)
      any = any || face != FaceCondition::free;
    RC_ASSERT(sums.touches_faces == any);
    // Contact may push through a face afterwards: what the face then takes is what it reports.
    const double disturbance = chance.whole(0, 1) == 0 ? 0.0 : 1.0;
    for_each_node(grid, [&](std::size_t i, const std::array<int, Dim>&) {
      for (int c = 0; c < Dim; ++c)
        if (node_mass(grid, i) > 0.0)
          grid.nodes()[i][c] += chance(-disturbance, disturbance);
    });
    const double before = kinetic(grid, true);
    const double taken = GridUpdate<Dim>().apply_faces(grid);
    RC_ASSERT(taken >= 0.0);
    RC_ASSERT(std::abs(before - kinetic(grid, true) - taken) < 1e-11 * (1.0 + before));
    if (disturbance == 0.0)
      RC_ASSERT(taken == 0.0);

    const Vec<Dim> lower = lower_of(grid), upper = upper_of(grid);
    for (int k = 0; k < 10; ++k) {
      Face<Dim> face = random_face<Dim>(chance);
      face.condition = faces[static_cast<std::size_t>(2 * face.d + face.side)];
      Vec<Dim> x;
      for (int d = 0; d < Dim; ++d)
        x[d] = chance(lower[d], upper[d]);
      x[face.d] = face.side == 0 ? lower[face.d] : upper[face.d];
      const Vec<Dim> v = interpolated(grid, x);
      for (int c = 0; c < Dim; ++c)
        if (face.condition != FaceCondition::free && face.sign(c) < 0.0)
          RC_ASSERT(std::abs(v[c]) < 1e-13);
    }
  }));
}

/// A point, velocity, affine matrix and stress behind the mirror.
template <int Dim>
void append_mirror_image(const Face<Dim>& face, double plane, Particles<Dim>& particles)
{
  const Particles<Dim> original = particles;
  const std::size_t n = original.size();
  particles.resize(2 * n);
  Vec<Dim> flip = Vec<Dim>::Ones(), sign;
  flip[face.d] = -1.0;
  for (int c = 0; c < Dim; ++c)
    sign[c] = face.sign(c);
  for (std::size_t p = 0; p < 2 * n; ++p) {
    const std::size_t q = p % n;
    const bool image = p >= n;
    Vec<Dim> x = vector_at<Dim>(original.position, q), v = vector_at<Dim>(original.velocity, q);
    Mat<Dim> c = matrix_at<Dim>(original.affine, q);
    if (image) {
      x[face.d] = 2.0 * plane - x[face.d];
      v = sign.cwiseProduct(v);
      c = sign.asDiagonal() * c * flip.asDiagonal();
    }
    set_vector<Dim>(particles.position, p, x);
    set_vector<Dim>(particles.velocity, p, v);
    set_matrix<Dim>(particles.affine, p, c);
    for (std::size_t k = 0; k < particles.stress.size(); ++k)
      particles.stress[k][p] = original.stress[k][q];
    if (image) {
      // Shear components with the mirrored direction change sign. Order: material/law.h.
      const auto turn = [&](std::size_t k, int i, int j) { particles.stress[k][p] *= flip[i] * flip[j]; };
      if constexpr (Dim == 2) {
        turn(2, 0, 1);
      } else {
        turn(3, 0, 1);
        turn(4, 0, 2);
        turn(5, 1, 2);
      }
    }
    particles.mass[p] = particles.weight_mass[p] = original.mass[q];
    particles.volume[p] = original.volume[q];
  }
}

TYPED_TEST(Update, FaceIsAMirror)
{
  // A roller answers as if the material went on behind it as its own mirror image, with all of its stress. A fixed face
  // does the same with the velocity reversed; no symmetric stress reverses a force, so there without.
  constexpr int Dim = TypeParam::Dim;
  EXPECT_TRUE(holds("mirror", [](Chance& chance) {
    const Face<Dim> face = random_face<Dim>(chance);
    std::array<FaceCondition, 2 * Dim> faces = free_faces<Dim>();
    faces[static_cast<std::size_t>(2 * face.d + face.side)] = face.condition;
    std::array<int, Dim> size;
    size.fill(4);
    Grid<Dim> half = random_grid<Dim>(chance, size, faces);
    Vec<Dim> lower = lower_of(half), upper = upper_of(half);
    const double plane = face.side == 0 ? lower[face.d] : upper[face.d];
    Particles<Dim> particles = random_cloud(chance, count, half);
    particles.weight_mass = particles.mass;
    Vec<Dim> gravity = chance.vector<Dim>(10.0);
    gravity[face.d] = 0.0;
    if (face.condition == FaceCondition::fixed) {
      gravity.setZero();
      for (Column& component : particles.stress)
        std::fill(component.begin(), component.end(), 0.0);
    }
    (face.side == 0 ? lower : upper)[face.d] += (face.side == 0 ? -1.0 : 1.0) * 4 * half.dx();
    Grid<Dim> whole(lower, upper, half.dx(), free_faces<Dim>());
    Particles<Dim> doubled = particles;
    append_mirror_image(face, plane, doubled);

    scatter_body<Dim>(particles, gravity, half);
    scatter_body<Dim>(doubled, gravity, whole);
    const double kick = chance(1e-4, 1e-2);
    const MotionSums<Dim> half_sums = apply_forces(half, kick, 0.0);
    GridUpdate<Dim>().apply_faces(half);
    const MotionSums<Dim> sums = apply_forces(whole, kick, 0.0);
    RC_ASSERT(std::abs(2.0 * half_sums.kinetic_before - sums.kinetic_before) < 1e-10 * sums.kinetic_before);
    RC_ASSERT(std::abs(2.0 * half_sums.kinetic_after - sums.kinetic_after) < 1e-10 * sums.kinetic_after);
    for (std::size_t p = 0; p < particles.size(); ++p) {
      const Vec<Dim> x = vector_at<Dim>(particles.position, p);
      RC_ASSERT(apart(interpolated(half, x), interpolated(whole, x)) < 1e-9);
    }
  }));
}

}  // namespace
}  // namespace geocontainer_mpm::mpm::testing
