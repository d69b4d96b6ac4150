#pragma once
/// Instants on the wire: UTC, ISO 8601 with milliseconds and Z.

#include <chrono>
#include <optional>
#include <string>
#include <string_view>

namespace geocontainer_mpm::vessel {

using Stamp = std::chrono::time_point<std::chrono::system_clock, std::chrono::nanoseconds>;

/// `2026-11-26T09:20:14.123Z`, rounded down to a millisecond. Years 0 to 9999; the epoch's beginning for others.
std::string format_utc(Stamp stamp);

/// The same with any number of digits after the second, or none. Nothing for another form, an impossible date
/// or a year outside of 1970 to 2199.
std::optional<Stamp> parse_utc(std::string_view text);

}  // namespace geocontainer_mpm::vessel
