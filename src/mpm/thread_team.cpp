#include "geocontainer_mpm/mpm/thread_team.h"

#if defined(__x86_64__) || defined(__i386__)
#include <immintrin.h>
#endif

namespace geocontainer_mpm::mpm {
namespace {

/// About 20 microseconds: longer than the serial pieces between two parallel ones in a step.
constexpr int spins_before_sleep = 500;

// A ticket: 16 bits of work number, 24 of count, 24 of the next piece.
constexpr int field_bits = 24;
constexpr std::uint64_t field_mask = (std::uint64_t{ 1 } << field_bits) - 1;

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
    ++work_;
  }
  wake_.notify_all();
  for (std::thread& helper : helpers_)
    helper.join();
}

void ThreadTeam::take_pieces()
{
  for (;;) {
    const std::uint64_t ticket = ticket_.fetch_add(1);
    const std::uint64_t piece = ticket & field_mask, count = (ticket >> field_bits) & field_mask;
    if (piece >= count)
      return;
    // The caller cannot go on to other work before this piece is done: what the ticket is for stays in place.
    piece_(context_, static_cast<int>(piece));
    ++done_;
  }
}

void ThreadTeam::run(int count, Piece piece, void* context)
{
  piece_ = piece;
  context_ = context;
  done_ = 0;
  ticket_ = (std::uint64_t{ work_ + 1U } << (2 * field_bits)) | (static_cast<std::uint64_t>(count) << field_bits);
  {
    // Under the lock, so that a helper about to sleep either sees the new number or gets the notification.
    const std::lock_guard<std::mutex> lock(mutex_);
    ++work_;
  }
  wake_.notify_all();
  take_pieces();
  for (int spins = 0; done_ < count; ++spins)
    if (spins < spins_before_sleep)
      pause_briefly();
    else
      std::this_thread::yield();
}

void ThreadTeam::help()
{
  unsigned seen = 0;
  for (;;) {
    for (int spins = 0; spins < spins_before_sleep && work_ == seen; ++spins)
      pause_briefly();
    if (work_ == seen) {
      std::unique_lock<std::mutex> lock(mutex_);
      wake_.wait(lock, [&] { return work_ != seen; });
    }
    seen = work_;
    if (stop_)
      return;
    take_pieces();
  }
}

}  // namespace geocontainer_mpm::mpm
