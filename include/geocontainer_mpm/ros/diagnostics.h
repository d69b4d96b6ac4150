#pragma once
/// /diagnostics: how the simulation, the opening and the outputs are doing.

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>
#include <ros/wall_timer.h>

#include <functional>
#include <string>

#include "geocontainer_mpm/ros/outputs.h"
#include "geocontainer_mpm/ros/progress.h"
#include "geocontainer_mpm/ros/release_alarms.h"

namespace geocontainer_mpm::ros_bridge {

/// Level, message and values of one task; pure.
void describe_simulation(const Progress& progress, const std::string& scene_name, int threads,
                         diagnostic_updater::DiagnosticStatusWrapper& status);
/// `before` is what the period before ended with: only what is new is a reason to warn.
void describe_opening(const Progress& progress, const Progress& before, unsigned senders,
                      diagnostic_updater::DiagnosticStatusWrapper& status);
void describe_outputs(const OutputHealth& health, const OutputHealth& before,
                      diagnostic_updater::DiagnosticStatusWrapper& status);
/// The worst level, what is latched included. Those of a replay are shown and are no reason to warn.
void describe_alarms(const AlarmReport& report, diagnostic_updater::DiagnosticStatusWrapper& status);

struct DiagnosticSources {
  std::function<Progress()> progress;
  std::function<OutputHealth()> outputs;
  std::function<unsigned()> senders;
  std::function<AlarmReport()> alarms;
};

class Diagnostics {
public:
  Diagnostics(ros::NodeHandle& node, const ros::NodeHandle& private_node, double period_s, std::string scene_name,
              int threads, DiagnosticSources sources);

private:
  void simulation(diagnostic_updater::DiagnosticStatusWrapper& status);
  void opening(diagnostic_updater::DiagnosticStatusWrapper& status);
  void outputs(diagnostic_updater::DiagnosticStatusWrapper& status);
  void alarms(diagnostic_updater::DiagnosticStatusWrapper& status);

  std::string scene_name_;
  int threads_;
  DiagnosticSources sources_;
  Progress progress_before_;
  OutputHealth outputs_before_;
  diagnostic_updater::Updater updater_;
  ros::WallTimer timer_;  ///< wall time: a paused or looping clock must not silence the diagnostics
};

}  // namespace geocontainer_mpm::ros_bridge
