/// Alarms as notifications and as sentences.
#include "geocontainer_mpm/vessel/alarms.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <set>

namespace geocontainer_mpm::vessel {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

const Stamp noon{ seconds(1'795'694'400) + milliseconds(1'250) };  // 2026-11-26T12:00:01.250Z

Alarm hung_up(AlarmLevel level, AlarmLevel latched, bool acknowledged = false)
{
  return { "hung_up", level, latched, acknowledged, noon, "The container stands still in the slot" };
}

TEST(Alarms, NamesAndNumbersAreUnique)
{
  std::set<std::string> names;
  std::set<int> numbers;
  for (const AlarmKind& kind : alarm_kinds()) {
    EXPECT_TRUE(names.insert(kind.name).second) << kind.name;
    EXPECT_TRUE(numbers.insert(kind.number).second) << kind.number;
    EXPECT_TRUE(kind.number >= 1 && kind.number <= 999);
  }
}

TEST(Alarms, StayUpUntilTheyAreAcknowledged)
{
  using L = AlarmLevel;
  EXPECT_EQ(to_notice(hung_up(L::normal, L::normal)).state, "normal");
  EXPECT_EQ(to_notice(hung_up(L::warn, L::warn)).state, "warn");
  EXPECT_FALSE(to_notice(hung_up(L::warn, L::warn)).sound);
  EXPECT_TRUE(to_notice(hung_up(L::alarm, L::alarm)).sound);
  EXPECT_EQ(to_notice(hung_up(L::normal, L::alarm)).state, "alarm");  // latched
  const Notice seen = to_notice(hung_up(L::alarm, L::alarm, true));
  EXPECT_EQ(seen.state, "alarm");
  EXPECT_FALSE(seen.sound);
  EXPECT_TRUE(seen.acknowledged);
  EXPECT_EQ(to_notice(hung_up(L::normal, L::alarm, true)).state, "normal");
}

TEST(Alarms, AsSentences)
{
  const std::string text = write_alarm(hung_up(AlarmLevel::alarm, AlarmLevel::alarm), {});
  EXPECT_EQ(text.substr(0, text.find('*')), "$IIALR,120001.25,004,A,V,The container stands still in the slot");
  const std::string gone = write_alarm(hung_up(AlarmLevel::normal, AlarmLevel::alarm, true), {});
  EXPECT_EQ(gone.substr(0, gone.find('*')), "$IIALR,120001.25,004,V,A,The container stands still in the slot");
  Alarm unknown = hung_up(AlarmLevel::alarm, AlarmLevel::alarm);
  unknown.name = "weather";
  EXPECT_EQ(write_alarm(unknown, {}), "");
}

RC_GTEST_PROP(Alarms, AnyMessageMakesAWholeSentence, ())
{
  Alarm alarm = hung_up(AlarmLevel::alarm, AlarmLevel::alarm);
  alarm.message = *rc::gen::string<std::string>();
  const std::string text = write_alarm(alarm, {});
  RC_ASSERT(!text.empty() && text.size() <= longest_sentence);
  Sentence sentence;
  RC_ASSERT(!parse_sentence(std::string_view(text).substr(0, text.size() - 2), sentence));
  RC_ASSERT(sentence.formatter == "ALR");
  RC_ASSERT(sentence.fields.size() == 5U);
}

TEST(AlarmSentences, OnlyChangesAndEveryTenSeconds)
{
  using L = AlarmLevel;
  AlarmSentences sentences;
  AlarmSentences::Steady now{};
  const auto count = [&](L level, L latched, bool acknowledged) {
    const std::string text = sentences.due({ hung_up(level, latched, acknowledged) }, now, {});
    now += milliseconds(100);
    return std::count(text.begin(), text.end(), '$');
  };
  EXPECT_EQ(count(L::warn, L::warn, false), 0);    // no sentence of a warning
  EXPECT_EQ(count(L::alarm, L::alarm, false), 1);  // rises
  long repeated = 0;
  for (int i = 0; i < 250; ++i)
    repeated += count(L::alarm, L::alarm, false);
  EXPECT_EQ(repeated, 2);                           // in 25 s
  EXPECT_EQ(count(L::normal, L::alarm, false), 1);  // the condition has gone, nobody has seen it
  EXPECT_EQ(count(L::normal, L::alarm, false), 0);
  EXPECT_EQ(count(L::alarm, L::alarm, false), 1);   // and is back
  EXPECT_EQ(count(L::alarm, L::alarm, true), 1);    // seen
  EXPECT_EQ(count(L::normal, L::normal, true), 1);  // over
  EXPECT_EQ(count(L::normal, L::normal, true), 0);
}

}  // namespace
}  // namespace geocontainer_mpm::vessel
