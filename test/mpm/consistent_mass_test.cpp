// The consistent mass matrix: what it is made of, that it is solved, and that few particles do no harm.

#include "choices.h"

namespace geocontainer_mpm::mpm::testing {
namespace {

template <class K>
class Consistent : public ::testing::Test {
};
TYPED_TEST_SUITE(Consistent, Kinds);

constexpr int cells = 4;

Discretisation consistent(Shape shape)
{
  Discretisation choice = choice_of(shape, Transfer::flip);
  choice.mass = MassMatrix::consistent;
  return choice;
}

template <int Dim>
struct Case {
  Grid<Dim> grid;
  Particles<Dim> particles;
  GridUpdate<Dim> update;
  ThreadTeam alone{ 1 };

  /// Scattered and assembled: what a step does before the forces.
  Case(Chance& chance, Shape shape, std::size_t count, const std::array<FaceCondition, 2 * Dim>& faces)
      : grid(random_grid<Dim>(chance, all_cells(), faces))
      , particles(boxed(chance, shape, grid, random_cloud(chance, count, grid)))
  {
    Strips strips;
    Sorter<Dim>().sort(grid, particles, strips);
    open(everything(grid), grid);
    body_to_grid(particles, strips, chance.vector<Dim>(10.0), grid, consistent(shape));
    update.mass().open(shape, grid);
    if (chance.whole(0, 1) == 0)
      update.mass().add(particles, strips, grid, alone);
    else
      update.mass().add(particles, grid);
  }
  static std::array<int, Dim> all_cells()
  {
    std::array<int, Dim> all;
    all.fill(cells);
    return all;
  }
};

TYPED_TEST(Consistent, RowsAddUpToTheLumpedMass)
{
  constexpr int Dim = TypeParam::Dim;
  EXPECT_TRUE(holds("rows", [](Chance& chance) {
    Case<Dim> c(chance, TypeParam::shape, 100, free_faces<Dim>());
    std::vector<typename ConsistentMass<Dim>::Value> v(c.update.mass().active().size());
    for (auto& value : v)
      value.setOnes();
    c.update.mass().multiply(v, c.alone);
    for (std::size_t n = 0; n < v.size(); ++n)
      RC_ASSERT(std::abs(v[n][0] - node_mass(c.grid, c.update.mass().active()[n])) < 1e-13);
  }));
}

TYPED_TEST(Consistent, HoldsTheKineticEnergyOfTheParticlesUnderAnyFaces)
{
  // v M v is what particles have that move with the grid, mirrored beyond its faces, for 99 % of it, and that of the
  // nodes for the rest.
  constexpr int Dim = TypeParam::Dim;
  EXPECT_TRUE(holds("energy", [](Chance& chance) {
    Case<Dim> c(chance, TypeParam::shape, 100, any_faces<Dim>(chance));
    const std::vector<std::uint32_t>& active = c.update.mass().active();
    Grid<Dim> moving = c.grid;
    for (std::uint32_t i : active)
      moving.nodes()[i].matrix().template head<Dim>() = chance.vector<Dim>(2.0);
    GridUpdate<Dim>().apply_faces(moving);
    std::vector<typename ConsistentMass<Dim>::Value> v(active.size());
    double expected = 0.0, energy = 0.0;
    for (std::size_t n = 0; n < active.size(); ++n) {
      v[n] = node_vector(moving, active[n]).array();
      expected += ConsistentMass<Dim>::lumped_part * node_mass(c.grid, active[n]) * v[n].square().sum();
    }
    for (std::size_t p = 0; p < c.particles.size(); ++p)
      expected +=
          (1.0 - ConsistentMass<Dim>::lumped_part) * c.particles.mass[p] *
          velocity_at<Dim>(TypeParam::shape, moving, vector_at<Dim>(c.particles.position, p), box_of(c.particles, p))
              .squaredNorm();
    const auto before = v;
    c.update.mass().multiply(v, c.alone);
    for (std::size_t n = 0; n < active.size(); ++n)
      energy += (before[n] * v[n]).sum();
    RC_ASSERT(std::abs(energy - expected) < 1e-12 * expected);
  }));
}

TYPED_TEST(Consistent, IsSolvedWhateverTheFacesAndHoweverFewTheParticles)
{
  constexpr int Dim = TypeParam::Dim;
  EXPECT_TRUE(holds("solved", [](Chance& chance) {
    const auto count = static_cast<std::size_t>(chance.whole(0, 1) == 0 ? chance.whole(1, 5) : chance.whole(6, 200));
    Case<Dim> c(chance, TypeParam::shape, count, any_faces<Dim>(chance));
    ConsistentMass<Dim>& mass = c.update.mass();
    // A right-hand side that the faces allow.
    std::vector<typename ConsistentMass<Dim>::Value> v(mass.active().size());
    for (auto& value : v)
      value = chance.vector<Dim>(1.0).array();
    mass.multiply(v, c.alone);
    const auto wanted = v;
    const int iterations = mass.solve(v, c.alone);
    RC_ASSERT(iterations < mass.most_iterations);
    mass.multiply(v, c.alone);
    double size = 0.0;
    for (const auto& value : wanted)
      size = std::max(size, value.abs().maxCoeff());
    for (std::size_t n = 0; n < v.size(); ++n)
      RC_ASSERT((v[n] - wanted[n]).abs().maxCoeff() < 1e-10 * size);
  }));
}

TYPED_TEST(Consistent, UpdatesByTheForcesAndBooksIt)
{
  constexpr int Dim = TypeParam::Dim;
  EXPECT_TRUE(holds("update", [](Chance& chance) {
    const auto count = static_cast<std::size_t>(chance.whole(1, 200));
    Case<Dim> c(chance, TypeParam::shape, count, free_faces<Dim>());
    Grid<Dim> lumped = c.grid;
    const double kick = chance(1e-5, 1e-3);
    const MotionSums<Dim> wanted = apply_forces(lumped, kick, 0.0, choice_of(TypeParam::shape, Transfer::flip));
    const MotionSums<Dim> sums = c.update.apply_forces(consistent(TypeParam::shape), c.grid, kick, 0.0, c.alone);
    RC_ASSERT(sums.iterations > 0);
    Vec<Dim> momentum = Vec<Dim>::Zero(), kept = Vec<Dim>::Zero();
    double size = 0.0;
    for_each_node(c.grid, [&](std::size_t i, const std::array<int, Dim>&) {
      momentum += node_mass(c.grid, i) * node_vector(c.grid, i);
      kept += node_mass(c.grid, i) * c.grid.kept()[i].matrix().template head<Dim>();
      size += node_mass(c.grid, i) * (1.0 + node_vector(c.grid, i).norm());
    });
    RC_ASSERT(apart(momentum, wanted.momentum_after) < 1e-10 * size);
    RC_ASSERT(apart(kept, wanted.momentum_before) < 1e-10 * size);
    RC_ASSERT(apart(sums.momentum_after, wanted.momentum_after) < 1e-12 * size);
    // The lumped matrix has the largest mass for every velocity, and a hundredth of it is the least.
    RC_ASSERT(sums.kinetic_before >= wanted.kinetic_before * (1.0 - 1e-9));
    RC_ASSERT(sums.kinetic_after >= wanted.kinetic_after * (1.0 - 1e-9));
    RC_ASSERT(sums.kinetic_after <= wanted.kinetic_after / ConsistentMass<Dim>::lumped_part);
  }));
}

TYPED_TEST(Consistent, HoldsFacesAndReturnsARigidTranslation)
{
  constexpr int Dim = TypeParam::Dim;
  EXPECT_TRUE(holds("translation", [](Chance& chance) {
    // Along a roller: free in all directions but its own.
    std::array<FaceCondition, 2 * Dim> faces = free_faces<Dim>();
    const int d = chance.whole(0, Dim - 1);
    faces[static_cast<std::size_t>(2 * d + chance.whole(0, 1))] = FaceCondition::roller;
    Case<Dim> c(chance, TypeParam::shape, 50, faces);
    Vec<Dim> v = chance.vector<Dim>(2.0);
    v[d] = 0.0;
    for (std::size_t p = 0; p < 50; ++p) {
      set_vector<Dim>(c.particles.velocity, p, v);
      for (Column& component : c.particles.stress)
        component[p] = 0.0;
    }
    const Discretisation choice = consistent(TypeParam::shape);
    Strips strips;
    Sorter<Dim>().sort(c.grid, c.particles, strips);
    open(everything(c.grid), c.grid);
    body_to_grid(c.particles, strips, Vec<Dim>::Zero().eval(), c.grid, choice);
    c.update.apply_forces(choice, c.grid, 1e-3, 0.0, c.alone);
    c.update.apply_faces(c.grid);
    gather(choice, c.grid, 1e-3, Gather::all, c.particles);
    for (std::size_t p = 0; p < 50; ++p)
      RC_ASSERT(apart(vector_at<Dim>(c.particles.velocity, p), v) < 1e-10);
  }));
}

}  // namespace
}  // namespace geocontainer_mpm::mpm::testing
