#pragma once
/// The driver: one scene, one opening signal, stepped. The ROS node and the `simulate` program use this class and
/// nothing else, so that a replay and an offline run agree bit for bit.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "geocontainer_mpm/barge/opening_signal.h"
#include "geocontainer_mpm/scene/description.h"
#include "geocontainer_mpm/scene/frame.h"
#include "geocontainer_mpm/state_access.h"

namespace geocontainer_mpm::scene {

/// What one call of advance() did.
enum class Advance {
  stepped,    ///< one or more steps or a jump over rest; call again
  frame_due,  ///< the same, and an output instant was reached: frame() is the one to keep
  waiting,    ///< the opening is not known far enough ahead yet: add samples, or tell the clock
  finished,   ///< end_s is reached
  stopped     ///< the solver had to stop; see failure()
};

/// What was not computed because the scene did not need it.
struct SkippedCounts {
  double resting_time_s = 0.0;         ///< simulated time jumped over at rest
  std::uint64_t contact_searches = 0;  ///< steps x boundaries in which no contact was looked for: bodies apart
  std::uint64_t grid_nodes = 0;        ///< nodes outside the active window, summed over steps
  std::uint64_t membrane_passes = 0;   ///< steps in which no segment was taut
};

/// Wall-clock seconds by stage, summed over steps.
struct StageTimes {
  double p2g_s = 0.0, forces_s = 0.0, contact_s = 0.0, membrane_s = 0.0, g2p_s = 0.0, material_s = 0.0, bound_s = 0.0;
};

struct RunCounters {
  std::uint64_t particles = 0;
  std::uint64_t steps = 0;
  double simulated_time_s = 0.0;
  double min_dt_s = 0.0, max_dt_s = 0.0;
  std::uint64_t retries = 0;    ///< how often steps were undone and taken again at half the length
  double momentum_error = 0.0;  ///< |momentum change - impulse of all forces| over the impulse that changed hands
  SkippedCounts skipped;
  StageTimes stages;
};

/// Why a run had to stop: what, where, when.
struct Failure {
  std::string reason;              ///< one sentence: cause, body, particle
  Vec3 position_m = Vec3::Zero();  ///< in the barge frame
  double time_s = 0.0;
};

/// The state of a run at one instant and the opening it knows, from which others go on. Does not change any more and is
/// cheap to hand over.
class Snapshot {
public:
  double time_s() const;
  const barge::OpeningSignal& opening() const;

private:
  friend class Simulation;

  struct State;
  explicit Snapshot(std::shared_ptr<const State> state);
  std::shared_ptr<const State> state_;
};

class Simulation {
public:
  /// Builds the scene (and settles it where bodies ask for gravity). Throws InputError for a bad scene or
  /// threads < 1.
  Simulation(const SceneDescription& scene, int threads);
  /// Goes on from a snapshot, bit for bit as the run it was taken of would. `scene` must be that run's, but for another
  /// `time.end_s`. May be called while that run goes on. reset() leads back to the snapshot's own beginning.
  Simulation(const SceneDescription& scene, int threads, const Snapshot& from);
  ~Simulation();
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;

  /// The opening history this run follows; feed it samples, tell it the clock or finish() it between advance() calls.
  /// A scene without a hull, or one run on its own opening table, has a finished signal from the start of
  /// use_scene_opening().
  barge::OpeningSignal& opening();
  const barge::OpeningSignal& opening() const;
  /// Follows the scene's own opening_table (or stays closed) instead of samples.
  void use_scene_opening();

  /// Does at most `max_steps` steps, never past the known opening; returns early at an output instant.
  Advance advance(int max_steps = 64);

  /// The last state that the run has found right: at rest the present one, else at most a few dozen steps back. None
  /// before the first frame. Costs a copy of the state.
  std::optional<Snapshot> snapshot() const;

  /// Back to the state after construction, bit for bit, with an empty opening signal.
  void reset();

  const SceneDescription& scene() const;
  double time_s() const;
  Frame frame() const;         ///< snapshot of the present state
  StatusFrame status() const;  ///< the cheap part of frame()
  EnergyFrame energy() const;
  std::optional<WaterFrame> water() const;  ///< of a scene with water
  RunCounters counters() const;
  /// What the scene's probes have measured since the start.
  const std::vector<ProbeFrame>& probes() const;
  const Failure& failure() const;  ///< meaningful after Advance::stopped
  /// 64-bit digest of the mechanical state (positions, velocities, stresses, tensions): equal bits, equal digest. Time
  /// is left out, so that a state at rest has one digest.
  std::uint64_t digest() const;

private:
  friend struct geocontainer_mpm::StateAccess;

  struct State;
  explicit Simulation(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

/// The summary of `simulate --summary` as JSON text (docs/how-to lists the keys). `wall_time_s` is the caller's.
std::string summary_json(const Simulation& simulation, double wall_time_s, int threads);

}  // namespace geocontainer_mpm::scene
