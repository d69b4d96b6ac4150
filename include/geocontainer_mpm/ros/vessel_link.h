#pragma once
/// Between the topics of release_node and the vessel's monitoring system: Signal K and NMEA 0183. A node of its own, so
/// that nothing that happens on the vessel's network reaches the solver.

#include <diagnostic_updater/diagnostic_updater.h>
#include <geocontainer_mpm/ReleaseStatus.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/subscriber.h>
#include <ros/wall_timer.h>

#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

#include "geocontainer_mpm/ros/vessel_parameters.h"
#include "geocontainer_mpm/vessel/opening_pair.h"

namespace geocontainer_mpm::ros_bridge {

vessel::ReleaseFigures to_figures(const ReleaseStatus& status);

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

  void open_signalk();
  void open_port(const VesselNmeaPort& parameters);
  void on_status(const ReleaseStatus& message);
  void on_sentence(Port& port, const vessel::Sentence& sentence, vessel::NmeaCounts& counts);
  void on_input(const vessel::IncomingValue& value);
  void publish(const vessel::OpeningSample& sample);
  void describe(Status& status);

  VesselLinkParameters parameters_;
  bool replay_;  ///< use_sim_time: what is heard is not happening now
  std::atomic<std::uint64_t> heard_{ 0 }, withheld_{ 0 }, published_{ 0 }, unbelieved_{ 0 };
  ros::Publisher opening_;
  vessel::OpeningPair signalk_pair_;
  vessel::SignalKHealth signalk_before_;
  diagnostic_updater::Updater updater_;
  // Their threads use all of the above: they end first.
  std::unique_ptr<vessel::SignalKClient> signalk_;
  std::vector<std::unique_ptr<Port>> ports_;
  ros::Subscriber status_;
  ros::WallTimer timer_;
};

}  // namespace geocontainer_mpm::ros_bridge
