#include "websocket.h"

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/ssl/context.hpp>
#include <boost/asio/ssl/host_name_verification.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http/field.hpp>
#include <boost/beast/ssl.hpp>
#include <boost/beast/websocket.hpp>
#include <boost/beast/websocket/ssl.hpp>
#include <string>
#include <type_traits>
#include <utility>

namespace geocontainer_mpm::vessel {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace websocket = beast::websocket;
using asio::ip::tcp;
using boost::system::error_code;

using Plain = beast::tcp_stream;
using Tls = beast::ssl_stream<beast::tcp_stream>;

asio::ssl::context tls_context(const std::string& ca_file)
{
  asio::ssl::context context(asio::ssl::context::tls_client);
  context.set_options(asio::ssl::context::default_workarounds | asio::ssl::context::no_tlsv1 |
                      asio::ssl::context::no_tlsv1_1);
  context.set_verify_mode(asio::ssl::verify_peer);
  if (ca_file.empty())
    context.set_default_verify_paths();
  else
    context.load_verify_file(ca_file);
  return context;
}

template <typename Next>
class Socket final : public WebSocket, public std::enable_shared_from_this<Socket<Next>> {
public:
  static constexpr bool is_tls = std::is_same_v<Next, Tls>;

  template <typename... Arguments>
  Socket(asio::io_context& context, WebSocketTarget target, WebSocketEvents& events, Arguments&&... stream)
      : target_(std::move(target))
      , events_(&events)
      , resolver_(context)
      , stream_(context, std::forward<Arguments>(stream)...)
  {
  }

  void start()
  {
    stage_ = "resolve";
    error_code not_literal;
    const auto address = asio::ip::make_address(target_.host, not_literal);
    if (!not_literal) {
      const tcp::endpoint endpoint(address, static_cast<std::uint16_t>(target_.port));
      // Not from within the caller: events come from the thread's loop.
      asio::post(stream_.get_executor(), [self = this->shared_from_this(), endpoint] { self->connect(endpoint); });
      return;
    }
    resolver_.async_resolve(target_.host, std::to_string(target_.port),
                            [self = this->shared_from_this()](error_code error, const auto& found) {
                              if (!self->failed(error))
                                self->connect(found);
                            });
  }

  void send(std::string text) override
  {
    outgoing_ = std::move(text);
    stream_.async_write(asio::buffer(outgoing_), [self = this->shared_from_this()](error_code error, std::size_t) {
      if (!self->failed(error))
        self->events_->written();
    });
  }

  void drop() override
  {
    events_ = nullptr;
    resolver_.cancel();
    lowest().close();
  }

private:
  auto& lowest() { return beast::get_lowest_layer(stream_); }

  void connect(const tcp::endpoint& endpoint)
  {
    begin("connect");
    lowest().async_connect(endpoint, [self = this->shared_from_this()](error_code error) {
      if (!self->failed(error))
        self->connected();
    });
  }

  void connect(const tcp::resolver::results_type& found)
  {
    begin("connect");
    lowest().async_connect(found, [self = this->shared_from_this()](error_code error, const tcp::endpoint&) {
      if (!self->failed(error))
        self->connected();
    });
  }

  void begin(const char* stage)
  {
    if (events_ == nullptr)
      return;
    stage_ = stage;
    lowest().expires_after(target_.connect_timeout);
  }

  void connected()
  {
    error_code ignored;
    lowest().socket().set_option(tcp::no_delay(true), ignored);
    if constexpr (is_tls) {
      begin("TLS");
      Tls& tls = stream_.next_layer();
      error_code is_name;
      asio::ip::make_address(target_.host, is_name);
      if (is_name)  // RFC 6066: no addresses
        SSL_set_tlsext_host_name(tls.native_handle(), target_.host.c_str());
      tls.set_verify_callback(asio::ssl::host_name_verification(target_.host));
      tls.async_handshake(asio::ssl::stream_base::client, [self = this->shared_from_this()](error_code error) {
        if (!self->failed(error))
          self->upgrade();
      });
    } else {
      upgrade();
    }
  }

  void upgrade()
  {
    stage_ = "upgrade";
    lowest().expires_never();  // from here on the WebSocket's own
    stream_.set_option(websocket::stream_base::timeout{ target_.connect_timeout, target_.idle_timeout, true });
    stream_.read_message_max(target_.longest_message);
    stream_.set_option(websocket::stream_base::decorator([token = target_.token](websocket::request_type& request) {
      request.set(beast::http::field::user_agent, "geocontainer_mpm");
      if (!token.empty())
        request.set(beast::http::field::authorization, "Bearer " + token);
    }));
    const bool version_6 = target_.host.find(':') != std::string::npos;
    const std::string host = (version_6 ? "[" + target_.host + "]" : target_.host) + ":" + std::to_string(target_.port);
    stream_.async_handshake(response_, host, target_.path, [self = this->shared_from_this()](error_code error) {
      if (self->failed(error))
        return;
      self->stage_ = "connection";
      self->events_->opened();
      self->read();
    });
  }

  void read()
  {
    if (events_ == nullptr)
      return;
    stream_.async_read(incoming_, [self = this->shared_from_this()](error_code error, std::size_t) {
      if (self->failed(error))
        return;
      const auto data = self->incoming_.cdata();
      self->events_->message(std::string_view(static_cast<const char*>(data.data()), data.size()));
      self->incoming_.consume(self->incoming_.size());
      self->read();
    });
  }

  /// True when there is nothing more to do: an error, or dropped.
  bool failed(error_code error)
  {
    if (events_ == nullptr)
      return true;
    if (!error)
      return false;
    std::string why = std::string(stage_) + ": " + error.message();
    if (error == websocket::error::upgrade_declined)
      why = "the server refused the connection with HTTP status " + std::to_string(response_.result_int());
    WebSocketEvents* const events = std::exchange(events_, nullptr);
    lowest().close();
    events->closed(why);
    return true;
  }

  WebSocketTarget target_;
  WebSocketEvents* events_;  ///< null when closed
  tcp::resolver resolver_;
  websocket::stream<Next> stream_;
  websocket::response_type response_;
  beast::flat_buffer incoming_;
  std::string outgoing_;
  const char* stage_ = "";
};

}  // namespace

std::shared_ptr<WebSocket> open_websocket(asio::io_context& context, const WebSocketTarget& target,
                                          WebSocketEvents& events)
{
  if (target.tls) {
    asio::ssl::context tls = tls_context(target.ca_file);  // OpenSSL counts references: the stream keeps what it needs
    auto socket = std::make_shared<Socket<Tls>>(context, target, events, tls);
    socket->start();
    return socket;
  }
  auto socket = std::make_shared<Socket<Plain>>(context, target, events);
  socket->start();
  return socket;
}

}  // namespace geocontainer_mpm::vessel
