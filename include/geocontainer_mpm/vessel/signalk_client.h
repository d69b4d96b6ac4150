#pragma once
/// A Signal K client that can be left alone: it connects again for ever, never makes its caller wait, holds no more
/// than the newest value of each path, and says whether the server has really taken what was sent.

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "geocontainer_mpm/vessel/signalk_delta.h"

namespace geocontainer_mpm::vessel {

struct SignalKParameters {
  std::string host = "127.0.0.1";  ///< name or address of the server
  int port = 3000;                 ///< 1 to 65535
  bool tls = false;
  std::string ca_file;            ///< PEM file of the certificate to trust; empty: the system's
  std::string token_file;         ///< file whose first line is the bearer token, read for each connection; empty: none
  std::string token_environment;  ///< name of an environment variable with the token; empty: none
  bool token_in_clear = false;    ///< allow a token without TLS to another machine
  std::string source = "geocontainer_mpm";  ///< `$source` of all that is sent
  double connect_timeout_s = 5.0;           ///< until the server has said hello, s, > 0
  double idle_timeout_s = 10.0;             ///< a server that is silent for so long, also to pings, is given up, s, > 0
  double first_retry_s = 0.5;               ///< wait after the first failure, s, > 0; doubled for each further one
  double longest_retry_s = 30.0;            ///< s, not below first_retry_s
  double confirm_within_s = 5.0;            ///< a value that is not read back within this is unconfirmed, s, > 0

  /// Throws InputError with the key's name below `where`.
  void validate(const std::string& where) const;
};

enum class LinkState {
  connecting,
  waiting,  ///< for the next attempt
  open,     ///< the server has said hello
};
const char* to_string(LinkState state);

enum class Confirmation {
  nothing_sent,
  pending,      ///< sent, not yet read back
  confirmed,    ///< the newest value of every path that was sent was read back
  unconfirmed,  ///< something was not read back in time: security may have dropped it without a word
};
const char* to_string(Confirmation confirmation);

struct SignalKHealth {
  LinkState state = LinkState::connecting;
  Confirmation confirmation = Confirmation::nothing_sent;
  std::string last_error;           ///< never a secret; empty while there was none
  std::string oldest_unconfirmed;   ///< path; empty when none
  std::uint64_t connections = 0;    ///< that came as far as the hello
  std::uint64_t failures = 0;       ///< attempts and connections that ended
  std::uint64_t messages_sent = 0;  ///< deltas with values
  std::uint64_t values_sent = 0;
  std::uint64_t values_confirmed = 0;
  std::uint64_t values_replaced = 0;  ///< by newer ones before they could be sent
  std::uint64_t values_refused = 0;   ///< on paths that were not announced
  std::uint64_t values_received = 0;  ///< on input paths
  std::uint64_t bad_messages = 0;
};

class SignalKClient {
public:
  /// `announced`: all paths that will be sent. `inputs`: paths of this vessel that `on_input` is called for, on the
  /// client's own thread; it must not throw, nor wait. Own values that come back are not inputs. Throws InputError.
  SignalKClient(const SignalKParameters& parameters, std::vector<PathMeta> announced,
                const std::vector<std::string>& inputs, std::function<void(const IncomingValue&)> on_input);
  ~SignalKClient();  ///< within a fraction of a second, whatever the peer does
  SignalKClient(const SignalKClient&) = delete;
  SignalKClient& operator=(const SignalKClient&) = delete;

  /// Never waits for the network. A value that is still here when a newer one of its path comes is replaced.
  void send(const std::vector<PathValue>& values);

  SignalKHealth health() const;

private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// The token of these parameters, empty where none is configured. Throws InputError, which never quotes a token.
std::string read_token(const SignalKParameters& parameters, const std::string& where);

}  // namespace geocontainer_mpm::vessel
