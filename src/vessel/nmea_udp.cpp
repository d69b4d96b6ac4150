#include <array>
#include <boost/asio/buffer.hpp>
#include <boost/asio/ip/udp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <chrono>
#include <utility>

#include "nmea_link.h"

namespace geocontainer_mpm::vessel {
namespace {

using boost::asio::ip::udp;
using boost::system::error_code;

/// Between two attempts to receive where the system refuses it (the network is down).
constexpr std::chrono::milliseconds pause_after_error{ 200 };

class UdpLink final : public NmeaLink {
public:
  UdpLink(const NmeaPortParameters& parameters, OnSentence on_sentence)
      : NmeaLink(parameters, std::move(on_sentence)), socket_(context_), pause_(context_)
  {
    const udp::endpoint local(boost::asio::ip::make_address(parameters.address),
                              static_cast<std::uint16_t>(parameters.port));
    bind_to(socket_, local);
    socket_.non_blocking(true);
    if (!parameters.peer.empty()) {
      error_code ignored;
      socket_.set_option(udp::socket::broadcast(true), ignored);
      peer_ = udp::endpoint(boost::asio::ip::make_address(parameters.peer),
                            static_cast<std::uint16_t>(parameters.peer_port));
    }
    receive_next();
  }

  int bound_port() const override
  {
    error_code ignored;
    return socket_.local_endpoint(ignored).port();
  }

private:
  void receive_next()
  {
    socket_.async_receive_from(boost::asio::buffer(buffer_), sender_, [this](error_code error, std::size_t size) {
      if (error == boost::asio::error::operation_aborted)
        return;
      if (!error) {
        splitter_.clear();
        receive(splitter_, std::string_view(buffer_.data(), size), true);
        receive_next();
        return;
      }
      // "Connection refused" among them: nobody listens where the last datagram went.
      note(error);
      pause_.expires_after(pause_after_error);
      pause_.async_wait([this](error_code) { receive_next(); });
    });
  }

  void transmit(const Text& text) override
  {
    if (peer_.port() == 0)
      return;
    error_code error;
    socket_.send_to(boost::asio::buffer(*text), peer_, 0, error);  // does not wait: the socket is non-blocking
    count([&](NmeaPortHealth& health) { ++(error ? health.dropped : health.sent); });
    if (error)
      note(error);
  }

  void note(error_code error)
  {
    count([&](NmeaPortHealth& health) { health.last_error = error.message(); });
  }

  udp::socket socket_;
  boost::asio::steady_timer pause_;
  udp::endpoint peer_, sender_;
  std::array<char, 2048> buffer_{};  ///< a longer datagram is cut: its last line then fails its checksum
  SentenceSplitter splitter_;
};

}  // namespace

std::unique_ptr<NmeaLink> make_udp_link(const NmeaPortParameters& parameters, NmeaLink::OnSentence on_sentence)
{
  return std::make_unique<UdpLink>(parameters, std::move(on_sentence));
}

}  // namespace geocontainer_mpm::vessel
