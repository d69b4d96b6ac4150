#pragma once
/// Private parameters of vessel_link_node: read at once, checked as a whole, refused with one line. None holds a
/// secret.

#include <ros/node_handle.h>
#include <xmlrpcpp/XmlRpcValue.h>

#include <array>
#include <string>
#include <vector>

#include "geocontainer_mpm/vessel/nmea_angles.h"
#include "geocontainer_mpm/vessel/nmea_port.h"
#include "geocontainer_mpm/vessel/signalk_client.h"

namespace geocontainer_mpm::ros_bridge {

enum class AngleSource { none, nmea, signalk };

/// What pictures of the section show beside the geotextile, with the scene's names; nothing is computed from it.
struct VesselSection {
  std::string geotextile;                    ///< whose outline is sent; empty: every one that is heard
  std::array<double, 2> hinge_m = { 0, 0 };  ///< y, z in the barge's frame
  std::vector<std::array<double, 2>> port_section_m = {
    { 1.5, -4.3 }, { 0, -4.3 }, { 0, -3.9 }, { 2.5, -1.3 }, { 2.5, 0 }
  };                                 ///< y, z of the port half, closed; at least two points
  double bed_z_m = vessel::unknown;  ///< of the bed; not given: none is drawn

  vessel::Columns columns() const;
};

struct VesselSignalK {
  bool enabled = false;
  vessel::SignalKParameters server;
  std::string path_prefix = "cargo.geocontainer";  ///< of all that is sent
  double utilisation_warn = 0.8;                   ///< zones of the utilisation, > 0
  double utilisation_alarm = 1.0;                  ///< > utilisation_warn
  std::string port_path;                           ///< hull angles in, rad; not below path_prefix
  std::string starboard_path;
  VesselSection section;
  double max_age_s = 2.0;  ///< an angle whose stamp is further from this machine's clock is not believed, s, > 0
};

struct VesselNmeaPort {
  vessel::NmeaPortParameters port;
  bool receive = false;      ///< hull angles from here, with `hull_angles: nmea`
  bool send = false;         ///< the release as $PGCM
  bool send_angles = false;  ///< the opening in use as XDR; not with `hull_angles: nmea`: they could come back
};

struct VesselLinkParameters {
  AngleSource hull_angles = AngleSource::none;  ///< who measures: `none`, `nmea`, `signalk`
  double pair_within_s = 0.2;                   ///< port and starboard further apart are not one measurement, s, > 0
  std::string barge_frame = "base_link";        ///< frame_id of hull_opening
  bool send_replays = false;                    ///< under use_sim_time: send, marked as a replay, without alarms
  double diagnostic_period = 1.0;               ///< s, > 0
  VesselSignalK signalk;
  vessel::NmeaNames names;
  std::vector<VesselNmeaPort> nmea;
};

/// As parse_parameters() of release_node.
VesselLinkParameters parse_vessel_parameters(const XmlRpc::XmlRpcValue& tree, const std::string& source);

VesselLinkParameters load_vessel_parameters(const ros::NodeHandle& private_handle);

}  // namespace geocontainer_mpm::ros_bridge
