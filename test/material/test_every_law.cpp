// What holds for every law in both dimensions.

#include <gtest/gtest.h>

#include <vector>

#include "random_input.h"

namespace geocontainer_mpm::material::testing {
namespace {

template <LawName law, int dimension>
struct Case {
  static constexpr int Dim = dimension;
  static Parameters random()
  {
    if (law == LawName::mohr_coulomb)
      return random_mohr_coulomb();
    Parameters p = elastic_soil();
    p.poisson_ratio = uniform(0.0, 0.49);
    return p;
  }
};

template <class Case>
class EveryLaw : public ::testing::Test {
};
using Cases = ::testing::Types<Case<LawName::linear_elastic, 2>, Case<LawName::linear_elastic, 3>,
                               Case<LawName::mohr_coulomb, 2>, Case<LawName::mohr_coulomb, 3>>;
TYPED_TEST_SUITE(EveryLaw, Cases);

constexpr double stress_size_pa = 1e5;

// A random state that the law admits: one step at rest returns any other to it.
template <int Dim>
OneParticle<Dim> random_state(const Parameters& parameters)
{
  OneParticle<Dim> particle(parameters);
  particle.set_stress(random_stress<Dim>(stress_size_pa));
  particle.step(Mat<Dim>::Zero());
  particle.work = particle.dissipated = particle.volume_defect = 0.0;
  return particle;
}

TYPED_TEST(EveryLaw, TurnsItsStressWithARigidRotationInManySteps)
{
  constexpr int Dim = TypeParam::Dim;
  EXPECT_TRUE(rc::check("rigid rotation", [] {
    OneParticle<Dim> particle = random_state<Dim>(TypeParam::random());
    const Eigen::Matrix3d start = particle.stress();
    const double volume = particle.volume, energy = particle.elastic_energy;
    const Mat<Dim> q = turn<Dim>(uniform(-0.1, 0.1), random_axis());
    Eigen::Matrix3d total = Eigen::Matrix3d::Identity(), each = Eigen::Matrix3d::Identity();
    each.topLeftCorner<Dim, Dim>() = q;
    for (int i = 0; i < 1000; ++i) {
      particle.step(q - Mat<Dim>::Identity());
      total = each * total;
    }
    RC_ASSERT((particle.stress() - total * start * total.transpose()).norm() <= 1e-6 * start.norm() + 1e-5);
    RC_ASSERT(std::abs(particle.volume / volume - 1.0) <= 1e-12);
    RC_ASSERT(std::abs(particle.elastic_energy - energy) <= 1e-6 * energy + 1e-9);
  }));
}

TYPED_TEST(EveryLaw, AnswersTheSameInEveryFrame)
{
  constexpr int Dim = TypeParam::Dim;
  EXPECT_TRUE(rc::check("isotropy", [] {
    OneParticle<Dim> here = random_state<Dim>(TypeParam::random());
    OneParticle<Dim> there = here;
    const Mat<Dim> q = turn<Dim>(uniform(-3.0, 3.0), random_axis());
    Eigen::Matrix3d full = Eigen::Matrix3d::Identity();
    full.topLeftCorner<Dim, Dim>() = q;
    there.set_stress(full * here.stress() * full.transpose());
    for (int i = 0; i < 5; ++i) {
      const Mat<Dim> h = random_gradient<Dim>(2e-3);
      here.step(h);
      there.step(q * h * q.transpose());
    }
    RC_ASSERT((there.stress() - full * here.stress() * full.transpose()).norm() <= 1e-9 * stress_size_pa);
    RC_ASSERT(std::abs(there.volume - here.volume) <= 1e-13);
    RC_ASSERT(std::abs(there.bank - here.bank) <= 1e-9);
  }));
}

TYPED_TEST(EveryLaw, ClosesTheEnergyBalanceAndDissipates)
{
  constexpr int Dim = TypeParam::Dim;
  EXPECT_TRUE(rc::check("energy", [] {
    const Parameters parameters = TypeParam::random();
    OneParticle<Dim> particle = random_state<Dim>(parameters);
    const double start = particle.elastic_energy;
    const int steps = *rc::gen::inRange(1, 30);
    for (int i = 0; i < steps; ++i) {
      const Mat<Dim> h = random_gradient<Dim>(2e-3);
      const Eigen::Matrix3d r = OneParticle<Dim>::rotation(h), old = r * particle.stress() * r.transpose();
      const double dissipated = particle.dissipated;
      particle.step(h);
      // Second order: no more than stress increment times plastic strain increment.
      const double change = (particle.stress() - old).norm();
      const double plastic = OneParticle<Dim>::strain(h).norm() + change / parameters.young_modulus_pa * 2.0;
      RC_ASSERT(particle.dissipated - dissipated >= -0.5 * change * plastic * 1.1 - 1e-9);
    }
    const double residual =
        particle.work - (particle.elastic_energy - start) - particle.dissipated + particle.volume_defect;
    RC_ASSERT(std::abs(residual) <= 1e-9 * (std::abs(particle.work) + start + 1.0) + 1e-5 * std::abs(start));
  }));
}

TYPED_TEST(EveryLaw, FollowsTheVolumeOfTheMap)
{
  constexpr int Dim = TypeParam::Dim;
  EXPECT_TRUE(rc::check("volume", [] {
    OneParticle<Dim> particle = random_state<Dim>(TypeParam::random());
    Mat<Dim> map = Mat<Dim>::Identity();
    for (int i = 0; i < 20; ++i) {
      const Mat<Dim> h = random_gradient<Dim>(2e-2);
      particle.step(h);
      map = (Mat<Dim>::Identity() + h) * map;
    }
    RC_ASSERT(std::abs(particle.volume / map.determinant() - 1.0) <= 1e-12);
  }));
}

// Bit for bit, so that the number of threads cannot matter: whole or in pieces of any size and alignment.
TYPED_TEST(EveryLaw, DoesNotCareHowABatchIsSplit)
{
  constexpr int Dim = TypeParam::Dim;
  EXPECT_TRUE(rc::check("split", [] {
    const std::size_t count = 301, arrays = Dim * Dim + stress_size<Dim> + 4;
    std::vector<std::vector<double>> whole(arrays, std::vector<double>(count));
    const auto seed = *rc::gen::inRange(1u, 1000000u);
    std::srand(seed);
    const auto noise = [] { return 2.0 * std::rand() / RAND_MAX - 1.0; };
    for (std::size_t a = 0; a < arrays; ++a)
      for (double& x : whole[a])
        x = a < Dim * Dim ? noise() : a < arrays - 4 ? 1e4 * noise() : a == arrays - 4 ? 1.0 + 0.1 * noise() : 0.0;
    std::vector<std::vector<double>> pieces = whole;
    const auto view = [](std::vector<std::vector<double>>& data) {
      Batch<Dim> b{};
      std::size_t a = 0;
      for (auto& x : b.velocity_gradient)
        x = data[a++].data();
      for (auto& x : b.stress)
        x = data[a++].data();
      b.volume = data[a++].data();
      b.separated_strain = data[a++].data();
      b.elastic_energy = data[a++].data();
      b.dissipated = data[a++].data();
      return b;
    };
    const auto law = make_law<Dim>(TypeParam::random());
    const Batch<Dim> first = view(whole), second = view(pieces);
    law->initialise(first, 0, count);
    law->initialise(second, 0, count);
    for (int i = 0; i < 4; ++i) {
      law->update(first, 1e-3, 0, count);
      for (std::size_t begin = 0; begin < count;) {
        const std::size_t end = std::min(count, begin + *rc::gen::inRange<std::size_t>(1, 140));
        law->update(second, 1e-3, begin, end);
        begin = end;
      }
    }
    RC_ASSERT(whole == pieces);
  }));
}

TEST(PlaneStrainAgainstThreeDimensions, AgreeInStressVolumeBankAndEnergy)
{
  EXPECT_TRUE(rc::check("plane strain", [] {
    const Parameters parameters = *rc::gen::arbitrary<bool>() ? random_mohr_coulomb() : elastic_soil();
    OneParticle<2> flat(parameters);
    OneParticle<3> solid(parameters);
    const Eigen::Matrix3d start = random_stress<2>(3e4);
    flat.set_stress(start);
    solid.set_stress(start);
    for (int i = 0; i < 30; ++i) {
      const Mat<2> h = random_gradient<2>(3e-3);
      Mat<3> h3 = Mat<3>::Zero();
      h3.topLeftCorner<2, 2>() = h;
      flat.step(h);
      solid.step(h3);
    }
    RC_ASSERT((flat.stress() - solid.stress()).norm() <= 1e-4);
    RC_ASSERT(std::abs(flat.volume - solid.volume) <= 1e-13);
    RC_ASSERT(std::abs(flat.bank - solid.bank) <= 1e-10);
    RC_ASSERT(std::abs(flat.dissipated - solid.dissipated) <= 1e-7 * (1.0 + std::abs(flat.dissipated)));
  }));
}

}  // namespace
}  // namespace geocontainer_mpm::material::testing
