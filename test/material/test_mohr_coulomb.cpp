#include <gtest/gtest.h>

#include <vector>

#include "random_input.h"

namespace geocontainer_mpm::material::testing {
namespace {

template <class Dimension>
class MohrCoulomb : public ::testing::Test {
};
using Dimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(MohrCoulomb, Dimensions);

struct Surface {
  Eigen::Vector3d gradient, flow;
  double limit;
};

// All six shear planes and three cut-offs, for principal stresses in any order.
std::vector<Surface> surfaces(const Parameters& p)
{
  const double k = slope(p.friction_angle_deg), k_flow = slope(p.dilation_angle_deg);
  std::vector<Surface> all;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j)
      if (i != j)
        all.push_back({ k * Eigen::Vector3d::Unit(i) - Eigen::Vector3d::Unit(j),
                        k_flow * Eigen::Vector3d::Unit(i) - Eigen::Vector3d::Unit(j),
                        2.0 * p.cohesion_pa * std::sqrt(k) });
    all.push_back({ Eigen::Vector3d::Unit(i), Eigen::Vector3d::Unit(i), p.tension_cutoff_pa });
  }
  return all;
}

// The least distance of `strain` from the non-negative sums of the columns of `basis`; its length if they are
// dependent.
template <int N>
double distance_from_sums(const Eigen::Vector3d& strain, const Eigen::Matrix<double, 3, N>& basis)
{
  const Eigen::Matrix<double, N, N> gram = basis.transpose() * basis;
  if (gram.determinant() < 1e-9 * std::pow(gram.trace(), N))
    return strain.norm();
  const Eigen::Matrix<double, N, 1> weights = gram.inverse() * (basis.transpose() * strain);
  return weights.minCoeff() >= -1e-9 * strain.norm() ? (basis * weights - strain).norm() : strain.norm();
}

// The same for any number of directions. By Caratheodory three of them are enough: try them all.
double distance_from_cone(const Eigen::Vector3d& strain, const std::vector<Eigen::Vector3d>& directions)
{
  double best = strain.norm();
  Eigen::Matrix<double, 3, 2> two;
  Eigen::Matrix3d three;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    best = std::min(best, distance_from_sums<1>(strain, directions[i]));
    for (std::size_t j = 0; j < i; ++j) {
      two << directions[i], directions[j];
      best = std::min(best, distance_from_sums<2>(strain, two));
      for (std::size_t l = 0; l < j; ++l) {
        three << directions[i], directions[j], directions[l];
        best = std::min(best, distance_from_sums<3>(strain, three));
      }
    }
  }
  return best;
}

// The whole definition of the return, on every plane, edge and point of the surface: the stress is admissible, and the
// plastic strain is a non-negative sum of the flow directions of the surfaces that the stress stands on.
TYPED_TEST(MohrCoulomb, ReturnIsAdmissibleAndFlowsByTheActiveSurfaces)
{
  constexpr int Dim = TypeParam::value;
  EXPECT_TRUE(rc::check("return", [] {
    const Parameters p = random_mohr_coulomb();
    const double size = *rc::gen::element(1e3, 1e5, 1e6);
    Eigen::Matrix3d trial = random_stress<Dim>(size);
    if (*rc::gen::element(0, 1, 2, 3) == 0)  // exactly on an edge of the trial space
      trial = Eigen::Vector3d(trial(0, 0), trial(0, 0), trial(2, 2)).asDiagonal();
    OneParticle<Dim> particle(p);
    particle.set_stress(trial);
    particle.step(Mat<Dim>::Zero());
    const Eigen::Matrix3d stress = particle.stress();
    const double scale = size + p.cohesion_pa;
    RC_ASSERT(yield_excess(p, stress) <= 1e-8 * scale);
    if (yield_excess(p, trial) <= 0.0) {
      RC_ASSERT((stress - trial).norm() <= 1e-10 * scale);
      return;
    }
    RC_ASSERT(yield_excess(p, stress) >= -1e-8 * scale);

    RC_ASSERT((stress * trial - trial * stress).norm() <= 1e-9 * scale * scale);
    // Principal values of trial and return pair up in order; the shear planes of that order and its ties are
    // active.
    const Eigen::Vector3d s = principal(stress), t = principal(trial), d = t - s;
    const double young = p.young_modulus_pa, poisson = p.poisson_ratio;
    const Eigen::Vector3d strain = ((1.0 + poisson) * d - poisson * d.sum() * Eigen::Vector3d::Ones()) / young;
    std::vector<Eigen::Vector3d> active;
    for (const Surface& surface : surfaces(p))
      if (surface.gradient.dot(s) >= surface.limit - 1e-8 * scale)
        active.push_back(surface.flow);
    RC_ASSERT(!active.empty());
    RC_ASSERT(distance_from_cone(strain, active) <= 1e-7 * strain.norm() + 1e-12 * scale / young);
  }));
}

TYPED_TEST(MohrCoulomb, ReturnsOnceAndForAll)
{
  constexpr int Dim = TypeParam::value;
  EXPECT_TRUE(rc::check("idempotent", [] {
    const Parameters p = random_mohr_coulomb();
    OneParticle<Dim> particle(p);
    particle.set_stress(random_stress<Dim>(1e5));
    particle.step(Mat<Dim>::Zero());
    const Eigen::Matrix3d once = particle.stress();
    for (int i = 0; i < 100; ++i)
      particle.step(Mat<Dim>::Zero());
    RC_ASSERT((particle.stress() - once).norm() <= 1e-7);
  }));
}

// Strains the particle axially (component 1) by `axial` while the lateral stress is held: in plane strain on component
// 0, in three dimensions, triaxially, on 0 and 2. Returns the lateral increment.
template <int Dim>
double compress(OneParticle<Dim>& particle, double axial, double lateral_stress)
{
  const auto strained = [&](double lateral) {
    Mat<Dim> h = Mat<Dim>::Zero();
    h(1, 1) = axial;
    h(0, 0) = lateral;
    if (Dim == 3)
      h(Dim - 1, Dim - 1) = lateral;
    OneParticle<Dim> moved = particle;
    moved.step(h);
    return moved;
  };
  double a = -0.1 * axial, b = -axial;
  double at_a = strained(a).stress()(0, 0) - lateral_stress, at_b = strained(b).stress()(0, 0) - lateral_stress;
  for (int i = 0; i < 100 && std::abs(at_b) > 1e-11 * std::abs(lateral_stress) && at_a != at_b; ++i) {
    const double next = b - at_b * (b - a) / (at_b - at_a);
    a = b;
    at_a = at_b;
    b = next;
    at_b = strained(b).stress()(0, 0) - lateral_stress;
  }
  particle = strained(b);
  return b;
}

double midpoint_strain(double h)
{
  return h / (1.0 + 0.5 * h);
}

TYPED_TEST(MohrCoulomb, CompressionTestGivesTheExactStrengthAndDilation)
{
  constexpr int Dim = TypeParam::value;
  for (const Parameters& soil : { sand(33.0, 0.0), sand(36.0, 6.0), clayey(25.0, 5.0), clayey(20.0, 20.0) }) {
    OneParticle<Dim> particle(soil);
    const double cell = -2e4;  // Pa
    particle.set_stress(cell * Eigen::Matrix3d::Identity());
    double axial = -2e-4, lateral = 0.0;
    for (int i = 0; i < 200; ++i)
      lateral = compress(particle, axial, cell);
    const double k = slope(soil.friction_angle_deg);
    const double strength = k * cell - 2.0 * soil.cohesion_pa * std::sqrt(k);
    EXPECT_NEAR(particle.stress()(1, 1) / strength, 1.0, 1e-8);
    const double e_axial = midpoint_strain(axial), e_lateral = midpoint_strain(lateral);
    if (Dim == 2) {
      const double sin_dilation = std::sin(soil.dilation_angle_deg * pi / 180.0);
      EXPECT_NEAR((e_lateral + e_axial) / (e_lateral - e_axial), sin_dilation, 1e-8);
    } else {
      EXPECT_NEAR((2.0 * e_lateral + e_axial) / -e_axial, slope(soil.dilation_angle_deg) - 1.0, 1e-7);
    }
    EXPECT_EQ(particle.bank, 0.0);  // dilation under load is not separation
    EXPECT_GT(particle.dissipated, 0.0);
  }
}

TYPED_TEST(MohrCoulomb, UniaxialCompressionFollowsElasticK0UntilActiveFailure)
{
  constexpr int Dim = TypeParam::value;
  Mat<Dim> h = Mat<Dim>::Zero();
  h(1, 1) = -1e-4;
  OneParticle<Dim> strong(sand(33.0));  // nu / (1 - nu) = 0.43 > 1 / k = 0.29: stays elastic
  Parameters weak_soil = sand(33.0);
  weak_soil.poisson_ratio = 0.1;  // 0.11 < 0.29: yields at once, lateral stress at the active limit
  OneParticle<Dim> weak(weak_soil);
  for (int i = 0; i < 100; ++i) {
    strong.step(h);
    weak.step(h);
  }
  EXPECT_NEAR(strong.stress()(0, 0) / strong.stress()(1, 1), 0.3 / 0.7, 1e-12);
  EXPECT_EQ(strong.dissipated, 0.0);
  EXPECT_NEAR(weak.stress()(0, 0) / weak.stress()(1, 1), 1.0 / slope(33.0), 1e-12);
  EXPECT_NEAR(weak.stress()(2, 2) / weak.stress()(1, 1), 1.0 / slope(33.0), 1e-12);
}

TYPED_TEST(MohrCoulomb, LargeSimpleShearSettlesAtTheFrictionAngle)
{
  constexpr int Dim = TypeParam::value;
  OneParticle<Dim> particle(sand(30.0, 0.0));
  particle.set_stress(-1e4 * Eigen::Matrix3d::Identity());
  Mat<Dim> h = Mat<Dim>::Zero();
  h(0, 1) = 1e-3;
  for (int i = 0; i < 3000; ++i)
    particle.step(h);
  // Coaxial without dilation: the planes of shearing carry sin(phi) of the in-plane mean stress, up to the elastic
  // strain.
  const Eigen::Matrix3d s = particle.stress();
  EXPECT_NEAR(s(0, 1) / (-0.5 * (s(0, 0) + s(1, 1))), 0.5, 2e-3);
  EXPECT_NEAR(s(0, 0) / s(1, 1), 1.0, 2e-2);
  EXPECT_NEAR(s(0, 0), -1e4, 3e3);
  EXPECT_NEAR(particle.volume, 1.0, 1e-11);
}

}  // namespace
}  // namespace geocontainer_mpm::material::testing
