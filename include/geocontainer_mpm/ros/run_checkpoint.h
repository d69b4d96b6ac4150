#pragma once
/// The state of a run on disk, from which a node that was killed goes on, and whether the log that is heard then is the
/// one it is of.

#include <cstdint>
#include <future>
#include <string>

#include "geocontainer_mpm/barge/opening_signal.h"
#include "geocontainer_mpm/scene/simulation.h"

namespace geocontainer_mpm::ros_bridge {

/// How a node begins.
struct Beginning {
  scene::Simulation simulation;
  bool found = false;    ///< there was a checkpoint, whatever became of it
  bool resumed = false;  ///< and it is used
  std::string what;      ///< which of the two and why, in one sentence; empty where none was found
};

/// The run in this checkpoint, or a new one where there is none, it had come to its end or it cannot be used; the file
/// is kept as `<path>.unused` then. An empty path: a new one. Throws InputError for a bad scene.
Beginning begin_or_resume(const scene::SceneDescription& scene, int threads, const std::string& path);

/// Keeps the newest state in a file. The bytes are made on the calling thread (HDF5's C library is used from one thread
/// only), which takes milliseconds; they are written to the disk, which may take any time, on another.
class RunCheckpoint {
public:
  /// An empty path keeps nothing. `period_s` is wall-clock time, and at least twenty times the processor time that the
  /// bytes take.
  RunCheckpoint(std::string path, double period_s);

  bool due(std::int64_t steady_ns) const { return !path_.empty() && steady_ns >= due_ns_; }
  /// Leaves it at what is there when the one before is still on its way to the disk or the run has not begun.
  void save(const scene::Simulation& simulation);
  void wait();       ///< until what was saved is on the disk
  void discard();    ///< the run was given up: nobody is to go on from it
  void set_aside();  ///< the same, but kept as `<path>.unused`

  const std::string& path() const { return path_; }
  const std::string& error();                ///< of the newest one; empty: none
  double time_s() const { return time_s_; }  ///< simulated instant of the newest one; < 0: none
  double cost_s() const { return cost_s_; }  ///< most that one has cost the run, processor time, s

private:
  void look_at_writer();

  std::string path_;
  std::int64_t period_ns_;
  std::int64_t due_ns_ = 0;  ///< steady clock
  std::future<std::string> writer_;
  std::string error_;
  double time_s_ = -1.0;
  double cost_s_ = 0.0;
};

/// Judges what is heard after a resume. Samples that the checkpoint's run knew are not given to it again, so that the
/// rest of the log will do as well as all of it.
class ResumedLog {
public:
  enum class Verdict {
    goes_on,  ///< a sample for the run
    known,    ///< from before the checkpoint
    another   ///< of another log: from before its beginning, or too long after it
  };

  ResumedLog() = default;  ///< nothing was resumed: every log goes on
  /// `longest_break_s`: between the last sample known and the first one heard.
  ResumedLog(const barge::OpeningSignal& saved, const barge::OpeningSignalParameters& believable,
             double longest_break_s);

  Verdict judge(const barge::OpeningSample& sample) const;
  bool too_late(std::int64_t now_ns) const;  ///< the clock alone says that it is another log
  void has_gone_on() { open_ = false; }      ///< a sample was accepted: later breaks are the run's own
  std::string contradiction() const;         ///< of another log, in one sentence

private:
  bool open_ = false;  ///< it is not yet known whether the log goes on
  std::int64_t first_ns_ = 0, last_ns_ = -1, latest_ns_ = 0;
  double lowest_rad_ = 0.0, highest_rad_ = 0.0;
};

}  // namespace geocontainer_mpm::ros_bridge
