/// How a run comes to rest before it starts.

#include <algorithm>
#include <limits>

#include "simulation_state.h"

namespace geocontainer_mpm::scene {
namespace {

/// Settling under gravity: damping as part of the lowest frequency's critical value, how still is still enough, and
/// when to give up.
constexpr double settling_damping = 0.5;
constexpr double settled_part_of_rest_velocity = 0.25;
constexpr double settled_for_s = 0.1;
constexpr double longest_settling_s = 10.0;

}  // namespace

/// Damped steps at time zero with the hull closed until everything is still. False if that did not happen, or the
/// material slid further than `furthest_slide_m` on the way.
template <int Dim>
bool Run<Dim>::damp_to_rest(double furthest_slide_m)
{
  const std::vector<contact::RigidPose> closed = motion.poses(0.0, {});
  const double damping = 2.0 * settling_damping * model.fundamental_frequency();
  const double still = settled_part_of_rest_velocity * scene.numerics.rest_velocity_m_per_s;
  const Vec<Dim> from = model.centroid();
  double time = 0.0, moved = 0.0;
  while (time - moved < settled_for_s) {
    const double dt = model.stable_dt(0.0);
    if (!model.step({ 0.0, dt, closed, closed, damping }).ok || time > longest_settling_s ||
        (model.centroid() - from).norm() > furthest_slide_m)
      return false;
    time += dt;
    if (model.rms_velocity() > still)
      moved = time;
  }
  model.stop_motion();
  return true;
}

/// Lets bodies that ask for it come to rest under gravity with the hull closed: first held where they touch, then with
/// their true friction; where that cannot hold them, the held state is the start. A state that cannot
/// settle at all ends the run before it begins.
template <int Dim>
void Run<Dim>::settle()
{
  if (std::any_of(scene.bodies.begin(), scene.bodies.end(),
                  [](const auto& body) { return body.second.initial_stress == InitialStress::gravity; })) {
    const ModelState<Dim> raw = model.state();
    model.hold(true);
    damp_to_rest(std::numeric_limits<double>::infinity());
    model.hold(false);
    if (!model.state().health.ok) {
      progress.stopped = true;
      progress.failure = model.state().health.failure;
      progress.failure.reason = "while settling under gravity: " + progress.failure.reason;
      model.restore(raw);
    } else {
      const ModelState<Dim> held = model.state();
      if (!damp_to_rest(scene.grid.cell_size_m))
        model.restore(held);
    }
  }
  model.open_ledger();
}

template bool Run<2>::damp_to_rest(double);
template bool Run<3>::damp_to_rest(double);
template void Run<2>::settle();
template void Run<3>::settle();

}  // namespace geocontainer_mpm::scene
