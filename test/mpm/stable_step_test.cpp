// The longest step of every order of update and transfer: one mode, and whole clouds with what their transfer keeps.

#include <gtest/gtest.h>

#include "dense_stiffness.h"

namespace geocontainer_mpm::mpm::testing {
namespace {

/// One mode with displacement u; V as it comes from the particles, v after the forces; p is what a transfer keeps.
struct Mode {
  double omega_square, rate, p;
  Discretisation method;

  /// Size after 4000 steps from size 1. apic is pic here, flip with a flip_fraction of 0.
  double amplitude(double dt) const
  {
    double u = 1.0, from_particles = 0.0, v = 0.0;
    for (int k = 0; k < 4000; ++k) {
      if (method.update == UpdateOrder::usf)
        u += dt * from_particles;
      // The viscous part is as old as the stress: for usf it is this step's own.
      const double seen = method.update == UpdateOrder::usl ? v : from_particles;
      v = from_particles - dt * (omega_square * u + rate * seen);
      from_particles =
          method.flip_fraction * (from_particles + p * (v - from_particles)) + (1.0 - method.flip_fraction) * p * v;
      if (method.update != UpdateOrder::usf)
        u += dt * (method.update == UpdateOrder::usl ? v : from_particles);
    }
    return std::abs(u) + dt * std::abs(from_particles);  // v itself is as large as p is small
  }
};

TEST(StableStep, HoldsForEveryLossInTheTransfer)
{
  EXPECT_TRUE(holds("mode", [](Chance& chance) {
    // From stiffness alone to viscosity alone.
    const double omega = std::pow(10.0, chance(-3.0, 3.0)), rate = omega * std::pow(10.0, chance(-4.0, 4.0));
    for (const UpdateOrder update : { UpdateOrder::usl, UpdateOrder::usf, UpdateOrder::musl })
      for (const double flip : { 0.0, chance(0.0, 1.0), 1.0 }) {
        Discretisation method;
        method.update = update;
        method.flip_fraction = flip;
        for (const Transfer transfer : { Transfer::apic, Transfer::flip }) {
          if (transfer == Transfer::apic && flip > 0.0)
            continue;
          method.transfer = transfer;
          const auto limit = [&](double p) {
            const double felt = feels_what_particles_hold(method) ? p : 1.0;
            return stable_step(felt * omega * omega, felt * rate, method);
          };
          // Just below the limit a mode beats, with an amplitude of 1 / sqrt(distance from the limit).
          const double any = chance(1e-3, 1.0), worst = update == UpdateOrder::usl ? 0.0 : 1.0;
          RC_ASSERT((Mode{ omega * omega, rate, any, method }.amplitude(0.99 * limit(any))) < 100.0);
          RC_ASSERT((Mode{ omega * omega, rate, worst, method }.amplitude(0.99 * limit(worst))) < 100.0);
          if (update == UpdateOrder::usl || flip == 1.0)
            RC_ASSERT(!(Mode{ omega * omega, rate, worst, method }.amplitude(1.01 * limit(worst)) < 1e4));
        }
      }
  }));
  Discretisation musl;
  musl.update = UpdateOrder::musl;
  EXPECT_DOUBLE_EQ(stable_step(4.0, 0.0, musl), 1.0);
  EXPECT_DOUBLE_EQ(stable_step(0.0, 4.0, musl), 0.5);
  EXPECT_DOUBLE_EQ(stable_step(2.0, 0.0, {}), 1.0);
}

TEST(StableStep, HoldsForCloudsAndSheetsWithTheirTransfer)
{
  const std::vector<Cloud> clouds = { { 1, 1 }, { 3, 2, 0.3, 0.2 }, { 3, 2, 0.3, 0.2, 30.0, 1.0 } };
  for (int seed = 0; seed < 4; ++seed)
    for (const Cloud& cloud : clouds)
      for (const Transfer transfer : { Transfer::apic, Transfer::flip, Transfer::aflip }) {
        Chance chance(static_cast<std::uint64_t>(seed));
        Setting<2> setting = make_setting<2>(chance, Shape::bspline2, 0.3, cloud);
        const double viscosity = std::sqrt(setting.elastic.constrained() * 1000.0) * setting.grid.dx() *
                                 (seed % 2 == 0 ? 0.0 : chance(0.01, 1.0));
        setting.viscous = { -2.0 / 3.0 * viscosity, viscosity };
        const Eigen::MatrixXd k = scaled_matrix(setting, setting.elastic, true);
        const Eigen::MatrixXd c = scaled_matrix(setting, setting.viscous, false);
        // On the nodes: what comes of the particles' velocities, and what of their affine matrices.
        const Eigen::MatrixXd own = kept(setting, Transfer::flip);
        const Eigen::MatrixXd affine =
            is_affine(transfer) ? (kept(setting, Transfer::apic) - own).eval() : (0.0 * own).eval();
        const double f = transfer == Transfer::apic ? 0.0 : transfer == Transfer::flip ? 1.0 : 0.25 * (seed + 1);
        const auto result = bound_of(setting);
        const auto grows = [&](double dt) {
          Eigen::VectorXd u = Eigen::VectorXd::Random(k.rows()), v = Eigen::VectorXd::Zero(k.rows());
          Eigen::VectorXd from_own = v, from_affine = v;
          const double start = u.norm();
          for (int step = 0; step < 1000 && u.norm() < 1e3 * start; ++step) {
            const Eigen::VectorXd from = from_own + from_affine;
            v = from - dt * (k * u + c * v);
            from_own = f * (from_own + own * (v - from)) + (1.0 - f) * (own * v);
            from_affine = affine * v;
            u += dt * v;
          }
          return !(u.norm() < 100.0 * start);
        };
        EXPECT_FALSE(grows(stable_step(result.frequency_square, result.damping_rate, {})));
        // One particle with flip keeps none of its strain rates: leapfrog's limit would be too long.
        if (cloud.cells == 1 && transfer == Transfer::flip && viscosity == 0.0) {
          EXPECT_TRUE(grows(1.02 * stable_step(result.frequency_square, result.damping_rate, {})));
        }
      }
}

}  // namespace
}  // namespace geocontainer_mpm::mpm::testing
