// What every shape and transfer conserves and reproduces.

#include "choices.h"

namespace geocontainer_mpm::mpm::testing {
namespace {

template <class K>
class Choices : public ::testing::Test {
};
TYPED_TEST_SUITE(Choices, Kinds);

constexpr std::size_t count = 60;
constexpr int cells = 4;

/// Mass, momentum and the first moment of momentum, sum x p^T, whose antisymmetric part is angular momentum.
template <int Dim>
struct Motion {
  double mass = 0.0;
  Vec<Dim> momentum = Vec<Dim>::Zero();
  Mat<Dim> moment = Mat<Dim>::Zero();
};

template <int Dim>
Motion<Dim> of_particles(Shape shape, const Particles<Dim>& particles, const std::array<Column, Dim>& position,
                         const Grid<Dim>& grid)
{
  Motion<Dim> sum;
  for (std::size_t p = 0; p < particles.size(); ++p) {
    const double m = particles.mass[p];
    const Vec<Dim> v = vector_at<Dim>(particles.velocity, p), x = vector_at<Dim>(position, p);
    sum.mass += m;
    sum.momentum += m * v;
    sum.moment += m * x * v.transpose() + m * inertia_of<Dim>(shape, grid, x, box_of(particles, p)) *
                                              matrix_at<Dim>(particles.affine, p).transpose();
  }
  return sum;
}

template <int Dim>
Motion<Dim> of_grid(const Grid<Dim>& grid, bool node_is_velocity)
{
  Motion<Dim> sum;
  for_each_node(grid, [&](std::size_t i, const std::array<int, Dim>& node) {
    const Vec<Dim> momentum = (node_is_velocity ? node_mass(grid, i) : 1.0) * node_vector(grid, i);
    sum.mass += node_mass(grid, i);
    sum.momentum += momentum;
    sum.moment += grid.coordinate(node) * momentum.transpose();
  });
  return sum;
}

template <int Dim>
void check_equal(const Motion<Dim>& a, const Motion<Dim>& b)
{
  RC_ASSERT(std::abs(a.mass - b.mass) < 1e-12 * count);
  RC_ASSERT(apart(a.momentum, b.momentum) < 1e-11 * count);
  RC_ASSERT(apart(a.moment, b.moment) < 1e-11 * count);
}

TYPED_TEST(Choices, ConserveMassAndMomentaThereAndBack)
{
  constexpr int Dim = TypeParam::Dim;
  EXPECT_TRUE(holds("momenta", [](Chance& chance) {
    Grid<Dim> grid = random_grid<Dim>(chance, cells);
    Particles<Dim> particles = boxed(chance, TypeParam::shape, grid, awkward_cloud(chance, count, grid));
    const Discretisation apic = choice_of(TypeParam::shape, Transfer::apic);
    scatter_body<Dim>(particles, Vec<Dim>::Zero(), grid, apic);
    check_equal(of_particles<Dim>(apic.shape, particles, particles.position, grid), of_grid(grid, false));
    open(everything(grid), grid);
    sheet_to_grid<Dim>(particles, Vec<Dim>::Zero(), grid, apic);
    check_equal(of_particles<Dim>(apic.shape, particles, particles.position, grid), of_grid(grid, false));
    apply_forces(grid, 1e-3, 0.0, apic);
    const std::array<Column, Dim> before = particles.position;
    gather(apic, grid, 1e-3, Gather::all, particles);
    check_equal(of_particles<Dim>(apic.shape, particles, before, grid), of_grid(grid, true));
  }));
}

TYPED_TEST(Choices, ConserveMomentumWhateverTheBlend)
{
  constexpr int Dim = TypeParam::Dim;
  EXPECT_TRUE(holds("blended momentum", [](Chance& chance) {
    Grid<Dim> grid = random_grid<Dim>(chance, cells);
    Particles<Dim> particles = boxed(chance, TypeParam::shape, grid, random_cloud(chance, count, grid));
    const Transfer transfer = chance.whole(0, 1) == 0 ? Transfer::flip : Transfer::aflip;
    const Discretisation flip = choice_of(TypeParam::shape, transfer, chance(0.0, 1.0));
    scatter_body<Dim>(particles, Vec<Dim>::Zero(), grid, flip);
    const auto momentum = [&] {
      Vec<Dim> sum = Vec<Dim>::Zero();
      for (std::size_t p = 0; p < count; ++p)
        sum += particles.mass[p] * vector_at<Dim>(particles.velocity, p);
      return sum;
    };
    RC_ASSERT(apart(momentum(), of_grid(grid, false).momentum) < 1e-12 * count);
    // Internal forces alone: nothing changes in all. A node of little mass moves fast: 1e3 Pa * 2e-3 m2 / 0.05 m.
    const Vec<Dim> before = momentum();
    apply_forces(grid, 1e-3, 0.0, flip);
    gather(flip, grid, 1e-3, Gather::all, particles);
    RC_ASSERT(apart(momentum(), before) < 1e-11 * count);
  }));
}

TYPED_TEST(Choices, BlendTheChangeAndTheVelocity)
{
  constexpr int Dim = TypeParam::Dim;
  EXPECT_TRUE(holds("blend", [](Chance& chance) {
    Grid<Dim> grid = random_grid<Dim>(chance, cells);
    Particles<Dim> particles = boxed(chance, TypeParam::shape, grid, random_cloud(chance, count, grid));
    const Transfer transfer = chance.whole(0, 1) == 0 ? Transfer::flip : Transfer::aflip;
    const Discretisation flip = choice_of(TypeParam::shape, transfer, chance(0.0, 1.0));
    scatter_body<Dim>(particles, chance.vector<Dim>(10.0), grid, flip);
    Grid<Dim> old = grid;
    apply_forces(old, 0.0, 0.0, flip);
    apply_forces(grid, 1e-3, 2.0, flip);
    const Particles<Dim> before = particles;
    const double dt = chance(1e-4, 1e-3);
    gather(flip, grid, dt, Gather::all, particles);
    for (std::size_t p = 0; p < count; ++p) {
      const Vec<Dim> x = vector_at<Dim>(before.position, p), box = box_of(before, p);
      const Vec<Dim> now = velocity_at<Dim>(flip.shape, grid, x, box);
      const Vec<Dim> flipped = vector_at<Dim>(before.velocity, p) + now - velocity_at<Dim>(flip.shape, old, x, box);
      const Vec<Dim> expected = flip.flip_fraction * flipped + (1.0 - flip.flip_fraction) * now;
      const double size = 1.0 + now.norm();
      RC_ASSERT(apart(vector_at<Dim>(particles.velocity, p), expected) < 1e-12 * size);
      RC_ASSERT(apart(vector_at<Dim>(particles.position, p), x + dt * now) < 1e-13 * size);
    }
    Particles<Dim> affine = before;
    gather(choice_of(TypeParam::shape, Transfer::apic), grid, dt, Gather::all, affine);
    RC_ASSERT(particles.affine == (is_affine(transfer) ? affine.affine : before.affine));
  }));
}

TYPED_TEST(Choices, ReproduceAnAffineField)
{
  // FLIP too where the particles' velocities are affine: the grid's change is then that of the force, here none. Its
  // grid is not affine, though, since lumped momenta of velocities without C are smoothed.
  constexpr int Dim = TypeParam::Dim;
  EXPECT_TRUE(holds("affine field", [](Chance& chance) {
    Grid<Dim> grid = random_grid<Dim>(chance, cells);
    Particles<Dim> particles = boxed(chance, TypeParam::shape, grid, awkward_cloud(chance, count, grid));
    const Discretisation choice = choice_of(TypeParam::shape, any_transfer(chance));
    const Vec<Dim> v0 = chance.vector<Dim>(2.0);
    const Mat<Dim> b = chance.matrix<Dim>(3.0);
    for (std::size_t p = 0; p < count; ++p) {
      set_vector<Dim>(particles.velocity, p, v0 + b * vector_at<Dim>(particles.position, p));
      set_matrix<Dim>(particles.affine, p, b);
    }
    scatter_body<Dim>(particles, Vec<Dim>::Zero(), grid, choice);
    apply_forces(grid, 0.0, 0.0, choice);
    const std::array<Column, Dim> before = particles.position;
    gather(choice, grid, 1e-3, Gather::velocity, particles);
    RC_ASSERT(before == particles.position);
    for (std::size_t p = 0; p < count; ++p) {
      const Vec<Dim> v = v0 + b * vector_at<Dim>(before, p);
      RC_ASSERT(apart(vector_at<Dim>(particles.velocity, p), v) < 1e-11);
    }
    // Gradients of nodes with next to no mass carry its round-off: look at the grid that is exactly affine.
    for_each_node(grid, [&](std::size_t i, const std::array<int, Dim>& node) {
      grid.nodes()[i].matrix().template head<Dim>() = v0 + b * grid.coordinate(node);
    });
    gather(choice, grid, 1e-3, is_affine(choice.transfer) ? Gather::all : Gather::gradient, particles);
    for (std::size_t p = 0; p < count; ++p) {
      RC_ASSERT(apart(matrix_at<Dim>(particles.gradient, p), b) < 1e-11);
      RC_ASSERT(apart(matrix_at<Dim>(particles.affine, p), b) < 1e-11);
    }
  }));
}

TYPED_TEST(Choices, ReturnARigidTranslationExactly)
{
  constexpr int Dim = TypeParam::Dim;
  EXPECT_TRUE(holds("translation", [](Chance& chance) {
    Grid<Dim> grid = random_grid<Dim>(chance, cells);
    Particles<Dim> particles = boxed(chance, TypeParam::shape, grid, awkward_cloud(chance, count, grid));
    const Discretisation choice = choice_of(TypeParam::shape, any_transfer(chance), chance(0.0, 1.0));
    const Vec<Dim> v = chance.vector<Dim>(2.0), gravity = chance.vector<Dim>(10.0);
    particles.weight_mass = particles.mass;
    for (std::size_t p = 0; p < count; ++p) {
      set_vector<Dim>(particles.velocity, p, v);
      set_matrix<Dim>(particles.affine, p, Mat<Dim>::Zero());
      for (Column& component : particles.stress)
        component[p] = 0.0;
    }
    scatter_body<Dim>(particles, gravity, grid, choice);
    const double kick = chance(1e-4, 1e-2);
    apply_forces(grid, kick, 0.0, choice);
    const std::array<Column, Dim> before = particles.position;
    gather(choice, grid, 1e-3, Gather::motion, particles);
    const Vec<Dim> after = v + kick * gravity;
    for (std::size_t p = 0; p < count; ++p) {
      RC_ASSERT(apart(vector_at<Dim>(particles.velocity, p), after) < 1e-14);
      RC_ASSERT(apart(vector_at<Dim>(particles.position, p), vector_at<Dim>(before, p) + 1e-3 * after) < 1e-14);
    }
  }));
}

/// Force and moment sum x f^T on the grid.
template <int Dim>
struct Pull {
  Vec<Dim> force = Vec<Dim>::Zero();
  Mat<Dim> moment = Mat<Dim>::Zero();
  double size = 0.0;
  explicit Pull(const Grid<Dim>& grid)
  {
    for_each_node(grid, [&](std::size_t i, const std::array<int, Dim>& node) {
      force += node_force(grid, i);
      moment += node_force(grid, i) * grid.coordinate(node).transpose();
      size += node_force(grid, i).norm();
    });
  }
};

TYPED_TEST(Choices, PullWithStressViscosityWeightAndExternalForce)
{
  constexpr int Dim = TypeParam::Dim;
  EXPECT_TRUE(holds("forces", [](Chance& chance) {
    Grid<Dim> grid = random_grid<Dim>(chance, cells);
    Particles<Dim> particles = boxed(chance, TypeParam::shape, grid, awkward_cloud(chance, count, grid));
    const Discretisation choice = choice_of(TypeParam::shape, any_transfer(chance));
    const Vec<Dim> gravity = chance.vector<Dim>(10.0);
    BodyTerms terms;
    terms.part = chance.whole(0, 1) == 0 ? Part::all : Part::force;
    terms.external_force = chance.whole(0, 1) == 0;
    if (chance.whole(0, 1) == 0)
      terms.damping = { chance(0.0, 100.0), chance(0.0, 100.0) };
    scatter_body<Dim>(particles, gravity, grid, choice, terms);
    Vec<Dim> force = Vec<Dim>::Zero();
    Mat<Dim> moment = Mat<Dim>::Zero();
    double mass = 0.0;
    for (std::size_t p = 0; p < count; ++p) {
      Vec<Dim> pull = particles.weight_mass[p] * gravity;
      if (terms.external_force)
        pull += vector_at<Dim>(particles.force, p);
      const Mat<Dim> l = matrix_at<Dim>(particles.gradient, p);
      const Mat<Dim> viscous =
          terms.damping.lambda * l.trace() * Mat<Dim>::Identity() + terms.damping.shear * (l + l.transpose());
      force += pull;
      moment += pull * vector_at<Dim>(particles.position, p).transpose() -
                particles.volume[p] * (stress_at(particles, p) + viscous);
      mass += particles.mass[p];
    }
    const Pull<Dim> got(grid);
    RC_ASSERT(apart(got.force, force) < 1e-13 * got.size);
    RC_ASSERT(apart(got.moment, moment) < 1e-12 * got.size);
    RC_ASSERT(std::abs(of_grid(grid, false).mass - (terms.part == Part::all ? mass : 0.0)) < 1e-12 * mass);
  }));
}

TYPED_TEST(Choices, CarryASurfaceForceExactlyInForceAndMoment)
{
  constexpr int Dim = TypeParam::Dim;
  EXPECT_TRUE(holds("surface force", [](Chance& chance) {
    Grid<Dim> grid = random_grid<Dim>(chance, cells);
    open(everything(grid), grid);
    Vec<Dim> force = Vec<Dim>::Zero();
    Mat<Dim> moment = Mat<Dim>::Zero();
    for (int n = 0; n < 5; ++n) {
      Particles<Dim> one = boxed(chance, TypeParam::shape, grid, random_cloud(chance, 1, grid));
      const Vec<Dim> x = random_point(chance, grid), arm = chance.vector<Dim>(0.5 * grid.dx());
      const Vec<Dim> f = chance.vector<Dim>(10.0);
      set_vector<Dim>(one.position, 0, x);
      add_surface_force<Dim>(TypeParam::shape, one, 0, arm, f, grid);
      force += f;
      moment += f * (x + arm).transpose();
    }
    const Pull<Dim> got(grid);
    RC_ASSERT(apart(got.force, force) < 1e-12 * got.size);
    RC_ASSERT(apart(got.moment, moment) < 1e-12 * (1.0 + got.size));
  }));
}

}  // namespace
}  // namespace geocontainer_mpm::mpm::testing
