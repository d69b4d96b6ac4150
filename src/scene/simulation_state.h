#pragma once
/// The inside of Simulation: when to step, when to rest, when to undo.

#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "geocontainer_mpm/scene/changing_times.h"
#include "geocontainer_mpm/scene/model.h"
#include "geocontainer_mpm/scene/prescribed_motion.h"
#include "geocontainer_mpm/scene/probes.h"
#include "geocontainer_mpm/scene/release_watch.h"
#include "geocontainer_mpm/scene/simulation.h"
#include "geocontainer_mpm/state_access.h"

namespace geocontainer_mpm::scene {

template <int Dim>
struct Kept;

/// A run in plane strain or in space.
template <int Dim>
struct Run {
  /// What reset() restores, beside model, watch and probes.
  struct Progress {
    double time_s = 0.0;
    double dt_s = 0.0;
    double still_since_s = 0.0;  ///< everything has been slow since then
    bool resting = false;
    std::uint64_t next_frame = 0, next_sample = 0;
    double min_dt_s = 0.0, max_dt_s = 0.0;
    std::uint64_t steps = 0;
    double resting_time_s = 0.0;
    double interval_start_s = 0.0;
    std::vector<BoundaryTotal<Dim>> interval_start;  ///< per boundary body
    std::vector<Vec<Dim>> mean_force;                ///< over the last output interval, N/m; in space N
    std::uint64_t retries = 0;
    int halvings = 0;         ///< steps are shortened by this power of two
    double doubtful_s = 0.0;  ///< where a step went wrong last
    double wall_speed = 0.0;  ///< of rigid surfaces, the largest so far, m/s
    EnergyFrame start;        ///< the balance at the start
    double turnover = 0.0;    ///< the most energy that has changed hands since the start, J/m
    Failure failure;
    bool stopped = false;
  };
  /// The last state that was found right, with what its energy balance was.
  struct Checkpoint {
    ModelState<Dim> model;
    Progress progress;
    ReleaseWatch<Dim> watch;
    Probes<Dim> probes;
    EnergyFrame energy;
  };

  Run(const SceneDescription& description, int threads);
  /// The same but not settled, for a state that is to be put into it (load_checkpoint).
  struct Unsettled {};
  Run(const SceneDescription& description, int threads, Unsettled);

  /// The state to keep, if there is one: at rest no steps are taken and none need be undone.
  std::optional<Checkpoint> right_state() const;
  void go_on(Checkpoint state);

  barge::OpeningSignalParameters signal_parameters() const;
  /// Of a scene of which half is computed, the mean of both halves.
  barge::OpeningAngles angles_at(double time_s) const;
  void begin();
  std::optional<Kept<Dim>> keep() const;
  void go_on_from(const Kept<Dim>& kept);
  bool step_once(Advance& result);
  bool rest_on(Advance& result);

  SceneDescription scene;
  Model<Dim> model;
  barge::OpeningSignal opening;
  PrescribedMotion motion;
  ChangingTimes changes;
  ReleaseWatch<Dim> watch;
  Probes<Dim> probes;
  Progress progress;
  ModelState<Dim> settled;  ///< what reset() goes back to
  Probes<Dim> fresh_probes;
  Progress fresh_progress;

private:
  friend struct geocontainer_mpm::StateAccess;

  bool damp_to_rest(double furthest_slide_m);
  void settle();
  double output_time_s() const;
  double sample_time_s() const;
  void sample_if_due();
  bool output_reached();
  double still_for_s() const;
  double next_change_s(double time_s) const;
  double step_length(double stable_dt) const;
  std::optional<Failure> find_uneven(double time_s) const;
  std::optional<Failure> find_wrong(const StepInput& step, bool look);
  bool energy_jumped(const EnergyFrame& now);
  void save();
  Advance undo(const Failure& failure);
  void count_step(double dt);

  double explained_speed_ = 0.0;  ///< m/s, without rigid surfaces
  std::optional<Checkpoint> checkpoint_;
  int steps_since_checkpoint_ = 0;
};

/// A state of a run and all else that another one needs to go on from it.
template <int Dim>
struct Kept {
  typename Run<Dim>::Checkpoint now;
  barge::OpeningSignal opening;
  ModelState<Dim> settled;
  Probes<Dim> fresh_probes;
  typename Run<Dim>::Progress fresh_progress;
  double explained_speed;
};

struct Snapshot::State {
  std::variant<Kept<2>, Kept<3>> kept;
};

struct Simulation::State {
  std::variant<std::unique_ptr<Run<2>>, std::unique_ptr<Run<3>>> run;
  /// Calls `f` with the run, whichever it is.
  template <class F>
  decltype(auto) with(F&& f) const
  {
    return std::visit([&](const auto& is) -> decltype(auto) { return f(*is); }, run);
  }
};

}  // namespace geocontainer_mpm::scene
