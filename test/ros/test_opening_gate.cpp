#include <gtest/gtest.h>

#include "geocontainer_mpm/ros/opening_gate.h"
#include "geocontainer_mpm/ros/opening_input.h"

namespace geocontainer_mpm::ros_bridge {
namespace {

constexpr std::int64_t ms = 1'000'000;
constexpr std::int64_t s = 1000 * ms;
constexpr std::int64_t epoch = 1'700'000'000 * s;

ArrivedSample sample(std::int64_t stamp_ns, std::int64_t arrived_ns)
{
  return { { stamp_ns, {} }, arrived_ns };
}

TEST(OpeningGate, TakesWhatAgreesWithTheClock)
{
  const OpeningGate gate{ GateParameters() };
  EXPECT_EQ(gate.judge(sample(epoch, 0), epoch, 0), GateDecision::take);
  EXPECT_EQ(gate.judge(sample(epoch + 900 * ms, 0), epoch, 0), GateDecision::take);
}

TEST(OpeningGate, WaitsForTheFirstClockHoweverLong)
{
  const OpeningGate gate{ GateParameters() };
  EXPECT_EQ(gate.judge(sample(epoch, 0), 0, 100 * s), GateDecision::wait);
}

TEST(OpeningGate, UnstampedIsRejected)
{
  const OpeningGate gate{ GateParameters() };
  EXPECT_EQ(gate.judge(sample(0, 0), epoch, 0), GateDecision::reject_unstamped);
}

TEST(OpeningGate, LeftOverOfTheLoopBeforeIsRejectedOnceThePatienceIsOver)
{
  const OpeningGate gate{ GateParameters() };
  const ArrivedSample left_over = sample(epoch + 60 * s, 10 * s);
  EXPECT_EQ(gate.judge(left_over, epoch, 10 * s + 100 * ms), GateDecision::wait);
  EXPECT_EQ(gate.judge(left_over, epoch, 10 * s + 600 * ms), GateDecision::reject_future);
  // A clock that was merely late explains it.
  EXPECT_EQ(gate.judge(left_over, epoch + 60 * s, 10 * s + 100 * ms), GateDecision::take);
}

TEST(OpeningGate, FirstOfTheNextLoopWaitsForTheClockToGoBack)
{
  OpeningGate gate{ GateParameters() };
  gate.taken({ epoch + 60 * s, {} });
  const ArrivedSample first = sample(epoch, 10 * s);
  EXPECT_EQ(gate.judge(first, epoch + 60 * s, 10 * s + 100 * ms), GateDecision::wait);
  gate.reset();  // the clock went back
  EXPECT_EQ(gate.judge(first, epoch, 10 * s + 200 * ms), GateDecision::take);
}

TEST(OpeningGate, AnOldSampleWithoutATimeJumpGoesToTheSignalInTheEnd)
{
  OpeningGate gate{ GateParameters() };
  gate.taken({ epoch + 60 * s, {} });
  EXPECT_EQ(gate.judge(sample(epoch, 10 * s), epoch + 61 * s, 10 * s + 600 * ms), GateDecision::take);
}

TEST(OpeningGate, OnlyARealStepBackIsAJump)
{
  OpeningGate gate{ GateParameters() };
  EXPECT_FALSE(gate.jumped_back(0));
  EXPECT_FALSE(gate.jumped_back(epoch));
  EXPECT_FALSE(gate.jumped_back(epoch - 100 * ms));  // a clock that was set right
  EXPECT_FALSE(gate.jumped_back(epoch + 50 * s));    // seek forward
  EXPECT_TRUE(gate.jumped_back(epoch));
  gate.reset();
  EXPECT_FALSE(gate.jumped_back(epoch));
}

TEST(OpeningGate, SettledClockLagsByThePatience)
{
  OpeningGate gate{ GateParameters() };
  EXPECT_FALSE(gate.settled_clock(epoch, 0));
  for (std::int64_t t = 50 * ms; t <= 400 * ms; t += 50 * ms)
    EXPECT_FALSE(gate.settled_clock(epoch + 20 * t, t));
  for (std::int64_t t = 450 * ms; t <= 2 * s; t += 50 * ms)
    gate.settled_clock(epoch + 20 * t, t);
  EXPECT_EQ(gate.settled_clock(epoch + 41 * s, 2050 * ms), epoch + 20 * 1550 * ms);
}

TEST(OpeningQueue, KeepsOrderAndCountsWhatDoesNotFit)
{
  OpeningQueue queue(2);
  int pushes = 0;
  queue.on_push([&pushes] { ++pushes; });
  queue.push(sample(1, 0));
  queue.push(sample(2, 0));
  queue.push(sample(3, 0));
  EXPECT_EQ(pushes, 3);
  EXPECT_EQ(queue.dropped(), 1u);
  EXPECT_EQ(queue.front()->sample.stamp_ns, 1);
  queue.pop();
  EXPECT_EQ(queue.front()->sample.stamp_ns, 2);
  queue.clear();
  EXPECT_TRUE(queue.empty());
}

}  // namespace
}  // namespace geocontainer_mpm::ros_bridge
