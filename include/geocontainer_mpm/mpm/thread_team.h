#pragma once
/// A few threads that wait for short pieces of work, many thousand times a second.

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <thread>
#include <type_traits>
#include <vector>

namespace geocontainer_mpm::mpm {

/// The calling thread and `threads - 1` helpers. Which thread does which piece is left to chance; results must not
/// depend on it. Helpers spin for some microseconds, then sleep: on a busy machine, or between frames, they cost
/// nothing. One caller at a time.
class ThreadTeam {
public:
  /// At least 1 thread.
  explicit ThreadTeam(int threads);
  ~ThreadTeam();
  ThreadTeam(const ThreadTeam&) = delete;
  ThreadTeam& operator=(const ThreadTeam&) = delete;

  int threads() const { return static_cast<int>(helpers_.size()) + 1; }

  /// Calls `work(i)` once for every i in [0, count) and returns when all are done. `work` must not throw.
  template <class Work>
  void for_each(int count, Work&& work)
  {
    if (helpers_.empty() || count <= 1) {
      for (int i = 0; i < count; ++i)
        work(i);
      return;
    }
    using Plain = std::remove_reference_t<Work>;
    run(
        count, [](void* context, int i) { (*static_cast<Plain*>(context))(i); },
        const_cast<void*>(static_cast<const void*>(&work)));
  }

private:
  using Piece = void (*)(void* context, int i);

  void run(int count, Piece piece, void* context);
  void help();
  void take_pieces();

  std::vector<std::thread> helpers_;
  Piece piece_ = nullptr;
  void* context_ = nullptr;
  /// Number of this work, its count and the next piece in one word, so that whoever takes a ticket knows what it is
  /// for.
  std::atomic<std::uint64_t> ticket_{ 0 };
  std::atomic<int> done_{ 0 };       ///< pieces of this work that are finished
  std::atomic<unsigned> work_{ 0 };  ///< counts calls of run(); helpers wait for it to change
  std::atomic<bool> stop_{ false };
  std::mutex mutex_;
  std::condition_variable wake_;
};

}  // namespace geocontainer_mpm::mpm
