#pragma once
/// A place where NMEA 0183 comes in and goes out: a UDP socket, a TCP server or a TCP client. It can be left alone: it
/// never makes its caller wait, holds a bounded number of sentences, and outlives whatever its peers do.

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "geocontainer_mpm/vessel/nmea0183.h"

namespace geocontainer_mpm::vessel {

class NmeaLink;

enum class NmeaTransport { udp, tcp_server, tcp_client };
const char* to_string(NmeaTransport transport);

struct NmeaPortParameters {
  NmeaTransport transport = NmeaTransport::udp;
  std::string address = "127.0.0.1";  ///< that is bound: loopback; `0.0.0.0` for every interface. Not of a TCP client
  int port = 0;                       ///< that is bound, 0 to 65535; 0: one that is free. Not of a TCP client
  std::string peer;                ///< address that is sent to (UDP; empty: nobody) or name connected to (TCP client)
  int peer_port = 0;               ///< 1 to 65535 where there is a peer
  double connect_timeout_s = 5.0;  ///< TCP client, s, > 0
  double idle_timeout_s = 0.0;     ///< TCP client: a peer silent for so long is connected to anew, s; 0: never
  double write_timeout_s = 10.0;   ///< TCP: a peer that takes nothing for so long is dropped, s, > 0
  double first_retry_s = 0.5;      ///< TCP client, s, > 0; doubled for each further failure
  double longest_retry_s = 30.0;   ///< s, not below first_retry_s

  /// Throws InputError with the key's name below `where`.
  void validate(const std::string& where) const;
};

struct NmeaPortHealth {
  NmeaCounts counts;  ///< of what came in
  std::uint64_t bytes_in = 0;
  std::uint64_t sent = 0;         ///< texts that a peer has taken
  std::uint64_t dropped = 0;      ///< texts given up: by each slow peer, or without a connection
  std::uint64_t connections = 0;  ///< TCP, since the start
  std::uint64_t failures = 0;     ///< connections and attempts that ended, peers that were refused
  std::size_t peers = 0;          ///< TCP, now
  std::string last_error;         ///< empty while there was none
};

class NmeaPort {
public:
  /// `on_sentence` is called on the port's own thread for every sentence with a right checksum; it must not throw, nor
  /// wait. Throws InputError, also for an address that cannot be bound.
  NmeaPort(const NmeaPortParameters& parameters, std::function<void(const Sentence&, NmeaCounts&)> on_sentence);
  ~NmeaPort();
  NmeaPort(const NmeaPort&) = delete;
  NmeaPort& operator=(const NmeaPort&) = delete;

  /// One or several whole sentences. Never waits; for a slow peer the oldest are given up.
  void send(std::string text);

  int bound_port() const;  ///< 0 of a TCP client
  NmeaPortHealth health() const;

private:
  std::unique_ptr<NmeaLink> link_;
};

}  // namespace geocontainer_mpm::vessel
