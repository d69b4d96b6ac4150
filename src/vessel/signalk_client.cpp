#include "geocontainer_mpm/vessel/signalk_client.h"

#include <atomic>
#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <deque>
#include <exception>
#include <mutex>
#include <set>
#include <thread>
#include <utility>

#include "backoff.h"
#include "geocontainer_mpm/vessel/path_ledger.h"
#include "websocket.h"

namespace geocontainer_mpm::vessel {
namespace {

namespace asio = boost::asio;
using Clock = std::chrono::steady_clock;

constexpr std::size_t most_values_a_delta = 64;
/// A peer that talks so much nonsense in one connection is no Signal K server.
constexpr std::uint64_t most_bad_messages = 100;
/// A connection that lasted so long was a good one: the next failure is a new one.
constexpr std::chrono::seconds good_connection{ 10 };

std::chrono::milliseconds to_milliseconds(double seconds)
{
  return std::chrono::milliseconds(static_cast<std::chrono::milliseconds::rep>(1e3 * seconds) + 1);
}

}  // namespace

/// Everything but send() and health() happens on the client's thread.
class SignalKClient::Impl final : public WebSocketEvents {
public:
  Impl(const SignalKParameters& parameters, std::vector<PathMeta> announced, const std::vector<std::string>& inputs,
       std::function<void(const IncomingValue&)> on_input)
      : parameters_(parameters)
      , announced_(std::move(announced))
      , inputs_(inputs.begin(), inputs.end())
      , on_input_(std::move(on_input))
      , ledger_(announced_)
      , backoff_(to_milliseconds(parameters.first_retry_s), to_milliseconds(parameters.longest_retry_s))
      , work_(asio::make_work_guard(context_))
      , timer_(context_)
  {
    asio::post(context_, [this] { connect(); });
    thread_ = std::thread([this] { context_.run(); });
  }

  ~Impl()
  {
    asio::post(context_, [this] {
      stopping_ = true;
      timer_.cancel();
      if (socket_)
        socket_->drop();
      socket_.reset();
      work_.reset();
      context_.stop();
    });
    thread_.join();
  }

  void send(const std::vector<PathValue>& values)
  {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      for (const PathValue& value : values) {
        const PathLedger::Put put = ledger_.put(value);
        health_.values_replaced += put == PathLedger::Put::replaced ? 1 : 0;
        health_.values_refused += put == PathLedger::Put::refused ? 1 : 0;
      }
    }
    if (!flush_posted_.exchange(true))
      asio::post(context_, [this] {
        flush_posted_ = false;
        flush();
      });
  }

  SignalKHealth health() const
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    SignalKHealth health = health_;
    const auto oldest = ledger_.oldest_wait();
    if (!ledger_.anything_sent())
      health.confirmation = Confirmation::nothing_sent;
    else if (!oldest)
      health.confirmation = health.state == LinkState::open ? Confirmation::confirmed : Confirmation::pending;
    else
      health.confirmation = Clock::now() - oldest->second > to_milliseconds(parameters_.confirm_within_s)
                                ? Confirmation::unconfirmed
                                : Confirmation::pending;
    if (oldest)
      health.oldest_unconfirmed = oldest->first;
    return health;
  }

  void opened() override {}  // nothing is said before the server's hello

  void message(std::string_view text) override
  {
    const Incoming message = read_message(text);
    switch (message.kind) {
      case IncomingKind::hello:
        if (!open_)
          begin(message.self);
        break;
      case IncomingKind::delta:
        receive(message);
        break;
      case IncomingKind::other:
        break;
      case IncomingKind::faulty: {
        std::unique_lock<std::mutex> lock(mutex_);
        ++health_.bad_messages;
        lock.unlock();
        if (++bad_messages_ >= most_bad_messages)
          give_up("the peer sends what is not Signal K");
      } break;
    }
  }

  void written() override
  {
    writing_ = false;
    flush();
  }

  void closed(const std::string& why) override
  {
    socket_.reset();
    retry(why);
  }

private:
  void connect()
  {
    if (stopping_)
      return;
    open_ = writing_ = false;
    bad_messages_ = 0;
    control_.clear();
    set_state(LinkState::connecting);
    WebSocketTarget target;
    target.host = parameters_.host;
    target.port = parameters_.port;
    target.path = "/signalk/v1/stream?subscribe=none";
    target.tls = parameters_.tls;
    target.ca_file = parameters_.ca_file;
    target.connect_timeout = to_milliseconds(parameters_.connect_timeout_s);
    target.idle_timeout = to_milliseconds(parameters_.idle_timeout_s);
    target.longest_message = IncomingLimits{}.longest;
    try {
      target.token = read_token(parameters_, "signalk");
      socket_ = open_websocket(context_, target, *this);
    } catch (const std::exception& error) {  // the token's or the certificate's file has gone
      retry(error.what());
      return;
    }
    after(target.connect_timeout, [this] { give_up("no hello from the server in time"); });
  }

  void begin(const std::string& self)
  {
    timer_.cancel();
    self_ = self;
    open_ = true;
    opened_at_ = Clock::now();
    std::set<std::string> watched = inputs_;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      ledger_.begin_connection();
      for (std::string& path : ledger_.paths())
        watched.insert(std::move(path));
      health_.state = LinkState::open;
      ++health_.connections;
    }
    // The subscription before the values: it brings the confirmations.
    control_.push_back(write_subscription({ watched.begin(), watched.end() }));
    control_.push_back(write_meta(announced_, parameters_.source, std::chrono::system_clock::now()));
    flush();
  }

  void flush()
  {
    if (!open_ || writing_)
      return;
    std::string text;
    if (!control_.empty()) {
      text = std::move(control_.front());
      control_.pop_front();
    } else {
      const std::lock_guard<std::mutex> lock(mutex_);
      const auto values = ledger_.take(most_values_a_delta, Clock::now());
      if (values.empty())
        return;
      ++health_.messages_sent;
      health_.values_sent += values.size();
      text = write_delta(values, parameters_.source);
    }
    writing_ = true;
    socket_->send(std::move(text));
  }

  void receive(const Incoming& delta)
  {
    if (!open_ || !(delta.context.empty() || delta.context == "vessels.self" || delta.context == self_))
      return;
    for (const IncomingValue& value : delta.values) {
      if (value.source == parameters_.source) {
        const std::lock_guard<std::mutex> lock(mutex_);
        health_.values_confirmed += ledger_.confirm(value) ? 1 : 0;
      } else if (inputs_.count(value.path) != 0) {
        {
          const std::lock_guard<std::mutex> lock(mutex_);
          ++health_.values_received;
        }
        on_input_(value);
      }
    }
  }

  void give_up(const std::string& why)
  {
    if (socket_)
      socket_->drop();
    socket_.reset();
    retry(why);
  }

  void retry(const std::string& why)
  {
    if (open_ && Clock::now() - opened_at_ > good_connection)
      backoff_.reset();
    open_ = false;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      health_.state = LinkState::waiting;
      health_.last_error = why;
      ++health_.failures;
      ledger_.begin_connection();
    }
    after(backoff_.next(), [this] { connect(); });
  }

  template <typename Action>
  void after(std::chrono::milliseconds wait, Action action)
  {
    timer_.expires_after(wait);
    timer_.async_wait([action = std::move(action)](const boost::system::error_code& error) {
      if (!error)
        action();
    });
  }

  void set_state(LinkState state)
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    health_.state = state;
  }

  const SignalKParameters parameters_;
  const std::vector<PathMeta> announced_;
  const std::set<std::string> inputs_;
  const std::function<void(const IncomingValue&)> on_input_;

  mutable std::mutex mutex_;  ///< of the ledger and the health; held for microseconds
  PathLedger ledger_;
  SignalKHealth health_;
  std::atomic<bool> flush_posted_{ false };

  Backoff backoff_;
  asio::io_context context_;
  asio::executor_work_guard<asio::io_context::executor_type> work_;
  asio::steady_timer timer_;  ///< the next attempt, or the end of waiting for the hello
  std::shared_ptr<WebSocket> socket_;
  std::deque<std::string> control_;  ///< subscription and meta of a new connection
  std::string self_;
  Clock::time_point opened_at_;
  std::uint64_t bad_messages_ = 0;
  bool open_ = false, writing_ = false, stopping_ = false;
  std::thread thread_;
};

SignalKClient::SignalKClient(const SignalKParameters& parameters, std::vector<PathMeta> announced,
                             const std::vector<std::string>& inputs, std::function<void(const IncomingValue&)> on_input)
{
  parameters.validate("signalk");
  impl_ = std::make_unique<Impl>(parameters, std::move(announced), inputs, std::move(on_input));
}

SignalKClient::~SignalKClient() = default;

void SignalKClient::send(const std::vector<PathValue>& values)
{
  impl_->send(values);
}

SignalKHealth SignalKClient::health() const
{
  return impl_->health();
}

const char* to_string(LinkState state)
{
  switch (state) {
    case LinkState::connecting:
      return "connecting";
    case LinkState::waiting:
      return "waiting to connect again";
    case LinkState::open:
      break;
  }
  return "open";
}

const char* to_string(Confirmation confirmation)
{
  switch (confirmation) {
    case Confirmation::nothing_sent:
      return "nothing sent";
    case Confirmation::pending:
      return "pending";
    case Confirmation::confirmed:
      return "confirmed";
    case Confirmation::unconfirmed:
      break;
  }
  return "unconfirmed";
}

}  // namespace geocontainer_mpm::vessel
