#include "geocontainer_mpm/vessel/nmea_port.h"

#include <fmt/format.h>

#include <boost/asio/ip/address.hpp>
#include <utility>

#include "nmea_link.h"

namespace geocontainer_mpm::vessel {
namespace {

constexpr double longest_time_s = 3600.0;

bool is_address(const std::string& text)
{
  boost::system::error_code error;
  boost::asio::ip::make_address(text, error);
  return !error;
}

std::unique_ptr<NmeaLink> make_link(const NmeaPortParameters& parameters, NmeaLink::OnSentence on_sentence)
{
  switch (parameters.transport) {
    case NmeaTransport::udp:
      return make_udp_link(parameters, std::move(on_sentence));
    case NmeaTransport::tcp_server:
      return make_tcp_server_link(parameters, std::move(on_sentence));
    case NmeaTransport::tcp_client:
      break;
  }
  return make_tcp_client_link(parameters, std::move(on_sentence));
}

}  // namespace

void NmeaPortParameters::validate(const std::string& where) const
{
  const auto require = [&](bool right, const char* key, const std::string& value, const char* allowed) {
    if (!right)
      throw InputError(where, key, value, allowed);
  };
  const bool is_client = transport == NmeaTransport::tcp_client;
  require(is_client || is_address(address), "address", address, "must be an IP address of this machine");
  require(port >= 0 && port <= 65535, "port", fmt::format("{}", port), "must be a whole number from 0 to 65535");
  require(!is_client || !peer.empty(), "peer", peer, "must be given for a TCP client");
  require(transport != NmeaTransport::udp || peer.empty() || is_address(peer), "peer", peer, "must be an IP address");
  require(peer.empty() || (peer_port >= 1 && peer_port <= 65535), "peer_port", fmt::format("{}", peer_port),
          "must be a whole number from 1 to 65535");
  for (const auto& [key, seconds] :
       { std::pair("connect_timeout_s", connect_timeout_s), std::pair("write_timeout_s", write_timeout_s),
         std::pair("first_retry_s", first_retry_s), std::pair("longest_retry_s", longest_retry_s) })
    require(seconds > 0.0 && seconds <= longest_time_s, key, fmt::format("{}", seconds),
            "must be a number in (0, 3600]");
  require(idle_timeout_s >= 0.0 && idle_timeout_s <= longest_time_s, "idle_timeout_s",
          fmt::format("{}", idle_timeout_s), "must be a number in [0, 3600]");
  require(longest_retry_s >= first_retry_s, "longest_retry_s", fmt::format("{}", longest_retry_s),
          "must not be below first_retry_s");
}

const char* to_string(NmeaTransport transport)
{
  switch (transport) {
    case NmeaTransport::udp:
      return "UDP";
    case NmeaTransport::tcp_server:
      return "TCP server";
    case NmeaTransport::tcp_client:
      break;
  }
  return "TCP client";
}

NmeaPort::NmeaPort(const NmeaPortParameters& parameters, std::function<void(const Sentence&, NmeaCounts&)> on_sentence)
{
  parameters.validate("nmea");
  link_ = make_link(parameters, std::move(on_sentence));
  link_->run();
}

NmeaPort::~NmeaPort()
{
  link_->stop();
}

void NmeaPort::send(std::string text)
{
  link_->send(std::move(text));
}

int NmeaPort::bound_port() const
{
  return link_->bound_port();
}

NmeaPortHealth NmeaPort::health() const
{
  return link_->health();
}

}  // namespace geocontainer_mpm::vessel
