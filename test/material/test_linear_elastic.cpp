#include <gtest/gtest.h>

#include "one_particle.h"

namespace geocontainer_mpm::material::testing {
namespace {

template <class Dimension>
class LinearElastic : public ::testing::Test {
};
using Dimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(LinearElastic, Dimensions);

// Oedometer: sigma = M ln(stretch), lateral stress nu / (1 - nu) of it.
template <int Dim>
double oedometer_error(int steps)
{
  const Parameters soil = elastic_soil();
  OneParticle<Dim> particle(soil);
  const double stretch = 0.7, step = std::pow(stretch, 1.0 / steps) - 1.0;
  Mat<Dim> h = Mat<Dim>::Zero();
  h(1, 1) = step;
  for (int i = 0; i < steps; ++i)
    particle.step(h);
  const Eigen::Matrix3d s = particle.stress();
  const double k0 = soil.poisson_ratio / (1.0 - soil.poisson_ratio);
  EXPECT_NEAR(s(0, 0) / s(1, 1), k0, 1e-12);
  EXPECT_NEAR(s(2, 2) / s(1, 1), k0, 1e-12);
  EXPECT_NEAR(particle.volume, stretch, 1e-12);
  EXPECT_EQ(particle.dissipated, 0.0);
  return std::abs(s(1, 1) / (constrained_modulus(soil) * std::log(stretch)) - 1.0);
}

TYPED_TEST(LinearElastic, OedometerFollowsTheLogarithmicStrainToSecondOrder)
{
  constexpr int Dim = TypeParam::value;
  const double coarse = oedometer_error<Dim>(10), fine = oedometer_error<Dim>(20);
  EXPECT_LT(fine, 5e-5);
  EXPECT_NEAR(coarse / fine, 4.0, 0.1);
}

// Simple shear of a Jaumann-rate law (Dienes 1979): shear stress G sin(gamma), normal stress +-G (1 - cos(gamma)).
template <int Dim>
double shear_error(int steps)
{
  const Parameters soil = elastic_soil();
  OneParticle<Dim> particle(soil);
  const double total = 1.5, g = shear_modulus(soil);
  Mat<Dim> h = Mat<Dim>::Zero();
  h(0, 1) = total / steps;
  for (int i = 0; i < steps; ++i)
    particle.step(h);
  Eigen::Matrix3d exact = Eigen::Matrix3d::Zero();
  exact(0, 1) = exact(1, 0) = g * std::sin(total);
  exact(0, 0) = g * (1.0 - std::cos(total));
  exact(1, 1) = -exact(0, 0);
  EXPECT_NEAR(particle.volume, 1.0, 1e-12);
  return (particle.stress() - exact).norm() / g;
}

TYPED_TEST(LinearElastic, SimpleShearWithLargeRotationConvergesToTheClosedForm)
{
  constexpr int Dim = TypeParam::value;
  const double coarse = shear_error<Dim>(50), fine = shear_error<Dim>(100);
  EXPECT_LT(fine, 1e-4);
  EXPECT_NEAR(coarse / fine, 4.0, 0.1);
}

TYPED_TEST(LinearElastic, StoresTheWorkDoneOnItAtSmallStrain)
{
  constexpr int Dim = TypeParam::value;
  OneParticle<Dim> particle(elastic_soil());
  Mat<Dim> h = Mat<Dim>::Zero();
  h(0, 0) = -1e-6;
  h(0, 1) = 2e-6;
  h(1, 1) = 3e-7;
  for (int i = 0; i < 10; ++i)
    particle.step(h);
  // By hand: W = V (lambda tr(e)^2 + 2 G e : e) / 2 with e = 10 sym(h); the volume changes it by the strain itself.
  const double e00 = -1e-5, e11 = 3e-6, e01 = 1e-5, young = 1e7, poisson = 0.3;
  const double g = young / (2.0 * (1.0 + poisson)),
               lambda = young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson));
  const double sum = e00 + e11;
  const double expected = 0.5 * lambda * sum * sum + g * (e00 * e00 + e11 * e11 + 2.0 * e01 * e01);
  EXPECT_NEAR(particle.elastic_energy / expected, 1.0, 1e-4);
  EXPECT_NEAR(particle.work / expected, 1.0, 1e-4);
}

TEST(ElasticConstants, AreThoseOfTheTextbook)
{
  Parameters soil = elastic_soil();
  EXPECT_NEAR(shear_modulus(soil), 1e7 / 2.6, 1e-6);
  EXPECT_NEAR(constrained_modulus(soil), 1e7 * 0.7 / (1.3 * 0.4), 1e-6);
  soil.poisson_ratio = 0.0;
  EXPECT_DOUBLE_EQ(constrained_modulus(soil), 1e7);
}

}  // namespace
}  // namespace geocontainer_mpm::material::testing
