// Neo-Hookean and Hencky elasticity against closed forms at large strain.

#include <gtest/gtest.h>

#include "random_input.h"

namespace geocontainer_mpm::material::testing {
namespace {

template <class Dimension>
class FiniteStrain : public ::testing::Test {
};
using Dimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(FiniteStrain, Dimensions);

struct Lame {
  double lambda, mu;
};

Lame lame(const Parameters& p)
{
  return { constrained_modulus(p) - 2.0 * shear_modulus(p), shear_modulus(p) };
}

template <int Dim>
OneParticle<Dim> stretched(LawName law, double stretch, int steps)
{
  OneParticle<Dim> particle(finite(law));
  Mat<Dim> h = Mat<Dim>::Zero();
  h(1, 1) = std::pow(stretch, 1.0 / steps) - 1.0;
  for (int i = 0; i < steps; ++i)
    particle.step(h);
  return particle;
}

// In any number of steps: the stress is a function of F.
TYPED_TEST(FiniteStrain, UniaxialStrainOfNeoHookeanIsExact)
{
  constexpr int Dim = TypeParam::value;
  const auto [lambda, mu] = lame(finite(LawName::neo_hookean));
  for (const double stretch : { 0.3, 0.9, 1.000001, 2.5 })
    for (const int steps : { 1, 50 }) {
      const OneParticle<Dim> particle = stretched<Dim>(LawName::neo_hookean, stretch, steps);
      const double log = std::log(stretch);
      const Eigen::Matrix3d s = particle.stress();
      EXPECT_NEAR(s(1, 1), (lambda * log + mu * (stretch * stretch - 1.0)) / stretch, 1e-13 * 1e7 * 20);
      EXPECT_NEAR(s(0, 0), lambda * log / stretch, 1e-13 * 1e7 * 20);
      EXPECT_NEAR(s(2, 2), s(0, 0), 1e-13 * 1e7 * 20);
      const double energy = 0.5 * mu * (stretch * stretch - 1.0 - 2.0 * log) + 0.5 * lambda * log * log;
      EXPECT_NEAR(particle.elastic_energy, energy, 1e-13 * 1e7);
      EXPECT_NEAR(particle.volume, stretch, 1e-13);
    }
}

TYPED_TEST(FiniteStrain, UniaxialStrainOfHenckyIsExact)
{
  constexpr int Dim = TypeParam::value;
  const auto [lambda, mu] = lame(finite(LawName::hencky));
  for (const double stretch : { 0.3, 0.9, 1.000001, 2.5 })
    for (const int steps : { 1, 50 }) {
      const OneParticle<Dim> particle = stretched<Dim>(LawName::hencky, stretch, steps);
      const double log = std::log(stretch);
      const Eigen::Matrix3d s = particle.stress();
      EXPECT_NEAR(s(1, 1), (lambda + 2.0 * mu) * log / stretch, 1e-13 * 1e7 * 20);
      EXPECT_NEAR(s(0, 0), lambda * log / stretch, 1e-13 * 1e7 * 20);
      EXPECT_NEAR(s(2, 2), s(0, 0), 1e-13 * 1e7 * 20);
      EXPECT_NEAR(particle.elastic_energy, 0.5 * (lambda + 2.0 * mu) * log * log, 1e-13 * 1e7);
    }
}

// F = I + gamma e0 e1^T: B - I = [gamma^2, gamma; gamma, 0], J = 1.
TYPED_TEST(FiniteStrain, SimpleShearOfNeoHookeanIsExact)
{
  constexpr int Dim = TypeParam::value;
  const double gamma = 1.7, mu = lame(finite(LawName::neo_hookean)).mu;
  for (const int steps : { 1, 100 }) {
    OneParticle<Dim> particle(finite(LawName::neo_hookean));
    Mat<Dim> h = Mat<Dim>::Zero();
    h(0, 1) = gamma / steps;
    for (int i = 0; i < steps; ++i)
      particle.step(h);
    Eigen::Matrix3d exact = Eigen::Matrix3d::Zero();
    exact(0, 0) = mu * gamma * gamma;
    exact(0, 1) = exact(1, 0) = mu * gamma;
    EXPECT_NEAR((particle.stress() - exact).norm() / mu, 0.0, 1e-13);
    EXPECT_NEAR(particle.elastic_energy / (0.5 * mu * gamma * gamma), 1.0, 1e-13);
    EXPECT_NEAR(particle.volume, 1.0, 1e-14);
  }
}

// Principal stretches of simple shear: exp(+-asinh(gamma / 2)), the larger along an angle of atan(2 / gamma) / 2.
TYPED_TEST(FiniteStrain, SimpleShearOfHenckyIsExact)
{
  constexpr int Dim = TypeParam::value;
  const double gamma = 1.7, mu = lame(finite(LawName::hencky)).mu;
  OneParticle<Dim> particle(finite(LawName::hencky));
  Mat<Dim> h = Mat<Dim>::Zero();
  h(0, 1) = gamma;
  particle.step(h);
  const double strain = std::asinh(0.5 * gamma), twice = std::atan2(2.0, gamma);
  Eigen::Matrix3d exact = Eigen::Matrix3d::Zero();
  exact(0, 0) = 2.0 * mu * strain * std::cos(twice);
  exact(1, 1) = -exact(0, 0);
  exact(0, 1) = exact(1, 0) = 2.0 * mu * strain * std::sin(twice);
  EXPECT_NEAR((particle.stress() - exact).norm() / mu, 0.0, 1e-13);
  EXPECT_NEAR(particle.elastic_energy / (2.0 * mu * strain * strain), 1.0, 1e-13);
}

// The law's own logarithm and diagonalisation against Eigen's, from strains of rounding size to large ones, with equal
// and nearly equal stretches among them.
TYPED_TEST(FiniteStrain, HenckyAgreesWithTheMatrixLogarithm)
{
  constexpr int Dim = TypeParam::value;
  EXPECT_TRUE(rc::check("logarithm", [] {
    const auto [lambda, mu] = lame(finite(LawName::hencky));
    const double size = *rc::gen::element(1e-9, 1e-4, 0.1, 0.7);
    Mat<Dim> f = random_deformation<Dim>(size);
    if (*rc::gen::element(0, 1, 2) == 0) {  // stretches that (nearly) agree, turned
      const Mat<Dim> q = turn<Dim>(uniform(-3.0, 3.0), random_axis());
      Vec<Dim> stretches = Vec<Dim>::Constant(1.0 + uniform(-0.5, 0.5) * size);
      stretches[0] += *rc::gen::element(0.0, 1e-15, 1e-9, 0.3) * size;
      f = q * stretches.asDiagonal() * q.transpose();
    }
    OneParticle<Dim> particle(finite(LawName::hencky));
    particle.set_deformation(f);
    Eigen::Matrix3d full = Eigen::Matrix3d::Identity();
    full.topLeftCorner<Dim, Dim>() = f;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> b(full * full.transpose());
    const Eigen::Matrix3d e =
        b.eigenvectors() * (0.5 * b.eigenvalues().array().log()).matrix().asDiagonal() * b.eigenvectors().transpose();
    const Eigen::Matrix3d stress = (lambda * e.trace() * Eigen::Matrix3d::Identity() + 2.0 * mu * e) / f.determinant();
    // Rounding of B against its smallest eigenvalue, for which Eigen's own logarithm loses digits.
    const double condition = b.eigenvalues()[2] / b.eigenvalues()[0] / f.determinant();
    RC_ASSERT((particle.stress() - stress).norm() <= 3e-15 * condition * 10.0 * (lambda + 2.0 * mu));
  }));
}

// What a settled pile needs: at strains of 1e-7 the energy is right to nine digits, not lost in the rounding of tr B.
TYPED_TEST(FiniteStrain, SmallStrainsKeepTheirEnergy)
{
  constexpr int Dim = TypeParam::value;
  for (const LawName law : { LawName::neo_hookean, LawName::hencky }) {
    OneParticle<Dim> particle(finite(law));
    Mat<Dim> h = Mat<Dim>::Zero();
    h(0, 0) = -3e-7;
    h(1, 0) = 2e-7;
    particle.step(h);
    const auto [lambda, mu] = lame(finite(law));
    const double small = 0.5 * lambda * 9e-14 + mu * (9e-14 + 2e-14);
    EXPECT_NEAR(particle.elastic_energy / small, 1.0, 1e-6);  // third order: the strain itself
    EXPECT_NEAR(particle.stress()(0, 0) / (-3e-7 * (lambda + 2.0 * mu)), 1.0, 1e-6);
  }
}

TYPED_TEST(FiniteStrain, BothLawsAreLinearElasticityAtSmallStrain)
{
  constexpr int Dim = TypeParam::value;
  Mat<Dim> h = Mat<Dim>::Zero();
  h(0, 0) = -1e-6;
  h(0, 1) = 2e-6;
  h(1, 1) = 3e-7;
  OneParticle<Dim> linear(elastic_soil());
  linear.step(h);
  for (const LawName law : { LawName::neo_hookean, LawName::hencky }) {
    OneParticle<Dim> particle(finite(law));
    particle.step(h);
    EXPECT_NEAR((particle.stress() - linear.stress()).norm() / linear.stress().norm(), 0.0, 5e-6);  // second order
    EXPECT_NEAR(particle.elastic_energy / linear.elastic_energy, 1.0, 2e-5);
  }
}

TYPED_TEST(FiniteStrain, StartsFromAGivenDeformation)
{
  constexpr int Dim = TypeParam::value;
  for (const LawName law : { LawName::neo_hookean, LawName::hencky }) {
    OneParticle<Dim> moved(finite(law)), placed(finite(law));
    const Mat<Dim> f = Mat<Dim>::Identity() * 0.9 + 0.2 * Mat<Dim>::Ones();
    moved.step(f - Mat<Dim>::Identity());
    placed.set_deformation(f);
    EXPECT_NEAR((moved.stress() - placed.stress()).norm(), 0.0, 1e-7);
    EXPECT_NEAR(moved.elastic_energy, placed.elastic_energy, 1e-7);
    EXPECT_NEAR(placed.volume, f.determinant(), 1e-15);
  }
}

}  // namespace
}  // namespace geocontainer_mpm::material::testing
