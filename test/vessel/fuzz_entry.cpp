/// What a peer's bytes go through, for libFuzzer (clang, GEOCONTAINER_MPM_BUILD_FUZZERS) and for fuzz_test.cpp.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "geocontainer_mpm/vessel/nmea_angles.h"
#include "geocontainer_mpm/vessel/signalk_delta.h"

namespace {

using namespace geocontainer_mpm::vessel;

void require(bool right)
{
  if (!right)
    std::abort();
}

void read_nmea(std::string_view bytes, std::size_t chunk)
{
  SentenceSplitter splitter;
  NmeaCounts counts;
  Sentence sentence;
  const auto take = [&](std::string_view line) {
    require(line.size() <= longest_body);
    if (const auto fault = parse_sentence(line, sentence)) {
      counts.add(*fault);
      return;
    }
    ++counts.sentences;
    for (const HullAngle& angle : read_hull_angles(sentence, {}, counts))
      require(angle.angle_rad >= -6.2832 && angle.angle_rad <= 6.2832);
  };
  while (!bytes.empty()) {
    splitter.feed(bytes.substr(0, chunk), counts, take);
    bytes.remove_prefix(bytes.size() < chunk ? bytes.size() : chunk);
  }
  splitter.end_of_datagram(counts, take);
}

void read_signalk(std::string_view text)
{
  const Incoming message = read_message(text);
  require(message.kind == IncomingKind::delta || message.values.empty());
  for (const IncomingValue& value : message.values) {
    require(!value.path.empty());
    if (value.stamp)  // what was read is written as what is read
      require(parse_utc(format_utc(*value.stamp)).has_value());
  }
}

}  // namespace

/// The first byte chooses the reader, and the size of chunks of a stream.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  if (size == 0)
    return 0;
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  if (data[0] % 2 == 0)
    read_nmea(bytes, 1 + data[0] / 2);
  else
    read_signalk(bytes);
  return 0;
}
