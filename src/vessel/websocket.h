#pragma once
/// A WebSocket, plain or over TLS, on a thread that runs an io_context. Keeps Beast in one source file.

#include <boost/asio/io_context.hpp>
#include <chrono>
#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

namespace geocontainer_mpm::vessel {

struct WebSocketTarget {
  std::string host;
  int port = 0;
  std::string path;  ///< with query
  bool tls = false;
  std::string ca_file;                          ///< PEM; empty: the system's certificates
  std::string token;                            ///< bearer token; empty: none. Goes into one header and nowhere else
  std::chrono::milliseconds connect_timeout{};  ///< each of resolving with connecting, TLS, and the upgrade
  std::chrono::milliseconds idle_timeout{};     ///< nothing heard for so long, with pings in between, ends it
  std::size_t longest_message = 0;              ///< a longer one ends it
};

/// Called on the io_context's thread.
class WebSocketEvents {
public:
  virtual void opened() = 0;
  virtual void message(std::string_view text) = 0;
  virtual void written() = 0;
  virtual void closed(const std::string& why) = 0;  ///< the last one

protected:
  ~WebSocketEvents() = default;
};

class WebSocket {
public:
  virtual ~WebSocket() = default;
  virtual void send(std::string text) = 0;  ///< one at a time: written() must come before the next
  virtual void drop() = 0;                  ///< at once; no event follows
};

/// `events` must outlive closed() or drop().
std::shared_ptr<WebSocket> open_websocket(boost::asio::io_context& context, const WebSocketTarget& target,
                                          WebSocketEvents& events);

}  // namespace geocontainer_mpm::vessel
