// What holds for every law in both dimensions.

#include <gtest/gtest.h>

#include <vector>

#include "random_input.h"

namespace geocontainer_mpm::material::testing {
namespace {

template <LawName law, int dimension>
struct Case {
  static constexpr int Dim = dimension;
  static constexpr bool fluid = is_fluid(law);
  static constexpr bool finite_strain = law == LawName::neo_hookean || law == LawName::hencky;
  static constexpr bool rate_form = !fluid && !finite_strain;
  static constexpr LawName name = law;
  static Parameters random() { return random_parameters(law); }
};

template <class Case>
class EveryLaw : public ::testing::Test {
};
using Cases =
    ::testing::Types<Case<LawName::linear_elastic, 2>, Case<LawName::linear_elastic, 3>, Case<LawName::mohr_coulomb, 2>,
                     Case<LawName::mohr_coulomb, 3>, Case<LawName::neo_hookean, 2>, Case<LawName::neo_hookean, 3>,
                     Case<LawName::hencky, 2>, Case<LawName::hencky, 3>, Case<LawName::newtonian, 2>,
                     Case<LawName::newtonian, 3>, Case<LawName::bingham, 2>, Case<LawName::bingham, 3>>;
TYPED_TEST_SUITE(EveryLaw, Cases);

// Laws of rate form, which advance stress by increments.
template <class Case>
class RateLaw : public ::testing::Test {
};
using RateCases = ::testing::Types<Case<LawName::linear_elastic, 2>, Case<LawName::linear_elastic, 3>,
                                   Case<LawName::mohr_coulomb, 2>, Case<LawName::mohr_coulomb, 3>>;
TYPED_TEST_SUITE(RateLaw, RateCases);

// Laws with a stored energy of the deformation gradient.
template <class Case>
class FiniteStrainLaw : public ::testing::Test {
};
using FiniteStrainCases = ::testing::Types<Case<LawName::neo_hookean, 2>, Case<LawName::neo_hookean, 3>,
                                           Case<LawName::hencky, 2>, Case<LawName::hencky, 3>>;
TYPED_TEST_SUITE(FiniteStrainLaw, FiniteStrainCases);

// Laws whose stress is a function of the present state and rate: those, and the fluids.
template <class Case>
class StateLaw : public ::testing::Test {
};
using StateCases = ::testing::Types<Case<LawName::neo_hookean, 2>, Case<LawName::neo_hookean, 3>,
                                    Case<LawName::hencky, 2>, Case<LawName::hencky, 3>, Case<LawName::newtonian, 2>,
                                    Case<LawName::newtonian, 3>, Case<LawName::bingham, 2>, Case<LawName::bingham, 3>>;
TYPED_TEST_SUITE(StateLaw, StateCases);

template <int Dim>
Eigen::Matrix3d embed(const Mat<Dim>& q)
{
  Eigen::Matrix3d full = Eigen::Matrix3d::Identity();
  full.topLeftCorner<Dim, Dim>() = q;
  return full;
}

// The size of what rounds: a stress is a difference of moduli times strains of order 1 in a law that keeps F or V.
template <class Case>
double rounding_scale(const Parameters& p)
{
  return Case::rate_form ? stress_size_pa : Case::fluid ? p.bulk_modulus_pa : constrained_modulus(p);
}

// Round-off of 1000 steps: each rounds stress, or F, and the entries of the map, which so strains by 1e-16 itself.
TYPED_TEST(EveryLaw, TurnsItsStressWithARigidRotationInManySteps)
{
  constexpr int Dim = TypeParam::Dim;
  EXPECT_TRUE(rc::check("rigid rotation", [] {
    const Parameters parameters = TypeParam::random();
    OneParticle<Dim> particle = random_state<Dim>(parameters);
    const Eigen::Matrix3d start = particle.stress();
    const double volume = particle.volume, energy = particle.elastic_energy;
    const Mat<Dim> q = turn<Dim>(uniform(-0.1, 0.1), random_axis());
    Mat<Dim> total = Mat<Dim>::Identity();
    for (int i = 0; i < 1000; ++i) {
      particle.step(q - Mat<Dim>::Identity());
      total = q * total;
    }
    const double strain = 1000 * 4e-16,
                 modulus = constrained_modulus(parameters) + rounding_scale<TypeParam>(parameters);
    const Eigen::Matrix3d turned = embed<Dim>(total) * start * embed<Dim>(total).transpose();
    RC_ASSERT((particle.stress() - turned).norm() <= strain * (modulus + start.norm()));
    RC_ASSERT(std::abs(particle.volume / volume - 1.0) <= strain);
    const double stress = TypeParam::rate_form ? start.norm() + strain * modulus : modulus;
    RC_ASSERT(std::abs(particle.elastic_energy - energy) <= 2.0 * strain * stress);
    RC_ASSERT(std::abs(particle.dissipated) <= strain * stress);
  }));
}

TYPED_TEST(EveryLaw, AnswersTheSameInEveryFrame)
{
  constexpr int Dim = TypeParam::Dim;
  EXPECT_TRUE(rc::check("isotropy", [] {
    const Parameters parameters = TypeParam::random();
    OneParticle<Dim> here = random_state<Dim>(parameters);
    OneParticle<Dim> there = here;
    const Mat<Dim> q = turn<Dim>(uniform(-3.0, 3.0), random_axis());
    there.turn(q);
    for (int i = 0; i < 5; ++i) {
      const Mat<Dim> h = random_gradient<Dim>(2e-3);
      here.step(h);
      there.step(q * h * q.transpose());
    }
    const Eigen::Matrix3d full = embed<Dim>(q);
    const double scale = rounding_scale<TypeParam>(parameters);
    RC_ASSERT((there.stress() - full * here.stress() * full.transpose()).norm() <= 1e-12 * scale);
    RC_ASSERT(std::abs(there.volume - here.volume) <= 1e-14);
    RC_ASSERT(std::abs(there.bank - here.bank) <= 1e-14);
    RC_ASSERT(std::abs(there.elastic_energy - here.elastic_energy) <= 1e-13 * scale);
    RC_ASSERT(std::abs(there.dissipated - here.dissipated) <= 1e-13 * scale);
  }));
}

// A rotation before anything else is not seen by an isotropic law that remembers its reference shape.
TYPED_TEST(FiniteStrainLaw, DoesNotRememberHowItsReferenceWasTurned)
{
  constexpr int Dim = TypeParam::Dim;
  EXPECT_TRUE(rc::check("reference", [] {
    const Parameters parameters = TypeParam::random();
    OneParticle<Dim> plain(parameters), turned(parameters);
    const Mat<Dim> f = random_deformation<Dim>(0.4);
    plain.set_deformation(f);
    turned.set_deformation(f * turn<Dim>(uniform(-3.0, 3.0), random_axis()));
    const double scale = constrained_modulus(parameters);
    RC_ASSERT((plain.stress() - turned.stress()).norm() <= 1e-13 * scale);
    RC_ASSERT(std::abs(plain.elastic_energy - turned.elastic_energy) <= 1e-14 * scale);
  }));
}

TYPED_TEST(EveryLaw, NeverGivesEnergyAway)
{
  constexpr int Dim = TypeParam::Dim;
  EXPECT_TRUE(rc::check("dissipation", [] {
    const Parameters parameters = TypeParam::random();
    OneParticle<Dim> particle = random_state<Dim>(parameters);
    // What a Cauchy stress that is put on at one volume and taken off at another gives back beyond what was stored.
    double beyond = 0.0;
    for (int i = 0; i < 10; ++i) {
      const Mat<Dim> h = random_gradient<Dim>(2e-3);
      const double largest = particle.stress().squaredNorm(), volume = particle.volume;
      const Eigen::Matrix3d r = OneParticle<Dim>::rotation(h), old = r * particle.stress() * r.transpose();
      const double before = particle.dissipated;
      particle.step(h);
      // Only where a stress unloads and yields in one step the trapezoidal account may be negative, to second order: by
      // no more than stress increment times plastic strain increment.
      double slack = 0.0;
      if (TypeParam::name == LawName::mohr_coulomb) {
        const double change = (particle.stress() - old).norm();
        const double plastic = OneParticle<Dim>::strain(h).norm() + change / parameters.young_modulus_pa * 2.0;
        slack = 0.5 * change * plastic * 1.1 + 1e-16 * stress_size_pa;
      }
      RC_ASSERT(particle.dissipated - before >= -slack);
      if (!TypeParam::fluid && TypeParam::name != LawName::mohr_coulomb)
        RC_ASSERT(particle.dissipated == 0.0);
      if (TypeParam::rate_form)  // e = sigma : C^-1 : sigma / 2 is at most 3 / 4 of sigma : sigma / E
        beyond += 0.75 * std::max(largest, particle.stress().squaredNorm()) / parameters.young_modulus_pa *
                  std::abs(particle.volume - volume);
      RC_ASSERT(particle.elastic_energy >= -beyond);
    }
  }));
}

// The laws of rate form keep their account by the very trapezoidal rule of OneParticle::work: it closes to round-off.
TYPED_TEST(RateLaw, ClosesTheEnergyBalanceInAnySteps)
{
  constexpr int Dim = TypeParam::Dim;
  EXPECT_TRUE(rc::check("energy", [] {
    const Parameters parameters = TypeParam::random();
    OneParticle<Dim> particle = random_state<Dim>(parameters);
    const double start = particle.elastic_energy;
    double turnover = start;
    const int steps = *rc::gen::inRange(1, 30);
    for (int i = 0; i < steps; ++i) {
      const double before = particle.work;
      particle.step(random_gradient<Dim>(2e-3));
      turnover += std::abs(particle.work - before) + particle.elastic_energy;
    }
    const double residual = particle.work - (particle.elastic_energy - start) - particle.dissipated;
    RC_ASSERT(std::abs(residual) <= 1e-12 * turnover);
  }));
}

// Of the viscous stress at shear rates of `rate`, Pa.
double viscous_size(const Parameters& p, double rate)
{
  const double extra = p.law == LawName::bingham ? p.yield_stress_pa / p.regularisation_rate_per_s : 0.0;
  return 2.0 * (p.viscosity_pa_s + extra) * rate;
}

// Along a smooth path from a random state: residual of the balance with n steps.
template <class Case>
double balance_residual(OneParticle<Case::Dim> particle, const Mat<Case::Dim>& first, const Mat<Case::Dim>& second,
                        int n)
{
  using M = Mat<Case::Dim>;
  const double start = particle.elastic_energy, dt = 1.0 / n;
  for (int i = 0; i < n; ++i) {
    const double t = (i + 0.5) * dt;
    const M gradient = first * std::sin(pi * t) + second * std::sin(2.0 * pi * t);
    // The particle's map is I + dt L with L by start-of-step positions, of a flow whose gradient is by present ones.
    particle.step((M::Identity() - 0.5 * dt * gradient).inverse() * dt * gradient, dt);
  }
  return particle.work - (particle.elastic_energy - start) - particle.dissipated;
}

// Work is trapezoidal, stored energy exact: second order where stress is a function of the present state. The viscous
// stress of a step is that of its middle, so that the trapezoidal rule sees it half a step late: first order.
TYPED_TEST(StateLaw, ClosesTheEnergyBalanceOfASmoothPathAtItsOrder)
{
  constexpr int Dim = TypeParam::Dim;
  EXPECT_TRUE(rc::check("order", [] {
    const Parameters parameters = TypeParam::random();
    OneParticle<Dim> particle = random_state<Dim>(parameters);
    if (TypeParam::fluid)
      particle.set_volume(uniform(0.7, 0.85));  // stays under pressure: no kink
    const Mat<Dim> first = random_gradient<Dim>(0.1), second = random_gradient<Dim>(0.1);
    const double size = first.norm() + second.norm();
    const double scale = TypeParam::fluid ? parameters.bulk_modulus_pa : constrained_modulus(parameters);
    const auto residual = [&](int n) { return std::abs(balance_residual<TypeParam>(particle, first, second, n)); };
    // Errors of the trapezoidal rule: |stress''| |strain rate| dt^2 / 12 with moduli of a few times the scale here.
    for (const int n : { 50, 200 }) {
      double allowed = 2.0 * scale * size * size / (n * n) + 1e-13 * scale;
      if (TypeParam::fluid)
        allowed += 2.0 * viscous_size(parameters, size) * size * pi / n;
      RC_ASSERT(residual(n) <= allowed);
    }
  }));
}

// P = dW/dF with W per reference volume, sigma = P F^T / J; central differences.
TYPED_TEST(FiniteStrainLaw, StressIsTheDerivativeOfTheStoredEnergy)
{
  constexpr int Dim = TypeParam::Dim;
  EXPECT_TRUE(rc::check("hyperelastic", [] {
    const Parameters parameters = TypeParam::random();
    OneParticle<Dim> particle(parameters);
    const Mat<Dim> f = random_deformation<Dim>(*rc::gen::element(1e-6, 1e-2, 0.5));
    const double small = 1e-5;
    Mat<Dim> nominal;
    for (int i = 0; i < Dim; ++i)
      for (int j = 0; j < Dim; ++j) {
        const auto energy = [&](double offset) {
          Mat<Dim> moved = f;
          moved(i, j) += offset;
          particle.set_deformation(moved);
          return particle.elastic_energy;
        };
        nominal(i, j) = (energy(small) - energy(-small)) / (2.0 * small);
      }
    particle.set_deformation(f);
    const Mat<Dim> stress = nominal * f.transpose() / f.determinant();
    // Third derivatives times small^2 / 6, and round-off of the energies over small.
    const double scale = constrained_modulus(parameters) / std::pow(f.determinant(), 4);
    RC_ASSERT((particle.stress().template topLeftCorner<Dim, Dim>() - stress).norm() <= 1e-8 * scale);
    RC_ASSERT(std::abs(particle.volume - f.determinant()) <= 1e-14);
  }));
}

/// Components in the plane of motion, for a symmetric increment: 00, 11, (22,) 01, (02, 12).
template <int Dim>
constexpr int symmetric_size = Dim*(Dim + 1) / 2;

template <int Dim>
std::array<int, 2> component(int c)
{
  constexpr std::array<std::array<int, 2>, 6> all{ { { 0, 0 }, { 1, 1 }, { 2, 2 }, { 0, 1 }, { 0, 2 }, { 1, 2 } } };
  return all[static_cast<std::size_t>(Dim == 2 && c == 2 ? 3 : c)];
}

// How the stress after a step of a proportional path changes with that step, by central differences. Symmetric is that
// of the Kirchhoff stress where it has a potential, of the Cauchy stress in rate form. Mohr-Coulomb with an associated
// flow rule: also while it yields, but not while it is apart, where the bank decides.
TYPED_TEST(EveryLaw, HasASymmetricTangentInProportionalLoading)
{
  constexpr int Dim = TypeParam::Dim, size = symmetric_size<Dim>;
  EXPECT_TRUE(rc::check("tangent", [] {
    Parameters parameters = TypeParam::random();
    parameters.dilation_angle_deg = parameters.friction_angle_deg;
    OneParticle<Dim> particle(parameters);
    const Mat<Dim> random = random_gradient<Dim>(1e-3);
    const Mat<Dim> direction = 0.5 * (random + random.transpose()) - 5e-4 * Mat<Dim>::Identity();
    const double slowly = 1e9;  // viscosity does not show
    for (int i = 0; i < 20; ++i)
      particle.step(direction, slowly);
    const double small = 1e-9;
    const auto answer = [&](int c, double offset) {
      const auto [i, j] = component<Dim>(c);
      Mat<Dim> h = 1e-3 * direction;
      h(i, j) += 0.5 * offset;
      h(j, i) += 0.5 * offset;
      OneParticle<Dim> moved = particle;
      moved.step(h, slowly);
      const Eigen::Matrix3d s = moved.stress() * (TypeParam::rate_form ? 1.0 : moved.volume);
      Eigen::Matrix<double, size, 1> voigt;
      for (int row = 0; row < size; ++row)
        voigt[row] = s(component<Dim>(row)[0], component<Dim>(row)[1]);
      return voigt;
    };
    Eigen::Matrix<double, size, size> tangent;
    double bend = 0.0;  // between the sides
    for (int c = 0; c < size; ++c) {
      const auto less = answer(c, -small), here = answer(c, 0.0), more = answer(c, small);
      tangent.col(c) = (more - less) / (2.0 * small);
      bend = std::max(bend, (more - 2.0 * here + less).norm() / small);
    }
    const bool yields = particle.dissipated > 0.0, apart = particle.bank > 0.0;
    // Within `small` of where yielding begins, or of an edge of the yield surface, there is no one tangent.
    const bool kink = bend > 1e-4 * constrained_modulus(parameters);
    RC_CLASSIFY(yields);
    RC_CLASSIFY(apart);
    RC_CLASSIFY(kink);
    if (apart || kink)
      return;
    // Round-off of a stress over `small`, and the step's own strain, about 1e-6.
    RC_ASSERT((tangent - tangent.transpose()).norm() <= 1e-5 * constrained_modulus(parameters));
  }));
}

TYPED_TEST(EveryLaw, FollowsTheVolumeOfTheMap)
{
  constexpr int Dim = TypeParam::Dim;
  EXPECT_TRUE(rc::check("volume", [] {
    OneParticle<Dim> particle = random_state<Dim>(TypeParam::random());
    const double start = particle.volume;
    Mat<Dim> map = Mat<Dim>::Identity();
    for (int i = 0; i < 20; ++i) {
      const Mat<Dim> h = random_gradient<Dim>(2e-2);
      particle.step(h);
      map = (Mat<Dim>::Identity() + h) * map;
    }
    RC_ASSERT(std::abs(particle.volume / (start * map.determinant()) - 1.0) <= 1e-13);
    if (TypeParam::finite_strain)
      RC_ASSERT(std::abs(particle.volume / particle.deformation().determinant() - 1.0) <= 1e-14);
  }));
}

// Bit for bit, so that the number of threads cannot matter: whole or in pieces of any size and alignment.
TYPED_TEST(EveryLaw, DoesNotCareHowABatchIsSplit)
{
  constexpr int Dim = TypeParam::Dim;
  EXPECT_TRUE(rc::check("split", [] {
    constexpr std::size_t count = 301, square = Dim * Dim, arrays = 2 * square + stress_size<Dim> + 5;
    std::vector<std::vector<double>> whole(arrays, std::vector<double>(count));
    std::srand(*rc::gen::inRange(1u, 1000000u));
    const auto noise = [] { return 2.0 * std::rand() / RAND_MAX - 1.0; };
    for (std::size_t a = 0; a < arrays - 3; ++a)
      for (double& x : whole[a])
        x = a < square                          ? noise()
            : a < 2 * square                    ? 0.2 * noise() + ((a - square) % (Dim + 1) == 0 ? 1.0 : 0.0)
            : a < 2 * square + stress_size<Dim> ? 1e4 * noise()
                                                : 1.0 + 0.1 * noise();
    std::vector<std::vector<double>> pieces = whole;
    const auto view = [](std::vector<std::vector<double>>& data) {
      Batch<Dim> b{};
      std::size_t a = 0;
      for (auto& x : b.velocity_gradient)
        x = data[a++].data();
      for (auto& x : b.deformation)
        x = data[a++].data();
      for (auto& x : b.stress)
        x = data[a++].data();
      b.initial_volume = data[a++].data();
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
    Stiffness most{ 0.0, 0.0 };
    for (int i = 0; i < 4; ++i) {
      law->update(first, 1e-3, 0, count);
      most = {};
      for (std::size_t begin = 0; begin < count;) {
        const std::size_t end = std::min(count, begin + *rc::gen::inRange<std::size_t>(1, 140));
        law->update(second, 1e-3, begin, end);
        const Stiffness part = law->stiffness(second, begin, end);
        most.constrained_modulus = std::max(most.constrained_modulus, part.constrained_modulus);
        most.viscosity = std::max(most.viscosity, part.viscosity);
        begin = end;
      }
    }
    RC_ASSERT(whole == pieces);
    const Stiffness all = law->stiffness(first, 0, count);
    RC_ASSERT(all.constrained_modulus == most.constrained_modulus);
    RC_ASSERT(all.viscosity == most.viscosity);
  }));
}

}  // namespace
}  // namespace geocontainer_mpm::material::testing
