#pragma once
/// Private parameters of the release node: read at once, checked as a whole, refused with one line.

#include <ros/node_handle.h>
#include <xmlrpcpp/XmlRpcValue.h>

#include <string>
#include <vector>

#include "geocontainer_mpm/forecast/forecaster.h"
#include "geocontainer_mpm/ros/opening_conversion.h"
#include "geocontainer_mpm/ros/release_alarms.h"

namespace geocontainer_mpm::ros_bridge {

/// Dictionary `forecast`, with dictionaries `ensemble` and `advice` in it.
struct ForecastParameters {
  bool enabled = false;                   ///< run ahead at all
  forecast::ForecasterSettings settings;  ///< `horizon_s`, `interval_s`, `period_s`, ...; the advice is apart
  int members = 0;                        ///< `ensemble/members`; 0: no ensemble
  std::string distributions;              ///< `ensemble/distributions`: file of what is drawn
  /// `ensemble/scene_overrides`: on top of the scene's own, for a coarser grid.
  std::vector<std::string> ensemble_overrides;
  int seed = 1;              ///< `ensemble/seed`
  int ensemble_threads = 1;  ///< `ensemble/threads`
  bool advice_enabled = false;
  forecast::AdviceSettings advice;
};

struct NodeParameters {
  std::string scene;                         ///< path of the scene file; must be given
  std::vector<std::string> scene_overrides;  ///< `dotted.key=value`, applied to the scene before it is checked
  int threads = 2;                           ///< solver threads, 1 to 256; the result does not depend on it
  bool autostart = true;                     ///< follow the opening at once; otherwise wait for ~start

  OpeningJoints joints;  ///< `port_joint`, `starboard_joint`: names looked for in joint_states
  int queue_size =
      20000;  ///< opening samples kept while the solver is behind, 1 to 10 million; further ones are dropped

  double max_future_s = 1.0;      ///< a stamp further ahead of the clock than this is not believed, s, > 0
  double time_jump_back_s = 1.0;  ///< the clock going back by more than this restarts the run, s, > 0
  /// Longest believable delay of a message between its sender and this node, wall-clock s, >= 0. So long a sample that
  /// contradicts the clock may wait for it, and so long a silence must last before it is taken for one.
  double transport_patience_s = 0.5;
  /// The log is over when the last sender of the opening has gone: the angle holds and the run goes on to its end.
  /// For replays; a live sender may come back.
  bool finish_when_source_leaves = false;

  std::string fixed_frame = "map";        ///< frame of all geometry that is published
  std::string barge_frame = "base_link";  ///< hinge axis midships, x forward, y port, z up
  double display_width_m = 3.0;           ///< length along x over which the section is drawn, m, > 0
  double publish_rate_hz = 10.0;          ///< most frequent output by the wall clock, Hz, (0, 1000]
  int soil_stride = 1;                    ///< every how manyth soil particle is published, >= 1

  std::string record;                 ///< HDF5 file to which every frame is written; empty: none
  std::string save_directory = ".";   ///< where ~save puts its files
  std::string checkpoint;             ///< HDF5 file of the state to go on from after a kill; empty: none
  double checkpoint_period_s = 10.0;  ///< wall-clock time between two of them, s, > 0
  double resume_within_s = 600.0;     ///< a log that goes on later after the checkpoint is another one, s, > 0
  double service_timeout_s = 5.0;     ///< longest wait of a service for the solver, s, > 0
  double diagnostic_period = 1.0;     ///< wall-clock time between diagnostics, s, > 0

  AlarmParameters alarms;
  ForecastParameters forecast;
};

/// `tree` is the struct of all private parameters, `source` the node's name for messages. Throws InputError for a key
/// that is missing, unknown, ill-typed or out of range.
NodeParameters parse_parameters(const XmlRpc::XmlRpcValue& tree, const std::string& source);

NodeParameters load_parameters(const ros::NodeHandle& private_handle);

}  // namespace geocontainer_mpm::ros_bridge
