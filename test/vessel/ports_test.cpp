/// UDP and TCP ports against sockets of the test: what is sent arrives, what peers do is survived.
#include <gtest/gtest.h>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ip/udp.hpp>
#include <boost/asio/write.hpp>
#include <chrono>
#include <functional>
#include <mutex>
#include <thread>

#include "geocontainer_mpm/error.h"
#include "geocontainer_mpm/vessel/nmea_angles.h"
#include "geocontainer_mpm/vessel/nmea_port.h"

namespace geocontainer_mpm::vessel {
namespace {

using boost::asio::ip::tcp;
using boost::asio::ip::udp;
using namespace std::chrono_literals;

const boost::asio::ip::address loopback = boost::asio::ip::address_v4::loopback();

bool eventually(const std::function<bool()>& condition)
{
  for (int i = 0; i < 3000; ++i) {
    if (condition())
      return true;
    std::this_thread::sleep_for(10ms);
  }
  return false;
}

/// The angles that a port was given.
class Angles {
public:
  std::function<void(const Sentence&, NmeaCounts&)> taker()
  {
    return [this](const Sentence& sentence, NmeaCounts& counts) {
      const std::lock_guard<std::mutex> lock(mutex_);
      for (const HullAngle& angle : read_hull_angles(sentence, {}, counts))
        angles_.push_back(angle.angle_rad);
    };
  }
  bool holds(std::size_t count) const
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    return angles_.size() == count;
  }

private:
  mutable std::mutex mutex_;
  std::vector<double> angles_;
};

NmeaPortParameters parameters_of(NmeaTransport transport, int peer_port = 0)
{
  NmeaPortParameters parameters;
  parameters.transport = transport;
  if (peer_port != 0)
    parameters.peer = "127.0.0.1";
  parameters.peer_port = peer_port;
  parameters.connect_timeout_s = 1.0;
  parameters.write_timeout_s = 0.3;
  parameters.first_retry_s = 0.02;
  parameters.longest_retry_s = 0.1;
  return parameters;
}

const std::string angles_text = write_hull_angles(0.1, 0.2, {}).front();

class Peer {
public:
  tcp::socket connect(int port)
  {
    tcp::socket socket(context_);
    socket.connect({ loopback, static_cast<std::uint16_t>(port) });
    return socket;
  }
  boost::asio::io_context& context() { return context_; }

private:
  boost::asio::io_context context_;
};

std::string read_some(tcp::socket& socket)
{
  std::string text(4096, '\0');
  boost::system::error_code error;
  text.resize(socket.read_some(boost::asio::buffer(text), error));
  return text;
}

TEST(UdpPort, BothWaysAndGarbageIsCounted)
{
  Peer peer;
  udp::socket socket(peer.context(), udp::endpoint(loopback, 0));
  Angles angles;
  NmeaPort port(parameters_of(NmeaTransport::udp, socket.local_endpoint().port()), angles.taker());
  const udp::endpoint there(loopback, static_cast<std::uint16_t>(port.bound_port()));
  socket.send_to(boost::asio::buffer(angles_text + angles_text), there);
  socket.send_to(boost::asio::buffer("garbage" + std::string(2000, '\xff')), there);
  std::string wrong = angles_text;
  wrong[10] = '7';
  socket.send_to(boost::asio::buffer(wrong), there);
  // A datagram's end ends its line.
  socket.send_to(boost::asio::buffer(angles_text.substr(0, angles_text.size() - 2)), there);
  EXPECT_TRUE(eventually([&] { return angles.holds(6); }));
  const NmeaPortHealth health = port.health();
  EXPECT_EQ(health.counts.sentences, 3U);
  EXPECT_EQ(health.counts.angles, 6U);
  EXPECT_EQ(health.counts.of(NmeaFault::bad_checksum), 1U);
  EXPECT_EQ(health.counts.of(NmeaFault::noise), 1U);

  port.send(angles_text);
  std::string text(200, '\0');
  text.resize(socket.receive(boost::asio::buffer(text)));
  EXPECT_EQ(text, angles_text);
}

TEST(UdpPort, NobodyListeningIsNoEnd)
{
  Peer peer;
  udp::socket socket(peer.context(), udp::endpoint(loopback, 0));
  const udp::endpoint gone = socket.local_endpoint();
  socket.close();
  Angles angles;
  NmeaPort port(parameters_of(NmeaTransport::udp, gone.port()), angles.taker());
  for (int i = 0; i < 20; ++i)
    port.send(angles_text);
  EXPECT_TRUE(eventually([&] { return port.health().sent + port.health().dropped == 20; }));
  udp::socket sender(peer.context(), udp::endpoint(loopback, 0));
  sender.send_to(boost::asio::buffer(angles_text),
                 udp::endpoint(loopback, static_cast<std::uint16_t>(port.bound_port())));
  EXPECT_TRUE(eventually([&] { return angles.holds(2); }));
}

TEST(TcpServer, ServesSeveralAndOutlivesThem)
{
  Peer peer;
  Angles angles;
  NmeaPort port(parameters_of(NmeaTransport::tcp_server), angles.taker());
  tcp::socket first = peer.connect(port.bound_port());
  {
    tcp::socket second = peer.connect(port.bound_port());
    ASSERT_TRUE(eventually([&] { return port.health().peers == 2; }));
    // A byte at a time by one, all at once by the other: their lines do not mix.
    for (const char& byte : angles_text)
      boost::asio::write(first, boost::asio::buffer(&byte, 1));
    boost::asio::write(second, boost::asio::buffer(angles_text + "$unfinished"));
    EXPECT_TRUE(eventually([&] { return angles.holds(4); }));
    port.send(angles_text);
    EXPECT_EQ(read_some(first), angles_text);
    EXPECT_EQ(read_some(second), angles_text);
  }
  EXPECT_TRUE(eventually([&] { return port.health().peers == 1; }));
  port.send(angles_text);
  EXPECT_EQ(read_some(first), angles_text);
}

TEST(TcpServer, APeerThatTakesNothingIsDropped)
{
  Peer peer;
  Angles angles;
  NmeaPort port(parameters_of(NmeaTransport::tcp_server), angles.taker());
  tcp::socket lazy = peer.connect(port.bound_port());
  ASSERT_TRUE(eventually([&] { return port.health().peers == 1; }));
  const std::string much(100'000, 'x');
  EXPECT_TRUE(eventually([&] {
    port.send(much);  // fills the system's buffers, then ours
    return port.health().peers == 0;
  }));
  EXPECT_GT(port.health().dropped, 0U);
}

TEST(TcpServer, RefusesTheSeventeenth)
{
  Peer peer;
  Angles angles;
  NmeaPort port(parameters_of(NmeaTransport::tcp_server), angles.taker());
  std::vector<tcp::socket> sockets;
  for (int i = 0; i < 17; ++i)
    sockets.push_back(peer.connect(port.bound_port()));
  EXPECT_EQ(read_some(sockets.back()), "");  // closed
  EXPECT_EQ(port.health().peers, 16U);
}

TEST(TcpClient, ConnectsAgain)
{
  Peer peer;
  tcp::acceptor acceptor(peer.context(), tcp::endpoint(loopback, 0));
  Angles angles;
  NmeaPort port(parameters_of(NmeaTransport::tcp_client, acceptor.local_endpoint().port()), angles.taker());
  for (std::size_t round = 1; round <= 3; ++round) {
    tcp::socket socket = acceptor.accept();
    boost::asio::write(socket, boost::asio::buffer("noise\r\n" + angles_text));
    ASSERT_TRUE(eventually([&] { return angles.holds(2 * round); }));
    port.send(angles_text);
    EXPECT_EQ(read_some(socket), angles_text);
  }
  EXPECT_EQ(port.health().connections, 3U);
}

TEST(TcpClient, ASilentPeerIsLeftAndADeadOneTriedAgain)
{
  Peer peer;
  tcp::acceptor acceptor(peer.context(), tcp::endpoint(loopback, 0));
  const tcp::endpoint place = acceptor.local_endpoint();
  auto parameters = parameters_of(NmeaTransport::tcp_client, place.port());
  parameters.idle_timeout_s = 0.2;
  Angles angles;
  NmeaPort port(parameters, angles.taker());
  {
    tcp::socket silent = acceptor.accept();
    EXPECT_EQ(read_some(silent), "");  // closed by the client
  }
  acceptor.close();
  EXPECT_TRUE(eventually([&] { return port.health().failures > 3; }));
  tcp::acceptor again(peer.context(), place);
  tcp::socket socket = again.accept();
  boost::asio::write(socket, boost::asio::buffer(angles_text));
  EXPECT_TRUE(eventually([&] { return angles.holds(2); }));
}

TEST(Ports, BadParametersAreRefused)
{
  Angles angles;
  auto parameters = parameters_of(NmeaTransport::udp);
  parameters.address = "somewhere";
  EXPECT_THROW(NmeaPort(parameters, angles.taker()), InputError);
  EXPECT_THROW(NmeaPort(parameters_of(NmeaTransport::tcp_client), angles.taker()), InputError);
  const NmeaPort port(parameters_of(NmeaTransport::tcp_server), angles.taker());
  auto taken = parameters_of(NmeaTransport::tcp_server);
  taken.port = port.bound_port();
  EXPECT_THROW(NmeaPort(taken, angles.taker()), InputError);
}

}  // namespace
}  // namespace geocontainer_mpm::vessel
