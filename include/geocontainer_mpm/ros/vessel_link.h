#pragma once
/// Between the topics of release_node and the vessel's monitoring system: Signal K and NMEA 0183. A node of its own, so
/// that nothing that happens on the vessel's network reaches the solver.

#include <diagnostic_updater/diagnostic_updater.h>
#include <geocontainer_mpm/GeotextileForces.h>
#include <geocontainer_mpm/ReleaseEnsemble.h>
#include <geocontainer_mpm/ReleaseForecast.h>
#include <geocontainer_mpm/ReleaseStatus.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/subscriber.h>
#include <ros/wall_timer.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>

#include <Eigen/Geometry>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <vector>

#include "geocontainer_mpm/ros/vessel_parameters.h"
#include "geocontainer_mpm/vessel/alarms.h"
#include "geocontainer_mpm/vessel/opening_pair.h"

namespace geocontainer_mpm::ros_bridge {

vessel::ReleaseFigures to_figures(const ReleaseStatus& status);
vessel::ForecastFigures to_figures(const ReleaseForecast& forecast);
vessel::EnsembleFigures to_figures(const ReleaseEnsemble& ensemble);
std::vector<vessel::Alarm> to_alarms(const ReleaseStatus& status);
/// Of a geotextile in plane strain.
vessel::SectionFigures to_section(const GeotextileForces& forces, const Eigen::Isometry3d& to_barge);

/// Level, message and values of a diagnostic task; pure. `before` is what the period before ended with: only what is
/// new is a reason to warn.
void describe_signalk(const vessel::SignalKHealth& health, const vessel::SignalKHealth& before,
                      diagnostic_updater::DiagnosticStatusWrapper& status);
void describe_nmea_port(const vessel::NmeaPortHealth& health, const vessel::NmeaPortHealth& before,
                        vessel::NmeaTransport transport, int bound_port,
                        diagnostic_updater::DiagnosticStatusWrapper& status);

class VesselLink {
public:
  VesselLink(ros::NodeHandle node, const ros::NodeHandle& private_node);

private:
  using Status = diagnostic_updater::DiagnosticStatusWrapper;

  /// A port with what only its own thread uses.
  struct Port {
    VesselNmeaPort parameters;
    vessel::OpeningPair pair;
    vessel::NmeaPortHealth before;
    std::unique_ptr<vessel::NmeaPort> port;
  };

  void open_signalk(ros::NodeHandle& node);
  std::string notice_path(const std::string& name) const;
  bool withholds(bool replay) const;
  template <typename Source>
  void send(const std::vector<vessel::Figure<Source>>& table, const Source& figures);
  void open_port(const VesselNmeaPort& parameters);
  void on_status(const ReleaseStatus& message);
  void on_forces(const GeotextileForces& message);
  void on_sentence(Port& port, const vessel::Sentence& sentence, vessel::NmeaCounts& counts);
  void on_input(const vessel::IncomingValue& value);
  void publish(const vessel::OpeningSample& sample);
  void describe(Status& status);

  VesselLinkParameters parameters_;
  bool replay_;                ///< use_sim_time: what is heard is not happening now
  bool replay_heard_ = false;  ///< by release_node's own word
  std::atomic<std::uint64_t> heard_{ 0 }, withheld_{ 0 }, published_{ 0 }, unbelieved_{ 0 }, without_transform_{ 0 };
  ros::Publisher opening_;
  vessel::OpeningPair signalk_pair_;
  vessel::SignalKHealth signalk_before_;
  vessel::AlarmSentences alarm_sentences_;
  std::chrono::steady_clock::time_point next_outline_;
  tf2_ros::Buffer transforms_;
  tf2_ros::TransformListener listener_;
  diagnostic_updater::Updater updater_;
  // Their threads use all of the above: they end first.
  std::unique_ptr<vessel::SignalKClient> signalk_;
  std::vector<std::unique_ptr<Port>> ports_;
  ros::Subscriber status_, forecast_, ensemble_, forces_;
  ros::WallTimer timer_;
};

}  // namespace geocontainer_mpm::ros_bridge
