// Newtonian and Bingham fluid against closed forms.

#include <gtest/gtest.h>

#include "random_input.h"

namespace geocontainer_mpm::material::testing {
namespace {

template <class Dimension>
class Fluid : public ::testing::Test {
};
using Dimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(Fluid, Dimensions);

template <int Dim>
Mat<Dim> isotropic(double volume_ratio)
{
  return (std::pow(volume_ratio, 1.0 / Dim) - 1.0) * Mat<Dim>::Identity();
}

/// A time step so long that viscosity does not show: what is left is the equation of state.
constexpr double slowly = 1e15;

TYPED_TEST(Fluid, CompressionFollowsTheEquationOfStateAndStoresTheIntegralOfPressure)
{
  constexpr int Dim = TypeParam::value;
  for (const LawName law : { LawName::newtonian, LawName::bingham })
    for (const double ratio : { 1.0 - 1e-8, 0.999, 0.8, 0.3 }) {
      const double expansion = ratio - 1.0;
      OneParticle<Dim> particle(slurry(law)), placed(slurry(law));
      particle.set_volume(1.0);
      particle.step(isotropic<Dim>(ratio), slowly);
      placed.set_volume(ratio);
      const double pressure = 1e6 * (1.0 / ratio - 1.0);
      // K V0 (ln(V0 / V) - 1 + V / V0): its series where it cancels
      const double energy = expansion > -1e-6 ? 0.5e6 * expansion * expansion : 1e6 * (-std::log(ratio) - 1.0 + ratio);
      for (const OneParticle<Dim>& p : { particle, placed }) {
        // Rounding of the volume, of size 1, and at most 1 / ratio^2 of it in the pressure.
        EXPECT_NEAR((p.stress() + pressure * Eigen::Matrix3d::Identity()).norm(), 0.0, 1e-15 * 1e6 / (ratio * ratio));
        EXPECT_NEAR(p.elastic_energy / energy, 1.0, 5e-7);  // rounding of V at 1e-8, of the reference at 1e-3
      }
    }
}

TYPED_TEST(Fluid, DoesNotPullAndRemembersItsVolume)
{
  constexpr int Dim = TypeParam::value;
  EXPECT_TRUE(rc::check("no tension", [] {
    const Parameters fluid = random_parameters(*rc::gen::element(LawName::newtonian, LawName::bingham));
    OneParticle<Dim> particle(fluid);
    particle.set_volume(1.0);
    particle.step(isotropic<Dim>(1.0 + uniform(1e-6, 0.5)), slowly);
    for (int i = 0; i < 20; ++i) {  // any shape meanwhile
      particle.step(random_gradient<Dim>(1e-2), slowly);
      if (particle.volume > 1.0) {
        RC_ASSERT(particle.stress().norm() <= 1e-6);  // what viscosity leaves
        RC_ASSERT(particle.elastic_energy == 0.0);
      } else {
        RC_ASSERT(particle.stress().trace() < 0.0);
      }
    }
    particle.step(isotropic<Dim>(0.99 / particle.volume), slowly);
    RC_ASSERT(std::abs(particle.stress().trace() / (-3.0 * fluid.bulk_modulus_pa * (1.0 / 0.99 - 1.0)) - 1.0) <= 1e-10);
  }));
}

// Couette: dv_0/dx_1 = g. In small steps, so that the frame of a step does not turn.
template <int Dim>
OneParticle<Dim> couette(const Parameters& fluid, double rate, double dt, int steps)
{
  OneParticle<Dim> particle(fluid);
  particle.set_volume(1.0);
  Mat<Dim> h = Mat<Dim>::Zero();
  h(0, 1) = rate * dt;
  for (int i = 0; i < steps; ++i)
    particle.step(h, dt);
  return particle;
}

TYPED_TEST(Fluid, SteadyShearOfNewtonianGivesViscosityTimesRateAndDissipatesTheWork)
{
  constexpr int Dim = TypeParam::value;
  for (const double rate : { 1e-3, 1.0, 40.0 }) {
    const OneParticle<Dim> particle = couette<Dim>(slurry(LawName::newtonian), rate, 1e-7 / rate, 100);
    EXPECT_NEAR(particle.stress()(0, 1) / (2.0 * rate), 1.0, 1e-12);
    EXPECT_NEAR(particle.stress()(0, 0), 0.0, 1e-6 * rate);  // turned by half a step's angle
    EXPECT_NEAR(particle.dissipated / (2.0 * rate * rate * 1e-5 / rate), 1.0, 1e-10);
  }
}

TYPED_TEST(Fluid, SteadyShearOfBinghamGivesYieldStressAndPlasticViscosity)
{
  constexpr int Dim = TypeParam::value;
  const Parameters fluid = slurry(LawName::bingham);
  for (const double rate : { 1e-9, 1e-3, 0.05, 0.3, 1.0, 40.0 }) {
    const OneParticle<Dim> particle = couette<Dim>(fluid, rate, 1e-7 / rate, 100);
    // Papanastasiou (1987), eq. 2, simple shear
    const double exact =
        fluid.viscosity_pa_s * rate - fluid.yield_stress_pa * std::expm1(-rate / fluid.regularisation_rate_per_s);
    EXPECT_NEAR(particle.stress()(0, 1) / exact, 1.0, 1e-12);
    EXPECT_NEAR(particle.dissipated / (exact * 1e-5), 1.0, 1e-10);
  }
  // Well beyond the regularisation it is Bingham's own law.
  EXPECT_NEAR(couette<Dim>(fluid, 2.0, 1e-8, 1).stress()(0, 1), 50.0 + 2.0 * 2.0, 1e-6);
}

// Extension: no viscous part of the mean stress, three-dimensional deviator in plane strain too.
TYPED_TEST(Fluid, ExtensionMeetsTheDeviatorOnly)
{
  constexpr int Dim = TypeParam::value;
  OneParticle<Dim> particle(slurry(LawName::newtonian));
  particle.set_volume(2.0);
  Mat<Dim> h = Mat<Dim>::Zero();
  h(0, 0) = 1e-8;
  particle.step(h, 1e-8);  // rate 1 /s
  EXPECT_NEAR((particle.stress().diagonal() - 2.0 * 2.0 * Eigen::Vector3d(2.0, -1.0, -1.0) / 3.0).norm(), 0.0, 1e-7);
}

TYPED_TEST(Fluid, BinghamWithoutYieldStressIsNewtonian)
{
  constexpr int Dim = TypeParam::value;
  EXPECT_TRUE(rc::check("same bits", [] {
    Parameters newtonian = random_parameters(LawName::newtonian), bingham = newtonian;
    bingham.law = LawName::bingham;
    bingham.yield_stress_pa = 0.0;
    OneParticle<Dim> one(newtonian), other(bingham);
    one.set_volume(0.99);
    other.set_volume(0.99);
    for (int i = 0; i < 5; ++i) {
      const Mat<Dim> h = random_gradient<Dim>(1e-2);
      one.step(h);
      other.step(h);
    }
    RC_ASSERT(one.stress() == other.stress());
    RC_ASSERT(one.dissipated == other.dissipated);
  }));
}

}  // namespace
}  // namespace geocontainer_mpm::material::testing
