/// Sentences: what is written is read again, one wrong character is noticed, chunks do not matter.
#include "geocontainer_mpm/vessel/nmea0183.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "geocontainer_mpm/vessel/nmea_angles.h"
#include "geocontainer_mpm/vessel/opening_pair.h"

namespace geocontainer_mpm::vessel {
namespace {

constexpr double pi = 3.14159265358979323846;

/// A line without its end.
std::string line_of(const std::string& sentence)
{
  return sentence.substr(0, sentence.size() - 2);
}

std::optional<NmeaFault> fault_of(const std::string& line)
{
  Sentence sentence;
  return parse_sentence(line, sentence);
}

rc::Gen<std::string> field_text()
{
  static const std::string allowed = "ABCXYZabc0123456789.-_ ()/:;#%+=?";
  return rc::gen::scale(0.15, rc::gen::container<std::string>(rc::gen::elementOf(allowed)));
}

TEST(Nmea, ChecksumOfAPublishedSentence)
{
  // The example of the public domain "NMEA Revealed" (E. S. Raymond), section GLL.
  EXPECT_EQ(nmea_checksum("GNGLL,4404.14012,N,12118.85993,W,001037.00,A,A"), 0x67);
  EXPECT_EQ(fault_of("$GNGLL,4404.14012,N,12118.85993,W,001037.00,A,A*67"), std::nullopt);
}

TEST(Nmea, EveryFaultHasItsName)
{
  EXPECT_EQ(fault_of("IIXDR"), NmeaFault::noise);
  EXPECT_EQ(fault_of("$IIXDR,A,1,D,HULL_PORT"), NmeaFault::no_checksum);
  EXPECT_EQ(fault_of("$IIXDR,A,1,D,HULL_PORT*G0"), NmeaFault::no_checksum);
  EXPECT_EQ(fault_of("$IIXDR,A,1,D,HULL_PORT*00"), NmeaFault::bad_checksum);
  EXPECT_EQ(fault_of("$II\x01*00"), NmeaFault::bad_character);
  EXPECT_EQ(fault_of("$IIX*58"), NmeaFault::bad_address);
  EXPECT_EQ(fault_of("$" + std::string(90, 'A') + "*00"), NmeaFault::too_long);
}

TEST(Nmea, ReservedCharactersAndLongSentencesAreNotWritten)
{
  EXPECT_FALSE(write_sentence("IIXDR", { "a,b" }));
  EXPECT_FALSE(write_sentence("IIXDR", { "a*b" }));
  EXPECT_FALSE(write_sentence("IIXDR", { "a\r" }));
  EXPECT_FALSE(write_sentence("II", { "a" }));
  // $IIXDR, + n + *hh + line end = 12 + n
  EXPECT_TRUE(write_sentence("IIXDR", { std::string(70, 'a') }));
  EXPECT_FALSE(write_sentence("IIXDR", { std::string(71, 'a') }));
}

RC_GTEST_PROP(Nmea, WhatIsWrittenIsReadAgain, ())
{
  const auto fields = *rc::gen::scale(0.1, rc::gen::container<std::vector<std::string>>(field_text()));
  const auto text = write_sentence("IIXDR", fields);
  RC_PRE(text.has_value());
  Sentence sentence;
  const std::string line = line_of(*text);
  RC_ASSERT(parse_sentence(line, sentence) == std::nullopt);
  RC_ASSERT(sentence.talker == "II");
  RC_ASSERT(sentence.formatter == "XDR");
  RC_ASSERT(std::vector<std::string>(sentence.fields.begin(), sentence.fields.end()) == fields);
}

RC_GTEST_PROP(Nmea, AnyChangedCharacterIsNoticed, ())
{
  std::string line = line_of(write_hull_angles(0.1, 0.2, {}).front());
  const auto place = *rc::gen::inRange<std::size_t>(0, line.size());
  const auto character = *rc::gen::arbitrary<char>();
  RC_PRE(character != line[place]);
  // The checksum may be written in small letters.
  RC_PRE(std::toupper(static_cast<unsigned char>(character)) != line[place] || place + 2 < line.size());
  const bool start_changed = place == 0 && character == '!';
  line[place] = character;
  RC_ASSERT(start_changed || fault_of(line).has_value());
}

std::vector<std::string> split(const std::string& bytes, const std::vector<std::size_t>& sizes, NmeaCounts& counts)
{
  SentenceSplitter splitter;
  std::vector<std::string> lines;
  const auto take = [&](std::string_view line) { lines.emplace_back(line); };
  std::string_view rest = bytes;
  for (std::size_t i = 0; !rest.empty(); ++i) {
    const std::size_t size = sizes.empty() ? rest.size() : std::min(rest.size(), 1 + sizes[i % sizes.size()]);
    splitter.feed(rest.substr(0, size), counts, take);
    rest.remove_prefix(size);
  }
  return lines;
}

RC_GTEST_PROP(Nmea, ChunksDoNotMatter, ())
{
  const auto bytes = *rc::gen::container<std::string>(rc::gen::weightedOneOf<char>(
      { { 6, rc::gen::elementOf(std::string("$!*,\r\nIXDR0123")) }, { 1, rc::gen::arbitrary<char>() } }));
  const auto sizes = *rc::gen::nonEmpty(rc::gen::container<std::vector<std::size_t>>(rc::gen::inRange(0, 9)));
  NmeaCounts whole_counts, chunk_counts;
  const auto whole = split(bytes, {}, whole_counts);
  RC_ASSERT(split(bytes, sizes, chunk_counts) == whole);
  RC_ASSERT(whole_counts.faults == chunk_counts.faults);
  for (const std::string& line : whole)
    RC_ASSERT(line.size() <= longest_body && (line.front() == '$' || line.front() == '!'));
}

TEST(Nmea, GarbageBetweenSentencesCostsNone)
{
  const std::string good = write_hull_angles(0.1, 0.2, {}).front();
  NmeaCounts counts;
  const std::string tag_block = "\\s:hull,c:1700000000*1F\\";
  const auto lines = split("garbage\n" + good + "$IIXDR,broken" + good + std::string(1000, 'x') + "\n$" +
                               std::string(1000, 'y') + "\n" + tag_block + good,
                           {}, counts);
  EXPECT_EQ(lines, std::vector<std::string>(3, line_of(good)));
  EXPECT_EQ(counts.of(NmeaFault::too_long), 1U);
  EXPECT_EQ(counts.of(NmeaFault::noise), 4U);  // garbage, the broken line, x, the tag block
}

std::vector<HullAngle> angles_of(const std::string& body, NmeaCounts& counts, const NmeaNames& names = {})
{
  Sentence sentence;
  static std::string line;  // the sentence's views point into it
  static const char digits[] = "0123456789ABCDEF";
  const std::uint8_t sum = nmea_checksum(body);
  line = "$" + body + "*" + digits[sum >> 4] + digits[sum & 15];
  EXPECT_EQ(parse_sentence(line, sentence), std::nullopt) << body;
  return read_hull_angles(sentence, names, counts);
}

TEST(HullAngles, AreFoundAmongOtherTransducers)
{
  NmeaCounts counts;
  const auto angles = angles_of("IIXDR,C,19.5,C,TempAir,A,-3.25,D,HULL_STBD,A,12.5,D,HULL_PORT,A,1,D,PITCH", counts);
  ASSERT_EQ(angles.size(), 2U);
  EXPECT_EQ(angles[0].half, HullHalf::starboard);
  EXPECT_DOUBLE_EQ(angles[0].angle_rad, -3.25 * pi / 180.0);
  EXPECT_EQ(angles[1].half, HullHalf::port);
  EXPECT_DOUBLE_EQ(angles[1].angle_rad, 12.5 * pi / 180.0);
  EXPECT_EQ(counts.angles, 2U);
  EXPECT_EQ(counts.faults, NmeaCounts{}.faults);
}

TEST(HullAngles, NamesAreConfigurable)
{
  NmeaCounts counts;
  EXPECT_EQ(angles_of("YXXDR,A,1,D,BB,A,2,D,SB", counts, { "YX", "BB", "SB" }).size(), 2U);
  EXPECT_TRUE(angles_of("YXXDR,A,1,D,BB,A,2,D,SB", counts).empty());
}

TEST(HullAngles, FaultsAreCountedByKind)
{
  NmeaCounts counts;
  EXPECT_TRUE(angles_of("IIXDR,A,1,D", counts).empty());
  EXPECT_TRUE(angles_of("IIXDR,A,1e3,D,HULL_PORT", counts).empty());
  EXPECT_TRUE(angles_of("IIXDR,A,nan,D,HULL_PORT", counts).empty());
  EXPECT_EQ(counts.of(NmeaFault::bad_field), 3U);
  EXPECT_TRUE(angles_of("IIXDR,A,,D,HULL_PORT", counts).empty());
  EXPECT_EQ(counts.of(NmeaFault::empty_field), 1U);
  EXPECT_TRUE(angles_of("IIXDR,A,360.1,D,HULL_PORT", counts).empty());
  EXPECT_EQ(counts.of(NmeaFault::out_of_range), 1U);
  // Another type or unit under our name is another quantity, and so is another sentence.
  EXPECT_TRUE(angles_of("IIXDR,A,1,P,HULL_PORT,U,1,D,HULL_PORT", counts).empty());
  EXPECT_TRUE(angles_of("IIROT,1,A,1", counts).empty());
  EXPECT_EQ(counts.angles, 0U);
}

RC_GTEST_PROP(HullAngles, SurviveWritingToFourDecimalsOfADegree, ())
{
  const double port = 1e-6 * *rc::gen::inRange(-6'000'000, 6'000'000);
  const double starboard = 1e-6 * *rc::gen::inRange(-6'000'000, 6'000'000);
  NmeaCounts counts;
  std::vector<HullAngle> angles;
  for (const std::string& text : write_hull_angles(port, starboard, {})) {
    RC_ASSERT(text.size() <= longest_sentence);
    Sentence sentence;
    const std::string line = line_of(text);
    RC_ASSERT(parse_sentence(line, sentence) == std::nullopt);
    const auto read = read_hull_angles(sentence, {}, counts);
    angles.insert(angles.end(), read.begin(), read.end());
  }
  RC_ASSERT(angles.size() == 2U);
  const double half_digit = 0.5e-4 * pi / 180.0 + 1e-12;  // rounding to the last decimal, and of the product
  RC_ASSERT(std::abs(angles[0].angle_rad - port) <= half_digit);
  RC_ASSERT(std::abs(angles[1].angle_rad - starboard) <= half_digit);
}

TEST(HullAngles, LongNamesTakeTwoSentences)
{
  const NmeaNames names{ "II", std::string(30, 'P'), std::string(30, 'S') };
  EXPECT_EQ(write_hull_angles(0.1, 0.2, names).size(), 2U);
}

TEST(ReleaseSentence, SaysTheFigures)
{
  ReleaseFigures figures;
  figures.state = ReleaseState::released;
  figures.peak_utilisation = 0.4567;
  figures.peak_tension_n_per_m = 45670.4;
  figures.current_tension_n_per_m = 12000.0;
  figures.centroid_m = { 0.0, 0.1, -2.345 };
  figures.width_m = 4.5;
  figures.release_time_s = 21.25;
  figures.lag_s = 0.125;
  EXPECT_EQ(write_release(figures).substr(0, 47), "$PGCM,1,O,45.7,45670,12000,-2.35,4.50,21.25,0.1");
  figures.stopped = true;
  figures.release_time_s = -1.0;
  EXPECT_EQ(write_release(figures).substr(0, 10), "$PGCM,1,S,");
}

RC_GTEST_PROP(ReleaseSentence, FitsWhateverTheFigures, ())
{
  const auto figure =
      rc::gen::map(rc::gen::pair(rc::gen::inRange(-9'999'999, 9'999'999), rc::gen::inRange(-8, 300)),
                   [](const std::pair<int, int>& draw) { return draw.first * std::pow(10.0, draw.second); });
  ReleaseFigures release;
  release.peak_utilisation = *figure;
  release.peak_tension_n_per_m = *figure;
  release.current_tension_n_per_m = *figure;
  release.centroid_m[2] = *figure;
  release.width_m = *figure;
  release.release_time_s = *figure;
  release.lag_s = *figure;
  const std::string text = write_release(release);
  RC_ASSERT(!text.empty() && text.size() <= longest_sentence);
  RC_ASSERT(fault_of(line_of(text)) == std::nullopt);
}

TEST(OpeningPair, TakesEachAngleOnce)
{
  using std::chrono::milliseconds;
  OpeningPair pair(milliseconds(100));
  const Stamp zero{};
  EXPECT_FALSE(pair.add(HullHalf::port, zero, 0.1));
  const auto sample = pair.add(HullHalf::starboard, zero + milliseconds(50), 0.2);
  ASSERT_TRUE(sample);
  EXPECT_EQ(sample->stamp, zero + milliseconds(50));
  EXPECT_EQ(sample->port_rad, 0.1);
  EXPECT_EQ(sample->starboard_rad, 0.2);
  // One half alone, then one that comes too late for the other.
  EXPECT_FALSE(pair.add(HullHalf::port, zero + milliseconds(100), 0.3));
  EXPECT_FALSE(pair.add(HullHalf::port, zero + milliseconds(200), 0.4));
  EXPECT_EQ(pair.unpaired(), 1U);
  EXPECT_FALSE(pair.add(HullHalf::starboard, zero + milliseconds(400), 0.5));
  EXPECT_EQ(pair.unpaired(), 2U);
  const auto next = pair.add(HullHalf::port, zero + milliseconds(420), 0.6);
  ASSERT_TRUE(next);
  EXPECT_EQ(next->starboard_rad, 0.5);
}

}  // namespace
}  // namespace geocontainer_mpm::vessel
