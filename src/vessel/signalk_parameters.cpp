#include <fmt/format.h>

#include <algorithm>
#include <boost/asio/ip/address.hpp>
#include <cctype>
#include <cstdlib>
#include <fstream>
#include <utility>

#include "geocontainer_mpm/error.h"
#include "geocontainer_mpm/vessel/signalk_client.h"

namespace geocontainer_mpm::vessel {
namespace {

constexpr std::size_t longest_token = 4096;
constexpr double longest_time_s = 3600.0;

/// A bearer token is of visible ASCII (RFC 6750, 2.1); anything else could add lines to the request.
bool is_token(const std::string& text)
{
  return !text.empty() && text.size() <= longest_token &&
         std::all_of(text.begin(), text.end(), [](char c) { return c > ' ' && c < 0x7f; });
}

std::string first_line(const std::string& file)
{
  std::ifstream stream(file, std::ios::binary);
  std::string line(longest_token + 2, '\0');
  stream.read(line.data(), static_cast<std::streamsize>(line.size()));
  line.resize(static_cast<std::size_t>(stream.gcount()));
  line.resize(std::min(line.size(), line.find_first_of("\r\n")));
  return line;
}

bool is_loopback(const std::string& host)
{
  boost::system::error_code error;
  const auto address = boost::asio::ip::make_address(host, error);
  return error ? host == "localhost" : address.is_loopback();
}

/// Goes into the request's Host header.
bool is_host(const std::string& text)
{
  return !text.empty() && text.size() <= 253 && std::all_of(text.begin(), text.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '.' || c == '-' || c == '_' || c == ':' || c == '%';
  });
}

bool is_source(const std::string& text)
{
  return !text.empty() && text.size() <= 100 && std::all_of(text.begin(), text.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '.' || c == '-' || c == '_';
  });
}

}  // namespace

void SignalKParameters::validate(const std::string& where) const
{
  const auto require = [&](bool right, const char* key, const std::string& value, const char* allowed) {
    if (!right)
      throw InputError(where, key, value, allowed);
  };
  require(is_host(host), "host", host, "must be a host name or address");
  require(port >= 1 && port <= 65535, "port", fmt::format("{}", port), "must be a whole number from 1 to 65535");
  require(is_source(source), "source", source, "must be of letters, digits, '.', '-' and '_'");
  for (const auto& [key, seconds] :
       { std::pair("connect_timeout_s", connect_timeout_s), std::pair("idle_timeout_s", idle_timeout_s),
         std::pair("first_retry_s", first_retry_s), std::pair("longest_retry_s", longest_retry_s),
         std::pair("confirm_within_s", confirm_within_s) })
    require(seconds > 0.0 && seconds <= longest_time_s, key, fmt::format("{}", seconds),
            "must be a number in (0, 3600]");
  require(longest_retry_s >= first_retry_s, "longest_retry_s", fmt::format("{}", longest_retry_s),
          "must not be below first_retry_s");
  require(ca_file.empty() || tls, "ca_file", ca_file, "needs tls: true");
  require(ca_file.empty() || std::ifstream(ca_file).good(), "ca_file", ca_file, "must be a readable file");
  require(token_file.empty() || token_environment.empty(), "token_environment", token_environment,
          "must not be given together with token_file");
  const bool has_token = !read_token(*this, where).empty();
  require(!has_token || tls || token_in_clear || is_loopback(host), "host", host,
          "a token goes to another machine over TLS only (tls: true), unless token_in_clear: true");
}

std::string read_token(const SignalKParameters& parameters, const std::string& where)
{
  constexpr const char* allowed = "of 1 to 4096 visible ASCII characters";
  if (!parameters.token_file.empty()) {
    std::string token = first_line(parameters.token_file);
    if (!is_token(token))
      throw InputError(where, "token_file", parameters.token_file,
                       std::string("must be a readable file whose first line is a token ") + allowed);
    return token;
  }
  if (!parameters.token_environment.empty()) {
    const char* const value = std::getenv(parameters.token_environment.c_str());
    std::string token = value == nullptr ? "" : value;
    if (!is_token(token))
      throw InputError(where, "token_environment", parameters.token_environment,
                       std::string("must be the name of a variable whose value is a token ") + allowed);
    return token;
  }
  return "";
}

}  // namespace geocontainer_mpm::vessel
