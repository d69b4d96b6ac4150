#include "geocontainer_mpm/mpm/thread_team.h"

#if defined(__x86_64__) || defined(__i386__)
#include <immintrin.h>
#endif

namespace geocontainer_mpm::mpm {
namespace {

/// About 20 microseconds: longer than the serial pieces between two parallel ones in a step.
constexpr int spins_before_sleep = 500;

void pause_briefly()
{
#if defined(__x86_64__) || defined(__i386__)
  _mm_pause();
#else
  std::this_thread::yield();
#endif
}

}  // namespace

ThreadTeam::ThreadTeam(int threads)
{
  for (int t = 1; t < threads; ++t)
    helpers_.emplace_back([this] { help(); });
}

ThreadTeam::~ThreadTeam()
{
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stop_ = true;
    ++generation_;
  }
  wake_.notify_all();
  for (std::thread& helper : helpers_)
    helper.join();
}

void ThreadTeam::take_pieces()
{
  for (int i = next_.fetch_add(1); i < count_; i = next_.fetch_add(1))
    piece_(context_, i);
}

void ThreadTeam::run(int count, Piece piece, void* context)
{
  piece_ = piece;
  context_ = context;
  count_ = count;
  next_ = 0;
  busy_ = static_cast<int>(helpers_.size());
  {
    // Under the lock, so that a helper about to sleep either sees the new generation or gets the notification.
    const std::lock_guard<std::mutex> lock(mutex_);
    ++generation_;
  }
  wake_.notify_all();
  take_pieces();
  // A helper that has taken no piece still has to be seen past this work before the next one is set up.
  for (int spins = 0; busy_ > 0; ++spins)
    if (spins < spins_before_sleep)
      pause_briefly();
    else
      std::this_thread::yield();
}

void ThreadTeam::help()
{
  unsigned seen = 0;
  for (;;) {
    for (int spins = 0; spins < spins_before_sleep && generation_ == seen; ++spins)
      pause_briefly();
    if (generation_ == seen) {
      std::unique_lock<std::mutex> lock(mutex_);
      wake_.wait(lock, [&] { return generation_ != seen; });
    }
    seen = generation_;
    if (stop_)
      return;
    take_pieces();
    --busy_;
  }
}

}  // namespace geocontainer_mpm::mpm
