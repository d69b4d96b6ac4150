/// Deltas: written as the specification says, read back as they were, harmless whatever comes.
#include "geocontainer_mpm/vessel/signalk_delta.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "geocontainer_mpm/vessel/path_ledger.h"

namespace geocontainer_mpm::vessel {
namespace {

using Json = nlohmann::json;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;

TEST(Utc, KnownInstants)
{
  EXPECT_EQ(format_utc(Stamp{}), "1970-01-01T00:00:00.000Z");
  EXPECT_EQ(format_utc(Stamp(std::chrono::seconds(1709210096) + nanoseconds(7'999'999))), "2024-02-29T12:34:56.007Z");
  EXPECT_EQ(parse_utc("2024-02-29T12:34:56.007Z"), Stamp(std::chrono::seconds(1709210096) + milliseconds(7)));
  EXPECT_EQ(parse_utc("2024-02-29T12:34:56Z"), Stamp(std::chrono::seconds(1709210096)));
  for (const char* wrong :
       { "", "2024-02-29", "2024-02-29T12:34:56", "2024-02-29T12:34:56+01:00", "2023-02-29T00:00:00Z",
         "2024-13-01T00:00:00Z", "2024-01-01T24:00:00Z", "2024-01-01T00:00:00.Z", "0001-01-01T00:00:00Z",
         "2024-01-01T00:00:00Z ", "2024-0a-01T00:00:00Z" })
    EXPECT_FALSE(parse_utc(wrong)) << wrong;
}

RC_GTEST_PROP(Utc, RoundTripToTheMillisecond, ())
{
  const auto count = *rc::gen::inRange<std::int64_t>(0, 4'000'000'000'000);
  const Stamp stamp{ milliseconds(count) };
  RC_ASSERT(parse_utc(format_utc(stamp)) == stamp);
}

TEST(Delta, IsAsTheSpecificationSays)
{
  const Stamp stamp{ milliseconds(1'500) };
  const Json delta = Json::parse(
      write_delta({ { "a.b", 0.5, stamp },
                    { "a.c", std::string("text"), stamp },
                    { "a.d", Value(), stamp },
                    { "notifications.a", Notice{ "alarm", "look", true, false }, stamp + milliseconds(1) } },
                  "me"));
  EXPECT_EQ(delta, Json::parse(R"({"context": "vessels.self", "updates": [
      {"$source": "me", "timestamp": "1970-01-01T00:00:01.500Z", "values": [
          {"path": "a.b", "value": 0.5}, {"path": "a.c", "value": "text"}, {"path": "a.d", "value": null}]},
      {"$source": "me", "timestamp": "1970-01-01T00:00:01.501Z", "values": [
          {"path": "notifications.a", "value": {"state": "alarm", "method": ["visual", "sound"], "message": "look"}}]}]})"));
}

TEST(Delta, MetaHasUnitsDescriptionsAndZones)
{
  const auto paths = describe_figures("cargo", 0.8, 1.0);
  const Json meta = Json::parse(write_meta(paths, "me", Stamp{}));
  ASSERT_EQ(meta["updates"][0]["meta"].size(), release_figures().size() + forecast_figures().size() +
                                                   ensemble_figures().size() + section_figures().size());
  std::size_t with_zones = 0;
  for (const Json& entry : meta["updates"][0]["meta"]) {
    EXPECT_FALSE(entry["value"]["description"].get<std::string>().empty());
    if (!entry["value"].contains("zones"))
      continue;
    ++with_zones;
    EXPECT_EQ(entry["path"], "cargo.utilisation.peak");
    EXPECT_EQ(entry["value"]["zones"][1]["lower"], 0.8);
    EXPECT_EQ(entry["value"]["zones"][1]["upper"], 1.0);
    EXPECT_EQ(entry["value"]["zones"][2]["state"], "alarm");
    EXPECT_FALSE(entry["value"]["zones"][2].contains("upper"));
  }
  EXPECT_EQ(with_zones, 1U);
  for (const PathMeta& path : describe_figures("cargo", 0.0, 0.0))
    EXPECT_TRUE(path.zones.empty());
}

RC_GTEST_PROP(Delta, NumbersAndTextsSurviveToTheLastBit, ())
{
  const double number = *rc::gen::arbitrary<double>();
  RC_PRE(std::isfinite(number));
  const auto text = *rc::gen::string<std::string>();
  const Stamp stamp{ milliseconds(*rc::gen::inRange<std::int64_t>(0, 4'000'000'000'000)) };
  const Incoming read = read_message(write_delta({ { "a", number, stamp }, { "b", text, stamp } }, "me"));
  RC_ASSERT(read.kind == IncomingKind::delta);
  RC_ASSERT(read.values.size() == 2U);
  RC_ASSERT(std::get<double>(read.values[0].value) == number);
  RC_ASSERT(read.values[0].stamp == stamp);
  RC_ASSERT(read.values[0].source == "me");
  RC_ASSERT(std::get<std::string>(read.values[1].value).size() >= text.size());  // what is no UTF-8 is replaced
}

RC_GTEST_PROP(Delta, ColumnsSurviveAndOtherObjectsAreNothing, ())
{
  const auto number = rc::gen::map(rc::gen::inRange(-1'000'000, 1'000'000), [](int n) { return 1e-3 * n; });
  const Value columns = Columns{ { "y", *rc::gen::container<std::vector<double>>(number) }, { "z", { 0.1 } } };
  const Incoming read = read_message(write_delta({ { "a", columns, {} } }, "me"));
  RC_ASSERT(read.values.at(0).value == columns);
  for (const char* other : { "{}", R"({"y":1})", R"({"y":[1,"2"]})", R"({"y":[1],"z":null})" }) {
    const Incoming nothing =
        read_message(std::string(R"({"updates":[{"values":[{"path":"a","value":)") + other + "}]}]}");
    RC_ASSERT(nothing.values.at(0).value == Value());
  }
}

TEST(Figures, WhatIsNotKnownIsNull)
{
  for (const PathValue& value : to_values(ensemble_figures(), EnsembleFigures{}, "c"))
    if (value.path != "c.advice.state" && value.path != "c.advice.message") {
      EXPECT_EQ(value.value, Value()) << value.path;
    }
  ForecastFigures forecast;
  forecast.until_release_s = 5.0;  // of no release
  for (const PathValue& value : to_values(forecast_figures(), forecast, "c"))
    if (value.path.find("forecast.release.") != std::string::npos) {
      EXPECT_EQ(value.value, Value()) << value.path;
    }
  EnsembleFigures ensemble;
  ensemble.release_delay_s.p90 = std::numeric_limits<double>::infinity();
  ensemble.advised_rate_rad_per_s = 0.01;
  ensemble.advice = AdviceState::no_rate;
  for (const PathValue& value : to_values(ensemble_figures(), ensemble, "c"))
    if (value.path == "c.ensemble.release.p90" || value.path == "c.advice.rate") {
      EXPECT_EQ(value.value, Value()) << value.path;
    }
}

RC_GTEST_PROP(Figures, AThinCurveKeepsEndsAndPeak, ())
{
  const auto count = *rc::gen::inRange<std::size_t>(1, 400);
  const auto tension = *rc::gen::container<std::vector<double>>(
      count, rc::gen::map(rc::gen::inRange(0, 200'000), [](int n) { return double(n); }));
  std::vector<double> time;
  for (std::size_t i = 0; i < count; ++i)
    time.push_back(0.5 * static_cast<double>(i));
  Columns curve = thin_curve(time, tension);
  RC_ASSERT(curve["time"].size() == std::min(count, most_points));
  RC_ASSERT(curve["time"].size() == curve["tension"].size());
  RC_ASSERT(std::is_sorted(curve["time"].begin(), curve["time"].end()));
  RC_ASSERT(curve["time"].front() == time.front() && curve["time"].back() == time.back());
  RC_ASSERT(*std::max_element(curve["tension"].begin(), curve["tension"].end()) ==
            *std::max_element(tension.begin(), tension.end()));
}

RC_GTEST_PROP(Figures, AThinOutlineKeepsTheLargestUtilisation, ())
{
  const auto points = *rc::gen::inRange<std::size_t>(2, 400);
  const bool closed = *rc::gen::arbitrary<bool>();
  const auto place = rc::gen::map(rc::gen::inRange(-9'000, 9'000), [](int n) { return 1e-3 * n; });
  const auto y = *rc::gen::container<std::vector<double>>(points, place);
  const auto utilisation = *rc::gen::container<std::vector<double>>(
      closed ? points : points - 1, rc::gen::map(rc::gen::inRange(0, 1'500), [](int n) { return 1e-3 * n; }));
  Columns outline = thin_outline(y, y, utilisation);
  const std::size_t pieces = outline["utilisation"].size();
  RC_ASSERT(outline["y"].size() == outline["z"].size());
  RC_ASSERT(outline["y"].size() == (closed ? pieces : pieces + 1));
  RC_ASSERT(outline["y"].size() <= most_points + 1);
  RC_ASSERT(std::abs(*std::max_element(outline["utilisation"].begin(), outline["utilisation"].end()) -
                     *std::max_element(utilisation.begin(), utilisation.end())) < 1e-9);
  RC_ASSERT(std::abs(outline["y"].front() - y.front()) < 1e-9);
  RC_ASSERT(closed || std::abs(outline["y"].back() - y.back()) < 1e-9);
}

TEST(Incoming, KindsAreToldApart)
{
  EXPECT_EQ(read_message(R"({"name":"x","version":"2.23.0","self":"vessels.urn:x"})").kind, IncomingKind::hello);
  EXPECT_EQ(read_message(R"({"name":"x","version":"2.23.0","self":"vessels.urn:x"})").self, "vessels.urn:x");
  EXPECT_EQ(read_message(R"({"requestId":"1"})").kind, IncomingKind::other);
  EXPECT_EQ(read_message("[1]").kind, IncomingKind::faulty);
  EXPECT_EQ(read_message("HTTP/1.1 400").kind, IncomingKind::faulty);
  EXPECT_EQ(read_message("").kind, IncomingKind::faulty);
}

TEST(Incoming, WrongPartsAreLeftOut)
{
  const Incoming read = read_message(R"({"updates":[1,{"values":7},{"values":[1,{"path":3,"value":1},{"path":"a"},
      {"path":"b","value":[1]},{"path":"c","value":2}],"timestamp":5,"$source":{}}]})");
  ASSERT_EQ(read.values.size(), 2U);
  EXPECT_EQ(read.values[0].value, Value());
  EXPECT_EQ(read.values[1].value, Value(2.0));
  EXPECT_FALSE(read.values[1].stamp);
}

TEST(Incoming, SizeDepthAndNumberAreBounded)
{
  IncomingLimits limits;
  EXPECT_EQ(read_message(std::string(limits.longest + 1, ' '), limits).kind, IncomingKind::faulty);
  EXPECT_EQ(read_message(std::string(limits.longest, '['), limits).kind, IncomingKind::faulty);
  const std::string brackets = std::string(100, '[') + std::string(100, ']');
  EXPECT_EQ(read_message(R"({"a":")" + brackets + R"(\"[["})", limits).kind, IncomingKind::other);  // in a text
  EXPECT_EQ(read_message(R"({"a":)" + brackets + "}", limits).kind, IncomingKind::faulty);
  limits.most_values = 2;
  EXPECT_EQ(read_message(R"({"updates":[{"values":[{"path":"a","value":1},{"path":"a","value":1},
      {"path":"a","value":1}]}]})",
                         limits)
                .values.size(),
            2U);
}

class Ledger : public ::testing::Test {
protected:
  static IncomingValue echo(const PathValue& value) { return { value.path, "me", value.stamp, value.value }; }
  PathLedger ledger_{ { { "a", "", "", {} }, { "b", "", "", {} } } };
  PathLedger::Steady now_{};
};

TEST_F(Ledger, KeepsTheNewestOfEachPath)
{
  EXPECT_EQ(ledger_.put({ "a", 1.0, {} }), PathLedger::Put::queued);
  EXPECT_EQ(ledger_.put({ "a", 2.0, {} }), PathLedger::Put::replaced);
  EXPECT_EQ(ledger_.put({ "x", 2.0, {} }), PathLedger::Put::refused);
  const auto values = ledger_.take(10, now_);
  ASSERT_EQ(values.size(), 1U);
  EXPECT_EQ(values[0].value, Value(2.0));
  EXPECT_TRUE(ledger_.take(10, now_).empty());
}

TEST_F(Ledger, ConfirmsWhatComesBack)
{
  const PathValue first{ "a", 1.0, Stamp(milliseconds(1000)) };
  const PathValue second{ "a", 2.0, Stamp(milliseconds(2000)) };
  ledger_.put(first);
  ledger_.take(10, now_);
  ledger_.put(second);
  ledger_.take(10, now_ + milliseconds(5));
  EXPECT_FALSE(ledger_.confirm({ "a", "me", Stamp(milliseconds(999)), 1.0 }));   // older than what was sent
  EXPECT_FALSE(ledger_.confirm({ "a", "me", Stamp(milliseconds(2000)), 3.0 }));  // another value
  EXPECT_FALSE(ledger_.confirm({ "a", "me", std::nullopt, 1.0 }));
  EXPECT_TRUE(ledger_.confirm(echo(first)));
  ASSERT_TRUE(ledger_.oldest_wait());
  EXPECT_EQ(ledger_.oldest_wait()->second, now_ + milliseconds(5));
  EXPECT_TRUE(ledger_.confirm(echo(second)));
  EXPECT_FALSE(ledger_.oldest_wait());
  EXPECT_FALSE(ledger_.confirm(echo(second)));
}

TEST_F(Ledger, AServerThatTakesNothingIsSeenForAsLongAsItDoes)
{
  for (int i = 0; i < 1000; ++i) {
    ledger_.put({ "a", 1.0 * i, Stamp(milliseconds(i)) });
    ledger_.take(10, now_ + milliseconds(i));
  }
  EXPECT_EQ(ledger_.oldest_wait()->second, now_);
}

TEST_F(Ledger, ANewConnectionIsToldEverythingAgain)
{
  ledger_.put({ "a", 1.0, {} });
  ledger_.put({ "b", 2.0, {} });
  ledger_.take(10, now_);
  ledger_.begin_connection();
  EXPECT_FALSE(ledger_.oldest_wait());
  EXPECT_EQ(ledger_.take(1, now_).size(), 1U);
  EXPECT_EQ(ledger_.take(10, now_).size(), 1U);
}

}  // namespace
}  // namespace geocontainer_mpm::vessel
