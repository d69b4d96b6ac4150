#include "ranks.h"

#ifdef GEOCONTAINER_MPM_WITH_MPI
#define OMPI_SKIP_MPICXX 1
#include <mpi.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#endif

namespace geocontainer_mpm::program {

#ifdef GEOCONTAINER_MPM_WITH_MPI

namespace {

/// Open MPI, MPICH and their like, and Slurm's srun with PMIx tell a process that it has company.
bool started_by_mpirun()
{
  const char* const marks[] = { "OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "PMIX_RANK" };
  return std::any_of(std::begin(marks), std::end(marks), [](const char* mark) { return std::getenv(mark) != nullptr; });
}

}  // namespace

Ranks::Ranks()
{
  if (!started_by_mpirun())
    return;
  MPI_Init(nullptr, nullptr);  // an error ends the process with MPI's own words
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &size_);
}

Ranks::~Ranks()
{
  int initialised = 0;
  MPI_Initialized(&initialised);
  if (initialised != 0)
    MPI_Finalize();
}

bool Ranks::all(bool yes) const
{
  if (size_ == 1)
    return yes;
  const int mine = yes ? 1 : 0;
  int of_all = 0;
  MPI_Allreduce(&mine, &of_all, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD);
  return of_all == 1;
}

std::vector<std::string> Ranks::gather(const std::string& text) const
{
  if (size_ == 1)
    return { text };
  const int mine = static_cast<int>(text.size());  // a few hundred bytes a member
  const auto count = static_cast<std::size_t>(size_);
  std::vector<int> sizes(count), begins(count);
  MPI_Gather(&mine, 1, MPI_INT, sizes.data(), 1, MPI_INT, 0, MPI_COMM_WORLD);
  int total = 0;
  for (std::size_t r = 0; r < count; ++r) {
    begins[r] = total;
    total += sizes[r];
  }
  std::string joined(static_cast<std::size_t>(total), '\0');
  MPI_Gatherv(text.data(), mine, MPI_CHAR, joined.data(), sizes.data(), begins.data(), MPI_CHAR, 0, MPI_COMM_WORLD);
  std::vector<std::string> texts;
  if (first())
    for (std::size_t r = 0; r < count; ++r)
      texts.push_back(joined.substr(static_cast<std::size_t>(begins[r]), static_cast<std::size_t>(sizes[r])));
  return texts;
}

#else

Ranks::Ranks() = default;
Ranks::~Ranks() = default;

bool Ranks::all(bool yes) const
{
  return yes;
}

std::vector<std::string> Ranks::gather(const std::string& text) const
{
  return { text };
}

#endif

}  // namespace geocontainer_mpm::program
