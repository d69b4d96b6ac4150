/// What an alarm promises: example by example, and as laws over random histories.

#include "geocontainer_mpm/alarm/alarm_book.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

namespace geocontainer_mpm::alarm {
namespace {

constexpr std::int64_t second = 1'000'000'000;
constexpr Limits limits{ 0.8, 1.0 };
constexpr double band = 0.1;

/// One alarm on the limits above, judged by value and seconds.
struct One {
  explicit One(const Delays& delays = {}) { book.add("one", "1", delays); }
  const Alarm& judge(double value, double time_s)
  {
    Reading reading = graded(value, limits, band);
    reading.message = std::to_string(value);
    book.judge(0, reading, static_cast<std::int64_t>(std::llround(time_s * 1e9)));
    return now();
  }
  const Alarm& now() const { return book.alarms().front(); }
  AlarmBook book;
};

TEST(AlarmBook, RisesAtOnceAndSaysSinceWhen)
{
  One one;
  EXPECT_EQ(one.judge(0.79, 1.0).level, Level::normal);
  EXPECT_EQ(one.judge(0.8, 2.0).level, Level::warn);
  EXPECT_EQ(one.now().since_ns, 2 * second);
  EXPECT_EQ(one.judge(1.0, 3.0).level, Level::alarm);
  EXPECT_EQ(one.now().since_ns, 3 * second);
  EXPECT_EQ(one.judge(1.2, 4.0).since_ns, 3 * second);
  EXPECT_EQ(one.now().value, 1.2);
}

TEST(AlarmBook, FallsBelowTheBandAfterAWhile)
{
  One one({ 0.0, 2.0 });
  one.judge(1.1, 0.0);
  EXPECT_EQ(one.judge(0.91, 10.0).level, Level::alarm) << "inside the band";
  EXPECT_EQ(one.judge(0.89, 11.0).level, Level::alarm) << "not for long enough";
  EXPECT_EQ(one.judge(0.91, 12.0).level, Level::alarm) << "back in the band: the wait begins again";
  EXPECT_EQ(one.judge(0.89, 13.0).level, Level::alarm);
  EXPECT_EQ(one.judge(0.89, 14.9).level, Level::alarm);
  EXPECT_EQ(one.judge(0.89, 15.0).level, Level::warn) << "still above the warning's band";
  EXPECT_EQ(one.judge(0.0, 16.0).level, Level::warn);
  EXPECT_EQ(one.judge(0.0, 18.0).level, Level::normal);
  EXPECT_EQ(one.now().since_ns, 18 * second);
}

TEST(AlarmBook, ADelayedRiseAsksForTheConditionAllTheWhile)
{
  One one({ 1.0, 0.0 });
  EXPECT_EQ(one.judge(0.9, 0.0).level, Level::normal);
  EXPECT_EQ(one.judge(0.7, 0.9).level, Level::normal);
  EXPECT_EQ(one.judge(0.9, 1.0).level, Level::normal);
  EXPECT_EQ(one.judge(0.9, 2.0).level, Level::warn);
}

TEST(AlarmBook, StaysLatchedUntilItIsAcknowledged)
{
  One one;
  one.judge(1.1, 0.0);
  one.judge(0.9, 1.0);
  one.judge(0.1, 2.0);
  EXPECT_EQ(one.now().level, Level::normal);
  EXPECT_EQ(one.now().latched, Level::alarm);
  EXPECT_TRUE(one.now().waits());
  EXPECT_EQ(one.now().message, std::to_string(1.1)) << "what it was, since it is over";
  EXPECT_EQ(one.book.acknowledge(), std::vector<std::string>{ "one" });
  EXPECT_EQ(one.now().latched, Level::normal);
  EXPECT_FALSE(one.now().waits());
  EXPECT_TRUE(one.book.acknowledge().empty());
  EXPECT_EQ(one.judge(0.1, 3.0).message, std::to_string(0.1));
}

TEST(AlarmBook, AcknowledgedWhileItHoldsIsLetGoAtRest)
{
  One one;
  one.judge(1.1, 0.0);
  one.book.acknowledge();
  EXPECT_TRUE(one.now().acknowledged);
  EXPECT_EQ(one.judge(0.85, 1.0).level, Level::warn);
  EXPECT_EQ(one.now().latched, Level::alarm);
  EXPECT_TRUE(one.now().acknowledged) << "a fall asks for nothing";
  EXPECT_EQ(one.judge(1.1, 2.0).latched, Level::alarm);
  EXPECT_TRUE(one.now().waits()) << "it has risen again";
  one.book.acknowledge();
  EXPECT_EQ(one.judge(0.0, 3.0).latched, Level::normal);
  EXPECT_FALSE(one.now().acknowledged);
}

TEST(AlarmBook, AnotherRunKeepsWhatNobodyHasSeen)
{
  One one({ 0.0, 10.0 });
  one.judge(1.1, 5.0);
  one.book.begin_run(1 * second);
  EXPECT_EQ(one.now().level, Level::normal);
  EXPECT_EQ(one.now().latched, Level::alarm);
  EXPECT_EQ(one.now().since_ns, 1 * second);
  EXPECT_EQ(one.judge(0.9, 1.5).level, Level::warn) << "the clock of the run before is no matter";
}

TEST(AlarmBook, WhatIsNoNumberIsAnAlarm)
{
  One one;
  EXPECT_EQ(one.judge(std::numeric_limits<double>::quiet_NaN(), 0.0).level, Level::alarm);
}

TEST(AlarmBook, AlarmsAreApart)
{
  AlarmBook book;
  const std::size_t first = book.add("first", "s", {}), second_one = book.add("second", "", {});
  book.judge(second_one, stated(Level::alarm), 0);
  book.judge(first, stated(Level::warn), 0);
  EXPECT_EQ(book.alarms()[first].level, Level::warn);
  EXPECT_EQ(book.alarms()[second_one].level, Level::alarm);
  EXPECT_EQ(book.acknowledge(), (std::vector<std::string>{ "first", "second" }));
}

/// One look of a random history: a value, what time has passed, whether somebody acknowledges after it.
struct Look {
  double value;
  double wait_s;
  bool acknowledge;
};

std::vector<Look> any_history()
{
  std::vector<Look> history;
  for (int i = *rc::gen::inRange(1, 60); i > 0; --i)
    history.push_back(
        { 0.01 * *rc::gen::inRange(0, 130), 0.1 * *rc::gen::inRange(0, 20), *rc::gen::inRange(0, 8) == 0 });
  return history;
}

RC_GTEST_PROP(AlarmLaws, NeverSilentWhileTheConditionHolds, ())
{
  One one({ 0.0, 0.1 * *rc::gen::inRange(0, 30) });
  double time_s = 0.0;
  for (const Look& look : any_history()) {
    const Alarm& now = one.judge(look.value, time_s += look.wait_s);
    RC_ASSERT(look.value < limits.warn || now.level >= Level::warn);
    RC_ASSERT(look.value < limits.alarm || now.level == Level::alarm);
    if (look.acknowledge)
      one.book.acknowledge();
    RC_ASSERT(look.value < limits.alarm || now.level == Level::alarm);
  }
}

RC_GTEST_PROP(AlarmLaws, LatchedIsLetGoOnlyByAcknowledgement, ())
{
  One one({ 0.1 * *rc::gen::inRange(0, 10), 0.1 * *rc::gen::inRange(0, 30) });
  double time_s = 0.0;
  for (const Look& look : any_history()) {
    const Alarm before = one.now();
    const Alarm& now = one.judge(look.value, time_s += look.wait_s);
    RC_ASSERT(now.latched >= now.level);
    RC_ASSERT(now.latched >= before.latched || (before.acknowledged && now.level == Level::normal));
    RC_ASSERT(!now.acknowledged || before.acknowledged);  // judging acknowledges nothing
    RC_ASSERT(now.level <= before.level || now.waits());  // every rise asks
    RC_ASSERT(now.level != before.level || now.since_ns == before.since_ns);
    if (!look.acknowledge)
      continue;
    one.book.acknowledge();
    RC_ASSERT(!now.waits());
    RC_ASSERT((now.level == Level::normal ? now.latched == Level::normal : now.acknowledged));
  }
}

RC_GTEST_PROP(AlarmLaws, NoiseSmallerThanTheBandDoesNotChatter, ())
{
  // A value near one limit, from wherever it came, with noise that is smaller than the band: at most one change.
  One one({ 0.0, 0.0 });
  const double limit = *rc::gen::element(limits.warn, limits.alarm);
  const double lowest = limit * (1.0 - band) + 0.001 * *rc::gen::inRange(0, 60);
  one.judge(*rc::gen::element(0.5, 1.05), 0.0);
  one.judge(lowest, 0.0);
  int changes = 0;
  double time_s = 0.0;
  for (const Look& look : any_history()) {
    const Level before = one.now().level;
    // From `lowest` by less than the band: over the limit or not.
    const double value = lowest + look.value / 1.3 * 0.99 * band * limits.warn;
    changes += one.judge(value, time_s += look.wait_s).level != before;
  }
  RC_ASSERT(changes <= 1);
}

RC_GTEST_PROP(AlarmLaws, FallsNoSoonerThanItMay, ())
{
  const double fall_after_s = 0.1 * *rc::gen::inRange(1, 30);
  One one({ 0.0, fall_after_s });
  double time_s = 0.0, last_held_s = 0.0;
  for (const Look& look : any_history()) {
    const Level before = one.now().level;
    const Alarm& now = one.judge(look.value, time_s += look.wait_s);
    if (look.value >= limits.alarm * (1.0 - band))
      last_held_s = time_s;
    RC_ASSERT(!(before == Level::alarm && now.level < before) || time_s - last_held_s >= fall_after_s - 1e-9);
  }
}

}  // namespace
}  // namespace geocontainer_mpm::alarm
