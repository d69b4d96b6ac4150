/// The fuzzer's entry with good messages that were mutilated by chance: short and the same in every run. The long one
/// is libFuzzer's (docs/vessel.md).
#include <gtest/gtest.h>

#include <array>
#include <random>
#include <string>

#include "geocontainer_mpm/vessel/nmea_angles.h"
#include "geocontainer_mpm/vessel/signalk_delta.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace geocontainer_mpm::vessel {
namespace {

void feed(const std::string& bytes)
{
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
}

/// Changes, takes out, doubles or moves a few stretches.
std::string mutilated(std::string bytes, std::minstd_rand& chance)
{
  const auto below = [&](std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n - 1)(chance); };
  for (std::size_t count = 1 + below(6); count > 0 && bytes.size() > 1; --count) {
    const std::size_t place = 1 + below(bytes.size() - 1);
    const std::size_t size = 1 + below(8);
    switch (below(5)) {
      case 0:
        bytes[place] = static_cast<char>(below(256));
        break;
      case 1:
        bytes.erase(place, size);
        break;
      case 2:
        bytes.insert(place, bytes.substr(place, size));
        break;
      case 3:
        bytes.insert(place, std::array<const char*, 6>{ "[", "{\"a\":", "\"", "$", "*", "," }[below(6)]);
        break;
      default:
        bytes.insert(place, 1 + below(200), bytes[place]);
        break;
    }
  }
  return bytes;
}

TEST(Fuzz, MutilatedSentences)
{
  std::string seed = "0";  // '0' is even: sentences, in chunks of 25
  for (const std::string& sentence : write_hull_angles(0.1, 0.2, {}))
    seed += sentence;
  seed += "$IIXDR,C,19.5,C,TempAir,A,1.5,D,HULL_PORT*00\r\n" + write_release({});
  std::minstd_rand chance(20161);
  for (int i = 0; i < 20'000; ++i)
    feed(mutilated(seed, chance));
}

TEST(Fuzz, MutilatedDeltas)
{
  const std::string delta = "1" + write_delta({ { "a.b", 0.5, Stamp{} },
                                                { "n", Notice{ "alarm", "x", true, true }, {} },
                                                { "c", Columns{ { "y", { 0.5, -1.0 } }, { "z", {} } }, {} } },
                                              "me");
  const std::string hello = R"(1{"name":"x","version":"2.23.0","self":"vessels.urn:x","roles":["main"]})";
  std::minstd_rand chance(20161);
  for (int i = 0; i < 10'000; ++i) {
    feed(mutilated(delta, chance));
    feed(mutilated(hello, chance));
  }
}

TEST(Fuzz, NoiseAlone)
{
  std::minstd_rand chance(20161);
  std::uniform_int_distribution<int> byte(0, 255);
  for (int i = 0; i < 2'000; ++i) {
    std::string bytes(static_cast<std::size_t>(i % 300), '\0');
    for (char& c : bytes)
      c = static_cast<char>(byte(chance));
    feed(bytes);
  }
}

}  // namespace
}  // namespace geocontainer_mpm::vessel
