/// What the model adds up to: energies, momentum, digest.

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "geocontainer_mpm/scene/model.h"

namespace geocontainer_mpm::scene {
namespace {

constexpr double pi = 3.14159265358979323846;

double column_sum(const mpm::Column& column)
{
  double sum = 0.0;
  for (double value : column)
    sum += value;
  return sum;
}

}  // namespace

void Model::open_ledger()
{
  ledger_ = Ledger{};
  ledger_.plastic_at_start = plastic_work();
  ledger_.elastic_at_start = elastic_energy();
  ledger_.potential_at_start = potential_energy();
  ledger_.kinetic_at_start = kinetic_;
  skipped_ = SkippedCounts{};
  stages_ = StageTimes{};
}

double Model::rms_velocity() const
{
  return std::sqrt(2.0 * std::max(0.0, kinetic_) / inertia_);
}

Vec2 Model::centroid() const
{
  Vec2 moment = Vec2::Zero();
  for (const Body& body : bodies_)
    for (std::size_t p = 0; p < body.particles.size(); ++p)
      moment += body.particles.mass[p] * Vec2(body.particles.position[0][p], body.particles.position[1][p]);
  return moment / soil_mass();
}

double Model::soil_mass() const
{
  double mass = 0.0;
  for (const Body& body : bodies_)
    mass += column_sum(body.particles.mass);
  return mass;
}

double Model::fundamental_frequency() const
{
  // A quarter wave over the height of all that is there, at the slowest body's wave speed.
  double speed = std::numeric_limits<double>::infinity();
  for (const Body& body : bodies_)
    speed = std::min(speed, std::sqrt(body.constrained_modulus * body.particles.volume[0] / body.particles.mass[0]));
  return 0.5 * pi * speed / std::max(grid_.dx(), extent_upper_[1] - extent_lower_[1]);
}

double Model::elastic_energy() const
{
  double energy = 0.0;
  for (const Body& body : bodies_)
    energy += column_sum(body.particles.elastic_energy);
  for (const EnclosingSheet& sheet : sheets_)
    energy += sheet.sheet.elastic_energy();
  return energy;
}

double Model::potential_energy() const
{
  double energy = 0.0;
  const auto add = [&](const mpm::Particles<2>& particles) {
    for (std::size_t p = 0; p < particles.size(); ++p)
      energy -=
          particles.weight_mass[p] * (gravity_[0] * particles.position[0][p] + gravity_[1] * particles.position[1][p]);
  };
  for (const Body& body : bodies_)
    add(body.particles);
  for (const EnclosingSheet& sheet : sheets_)
    add(sheet.sheet.nodes());
  return energy;
}

/// Work of gravity per time at the velocities of the last step, J/(m s).
double Model::gravity_power() const
{
  double power = 0.0;
  const auto add = [&](const mpm::Particles<2>& particles) {
    for (std::size_t p = 0; p < particles.size(); ++p)
      power +=
          particles.weight_mass[p] * (gravity_[0] * particles.velocity[0][p] + gravity_[1] * particles.velocity[1][p]);
  };
  for (const Body& body : bodies_)
    add(body.particles);
  for (const EnclosingSheet& sheet : sheets_)
    add(sheet.sheet.nodes());
  return power;
}

double Model::plastic_work() const
{
  double work = 0.0;
  for (const Body& body : bodies_)
    work += column_sum(body.particles.dissipated);
  return work;
}

EnergyFrame Model::energy() const
{
  EnergyFrame e;
  e.kinetic = kinetic_known_ ? kinetic_ : ledger_.kinetic_at_start;
  e.elastic = elastic_energy();
  e.potential = potential_energy();
  e.dissipated_plastic = plastic_work() - ledger_.plastic_at_start;
  e.dissipated_contact = ledger_.contact + ledger_.faces;
  e.dissipated_transfer = ledger_.transfer;
  e.dissipated = e.dissipated_plastic + e.dissipated_contact + e.dissipated_transfer + ledger_.damped;
  e.work_in = ledger_.work_in;
  // Velocities live at mid-steps: the balance is struck there, gravity's work of the last half step taken back.
  const double kinetic = e.kinetic - ledger_.kinetic_at_start;
  const double elastic = e.elastic - ledger_.elastic_at_start;
  const double potential = e.potential + 0.5 * last_dt_ * gravity_power() - ledger_.potential_at_start;
  const double exchanged = 0.5 * (std::abs(kinetic) + std::abs(elastic) + std::abs(potential) + std::abs(e.dissipated) +
                                  std::abs(e.work_in));
  const double error = std::abs(kinetic + elastic + potential + e.dissipated - e.work_in);
  e.relative_balance_error = exchanged > 0.0 ? error / exchanged : 0.0;
  return e;
}

double Model::momentum_error() const
{
  return ledger_.momentum_exchanged > 0.0 ? ledger_.momentum_error / ledger_.momentum_exchanged : 0.0;
}

std::uint64_t Model::digest() const
{
  // FNV-1a over the bits of everything that the next step depends on; time itself is left out, so that a model at rest
  // has one digest however long it has rested.
  std::uint64_t hash = 14695981039346656037ULL;
  const auto add = [&](const mpm::Column& column) {
    for (double value : column) {
      std::uint64_t bits;
      std::memcpy(&bits, &value, sizeof bits);
      hash = (hash ^ bits) * 1099511628211ULL;
    }
  };
  const auto add_all = [&](const auto& columns) {
    for (const mpm::Column& column : columns)
      add(column);
  };
  const auto add_particles = [&](const mpm::Particles<2>& particles) {
    add_all(particles.position);
    add_all(particles.velocity);
    add_all(particles.affine);
    add_all(particles.stress);
    add(particles.volume);
    add(particles.separated_strain);
  };
  for (const Body& body : bodies_)
    add_particles(body.particles);
  for (const EnclosingSheet& sheet : sheets_) {
    add_particles(sheet.sheet.nodes());
    add(sheet.sheet.tension());
  }
  return hash;
}

}  // namespace geocontainer_mpm::scene
