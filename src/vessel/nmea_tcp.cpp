#include <algorithm>
#include <array>
#include <boost/asio/buffer.hpp>
#include <boost/asio/connect.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/write.hpp>
#include <chrono>
#include <deque>
#include <utility>
#include <vector>

#include "backoff.h"
#include "nmea_link.h"

namespace geocontainer_mpm::vessel {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;
using boost::system::error_code;

constexpr std::size_t most_peers = 16;
constexpr std::size_t most_waiting_texts = 64;  ///< of each peer
constexpr std::chrono::milliseconds pause_after_error{ 200 };

std::chrono::milliseconds to_milliseconds(double seconds)
{
  return std::chrono::milliseconds(static_cast<std::chrono::milliseconds::rep>(1e3 * seconds) + 1);
}

/// One connection of a server or a client: reads and writes until an error, a silence or a stall ends it.
class Connection final : public std::enable_shared_from_this<Connection> {
public:
  using Ended = std::function<void(const std::shared_ptr<Connection>&, const std::string& why)>;

  Connection(tcp::socket socket, const NmeaPortParameters& parameters, NmeaLink& link, Ended ended)
      : socket_(std::move(socket))
      , silence_(socket_.get_executor())
      , stall_(socket_.get_executor())
      , parameters_(parameters)
      , link_(link)
      , ended_(std::move(ended))
  {
    error_code ignored;
    socket_.set_option(tcp::no_delay(true), ignored);
    socket_.set_option(asio::socket_base::keep_alive(true), ignored);
  }

  void start() { read(); }

  void send(const NmeaLink::Text& text)
  {
    waiting_.push_back(text);
    if (waiting_.size() > most_waiting_texts) {
      // The first may be half written.
      waiting_.erase(waiting_.begin() + 1);
      link_.count([](NmeaPortHealth& health) { ++health.dropped; });
    }
    if (!writing_)
      write();
  }

private:
  using Self = std::shared_ptr<Connection>;

  void read()
  {
    if (parameters_.transport == NmeaTransport::tcp_client && parameters_.idle_timeout_s > 0.0)
      watch(silence_, parameters_.idle_timeout_s, "the peer was silent for too long");
    socket_.async_read_some(asio::buffer(buffer_), [self = shared_from_this()](error_code error, std::size_t size) {
      if (self->over_)
        return;
      if (error) {
        self->end(error.message());
        return;
      }
      self->link_.receive(self->splitter_, std::string_view(self->buffer_.data(), size), false);
      self->read();
    });
  }

  void write()
  {
    writing_ = true;
    watch(stall_, parameters_.write_timeout_s, "the peer took nothing for too long");
    asio::async_write(socket_, asio::buffer(*waiting_.front()),
                      [self = shared_from_this(), text = waiting_.front()](error_code error, std::size_t) {
                        if (self->over_)
                          return;
                        if (error) {
                          self->end(error.message());
                          return;
                        }
                        self->stall_.cancel();
                        self->waiting_.pop_front();
                        self->writing_ = false;
                        self->link_.count([](NmeaPortHealth& health) { ++health.sent; });
                        if (!self->waiting_.empty())
                          self->write();
                      });
  }

  void watch(asio::steady_timer& timer, double seconds, const char* why)
  {
    timer.expires_after(to_milliseconds(seconds));
    timer.async_wait([weak = weak_from_this(), why](error_code error) {
      const Self self = weak.lock();
      if (!error && self && !self->over_)
        self->end(why);
    });
  }

  void end(const std::string& why)
  {
    over_ = true;
    link_.count([&](NmeaPortHealth& health) { health.dropped += waiting_.size(); });
    silence_.cancel();
    stall_.cancel();
    error_code ignored;
    socket_.close(ignored);
    ended_(shared_from_this(), why);
  }

  tcp::socket socket_;
  asio::steady_timer silence_, stall_;
  const NmeaPortParameters& parameters_;
  NmeaLink& link_;
  Ended ended_;
  std::array<char, 1024> buffer_{};
  SentenceSplitter splitter_;
  std::deque<NmeaLink::Text> waiting_;  ///< the first is being written
  bool writing_ = false, over_ = false;
};

class TcpLink : public NmeaLink {
public:
  using NmeaLink::NmeaLink;

protected:
  void transmit(const Text& text) override
  {
    if (connections_.empty())
      count([](NmeaPortHealth& health) { ++health.dropped; });
    for (const auto& connection : connections_)
      connection->send(text);
  }

  void begin(tcp::socket socket)
  {
    auto connection = std::make_shared<Connection>(
        std::move(socket), parameters_, *this,
        [this](const std::shared_ptr<Connection>& ended, const std::string& why) {
          // Not at once: transmit() may be going through the list.
          asio::post(context_, [this, ended, why] {
            connections_.erase(std::remove(connections_.begin(), connections_.end(), ended), connections_.end());
            note(why);
            lost();
          });
        });
    connections_.push_back(connection);
    count([&](NmeaPortHealth& health) {
      ++health.connections;
      health.peers = connections_.size();
    });
    connection->start();
  }

  void note(const std::string& why)
  {
    count([&](NmeaPortHealth& health) {
      ++health.failures;
      health.last_error = why;
      health.peers = connections_.size();
    });
  }

  virtual void lost() {}

  std::vector<std::shared_ptr<Connection>> connections_;
};

class TcpServerLink final : public TcpLink {
public:
  TcpServerLink(const NmeaPortParameters& parameters, OnSentence on_sentence)
      : TcpLink(parameters, std::move(on_sentence)), acceptor_(context_), pause_(context_)
  {
    bind_to(acceptor_,
            tcp::endpoint(asio::ip::make_address(parameters.address), static_cast<std::uint16_t>(parameters.port)));
    acceptor_.listen();
    accept();
  }

  int bound_port() const override
  {
    error_code ignored;
    return acceptor_.local_endpoint(ignored).port();
  }

private:
  void accept()
  {
    acceptor_.async_accept([this](error_code error, tcp::socket socket) {
      if (error == asio::error::operation_aborted)
        return;
      if (error) {  // out of files, perhaps
        note(error.message());
        pause_.expires_after(pause_after_error);
        pause_.async_wait([this](error_code) { accept(); });
        return;
      }
      if (connections_.size() >= most_peers)
        note("more than 16 peers");
      else
        begin(std::move(socket));
      accept();
    });
  }

  tcp::acceptor acceptor_;
  asio::steady_timer pause_;
};

class TcpClientLink final : public TcpLink {
public:
  TcpClientLink(const NmeaPortParameters& parameters, OnSentence on_sentence)
      : TcpLink(parameters, std::move(on_sentence))
      , backoff_(to_milliseconds(parameters.first_retry_s), to_milliseconds(parameters.longest_retry_s))
      , resolver_(context_)
      , socket_(context_)
      , timer_(context_)
  {
    asio::post(context_, [this] { connect(); });
  }

  int bound_port() const override { return 0; }

private:
  static constexpr std::chrono::seconds good_connection{ 10 };

  void connect()
  {
    const std::uint64_t attempt = ++attempt_;
    timer_.expires_after(to_milliseconds(parameters_.connect_timeout_s));
    timer_.async_wait([this, attempt](error_code error) {
      if (!error && attempt == attempt_)
        fail("no connection in time");
    });
    resolver_.async_resolve(parameters_.peer, std::to_string(parameters_.peer_port),
                            [this, attempt](error_code error, const tcp::resolver::results_type& found) {
                              if (attempt != attempt_)
                                return;
                              if (error) {
                                fail(error.message());
                                return;
                              }
                              connect(found, attempt);
                            });
  }

  void connect(const tcp::resolver::results_type& found, std::uint64_t attempt)
  {
    socket_ = tcp::socket(context_);
    asio::async_connect(socket_, found, [this, attempt](error_code error, const tcp::endpoint&) {
      if (attempt != attempt_)
        return;
      if (error) {
        fail(error.message());
        return;
      }
      ++attempt_;
      timer_.cancel();
      connected_at_ = std::chrono::steady_clock::now();
      begin(std::move(socket_));
    });
  }

  void fail(const std::string& why)
  {
    note(why);
    lost();
  }

  void lost() override
  {
    if (std::chrono::steady_clock::now() - connected_at_ > good_connection &&
        connected_at_.time_since_epoch().count() > 0)
      backoff_.reset();
    connected_at_ = {};
    ++attempt_;
    error_code ignored;
    socket_.close(ignored);
    timer_.expires_after(backoff_.next());
    timer_.async_wait([this](error_code error) {
      if (!error)
        connect();
    });
  }

  Backoff backoff_;
  tcp::resolver resolver_;
  tcp::socket socket_;
  asio::steady_timer timer_;   ///< of the attempt, then of the wait for the next
  std::uint64_t attempt_ = 0;  ///< what belongs to an earlier one is too late
  std::chrono::steady_clock::time_point connected_at_;
};

}  // namespace

std::unique_ptr<NmeaLink> make_tcp_server_link(const NmeaPortParameters& parameters, NmeaLink::OnSentence on_sentence)
{
  return std::make_unique<TcpServerLink>(parameters, std::move(on_sentence));
}

std::unique_ptr<NmeaLink> make_tcp_client_link(const NmeaPortParameters& parameters, NmeaLink::OnSentence on_sentence)
{
  return std::make_unique<TcpClientLink>(parameters, std::move(on_sentence));
}

}  // namespace geocontainer_mpm::vessel
