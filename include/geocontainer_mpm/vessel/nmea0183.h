#pragma once
/// NMEA 0183 sentences: cut out of any stream of bytes, checked, read and written. Faults are counted by kind and
/// ignored; nothing here throws or grows with what a peer sends.
///
/// A sentence is `$` (or `!`), an address, fields parted by commas, `*`, two hexadecimal digits (the exclusive or of
/// all characters between `$` and `*`), carriage return, line feed: 82 characters at most in all (NMEA 0183
/// version 4.11, 5.3).

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace geocontainer_mpm::vessel {

constexpr std::size_t longest_sentence = 82;                ///< characters, with `$` and line end
constexpr std::size_t longest_body = longest_sentence - 2;  ///< without the line end
constexpr std::size_t most_fields = longest_body;           ///< a comma each cannot be more

/// Why a line was not taken for a sentence, or a field not for an angle.
enum class NmeaFault {
  noise,          ///< characters outside of sentences; one count for each run of them
  too_long,       ///< more than 82 characters before the line end
  bad_character,  ///< not printable ASCII, or a reserved one inside
  no_checksum,    ///< no `*hh` at the end
  bad_checksum,   ///< `*hh` differs from the characters
  bad_address,    ///< not a talker of two and a formatter of three characters, nor P and a name
  bad_field,      ///< an XDR that is not made of quadruples, or a watched transducer's value that is no number
  empty_field,    ///< a watched transducer without a value: the sensor has none
  out_of_range,   ///< a watched angle outside of -360 to 360 degrees
};
constexpr std::size_t nmea_fault_count = 9;
const char* to_string(NmeaFault fault);

struct NmeaCounts {
  std::uint64_t sentences = 0;  ///< with a right checksum, of any kind
  std::uint64_t angles = 0;     ///< of watched transducers
  std::array<std::uint64_t, nmea_fault_count> faults{};

  void add(NmeaFault fault) { ++faults[static_cast<std::size_t>(fault)]; }
  std::uint64_t of(NmeaFault fault) const { return faults[static_cast<std::size_t>(fault)]; }
};

/// Exclusive or of the characters between `$` and `*`.
std::uint8_t nmea_checksum(std::string_view characters);

/// Views into the line that was parsed.
struct Sentence {
  char start = '$';
  std::string_view talker;     ///< two characters; `P` of a proprietary one
  std::string_view formatter;  ///< three characters; of a proprietary one all of its name
  std::vector<std::string_view> fields;
};

/// A whole line without its line end. Nothing but a fault is returned for one that is not right in every point.
std::optional<NmeaFault> parse_sentence(std::string_view line, Sentence& sentence);

/// With checksum and line end. Nothing when it would be too long or a field has a reserved character.
std::optional<std::string> write_sentence(std::string_view address, const std::vector<std::string>& fields);

/// Cuts lines that begin with `$` or `!` out of chunks of any size, as they come from a socket. Holds 80 characters.
class SentenceSplitter {
public:
  /// Calls `take(std::string_view line)` for each line; the view is good until it returns.
  template <typename Take>
  void feed(std::string_view chunk, NmeaCounts& counts, Take&& take)
  {
    for (const char character : chunk)
      if (push(character, counts)) {
        take(std::string_view(line_.data(), size_));
        size_ = 0;
        inside_ = false;
      }
  }

  /// The end of a datagram ends a line; a new connection begins with none.
  template <typename Take>
  void end_of_datagram(NmeaCounts& counts, Take&& take)
  {
    feed("\n", counts, take);
  }
  void clear() { *this = {}; }

private:
  /// True when a line is complete.
  bool push(char character, NmeaCounts& counts);

  std::array<char, longest_body> line_{};
  std::size_t size_ = 0;
  bool inside_ = false;    ///< between a start and a line end
  bool overlong_ = false;  ///< the rest of a line that was too long
  bool in_noise_ = false;
};

}  // namespace geocontainer_mpm::vessel
