#pragma once
/// What UDP and TCP have in common: the thread, the count, the way in through splitter and parser.

#include <atomic>
#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/address.hpp>
#include <boost/asio/post.hpp>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>

#include "geocontainer_mpm/error.h"
#include "geocontainer_mpm/vessel/nmea_port.h"

namespace geocontainer_mpm::vessel {

/// One kind of transport. All but send(), health() and the constructor happens on its own thread.
class NmeaLink {
public:
  using OnSentence = std::function<void(const Sentence&, NmeaCounts&)>;
  using Text = std::shared_ptr<const std::string>;

  NmeaLink(const NmeaPortParameters& parameters, OnSentence on_sentence)
      : parameters_(parameters), on_sentence_(std::move(on_sentence)), work_(boost::asio::make_work_guard(context_))
  {
  }
  virtual ~NmeaLink() = default;

  void run()
  {
    thread_ = std::thread([this] { context_.run(); });
  }

  /// Before a derived class goes: handlers refer to it.
  void stop()
  {
    context_.stop();
    if (thread_.joinable())
      thread_.join();
  }

  /// A bounded number of texts is on its way from callers to the thread.
  void send(std::string text)
  {
    if (on_their_way_.fetch_add(1) >= most_on_their_way) {
      --on_their_way_;
      count([](NmeaPortHealth& health) { ++health.dropped; });
      return;
    }
    boost::asio::post(context_, [this, shared = std::make_shared<const std::string>(std::move(text))] {
      --on_their_way_;
      transmit(shared);
    });
  }

  NmeaPortHealth health() const
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    return health_;
  }

  virtual int bound_port() const = 0;

  void receive(SentenceSplitter& splitter, std::string_view bytes, bool datagram)
  {
    NmeaCounts counts = take_counts();
    const auto take = [&](std::string_view line) {
      if (const auto fault = parse_sentence(line, sentence_)) {
        counts.add(*fault);
      } else {
        ++counts.sentences;
        on_sentence_(sentence_, counts);
      }
    };
    splitter.feed(bytes, counts, take);
    if (datagram)
      splitter.end_of_datagram(counts, take);
    count([&](NmeaPortHealth& health) {
      health.counts = counts;
      health.bytes_in += bytes.size();
    });
  }

  template <typename Change>
  void count(Change&& change)
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    change(health_);
  }

protected:
  virtual void transmit(const Text& text) = 0;

  const NmeaPortParameters parameters_;
  boost::asio::io_context context_;

private:
  static constexpr int most_on_their_way = 64;

  /// Only this thread changes the counts.
  NmeaCounts take_counts()
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    return health_.counts;
  }

  OnSentence on_sentence_;
  Sentence sentence_;
  boost::asio::executor_work_guard<boost::asio::io_context::executor_type> work_;
  std::atomic<int> on_their_way_{ 0 };
  mutable std::mutex mutex_;
  NmeaPortHealth health_;
  std::thread thread_;
};

/// The sockets that listen are bound when these return. They throw InputError when that cannot be.
std::unique_ptr<NmeaLink> make_udp_link(const NmeaPortParameters& parameters, NmeaLink::OnSentence on_sentence);
std::unique_ptr<NmeaLink> make_tcp_server_link(const NmeaPortParameters& parameters, NmeaLink::OnSentence on_sentence);
std::unique_ptr<NmeaLink> make_tcp_client_link(const NmeaPortParameters& parameters, NmeaLink::OnSentence on_sentence);

/// Opens and binds a socket or an acceptor to the parameters' address.
template <typename Socket, typename Endpoint>
void bind_to(Socket& socket, const Endpoint& endpoint)
{
  boost::system::error_code error;
  socket.open(endpoint.protocol(), error);
  if (!error && endpoint.protocol().type() == SOCK_STREAM)  // for UDP it would share the port with another program
    socket.set_option(typename Socket::reuse_address(true), error);
  if (!error)
    socket.bind(endpoint, error);
  if (error)
    throw InputError("nmea", "port", std::to_string(endpoint.port()),
                     "cannot be bound at " + endpoint.address().to_string() + ": " + error.message());
}

}  // namespace geocontainer_mpm::vessel
