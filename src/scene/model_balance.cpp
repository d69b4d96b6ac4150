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

/// Stress times rate of strain, W/m^3.
template <int Dim>
double power_per_volume(const mpm::Particles<Dim>& particles, std::size_t p)
{
  const auto& s = particles.stress;
  const auto& l = particles.gradient;
  if constexpr (Dim == 2)
    return s[0][p] * l[0][p] + s[1][p] * l[3][p] + s[2][p] * (l[1][p] + l[2][p]);
  else
    return s[0][p] * l[0][p] + s[1][p] * l[4][p] + s[2][p] * l[8][p] + s[3][p] * (l[1][p] + l[3][p]) +
           s[4][p] * (l[2][p] + l[6][p]) + s[5][p] * (l[5][p] + l[7][p]);
}

}  // namespace

template <int Dim>
void Model<Dim>::open_ledger()
{
  now_.ledger = Ledger{};
  now_.water = WaterState<Dim>{};
  now_.ledger.plastic_at_start = plastic_work();
  now_.ledger.rupture_at_start = rupture_energy();
  now_.ledger.elastic_at_start = elastic_energy();
  now_.ledger.potential_at_start = potential_energy();
  now_.ledger.kinetic_at_start = now_.kinetic;
  now_.skipped = SkippedCounts{};
  stages_ = StageTimes{};
}

template <int Dim>
double Model<Dim>::rms_velocity() const
{
  return std::sqrt(2.0 * std::max(0.0, now_.kinetic) / (inertia_ - held(&LateStart::inertia)));
}

template <int Dim>
Vec<Dim> Model<Dim>::centroid() const
{
  Vec<Dim> moment = Vec<Dim>::Zero();
  double mass = 0.0;
  for (const Body& body : now_.bodies)
    for (std::size_t p = 0; p < body.particles.size(); ++p)
      moment += body.own_mass(p) * body.position(p);
  mass = soil_mass();
  if (now_.bodies.empty())
    for (const ModelSheet& sheet : now_.sheets) {
      const mpm::Particles<Dim>& nodes = sheet.sheet.nodes();
      for (std::size_t p = 0; p < nodes.size(); ++p)
        moment += nodes.mass[p] * nodes.position_of(p);
      mass += column_sum(nodes.mass);
    }
  return moment / mass;
}

template <int Dim>
double Model<Dim>::soil_mass() const
{
  double mass = 0.0;
  for (const Body& body : now_.bodies) {
    double sum = 0.0;
    for (std::size_t p = 0; p < body.particles.size(); ++p)
      sum += body.own_mass(p);
    mass += sum;
  }
  return mass;
}

template <int Dim>
double Model<Dim>::fundamental_frequency()
{
  // A quarter wave over the height of all that is there, at the slowest body's wave speed.
  double speed = std::numeric_limits<double>::infinity(), low = speed, high = -speed;
  for (Body& body : now_.bodies) {
    if (body.held)
      continue;
    mpm::Particles<Dim>& particles = body.particles;
    const double modulus = body.law->stiffness(particles.batch(), 0, particles.size()).constrained_modulus;
    speed = std::min(speed, std::sqrt(modulus * particles.volume[0] / particles.mass[0]));
    const mpm::Column& height = particles.position[z_axis<Dim>];
    const auto [lowest, highest] = std::minmax_element(height.begin(), height.end());
    low = std::min(low, *lowest);
    high = std::max(high, *highest);
  }
  return 0.5 * pi * speed / std::max(fields_.front().grid.dx(), high - low);
}

template <int Dim>
double Model<Dim>::elastic_energy() const
{
  double energy = 0.0;
  for (const Body& body : now_.bodies)
    energy += column_sum(body.particles.elastic_energy);
  for (const ModelSheet& sheet : now_.sheets)
    energy += sheet.sheet.elastic_energy();
  return energy;
}

template <int Dim>
double Model<Dim>::potential_energy() const
{
  double energy = 0.0;
  for (const Body& body : now_.bodies) {
    for (std::size_t p = 0; p < body.particles.size(); ++p)
      energy -= body.own_mass(p) * constant_gravity_.dot(body.position(p));
    if (water_)
      energy += water_->potential(body.particles, body.particle_height);
  }
  for (const ModelSheet& sheet : now_.sheets) {
    const mpm::Particles<Dim>& nodes = sheet.sheet.nodes();
    for (std::size_t p = 0; p < nodes.size(); ++p)
      energy -= nodes.weight_mass[p] * constant_gravity_.dot(nodes.position_of(p));
  }
  return energy;
}

/// Work of gravity per time at the velocities of the last step, J/(m s).
template <int Dim>
double Model<Dim>::gravity_power(const Vec<Dim>& gravity) const
{
  double power = 0.0;
  const auto add = [&](const mpm::Particles<Dim>& particles) {
    for (std::size_t p = 0; p < particles.size(); ++p)
      power += particles.weight_mass[p] * gravity.dot(particles.velocity_of(p));
  };
  for (const Body& body : now_.bodies)
    add(body.particles);
  for (const ModelSheet& sheet : now_.sheets)
    add(sheet.sheet.nodes());
  return power;
}

/// What stiffness-proportional damping takes at the velocity gradients of the last step, W/m.
template <int Dim>
double Model<Dim>::damping_power() const
{
  double power = 0.0;
  for (const Body& body : now_.bodies) {
    if (body.damping.lambda == 0.0 && body.damping.shear == 0.0)
      continue;
    for (std::size_t p = 0; p < body.particles.size(); ++p) {
      const Mat<Dim> gradient = body.gradient(p), rate = 0.5 * (gradient + gradient.transpose());
      const double trace = rate.trace();
      power += body.particles.volume[p] *
               (body.damping.lambda * trace * trace + 2.0 * body.damping.shear * rate.squaredNorm());
    }
  }
  return power;
}

template <int Dim>
double Model<Dim>::plastic_work() const
{
  double work = 0.0;
  for (const Body& body : now_.bodies)
    work += column_sum(body.particles.dissipated);
  return work;
}

/// What stresses store and dissipate at the velocity gradients of the last step, W/m.
template <int Dim>
double Model<Dim>::stress_power() const
{
  double power = 0.0;
  for (const Body& body : now_.bodies) {
    for (std::size_t p = 0; p < body.particles.size(); ++p)
      power += body.particles.volume[p] * power_per_volume(body.particles, p);
  }
  for (const ModelSheet& sheet : now_.sheets)
    power += sheet.sheet.stress_power();
  return power;
}

template <int Dim>
double Model<Dim>::rupture_energy() const
{
  double energy = 0.0;
  for (const ModelSheet& sheet : now_.sheets)
    energy += sheet.sheet.rupture_energy();
  return energy;
}

/// What tensions that follow from positions store, W/m. Membrane points are in stress_power().
template <int Dim>
double Model<Dim>::tension_power() const
{
  double power = 0.0;
  for (const ModelSheet& sheet : now_.sheets)
    power += sheet.sheet.tension_power();
  return power + sheet_drag_power();  // which the sheet does not tell from its tension
}

/// Velocities live at mid-steps, positions and stresses half a step later or, what the next step has yet to make of the
/// new positions, half a step earlier: what stresses store and dissipate and gravity gives within that half step, J/m.
/// With it the sum of energies is what leapfrog keeps, K + k u_n u_(n+1) / 2 for a spring, and not K + k u_(n+1)^2 / 2,
/// which swings by omega dt of it.
template <int Dim>
double Model<Dim>::half_step_work() const
{
  const double later = -1.0, earlier = 1.0;
  return 0.5 * now_.last_dt *
         (gravity_power(constant_gravity_) +
          (method_.update == mpm::UpdateOrder::usf ? earlier : later) * stress_power() +
          (on_grid_ ? later : earlier) * tension_power());
}

template <int Dim>
EnergyFrame Model<Dim>::energy() const
{
  EnergyFrame e;
  e.kinetic = now_.kinetic_known ? now_.kinetic : now_.ledger.kinetic_at_start;
  e.elastic = elastic_energy();
  e.potential = potential_energy();
  e.dissipated_plastic = plastic_work() - now_.ledger.plastic_at_start;
  e.dissipated_contact = now_.ledger.contact + now_.ledger.faces;
  e.dissipated_transfer = now_.ledger.transfer;
  e.dissipated_rupture = rupture_energy() - now_.ledger.rupture_at_start;
  e.dissipated_water = now_.ledger.water;
  e.dissipated = e.dissipated_plastic + e.dissipated_contact + e.dissipated_transfer + e.dissipated_rupture +
                 e.dissipated_water + now_.ledger.damped + now_.ledger.material_damping;
  e.work_in = now_.ledger.work_in;
  // The balance is struck where the velocities live, at mid-step.
  const double kinetic = e.kinetic - now_.ledger.kinetic_at_start;
  const double elastic = e.elastic - now_.ledger.elastic_at_start;
  const double potential = e.potential - now_.ledger.potential_at_start;
  const double exchanged = 0.5 * (std::abs(kinetic) + std::abs(elastic) + std::abs(potential) + std::abs(e.dissipated) +
                                  std::abs(e.work_in));
  e.unbalanced = kinetic + elastic + potential + half_step_work() + e.dissipated - e.work_in;
  e.relative_balance_error = exchanged > 0.0 ? std::abs(e.unbalanced) / exchanged : 0.0;
  return e;
}

template <int Dim>
double Model<Dim>::momentum_error() const
{
  return now_.ledger.momentum_exchanged > 0.0 ? now_.ledger.momentum_error / now_.ledger.momentum_exchanged : 0.0;
}

template <int Dim>
std::uint64_t Model<Dim>::digest() const
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
  const auto add_particles = [&](const mpm::Particles<Dim>& particles) {
    add_all(particles.position);
    add_all(particles.velocity);
    add_all(particles.affine);
    add_all(particles.stress);
    add_all(particles.deformation);
    add_all(particles.box);
    add(particles.volume);
    add(particles.separated_strain);
  };
  for (const Body& body : now_.bodies)
    add_particles(body.particles);
  for (const ModelSheet& sheet : now_.sheets) {
    add_particles(sheet.sheet.nodes());
    add(sheet.sheet.tension());
    if (sheet.sheet.ruptures() > 0)
      add(sheet.sheet.nodes().dissipated);  // of broken pieces alone not zero
  }
  return hash;
}

template class Model<2>;
template class Model<3>;

}  // namespace geocontainer_mpm::scene
