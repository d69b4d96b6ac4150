#include "geocontainer_mpm/vessel/stamp.h"

#include <fmt/format.h>

#include <array>
#include <ctime>

namespace geocontainer_mpm::vessel {
namespace {

/// `count` digits at `text`'s beginning, which they are taken from; -1 where there are none.
int take_digits(std::string_view& text, std::size_t count)
{
  if (text.size() < count)
    return -1;
  int value = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (text[i] < '0' || text[i] > '9')
      return -1;
    value = 10 * value + (text[i] - '0');
  }
  text.remove_prefix(count);
  return value;
}

bool take(std::string_view& text, char expected)
{
  if (text.empty() || text.front() != expected)
    return false;
  text.remove_prefix(1);
  return true;
}

/// Digits after the point, to the nanosecond; further ones are read and dropped.
std::optional<std::chrono::nanoseconds> take_fraction(std::string_view& text)
{
  std::int64_t nanoseconds = 0;
  std::int64_t digit_ns = 100'000'000;
  if (text.empty() || text.front() < '0' || text.front() > '9')
    return std::nullopt;
  while (!text.empty() && text.front() >= '0' && text.front() <= '9') {
    nanoseconds += digit_ns * (text.front() - '0');
    digit_ns /= 10;
    text.remove_prefix(1);
  }
  return std::chrono::nanoseconds(nanoseconds);
}

/// `month` from 0. Gregorian.
int days_of_month(int year, int month)
{
  static constexpr std::array<int, 12> days = { 31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31 };
  const bool leap = year % 4 == 0 && (year % 100 != 0 || year % 400 == 0);
  return days[static_cast<std::size_t>(month)] + (month == 1 && leap ? 1 : 0);
}

}  // namespace

std::string format_utc(Stamp stamp)
{
  const auto milliseconds = std::chrono::floor<std::chrono::milliseconds>(stamp.time_since_epoch());
  const auto seconds = std::chrono::floor<std::chrono::seconds>(milliseconds);
  const std::time_t time = seconds.count();
  std::tm utc{};
  if (::gmtime_r(&time, &utc) == nullptr || utc.tm_year < -1900 || utc.tm_year > 9999 - 1900)
    return "1970-01-01T00:00:00.000Z";
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}.{:03}Z", utc.tm_year + 1900, utc.tm_mon + 1, utc.tm_mday,
                     utc.tm_hour, utc.tm_min, utc.tm_sec, (milliseconds - seconds).count());
}

std::optional<Stamp> parse_utc(std::string_view text)
{
  std::tm utc{};
  const int year = take_digits(text, 4);
  const bool date = take(text, '-') && (utc.tm_mon = take_digits(text, 2) - 1) >= 0 && take(text, '-') &&
                    (utc.tm_mday = take_digits(text, 2)) >= 1;
  const bool time = date && take(text, 'T') && (utc.tm_hour = take_digits(text, 2)) >= 0 && take(text, ':') &&
                    (utc.tm_min = take_digits(text, 2)) >= 0 && take(text, ':') &&
                    (utc.tm_sec = take_digits(text, 2)) >= 0;
  // Any two of them are less than 292 years apart, what nanoseconds in 64 bits can hold.
  if (!time || year < 1970 || year > 2199 || utc.tm_hour > 23 || utc.tm_min > 59 || utc.tm_sec > 60)
    return std::nullopt;
  std::chrono::nanoseconds fraction{};
  if (take(text, '.')) {
    const auto digits = take_fraction(text);
    if (!digits)
      return std::nullopt;
    fraction = *digits;
  }
  if (text != "Z")
    return std::nullopt;
  if (utc.tm_mon > 11 || utc.tm_mday > days_of_month(year, utc.tm_mon))
    return std::nullopt;
  utc.tm_year = year - 1900;
  const std::time_t seconds = ::timegm(&utc);
  return Stamp(std::chrono::seconds(seconds) + fraction);
}

}  // namespace geocontainer_mpm::vessel
