// Every piece of work once, before the call returns, however often and however few.

#include "geocontainer_mpm/mpm/thread_team.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <numeric>
#include <set>

namespace geocontainer_mpm::mpm::testing {
namespace {

TEST(ThreadTeam, DoesEveryPieceOnceBeforeItReturns)
{
  for (const int threads : { 1, 2, 3, 5 }) {
    ThreadTeam team(threads);
    EXPECT_EQ(team.threads(), threads);
    for (int round = 0; round < 2000; ++round) {
      const int count = round % 37;
      std::vector<int> done(static_cast<std::size_t>(count), 0);  // plain: no two threads share an entry
      team.for_each(count, [&](int i) { done[static_cast<std::size_t>(i)] += i + round; });
      std::vector<int> expected(static_cast<std::size_t>(count));
      std::iota(expected.begin(), expected.end(), round);
      ASSERT_EQ(done, expected) << threads << " threads, round " << round;
    }
  }
}

TEST(ThreadTeam, WakesHelpersThatSleep)
{
  ThreadTeam team(3);
  std::atomic<int> sum{ 0 };
  for (int round = 0; round < 20; ++round) {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));  // far longer than they spin
    team.for_each(10, [&](int i) { sum += i; });
  }
  EXPECT_EQ(sum, 20 * 45);
}

TEST(ThreadTeam, WorksOnSeveralPiecesAtOnce)
{
  // Three pieces that wait for one another can only end if three threads have one each.
  ThreadTeam team(3);
  std::atomic<int> arrived{ 0 };
  std::mutex mutex;
  std::set<std::thread::id> threads;
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  team.for_each(3, [&](int) {
    {
      const std::lock_guard<std::mutex> lock(mutex);
      threads.insert(std::this_thread::get_id());
    }
    ++arrived;
    while (arrived < 3 && std::chrono::steady_clock::now() < deadline)
      std::this_thread::yield();
  });
  EXPECT_EQ(threads.size(), 3U);
}

TEST(ThreadTeam, EndsWithoutEverHavingWorked)
{
  for (int k = 0; k < 50; ++k)
    ThreadTeam team(4);
}

}  // namespace
}  // namespace geocontainer_mpm::mpm::testing
