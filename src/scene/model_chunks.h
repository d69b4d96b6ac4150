#pragma once
/// Particles are handed to threads in pieces; results do not depend on their size.

#include <algorithm>
#include <cstddef>

#include "geocontainer_mpm/mpm/thread_team.h"

namespace geocontainer_mpm::scene {

/// Calls `work(begin, end)` for pieces of [0, count).
template <class Work>
void for_chunks(std::size_t count, mpm::ThreadTeam& team, Work&& work)
{
  constexpr std::size_t chunk = 512;
  team.for_each(static_cast<int>((count + chunk - 1) / chunk), [&](int c) {
    const std::size_t begin = static_cast<std::size_t>(c) * chunk;
    work(begin, std::min(count, begin + chunk));
  });
}

}  // namespace geocontainer_mpm::scene
