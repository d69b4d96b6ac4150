#pragma once
/// The mechanical model of a scene: bodies, sheets and boundary bodies on one grid, and the MPM step that moves them.
/// Knows nothing of logs, outputs or outcomes; see simulation.h for those.

#include <memory>
#include <string>
#include <vector>

#include "geocontainer_mpm/contact/contact_solver.h"
#include "geocontainer_mpm/geotextile/sheet.h"
#include "geocontainer_mpm/mpm/grid.h"
#include "geocontainer_mpm/mpm/grid_update.h"
#include "geocontainer_mpm/mpm/sorting.h"
#include "geocontainer_mpm/scene/description.h"
#include "geocontainer_mpm/scene/simulation.h"

namespace geocontainer_mpm::scene {

struct Body {
  std::string name;
  mpm::Particles<2> particles;
  mpm::Strips strips;
  std::shared_ptr<const material::Law<2>> law;
  double constrained_modulus = 0.0, shear_modulus = 0.0;  ///< Pa, bound the wave speeds
  bool enclosed = false;                                  ///< a sheet is its surface
};

struct EnclosingSheet {
  std::string name;
  geotextile::Sheet sheet;
};

/// Energies that changed hands since the ledger was opened, per unit width, J/m, and what momentum did.
struct Ledger {
  double contact = 0.0, transfer = 0.0, faces = 0.0, damped = 0.0, work_in = 0.0;
  double plastic_at_start = 0.0, kinetic_at_start = 0.0, elastic_at_start = 0.0, potential_at_start = 0.0;
  double momentum_error = 0.0, momentum_exchanged = 0.0;  ///< N s / m, summed over steps away from faces
};

/// Result of one step: plain, no exceptions.
struct StepStatus {
  bool ok = true;
  Failure failure;
};

class Model {
public:
  /// Bodies, sheets and boundaries as described; throws InputError for what only building can find out.
  Model(const SceneDescription& scene, int threads);

  /// Longest stable step from the present state, s. Transfers to the grid on the way; idempotent until step().
  double stable_dt();
  /// One step of `dt` (at most stable_dt()). `start` and `end`: poses of the boundary bodies, in their order.
  StepStatus step(double dt, const std::vector<contact::RigidPose>& start, const std::vector<contact::RigidPose>& end,
                  double damping_per_s);
  /// While held, nothing that touches a boundary slides on it, whatever its friction.
  void hold(bool held) { contact_.hold(held); }
  /// Takes all velocity away: the model sleeps, and wakes from standstill.
  void stop_motion();
  /// Ends the initial settling: the ledger, counters and plastic work start from here.
  void open_ledger();

  const std::vector<Body>& bodies() const { return bodies_; }
  const std::vector<EnclosingSheet>& sheets() const { return sheets_; }
  const std::vector<contact::BoundaryBody>& boundaries() const { return boundaries_; }
  /// What each boundary body did in the last step.
  const std::vector<contact::BoundaryImpulse>& boundary_impulses() const { return impulses_; }
  /// Index of the first hull half in boundaries() (port, then starboard), or -1.
  int hull_index() const { return hull_index_; }

  double rms_velocity() const;           ///< by mass, of the last step, m/s
  Vec2 centroid() const;                 ///< of the bodies, by mass, m
  double soil_mass() const;              ///< kg/m
  double fundamental_frequency() const;  ///< rough lowest frequency of the bodies, rad/s: for settling
  EnergyFrame energy() const;
  double momentum_error() const;
  std::uint64_t digest() const;
  const SkippedCounts& skipped() const { return skipped_; }
  const StageTimes& stages() const { return stages_; }

private:
  void build_bodies(const SceneDescription& scene);
  void build_sheets(const SceneDescription& scene);
  void build_boundaries(const SceneDescription& scene);
  void survey();
  void transfer_to_grid();
  double elastic_energy() const;
  double potential_energy() const;
  double gravity_power() const;
  double plastic_work() const;

  std::shared_ptr<mpm::ThreadTeam> team_;  ///< shared by copies of the model: one steps at a time
  Vec2 gravity_;
  double time_step_factor_, max_step_, max_travel_;
  Vec2 lower_, upper_;
  mpm::Grid<2> grid_;
  mpm::GridUpdate<2> update_;
  mpm::Sorter<2> sorter_;
  contact::ContactSolver contact_;
  std::vector<Body> bodies_;
  std::vector<EnclosingSheet> sheets_;
  std::vector<contact::BoundaryBody> boundaries_;
  std::vector<contact::BoundaryImpulse> impulses_;
  std::vector<contact::ContactPoints> points_;  ///< scratch of step()
  int hull_index_ = -1;

  // From the last survey of the particles.
  Vec2 extent_lower_ = Vec2::Zero(), extent_upper_ = Vec2::Zero();
  double fastest_ = 0.0;  ///< m/s
  StepStatus health_;

  double travel_since_sort_ = 0.0;  ///< m
  bool sorted_ = false, on_grid_ = false;
  double stable_dt_ = 0.0, last_dt_ = 0.0;
  double kinetic_ = 0.0;  ///< on the grid after the last step, J/m
  bool kinetic_known_ = false;
  double weight_mass_ = 0.0;  ///< what gravity pulls in all, kg/m
  double inertia_ = 0.0;      ///< all mass, kg/m
  Ledger ledger_;
  SkippedCounts skipped_;
  StageTimes stages_;
};

}  // namespace geocontainer_mpm::scene
