// A bar between rollers, fixed at one end, in its first mode: every discretisation keeps its frequency, and the
// sequences of transfer.h are what a driver does.

#include <cmath>

#include "choices.h"
#include "geocontainer_mpm/material/law.h"

namespace geocontainer_mpm::mpm::testing {
namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double dx = 0.1;
constexpr int length = 10;  // cells

class Bar {
public:
  explicit Bar(const Discretisation& choice)
      : choice_(choice)
      , grid_({ 0.0, 0.0 }, { (length + 2) * dx, dx }, dx,
              { FaceCondition::roller, FaceCondition::free, FaceCondition::roller, FaceCondition::roller })
  {
    material::Parameters elastic;
    elastic.density_kg_per_m3 = 1000.0;
    elastic.young_modulus_pa = 1e6;
    elastic.poisson_ratio = 0.2;
    law_ = material::make_law<2>(elastic);
    speed_ = std::sqrt(material::constrained_modulus(elastic) / elastic.density_kg_per_m3);
    particles_.resize(4 * length);
    for (std::size_t p = 0; p < particles_.size(); ++p) {
      // Off the diagonals of the cells, symmetric about their middles.
      particles_.position[0][p] = 0.5 * dx * (static_cast<double>(p / 2) + 0.5);
      particles_.position[1][p] = dx * (p % 2 == 0 ? 0.29 : 0.71);
      particles_.velocity[0][p] = 1e-4 * speed_ * mode(p);  // displacements of 1e-3 of a cell
      particles_.volume[p] = 0.25 * dx * dx;
      particles_.mass[p] = elastic.density_kg_per_m3 * particles_.volume[p];
    }
    Sorter<2>().sort(grid_, particles_, strips_);
  }
  double frequency() const { return 0.5 * pi * speed_ / (length * dx); }

  /// One step; returns the amplitude of the mode's velocity.
  double step(double dt)
  {
    open();
    if (choice_.update == UpdateOrder::usf) {
      scatter(Part::momentum);
      assemble();
      update_.velocities(choice_, grid_, alone_);
      gather(Gather::gradient, dt);
      advance_stress(dt);
      update_.momenta(choice_, grid_, alone_);
      scatter(Part::force);
      forces(dt);
      gather(Gather::motion, dt);
    } else {
      scatter(Part::all);
      assemble();
      forces(dt);
      if (choice_.update == UpdateOrder::usl) {
        gather(Gather::gradient, dt);
        smooth();
        gather(Gather::motion, dt);
      } else {
        gather(Gather::velocity, dt);
        grid_.keep_velocities(alone_);
        open();
        scatter(Part::momentum);
        update_.velocities(choice_, grid_, alone_);
        gather(Gather::gradient, dt);
        smooth();
        gather(Gather::position, dt);
      }
      law_->update(particles_.batch(), dt, 0, particles_.size());
    }
    double amplitude = 0.0;
    for (std::size_t p = 0; p < particles_.size(); ++p)
      amplitude += particles_.velocity[0][p] * mode(p);
    return amplitude;
  }
  double speed() const { return speed_; }

private:
  double mode(std::size_t p) const { return std::sin(0.5 * pi * particles_.position[0][p] / (length * dx)); }
  void open() { grid_.open(everything(grid_), alone_); }
  void scatter(Part part)
  {
    BodyTerms terms;
    terms.part = part;
    mpm::body_to_grid(choice_, particles_, strips_, terms, Vec2::Zero().eval(), grid_, alone_);
  }
  void assemble()
  {
    if (choice_.mass == MassMatrix::lumped)
      return;
    update_.mass().open(choice_.shape, grid_);
    update_.mass().add(particles_, strips_, grid_, alone_);
  }
  void forces(double dt)
  {
    update_.apply_forces(choice_, grid_, 0.5 * (last_ + dt), 0.0, alone_);
    update_.apply_faces(grid_);
    last_ = dt;
  }
  void gather(Gather what, double dt) { testing::gather(choice_, grid_, dt, what, particles_); }
  void smooth() { smooth_gradients(choice_, strips_, particles_, grid_, alone_); }
  void advance_stress(double dt)
  {
    smooth();
    law_->update(particles_.batch(), dt, 0, particles_.size());
  }

  Discretisation choice_;
  Grid<2> grid_;
  Particles<2> particles_;
  Strips strips_;
  GridUpdate<2> update_;
  ThreadTeam alone_{ 1 };
  std::unique_ptr<material::Law<2>> law_;
  double speed_ = 0.0, last_ = 0.0;
};

/// Measured over exact frequency, from the half periods between changes of sign; 0 if the motion dies or grows.
double frequency_ratio(const Discretisation& choice)
{
  Bar bar(choice);
  // A fifth of a lumped linear element's limit: nodes at the bar's end are reached by few particles. A consistent mass
  // has frequencies up to 1 / sqrt(lumped_part) = 10 times those of the lumped one.
  const double dt = (choice.mass == MassMatrix::lumped ? 0.2 : 0.06) * dx / bar.speed();
  double last = 0.0, first_zero = 0.0, last_zero = 0.0, largest = 0.0;
  int zeros = 0;
  const int steps = static_cast<int>(2.0 * 2.0 * pi / bar.frequency() / dt);
  for (int n = 0; n < steps; ++n) {
    const double now = bar.step(dt);
    if (n > 0 && now * last < 0.0) {
      last_zero = (n - now / (now - last)) * dt;
      first_zero = zeros++ == 0 ? last_zero : first_zero;
    }
    if (n > steps / 2)
      largest = std::max(largest, std::abs(now));
    last = now;
  }
  const double start = 1e-4 * bar.speed() * 4 * length / 2;  // sum of sin^2 over the particles is half their number
  if (zeros < 3 || largest < 0.5 * start || largest > 1.1 * start)
    return 0.0;
  return (zeros - 1) * pi / (last_zero - first_zero) / bar.frequency();
}

TEST(VibratingBar, KeepsItsFrequencyWithEveryChoice)
{
  for (const Shape shape : { Shape::bspline2, Shape::linear_simplex })
    for (const UpdateOrder update : { UpdateOrder::usl, UpdateOrder::usf, UpdateOrder::musl })
      for (const Smoothing smoothing : { Smoothing::none, Smoothing::cell_average, Smoothing::nodal_mixed })
        for (int transfer = 0; transfer < 4; ++transfer) {
          Discretisation choice = choice_of(shape, transfer == 0   ? Transfer::apic
                                                   : transfer == 3 ? Transfer::aflip
                                                                   : Transfer::flip);
          choice.update = update;
          choice.smoothing = smoothing;
          choice.mass = transfer == 2 ? MassMatrix::consistent : MassMatrix::lumped;
          if (transfer == 2 && smoothing != Smoothing::none)
            continue;  // nothing of one is in the other, and the solves take their time
          EXPECT_NEAR(frequency_ratio(choice), 1.0, 0.02)
              << "shape " << static_cast<int>(shape) << ", update " << static_cast<int>(update) << ", smoothing "
              << static_cast<int>(smoothing) << ", transfer " << transfer;
        }
}

}  // namespace
}  // namespace geocontainer_mpm::mpm::testing
