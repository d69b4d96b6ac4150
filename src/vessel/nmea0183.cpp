#include "geocontainer_mpm/vessel/nmea0183.h"

#include <algorithm>

namespace geocontainer_mpm::vessel {
namespace {

bool is_upper_or_digit(char character)
{
  return (character >= 'A' && character <= 'Z') || (character >= '0' && character <= '9');
}

bool all_upper_or_digit(std::string_view text)
{
  return std::all_of(text.begin(), text.end(), is_upper_or_digit);
}

bool is_start(char character)
{
  return character == '$' || character == '!';
}

/// Printable and with no meaning of its own inside a sentence: `$ ! * \ ^ ~` are reserved; `,` parts fields.
bool may_stand_in_field(char character)
{
  return character >= 0x20 && character < 0x7f &&
         std::string_view("$!*\\^~,").find(character) == std::string_view::npos;
}

int hexadecimal(char digit)
{
  if (digit >= '0' && digit <= '9')
    return digit - '0';
  if (digit >= 'A' && digit <= 'F')
    return digit - 'A' + 10;
  return digit >= 'a' && digit <= 'f' ? digit - 'a' + 10 : -1;
}

void split(std::string_view characters, std::vector<std::string_view>& parts)
{
  parts.clear();
  while (true) {
    const std::size_t comma = characters.find(',');
    parts.push_back(characters.substr(0, comma));
    if (comma == std::string_view::npos)
      return;
    characters.remove_prefix(comma + 1);
  }
}

}  // namespace

const char* to_string(NmeaFault fault)
{
  static constexpr std::array<const char*, nmea_fault_count> names = { "noise",       "too long",     "bad character",
                                                                       "no checksum", "bad checksum", "bad address",
                                                                       "bad field",   "empty field",  "out of range" };
  return names[static_cast<std::size_t>(fault)];
}

std::uint8_t nmea_checksum(std::string_view characters)
{
  std::uint8_t sum = 0;
  for (const char character : characters)
    sum = static_cast<std::uint8_t>(sum ^ static_cast<std::uint8_t>(character));
  return sum;
}

std::optional<NmeaFault> parse_sentence(std::string_view line, Sentence& sentence)
{
  if (line.empty() || !is_start(line.front()))
    return NmeaFault::noise;
  if (line.size() > longest_body)
    return NmeaFault::too_long;
  const std::size_t star = line.find('*');
  if (star == std::string_view::npos || star + 3 != line.size())
    return NmeaFault::no_checksum;
  const std::string_view characters = line.substr(1, star - 1);
  if (!std::all_of(characters.begin(), characters.end(), [](char c) { return c == ',' || may_stand_in_field(c); }))
    return NmeaFault::bad_character;
  const int high = hexadecimal(line[star + 1]);
  const int low = hexadecimal(line[star + 2]);
  if (high < 0 || low < 0)
    return NmeaFault::no_checksum;
  if (nmea_checksum(characters) != high * 16 + low)
    return NmeaFault::bad_checksum;

  split(characters, sentence.fields);
  const std::string_view address = sentence.fields.front();
  const bool proprietary = address.size() >= 4 && address.front() == 'P';
  if (!all_upper_or_digit(address) || (!proprietary && address.size() != 5))
    return NmeaFault::bad_address;
  const std::size_t talker = proprietary ? 1 : 2;
  sentence.start = line.front();
  sentence.talker = address.substr(0, talker);
  sentence.formatter = address.substr(talker);
  sentence.fields.erase(sentence.fields.begin());
  return std::nullopt;
}

std::optional<std::string> write_sentence(std::string_view address, const std::vector<std::string>& fields)
{
  static constexpr char digits[] = "0123456789ABCDEF";
  if (address.size() < 4 || !all_upper_or_digit(address))
    return std::nullopt;
  std::string text = "$";
  text += address;
  for (const std::string& field : fields) {
    if (!std::all_of(field.begin(), field.end(), may_stand_in_field))
      return std::nullopt;
    text += ',';
    text += field;
  }
  const std::uint8_t sum = nmea_checksum(std::string_view(text).substr(1));
  text += '*';
  text += digits[sum >> 4U];
  text += digits[sum & 15U];
  text += "\r\n";
  return text.size() <= longest_sentence ? std::optional<std::string>(text) : std::nullopt;
}

bool SentenceSplitter::push(char character, NmeaCounts& counts)
{
  if (character == '\r' || character == '\n') {
    overlong_ = in_noise_ = false;
    return inside_;
  }
  if (is_start(character)) {
    // A start inside a sentence: the line before it lost its end, or was a tag block (\...*hh\$...).
    if (inside_)
      counts.add(NmeaFault::noise);
    inside_ = true;
    overlong_ = in_noise_ = false;
    size_ = 0;
  }
  if (!inside_) {
    if (!in_noise_ && !overlong_)
      counts.add(NmeaFault::noise);
    in_noise_ = true;
    return false;
  }
  if (size_ == line_.size()) {
    counts.add(NmeaFault::too_long);
    overlong_ = true;
    inside_ = false;
    size_ = 0;
    return false;
  }
  line_[size_++] = character;
  return false;
}

}  // namespace geocontainer_mpm::vessel
