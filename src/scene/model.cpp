#include "geocontainer_mpm/scene/model.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "geocontainer_mpm/mpm/transfer.h"

namespace geocontainer_mpm::scene {
namespace {

/// Adds the time since the last mark to a stage.
class StageClock {
public:
  void mark(double& stage_s)
  {
    const auto now = std::chrono::steady_clock::now();
    stage_s += std::chrono::duration<double>(now - last_).count();
    last_ = now;
  }

private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// Particles are handed to threads in pieces of this size; results do not depend on it.
constexpr std::size_t chunk = 512;

template <class Work>
void for_chunks(std::size_t count, mpm::ThreadTeam& team, Work&& work)
{
  team.for_each(static_cast<int>((count + chunk - 1) / chunk), [&](int c) {
    const std::size_t begin = static_cast<std::size_t>(c) * chunk;
    work(begin, std::min(count, begin + chunk));
  });
}

}  // namespace

void Model::survey()
{
  extent_lower_ = Vec2::Constant(std::numeric_limits<double>::infinity());
  extent_upper_ = -extent_lower_;
  double fastest_square = 0.0;
  const auto look_at = [&](const std::string& name, const mpm::Particles<2>& particles, bool has_volume) {
    Vec2 lower = extent_lower_, upper = extent_upper_;
    double sound = 0.0;  // stays zero, unless something is not finite: then NaN
    for (std::size_t p = 0; p < particles.size(); ++p) {
      const double y = particles.position[0][p], z = particles.position[1][p];
      const double vy = particles.velocity[0][p], vz = particles.velocity[1][p];
      lower = lower.cwiseMin(Vec2(y, z));
      upper = upper.cwiseMax(Vec2(y, z));
      const double square = vy * vy + vz * vz;
      fastest_square = std::max(fastest_square, square);
      sound += 0.0 * (y + z + square);
    }
    if (has_volume)
      for (std::size_t p = 0; p < particles.size(); ++p)
        sound += particles.volume[p] > 0.0 ? 0.0 * particles.volume[p] : std::numeric_limits<double>::quiet_NaN();
    extent_lower_ = lower;
    extent_upper_ = upper;
    const bool outside = (lower.array() < lower_.array()).any() || (upper.array() > upper_.array()).any();
    if ((sound == 0.0 && !outside) || !health_.ok)
      return;
    for (std::size_t p = 0; p < particles.size(); ++p) {
      const Vec2 x(particles.position[0][p], particles.position[1][p]);
      const Vec2 v(particles.velocity[0][p], particles.velocity[1][p]);
      const char* cause = !x.allFinite() || !v.allFinite()             ? "is not finite any more"
                          : has_volume && !(particles.volume[p] > 0.0) ? "has lost its volume"
                          : (x.array() < lower_.array()).any() || (x.array() > upper_.array()).any() ? "left the grid"
                                                                                                     : nullptr;
      if (cause) {
        health_.ok = false;
        health_.failure.reason = fmt::format("particle {} of {} {}", particles.id[p], name, cause);
        health_.failure.position_m = x.allFinite() ? x : Vec2::Zero();
        return;
      }
    }
  };
  for (const Body& body : bodies_)
    look_at(body.name, body.particles, true);
  for (const EnclosingSheet& sheet : sheets_)
    look_at(sheet.name, sheet.sheet.nodes(), false);
  fastest_ = std::sqrt(fastest_square);
}

void Model::transfer_to_grid()
{
  StageClock clock;
  if (!sorted_ || travel_since_sort_ > 0.9 * grid_.dx()) {
    for (Body& body : bodies_)
      sorter_.sort(grid_, body.particles, body.strips);
    sorted_ = true;
    travel_since_sort_ = 0.0;
  }
  mpm::Window<2> window;
  for (int d = 0; d < 2; ++d) {
    const auto base = [&](double x) {
      return static_cast<int>(std::floor((x - grid_.origin()[d]) * grid_.inverse_dx() - 0.5));
    };
    window.begin[static_cast<std::size_t>(d)] = base(extent_lower_[d]);
    window.end[static_cast<std::size_t>(d)] = base(extent_upper_[d]) + 3;
  }
  grid_.open(window, *team_);
  for (const Body& body : bodies_)
    mpm::body_to_grid(body.particles, body.strips, gravity_, grid_, *team_);
  clock.mark(stages_.p2g_s);
  bool taut = false;
  for (EnclosingSheet& sheet : sheets_) {
    taut = sheet.sheet.update_forces() || taut;
    mpm::sheet_to_grid(sheet.sheet.nodes(), gravity_, grid_);
  }
  if (!taut)
    ++skipped_.membrane_passes;
  skipped_.grid_nodes += grid_.size() - window.nodes();

  double frequency_square = 0.0;
  for (const Body& body : bodies_) {
    double volume_per_mass = 0.0;
    for (std::size_t p = 0; p < body.particles.size(); ++p)
      volume_per_mass = std::max(volume_per_mass, body.particles.volume[p] / body.particles.mass[p]);
    const double dt = mpm::stable_step<2>(body.constrained_modulus, body.shear_modulus, volume_per_mass, grid_.dx());
    frequency_square = std::max(frequency_square, 4.0 / (dt * dt));
  }
  for (EnclosingSheet& sheet : sheets_)
    frequency_square += sheet.sheet.frequency_bound(grid_);
  stable_dt_ = std::min(max_step_, time_step_factor_ * 2.0 / std::sqrt(frequency_square));
  if (fastest_ > 0.0)
    stable_dt_ = std::min(stable_dt_, max_travel_ / fastest_);
  clock.mark(stages_.membrane_s);
  on_grid_ = true;
}

double Model::stable_dt()
{
  if (!on_grid_)
    transfer_to_grid();
  return stable_dt_;
}

StepStatus Model::step(double dt, const std::vector<contact::RigidPose>& start,
                       const std::vector<contact::RigidPose>& end, double damping_per_s)
{
  if (!health_.ok)
    return health_;
  stable_dt();
  StageClock clock;

  // Leapfrog: velocities live at mid-steps.
  const double kick = 0.5 * (last_dt_ + dt);
  const mpm::MotionSums<2> sums = update_.apply_forces(grid_, kick, damping_per_s, *team_);
  if (kinetic_known_)
    ledger_.transfer += kinetic_ - sums.kinetic_before;
  else
    ledger_.kinetic_at_start = sums.kinetic_before;
  ledger_.damped += sums.damped;
  clock.mark(stages_.forces_s);

  for (std::size_t b = 0; b < boundaries_.size(); ++b)
    boundaries_[b].set_motion(start[b], end[b], dt);
  points_.clear();
  for (const Body& body : bodies_)
    if (!body.enclosed)
      points_.push_back({ &body.particles, true });
  for (const EnclosingSheet& sheet : sheets_)
    points_.push_back({ &sheet.sheet.nodes(), false });
  const contact::ContactSums contact = contact_.solve(boundaries_, points_, kick, dt, grid_, impulses_);
  for (const contact::BoundaryImpulse& impulse : impulses_)
    ledger_.work_in += impulse.work;
  ledger_.contact += contact.dissipated;
  skipped_.contact_searches += contact.skipped;
  const double taken = update_.apply_faces(grid_);
  ledger_.faces += taken;
  kinetic_ = sums.kinetic_after + contact.kinetic_change - taken;
  kinetic_known_ = true;
  if (!sums.touches_faces && damping_per_s == 0.0) {
    const Vec2 pull = kick * weight_mass_ * gravity_;
    ledger_.momentum_error += (sums.momentum_after - sums.momentum_before - pull).norm();
    ledger_.momentum_exchanged += pull.norm() + contact.impulse.norm();
  }
  clock.mark(stages_.contact_s);

  for (Body& body : bodies_)
    for_chunks(body.particles.size(), *team_, [&](std::size_t first, std::size_t last) {
      mpm::grid_to_particles(grid_, dt, true, body.particles, first, last);
    });
  for (EnclosingSheet& sheet : sheets_)
    mpm::grid_to_particles(grid_, dt, false, sheet.sheet.nodes(), 0, sheet.sheet.nodes().size());
  clock.mark(stages_.g2p_s);

  for (Body& body : bodies_) {
    const material::Batch<2> batch = body.particles.batch();
    for_chunks(body.particles.size(), *team_,
               [&](std::size_t first, std::size_t last) { body.law->update(batch, dt, first, last); });
  }
  clock.mark(stages_.material_s);

  last_dt_ = dt;
  on_grid_ = false;
  survey();
  travel_since_sort_ += fastest_ * dt;
  clock.mark(stages_.g2p_s);
  return health_;
}

void Model::stop_motion()
{
  const auto still = [](mpm::Particles<2>& particles) {
    for (auto* columns : { particles.velocity.data(), particles.velocity.data() + 1 })
      std::fill(columns->begin(), columns->end(), 0.0);
    for (mpm::Column& column : particles.affine)
      std::fill(column.begin(), column.end(), 0.0);
  };
  for (Body& body : bodies_)
    still(body.particles);
  for (EnclosingSheet& sheet : sheets_)
    still(sheet.sheet.nodes());
  ledger_.transfer += kinetic_;
  kinetic_ = 0.0;
  last_dt_ = 0.0;
  fastest_ = 0.0;
  on_grid_ = false;
}

}  // namespace geocontainer_mpm::scene
