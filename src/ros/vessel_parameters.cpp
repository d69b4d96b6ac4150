#include "geocontainer_mpm/ros/vessel_parameters.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <utility>

#include "parameter_reader.h"

namespace geocontainer_mpm::ros_bridge {
namespace {

using vessel::NmeaTransport;
using XmlRpc::XmlRpcValue;

constexpr double unlimited = std::numeric_limits<double>::infinity();

/// Capital letters and digits, of a talker.
bool is_talker(const std::string& text)
{
  return text.size() == 2 && text.front() != 'P' &&
         std::all_of(text.begin(), text.end(), [](char c) { return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9'); });
}

/// A name of letters, digits, `_` and `-` that leaves room for its quadruple.
bool is_transducer(const std::string& text)
{
  return !text.empty() && text.size() <= 40 && std::all_of(text.begin(), text.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_' || c == '-';
  });
}

/// Names parted by single dots.
bool is_path(const std::string& text)
{
  return !text.empty() && text.size() <= 200 && text.front() != '.' && text.back() != '.' &&
         text.find("..") == std::string::npos && std::all_of(text.begin(), text.end(), [](unsigned char c) {
           return std::isalnum(c) != 0 || c == '.' || c == '_' || c == '-';
         });
}

bool is_below(const std::string& path, const std::string& prefix)
{
  return path == prefix || path.compare(0, prefix.size() + 1, prefix + ".") == 0;
}

void require(const ParameterReader& reader, bool right, const char* key, const std::string& value, const char* allowed)
{
  if (!right)
    reader.fail(key, XmlRpcValue(value), allowed);
}

AngleSource read_angle_source(ParameterReader& reader)
{
  std::string text = "none";
  reader.read("hull_angles", text);
  require(reader, text == "none" || text == "nmea" || text == "signalk", "hull_angles", text,
          "must be none, nmea or signalk");
  return text == "nmea" ? AngleSource::nmea : text == "signalk" ? AngleSource::signalk : AngleSource::none;
}

VesselSection read_section(ParameterReader reader)
{
  VesselSection section;
  std::vector<std::array<double, 2>> hinge = { section.hinge_m };
  reader.read("geotextile", section.geotextile);
  reader.read("hinge_m", hinge);
  reader.read("port_section_m", section.port_section_m);
  reader.read("bed_z_m", section.bed_z_m, -unlimited, unlimited);
  reader.refuse_unknown();
  require(reader, hinge.size() == 1, "hinge_m", "", "must be a list of one point [y, z], m");
  require(reader, section.port_section_m.size() >= 2, "port_section_m", "", "must have at least two points");
  section.hinge_m = hinge.front();
  return section;
}

VesselSignalK read_signalk(ParameterReader reader, AngleSource hull_angles, const std::string& source)
{
  VesselSignalK signalk;
  vessel::SignalKParameters& server = signalk.server;
  reader.read("enabled", signalk.enabled);
  reader.read("host", server.host);
  reader.read("port", server.port, 1, 65535);
  reader.read("tls", server.tls);
  reader.read("ca_file", server.ca_file);
  reader.read("token_file", server.token_file);
  reader.read("token_environment", server.token_environment);
  reader.read("token_in_clear", server.token_in_clear);
  reader.read("source", server.source);
  reader.read("connect_timeout_s", server.connect_timeout_s, 0.0, 3600.0);
  reader.read("idle_timeout_s", server.idle_timeout_s, 0.0, 3600.0);
  reader.read("first_retry_s", server.first_retry_s, 0.0, 3600.0);
  reader.read("longest_retry_s", server.longest_retry_s, 0.0, 3600.0);
  reader.read("confirm_within_s", server.confirm_within_s, 0.0, 3600.0);
  reader.read("path_prefix", signalk.path_prefix);
  reader.read("utilisation_warn", signalk.utilisation_warn, 0.0, unlimited);
  reader.read("utilisation_alarm", signalk.utilisation_alarm, signalk.utilisation_warn, unlimited);
  reader.read("port_path", signalk.port_path);
  reader.read("starboard_path", signalk.starboard_path);
  reader.read("max_age_s", signalk.max_age_s, 0.0, 3600.0);
  signalk.section = read_section(reader.dictionary("section"));
  reader.refuse_unknown();

  require(reader, is_path(signalk.path_prefix), "path_prefix", signalk.path_prefix,
          "must be a Signal K path: names of letters, digits, '_' and '-', parted by dots");
  if (hull_angles == AngleSource::signalk) {
    require(reader, signalk.enabled, "enabled", "", "must be true with hull_angles: signalk");
    for (const auto& [key, path] :
         { std::pair("port_path", signalk.port_path), std::pair("starboard_path", signalk.starboard_path) })
      require(reader, is_path(path) && !is_below(path, signalk.path_prefix), key, path,
              "must be a Signal K path, and not one that this node sends (below path_prefix)");
    require(reader, signalk.port_path != signalk.starboard_path, "starboard_path", signalk.starboard_path,
            "must differ from port_path");
  }
  if (signalk.enabled)
    server.validate(source + "/signalk");
  return signalk;
}

VesselNmeaPort read_port(ParameterReader& reader, AngleSource hull_angles, const std::string& source)
{
  VesselNmeaPort nmea;
  vessel::NmeaPortParameters& port = nmea.port;
  std::string transport;
  reader.read("transport", transport);
  require(reader, transport == "udp" || transport == "tcp_server" || transport == "tcp_client", "transport", transport,
          "must be udp, tcp_server or tcp_client");
  port.transport = transport == "udp"          ? NmeaTransport::udp
                   : transport == "tcp_server" ? NmeaTransport::tcp_server
                                               : NmeaTransport::tcp_client;
  reader.read("address", port.address);
  reader.read("port", port.port, 0, 65535);
  reader.read("peer", port.peer);
  reader.read("peer_port", port.peer_port, 1, 65535);
  reader.read("connect_timeout_s", port.connect_timeout_s, 0.0, 3600.0);
  reader.read("idle_timeout_s", port.idle_timeout_s, 0.0, 3600.0, true);
  reader.read("write_timeout_s", port.write_timeout_s, 0.0, 3600.0);
  reader.read("first_retry_s", port.first_retry_s, 0.0, 3600.0);
  reader.read("longest_retry_s", port.longest_retry_s, 0.0, 3600.0);
  reader.read("receive", nmea.receive);
  reader.read("send", nmea.send);
  reader.read("send_angles", nmea.send_angles);
  reader.refuse_unknown();

  require(reader, nmea.receive || nmea.send || nmea.send_angles, "receive", "",
          "one of receive, send and send_angles must be true");
  require(reader, !(nmea.send_angles && hull_angles == AngleSource::nmea), "send_angles", "",
          "must be false with hull_angles: nmea: what is sent could come back as a measurement");
  require(reader, port.transport != NmeaTransport::udp || !port.peer.empty() || !(nmea.send || nmea.send_angles),
          "peer", "", "must be given for UDP that sends");
  port.validate(source + "/nmea");
  return nmea;
}

}  // namespace

vessel::Columns VesselSection::columns() const
{
  vessel::Columns columns{ { "hinge", { hinge_m[0], hinge_m[1] } } };
  for (const auto& [y, z] : port_section_m) {
    columns["y"].push_back(y);
    columns["z"].push_back(z);
  }
  if (std::isfinite(bed_z_m))
    columns["bed"] = { bed_z_m };
  return columns;
}

VesselLinkParameters parse_vessel_parameters(const XmlRpcValue& tree, const std::string& source)
{
  VesselLinkParameters parameters;
  ParameterReader reader(tree, source);
  parameters.hull_angles = read_angle_source(reader);
  reader.read("pair_within_s", parameters.pair_within_s, 0.0, 60.0);
  reader.read("barge_frame", parameters.barge_frame);
  reader.read("send_replays", parameters.send_replays);
  reader.read("diagnostic_period", parameters.diagnostic_period, 0.0, 3600.0);
  parameters.signalk = read_signalk(reader.dictionary("signalk"), parameters.hull_angles, source);

  ParameterReader nmea = reader.dictionary("nmea");
  nmea.read("talker", parameters.names.talker);
  nmea.read("port_name", parameters.names.port);
  nmea.read("starboard_name", parameters.names.starboard);
  for (ParameterReader& port : nmea.dictionaries("ports"))
    parameters.nmea.push_back(read_port(port, parameters.hull_angles, source));
  nmea.refuse_unknown();
  reader.refuse_unknown();

  require(nmea, is_talker(parameters.names.talker), "talker", parameters.names.talker,
          "must be two capital letters or digits, not beginning with P");
  for (const auto& [key, name] :
       { std::pair("port_name", parameters.names.port), std::pair("starboard_name", parameters.names.starboard) })
    require(nmea, is_transducer(name), key, name, "must be 1 to 40 letters, digits, '_' and '-'");
  require(nmea, parameters.names.port != parameters.names.starboard, "starboard_name", parameters.names.starboard,
          "must differ from port_name");
  const bool receives = std::any_of(parameters.nmea.begin(), parameters.nmea.end(),
                                    [](const VesselNmeaPort& port) { return port.receive; });
  require(nmea, parameters.hull_angles != AngleSource::nmea || receives, "ports", "",
          "must have one that receives, with hull_angles: nmea");
  return parameters;
}

VesselLinkParameters load_vessel_parameters(const ros::NodeHandle& private_handle)
{
  XmlRpcValue tree;
  private_handle.getParam(private_handle.getNamespace(), tree);  // stays invalid when there is none at all
  return parse_vessel_parameters(tree, private_handle.getNamespace());
}

}  // namespace geocontainer_mpm::ros_bridge
