// Contact between velocity fields: when it acts, what it conserves, Coulomb, and two discs that rebound.

#include "geocontainer_mpm/contact/field_contact.h"

#include <gtest/gtest.h>

#include "geocontainer_mpm/mpm/reach.h"
#include "two_fields.h"

namespace geocontainer_mpm::contact::testing {
namespace {

/// Steps by the time that a wave needs for a cell: half of what is stable.
constexpr double courant = 0.34;

constexpr double dx = 0.1;

TEST(FieldContact, ActsWhenTheFacesMeetAndNotBefore)
{
  EXPECT_TRUE(holds("meeting", [](Chance& chance) {
    // Two blocks head-on, turned anyhow and anywhere on the grid. Their faces meet at a known time.
    const double spacing = dx / chance.whole(2, 3), gap = chance(0.02, 0.15), speed = chance(0.5, 2.0);
    const RigidPose pose =
        RigidPose::motion(chance.whole(0, 2) == 0 ? 0.25 * pi : chance(-pi, pi), Vec2::Zero(), chance.vector<2>(dx));
    const Vec2 normal = pose.turn({ 1.0, 0.0 });
    Field a(lattice(1.0, dx),
            block({ -0.4 - gap, -0.2 }, static_cast<int>(std::lround(0.4 / spacing)), 8, spacing, pose), spacing,
            1000.0);
    Field b(lattice(1.0, dx), block({ 0.0, chance(-0.3, -0.1) }, 6, 8, spacing, pose), spacing, chance(10.0, 1e4));
    const double width = spacing * std::round(0.4 / spacing) - 0.4;  // of a block of whole particles
    const Vec2 common = chance.vector<2>(0.2);
    a.set_velocity(common + speed * normal);
    b.set_velocity(common);
    FieldContact contact;
    const double dt = chance(1e-3, 5e-3), meet = (gap - width) / speed;
    double time = 0.0;
    for (; time + dt <= meet * (1.0 - 1e-9); time += dt) {
      const ContactSums<2> sums = step(a, b, contact, 0.5, dt, dt);
      RC_ASSERT(sums.impulse == Vec2::Zero());
    }
    const Vec2 before = b.momentum() + a.momentum();
    const ContactSums<2> sums = step(a, b, contact, 0.0, dt, dt);
    RC_ASSERT(sums.impulse.dot(normal) > 0.0);
    // The direct way between two straight faces is their normal, but at nodes that see only a corner of each.
    RC_ASSERT(std::abs(sums.impulse.dot(Vec2(-normal[1], normal[0]))) < 0.02 * sums.impulse.norm());
    RC_ASSERT(apart(a.momentum() + b.momentum(), before) < 1e-12 * before.norm() + 1e-9);
  }));
}

/// Sulsky, Chen and Schreyer 1994: two elastic discs of radius 0.2 m that meet on the diagonal of a square metre.
struct Rebound {
  double meeting = -1.0;    ///< s
  double momentum = 0.0;    ///< largest of the sum of both, N s / m
  double dissipated = 0.0;  ///< by contact, part of the kinetic energy before
  Vec2 velocity;            ///< of the second disc afterwards, m/s
};

Rebound two_discs(int cells, const Vec2& shift)
{
  const double size = 1.0 / cells, spacing = 0.5 * size;
  material::Parameters rubber;
  rubber.density_kg_per_m3 = 1000.0;
  rubber.young_modulus_pa = 1000.0;
  rubber.poisson_ratio = 0.3;
  std::vector<std::unique_ptr<Field>> disc;
  for (const double sign : { -1.0, 1.0 }) {
    const Vec2 centre = Vec2::Constant(0.5 + 0.25 * sign);
    std::vector<Vec2> points;
    for (const Vec2& x : block({ 0.0, 0.0 }, 2 * cells, 2 * cells, spacing))
      if ((x - centre).norm() < 0.2)
        points.push_back(x + shift);
    disc.push_back(std::make_unique<Field>(
        mpm::Grid<2>({ 0.0, 0.0 }, { 1.0, 1.0 }, size, mpm::testing::free_faces<2>()), points, spacing, 1000.0));
    disc.back()->law = material::make_law<2>(rubber);
    disc.back()->set_velocity(Vec2::Constant(-0.1 * sign));
  }
  FieldContact contact;
  Rebound result;
  double time = 0.0, kinetic = 0.0, last = 0.0;
  const double dt = courant * size / std::sqrt(material::constrained_modulus(rubber) / 1000.0);
  while (time < 3.0) {
    const ContactSums<2> sums = step(*disc[0], *disc[1], contact, 0.0, last, dt);
    if (last == 0.0)
      kinetic = disc[0]->kinetic() + disc[1]->kinetic();
    last = dt;
    time += dt;
    result.dissipated += sums.dissipated / kinetic;
    if (result.meeting < 0.0 && sums.impulse != Vec2::Zero())
      result.meeting = time;
    result.momentum = std::max(result.momentum, (disc[0]->momentum() + disc[1]->momentum()).norm());
  }
  result.velocity = disc[1]->mean(disc[1]->particles.velocity);
  return result;
}

TEST(FieldContact, TwoElasticDiscsReboundOnTime)
{
  const double meeting = (std::sqrt(0.5) - 0.4) / (0.2 * std::sqrt(2.0));
  for (const int cells : { 20, 40 })
    for (const Vec2& shift : { Vec2(0.0, 0.0), Vec2(0.007, 0.013) }) {
      const Rebound rebound = two_discs(cells, shift);
      const double half_a_cell = 0.5 / cells / (0.2 * std::sqrt(2.0));
      EXPECT_NEAR(rebound.meeting, meeting, half_a_cell);
      EXPECT_LT(rebound.momentum, 1e-12 * 25.0);  // of the 25 N s / m that go each way
      // What contact itself takes, or gives where it works off penetration. (The transfer takes more: APIC.)
      EXPECT_LT(std::abs(rebound.dissipated), 0.02);
      EXPECT_GT(rebound.velocity[0], 0.07);
      EXPECT_NEAR(rebound.velocity[1] / rebound.velocity[0], 1.0, shift.isZero() ? 0.02 : 0.1);
    }
}

/// A pair of blocks, b on a, faces meeting at z = 0 after a gap; both random otherwise.
struct Pair {
  Field a, b;
  Pair(double gap, double density_a, double density_b)
      : a(lattice(1.0, dx), block({ -0.6, -0.4 }, 24, 8, 0.5 * dx), 0.5 * dx, density_a)
      , b(lattice(1.0, dx), block({ -0.27, gap }, 10, 6, 0.5 * dx), 0.5 * dx, density_b)
  {
  }
};

TEST(FieldContact, ConservesMomentumAndKeepsItsEnergyBook)
{
  EXPECT_TRUE(holds("books", [](Chance& chance) {
    Pair pair(chance(0.0, 0.001), chance(10.0, 5000.0), chance(10.0, 5000.0));
    for (Field* field : { &pair.a, &pair.b }) {
      field->gravity = chance.vector<2>(20.0);
      for (std::size_t p = 0; p < field->particles.size(); ++p)
        set_vector<2>(field->particles.velocity, p, chance.vector<2>(2.0) - Vec2(0.0, field == &pair.b ? 6.0 : 0.0));
    }
    const double kick = chance.whole(0, 1) == 0 ? 0.0 : chance(0.0, 2e-3), friction = chance(0.0, 1.0), dt = 1e-3;
    pair.a.to_grid(kick);
    pair.b.to_grid(kick);
    const Vec2 momentum_a = pair.a.momentum(), momentum_b = pair.b.momentum();
    const double kinetic = pair.a.kinetic() + pair.b.kinetic();
    const ContactSums<2> sums = FieldContact().solve(pair.a.side(), pair.b.side(), friction, kick, dt);
    const double change = pair.a.kinetic() + pair.b.kinetic() - kinetic, size = 1.0 + kinetic;
    RC_ASSERT(sums.impulse.norm() > 0.0);
    RC_ASSERT(sums.skipped == 0U);
    RC_ASSERT(apart(pair.b.momentum() - momentum_b, sums.impulse) < 1e-12 * size);
    RC_ASSERT(apart(pair.a.momentum() - momentum_a, -sums.impulse) < 1e-12 * size);
    RC_ASSERT(std::abs(change - sums.kinetic_change) < 1e-12 * size);
    if (kick == 0.0) {
      RC_ASSERT(std::abs(change + sums.dissipated) < 1e-12 * size);
      RC_ASSERT(sums.dissipated > 0.0);
    }
  }));
}

TEST(FieldContact, GivesTheCoulombAnswerForOneRigidBlow)
{
  EXPECT_TRUE(holds("Coulomb", [](Chance& chance) {
    // Uniform velocities: every shared node is the same collision, so that the sums have the ratio of each.
    Pair pair(0.0, chance(100.0, 5000.0), chance(100.0, 5000.0));
    const double friction = chance(0.0, 1.0), down = chance(0.1, 2.0), along = chance(-2.0, 2.0);
    const Vec2 common = chance.vector<2>(1.0);
    pair.a.set_velocity(common);
    pair.b.set_velocity(common + Vec2(along, -down));
    pair.a.to_grid(0.0);
    pair.b.to_grid(0.0);
    const ContactSums<2> sums = FieldContact().solve(pair.a.side(), pair.b.side(), friction, 0.0, 1e-3);
    const double ratio = std::min(friction, std::abs(along) / down);
    RC_ASSERT(sums.impulse[1] > 0.0);
    RC_ASSERT(std::abs(sums.impulse[0] + std::copysign(ratio, along) * sums.impulse[1]) < 1e-9 * sums.impulse[1]);
  }));
}

TEST(FieldContact, ABlockOnAnInclineSlidesOrStaysAsCoulombSays)
{
  // Gravity is turned instead of the ground, which is dust so heavy that nothing moves it.
  material::Parameters firm;
  firm.density_kg_per_m3 = 2000.0;
  firm.young_modulus_pa = 5e6;
  firm.poisson_ratio = 0.2;
  const double tilt = 30.0 * pi / 180.0, end = 0.35;
  for (const double friction : { 0.0, 0.2, 0.45, 0.7 }) {
    Pair pair(0.0, 2e12, 2000.0);
    pair.b.law = material::make_law<2>(firm);
    pair.b.gravity = 9.81 * Vec2(std::sin(tilt), -std::cos(tilt));
    // Its weight hangs on it already, and so does the friction that follows: no bounce, and no shear wave, in whose
    // time an unstressed block would gain velocity that it keeps.
    const double drag = std::min(std::sin(tilt), friction * std::cos(tilt));
    for (std::size_t p = 0; p < pair.b.particles.size(); ++p) {
      const double above = 2000.0 * 9.81 * (0.3 - pair.b.particles.position[1][p]);
      pair.b.particles.stress[1][p] = -above * std::cos(tilt);
      pair.b.particles.stress[2][p] = above * drag;
    }
    pair.b.law->initialise(pair.b.particles.batch(), 0, pair.b.particles.size());
    const Vec2 start = pair.b.mean(pair.b.particles.position);
    FieldContact contact;
    const double dt = courant * dx / std::sqrt(material::constrained_modulus(firm) / 2000.0);
    double time = 0.0, last = 0.0;
    for (; time < end; time += dt) {
      step(pair.a, pair.b, contact, friction, last, dt);
      last = dt;
    }
    const Vec2 way = pair.b.mean(pair.b.particles.position) - start;
    const double slid = 0.5 * 9.81 * std::max(0.0, std::sin(tilt) - friction * std::cos(tilt)) * time * time;
    // Its free sides rearrange its shear, about which it swings: by no more than the shear of its own weight.
    const double shear = 2000.0 * 9.81 * std::sin(tilt) * 0.3 * 0.3 / (2.0 * material::shear_modulus(firm));
    EXPECT_NEAR(way[0], slid, 0.01 * slid + shear) << friction;
    EXPECT_NEAR(way[1], 0.0, 1e-4);
    if (friction > std::tan(tilt)) {  // and it stays there
      for (time = 0.0; time < end; time += dt)
        step(pair.a, pair.b, contact, friction, last, dt);
      EXPECT_NEAR(pair.b.mean(pair.b.particles.position)[0], start[0] + way[0], 2e-5);
    }
  }
}

TEST(FieldContact, ASheetWithoutWidthMeetsABodyAtItsFace)
{
  EXPECT_TRUE(holds("sheet", [](Chance& chance) {
    const double gap = chance(0.0, 0.002), dt = 1e-3;
    Pair pair(0.0, 1000.0, 1000.0);
    std::vector<Vec2> line;
    for (int k = -3; k <= 3; ++k)
      line.emplace_back(0.9 * dx * k, gap);
    Field sheet(lattice(1.0, dx), line, 0.0, 1000.0);
    for (double& mass : sheet.particles.mass)
      mass = 20.0 * dx;
    const double down = chance(0.1, 5.0);
    sheet.set_velocity({ chance(-1.0, 1.0), -down });
    pair.a.to_grid(0.0);
    sheet.to_grid(0.0);
    const ContactSums<2> sums = FieldContact().solve(pair.a.side(), sheet.side(), 0.0, 0.0, dt);
    RC_ASSERT((sums.impulse[1] > 0.0) == (down * dt > gap));
    RC_ASSERT(std::abs(sums.impulse[0]) < 0.05 * (1e-9 + sums.impulse[1]));  // nodes beyond its ends look aslant
  }));
}

TEST(FieldContact, ClosesTheGapExactlyOnLinearSimplicesToo)
{
  EXPECT_TRUE(holds("simplices", [](Chance& chance) {
    const double gap = chance(0.0, 0.002), dt = 1e-3, speed = gap / dt + chance(0.1, 2.0);
    Pair pair(gap, 1000.0, chance(100.0, 5000.0));
    const auto scatter = [](Field& field, const Vec2& velocity) {
      mpm::testing::open(mpm::testing::everything(field.grid), field.grid);
      for (std::size_t p = 0; p < field.particles.size(); ++p) {
        const auto reach = mpm::simplex_reach<2>(vector_at<2>(field.particles.position, p), field.grid);
        for (std::size_t k = 0; k < 3; ++k)
          field.grid.nodes()[reach.node[k]] +=
              reach.weight[k] * field.particles.mass[p] * mpm::Grid<2>::Node(velocity[0], velocity[1], 0.0, 1.0);
      }
      mpm::testing::apply_forces(field.grid, 0.0, 0.0);
    };
    scatter(pair.a, Vec2::Zero());
    scatter(pair.b, { 0.3, -speed });
    const Vec2 before = pair.a.momentum() + pair.b.momentum();
    const ContactSums<2> sums =
        FieldContact(mpm::Shape::linear_simplex).solve(pair.a.side(), pair.b.side(), 0.0, 0.0, dt);
    RC_ASSERT(sums.impulse[1] > 0.0);
    RC_ASSERT(apart(pair.a.momentum() + pair.b.momentum(), before) < 1e-12 * before.norm());
    const auto place = [&](std::size_t i) {
      const auto rows = static_cast<std::size_t>(pair.a.grid.counts()[1]);
      return pair.a.grid.coordinate({ static_cast<int>(i / rows), static_cast<int>(i % rows) });
    };
    std::size_t shared = 0;
    for (std::size_t i = 0; i < pair.a.grid.size(); ++i)
      if (mpm::testing::node_mass(pair.a.grid, i) > 0.0 && mpm::testing::node_mass(pair.b.grid, i) > 0.0 &&
          std::abs(place(i)[0]) < 0.25) {  // not at the edges of the upper block, where nodes look aslant
        const Vec2 slip = mpm::testing::node_vector(pair.b.grid, i) - mpm::testing::node_vector(pair.a.grid, i);
        RC_ASSERT(std::abs(slip[1] + gap / dt) < 1e-9 * speed);
        ++shared;
      }
    RC_ASSERT(shared == 5U);
  }));
}

TEST(FieldContact, CountsFieldsThatShareNoNode)
{
  Pair pair(0.35, 1000.0, 1000.0);  // more than the reach of both
  pair.a.to_grid(0.0);
  pair.b.to_grid(0.0);
  EXPECT_EQ(FieldContact().solve(pair.a.side(), pair.b.side(), 0.3, 0.0, 1e-3).skipped, 1U);
}

}  // namespace
}  // namespace geocontainer_mpm::contact::testing
