// The pieces that USF and MUSL are made of, and threads, for every choice.

#include "choices.h"

namespace geocontainer_mpm::mpm::testing {
namespace {

template <class K>
class Sequences : public ::testing::Test {
};
TYPED_TEST_SUITE(Sequences, Kinds);

constexpr std::size_t count = 60;
constexpr int cells = 4;

TYPED_TEST(Sequences, SplitAScatterIntoMomentumAndForce)
{
  constexpr int Dim = TypeParam::Dim;
  EXPECT_TRUE(holds("parts", [](Chance& chance) {
    Grid<Dim> grid = random_grid<Dim>(chance, cells);
    Particles<Dim> particles = boxed(chance, TypeParam::shape, grid, awkward_cloud(chance, count, grid));
    const Discretisation choice = choice_of(TypeParam::shape, any_transfer(chance));
    const Vec<Dim> gravity = chance.vector<Dim>(10.0);
    Strips strips;
    Sorter<Dim>().sort(grid, particles, strips);
    open(everything(grid), grid);
    Grid<Dim> apart_grid = grid;
    body_to_grid(particles, strips, gravity, grid, choice);
    mpm::sheet_to_grid(choice, particles, Part::all, gravity, grid);
    for (const Part part : { Part::momentum, Part::force }) {
      BodyTerms terms;
      terms.part = part;
      body_to_grid(particles, strips, gravity, apart_grid, choice, terms);
      mpm::sheet_to_grid(choice, particles, part, gravity, apart_grid);
    }
    for_each_node(grid, [&](std::size_t i, const std::array<int, Dim>&) {
      RC_ASSERT((grid.nodes()[i] == apart_grid.nodes()[i]).all());
      RC_ASSERT((grid.forces()[i] == apart_grid.forces()[i]).all());
    });
  }));
}

TYPED_TEST(Sequences, GatherInPiecesWhatTheyGatherAtOnce)
{
  constexpr int Dim = TypeParam::Dim;
  EXPECT_TRUE(holds("pieces", [](Chance& chance) {
    Grid<Dim> grid = random_grid<Dim>(chance, cells);
    Particles<Dim> particles = boxed(chance, TypeParam::shape, grid, random_cloud(chance, count, grid));
    const Discretisation choice = choice_of(TypeParam::shape, any_transfer(chance), chance(0.0, 1.0));
    scatter_body<Dim>(particles, chance.vector<Dim>(10.0), grid, choice);
    apply_forces(grid, 1e-4, 0.0, choice);
    Particles<Dim> usf = particles, musl = particles;
    gather(choice, grid, 1e-4, Gather::all, particles);
    gather(choice, grid, 1e-4, Gather::gradient, usf);
    gather(choice, grid, 1e-4, Gather::motion, usf);
    gather(choice, grid, 1e-4, Gather::velocity, musl);
    gather(choice, grid, 1e-4, Gather::gradient, musl);
    ThreadTeam alone(1);
    grid.keep_velocities(alone);
    gather(choice, grid, 1e-4, Gather::position, musl);
    for (const Particles<Dim>* other : { &usf, &musl }) {
      RC_ASSERT(other->velocity == particles.velocity);
      RC_ASSERT(other->position == particles.position);
      RC_ASSERT(other->affine == particles.affine);
      RC_ASSERT(other->gradient == particles.gradient);
    }
  }));
}

TYPED_TEST(Sequences, GoToVelocitiesAndBackToMomenta)
{
  // USF: velocities without forces, momenta again, then forces: as if the forces had been there at once.
  constexpr int Dim = TypeParam::Dim;
  EXPECT_TRUE(holds("there and back", [](Chance& chance) {
    std::array<int, Dim> size;
    size.fill(cells);
    Grid<Dim> grid = random_grid<Dim>(chance, size, any_faces<Dim>(chance));
    Particles<Dim> particles = boxed(chance, TypeParam::shape, grid, random_cloud(chance, count, grid));
    const Discretisation choice = choice_of(TypeParam::shape, any_transfer(chance));
    Strips strips;
    Sorter<Dim>().sort(grid, particles, strips);
    const Vec<Dim> gravity = chance.vector<Dim>(10.0);
    open(everything(grid), grid);
    Grid<Dim> usl = grid;
    ThreadTeam alone(1);
    GridUpdate<Dim> update;
    body_to_grid(particles, strips, gravity, usl, choice);
    update.apply_forces(choice, usl, 1e-4, 0.0, alone);
    update.apply_faces(usl);
    BodyTerms terms;
    terms.part = Part::momentum;
    body_to_grid(particles, strips, gravity, grid, choice, terms);
    update.velocities(choice, grid, alone);
    update.momenta(choice, grid, alone);
    terms.part = Part::force;
    body_to_grid(particles, strips, gravity, grid, choice, terms);
    update.apply_forces(choice, grid, 1e-4, 0.0, alone);
    update.apply_faces(grid);
    for_each_node(grid, [&](std::size_t i, const std::array<int, Dim>&) {
      RC_ASSERT(apart(node_vector(grid, i), node_vector(usl, i)) < 1e-13 * (1.0 + node_vector(usl, i).norm()));
    });
  }));
}

TYPED_TEST(Sequences, KeepOldVelocitiesUnderTheFaceConditions)
{
  constexpr int Dim = TypeParam::Dim;
  EXPECT_TRUE(holds("kept", [](Chance& chance) {
    std::array<int, Dim> size;
    size.fill(cells);
    Grid<Dim> grid = random_grid<Dim>(chance, size, any_faces<Dim>(chance));
    Particles<Dim> particles = boxed(chance, TypeParam::shape, grid, random_cloud(chance, count, grid));
    const Discretisation flip = choice_of(TypeParam::shape, Transfer::flip);
    scatter_body<Dim>(particles, chance.vector<Dim>(10.0), grid, flip);
    Grid<Dim> old = grid;
    apply_forces(old, 0.0, 0.0, flip);
    GridUpdate<Dim>().apply_faces(old);
    apply_forces(grid, 1e-3, 0.0, flip);
    for_each_node(grid, [&](std::size_t i, const std::array<int, Dim>&) {
      const Vec<Dim> kept = grid.kept()[i].matrix().template head<Dim>();
      RC_ASSERT(apart(kept, node_vector(old, i)) < 1e-14 * (1.0 + kept.norm()));
    });
  }));
}

TYPED_TEST(Sequences, GiveTheSameBitsWithAnyNumberOfThreads)
{
  constexpr int Dim = TypeParam::Dim;
  EXPECT_TRUE(holds("threads", [](Chance& chance) {
    std::array<int, Dim> size;
    size.fill(3);
    size[0] = chance.whole(5, 40);
    Grid<Dim> start = random_grid<Dim>(chance, size, any_faces<Dim>(chance));
    Particles<Dim> particles = boxed(chance, TypeParam::shape, start, random_cloud(chance, 150, start));
    Strips strips;
    Sorter<Dim>().sort(start, particles, strips);
    Discretisation choice = choice_of(TypeParam::shape, any_transfer(chance), chance(0.0, 1.0));
    choice.smoothing = static_cast<Smoothing>(chance.whole(0, 2));
    if (choice.transfer == Transfer::flip && chance.whole(0, 1) == 0)
      choice.mass = MassMatrix::consistent;
    BodyTerms terms;
    terms.external_force = true;
    const auto step = [&](int threads) {
      Grid<Dim> grid = start;
      Particles<Dim> moved = particles;
      ThreadTeam team(threads);
      GridUpdate<Dim> update;
      grid.open(everything(grid), team);
      mpm::body_to_grid(choice, moved, strips, terms, Vec<Dim>::Ones().eval(), grid, team);
      if (choice.mass == MassMatrix::consistent) {
        update.mass().open(choice.shape, grid);
        update.mass().add(moved, strips, grid, team);
      }
      update.apply_forces(choice, grid, 1e-4, 0.1, team);
      update.apply_faces(grid);
      gather(choice, grid, 1e-4, Gather::gradient, moved);
      smooth_gradients(choice, strips, moved, grid, team);
      gather(choice, grid, 1e-4, Gather::motion, moved);
      return moved;
    };
    const Particles<Dim> one = step(1);
    for (const int threads : { 2, 3 }) {
      const Particles<Dim> more = step(threads);
      RC_ASSERT(one.position == more.position);
      RC_ASSERT(one.velocity == more.velocity);
      RC_ASSERT(one.affine == more.affine);
      RC_ASSERT(one.gradient == more.gradient);
    }
  }));
}

}  // namespace
}  // namespace geocontainer_mpm::mpm::testing
