/// Writes a synthetic record and says on stdout when each frame stands: the child of the kill tests and the source of
/// the pictures' test. With a fourth and fifth argument it kills itself at a chosen write to disk, or with `solid`
/// writes frames of three dimensions.

#include <fcntl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "geocontainer_mpm/record/recorder.h"
#include "synthetic_frame.h"

namespace {

long changes = 0;   ///< how often this process changed a file of the record
long kill_at = -1;  ///< the change at which it dies
bool torn = false;  ///< die with the first memory pages of that write done and the rest not, as SIGKILL can leave it

/// True when this change is the last one to be made, in part at most.
bool dies_now()
{
  return ++changes == kill_at;
}

[[noreturn]] void die()
{
  kill(getpid(), SIGKILL);
  std::abort();
}

ssize_t counted_pwrite(int file, const void* data, std::size_t size, off_t offset)
{
  if (dies_now()) {
    const std::size_t to_page_end = 4096 - static_cast<std::size_t>(offset) % 4096;
    if (torn && to_page_end < size)
      syscall(SYS_pwrite64, file, data, to_page_end, offset);
    die();
  }
  return syscall(SYS_pwrite64, file, data, size, offset);
}

int counted_ftruncate(int file, off_t size)
{
  if (dies_now())
    die();
  return static_cast<int>(syscall(SYS_ftruncate, file, size));
}

}  // namespace

// These take the place of the C library's for HDF5 as well: the kill falls between any two changes on disk.
extern "C" {
ssize_t pwrite(int file, const void* data, std::size_t size, off_t offset)
{
  return counted_pwrite(file, data, size, offset);
}
ssize_t pwrite64(int file, const void* data, std::size_t size, off64_t offset)
{
  return counted_pwrite(file, data, size, offset);
}
int ftruncate(int file, off_t size) noexcept
{
  return counted_ftruncate(file, size);
}
int ftruncate64(int file, off64_t size) noexcept
{
  return counted_ftruncate(file, size);
}
int renameat2(int from_folder, const char* from, int to_folder, const char* to, unsigned flags) noexcept
{
  if (dies_now())
    die();
  return static_cast<int>(syscall(SYS_renameat2, from_folder, from, to_folder, to, flags));
}
}

int main(int argc, char** argv)
{
  using namespace geocontainer_mpm;
  if (argc < 4) {
    std::fprintf(stderr, "usage: write_record RECORD.h5 FRAMES RINGS [KILL_AT_CHANGE [torn] | solid]\n");
    return 2;
  }
  const int frames = std::atoi(argv[2]);
  const int rings = std::atoi(argv[3]);
  const bool solid = argc > 4 && std::string(argv[4]) == "solid";
  kill_at = argc > 4 && !solid ? std::atol(argv[4]) : -1;
  torn = argc > 5 && std::string(argv[5]) == "torn";
  record::Recorder recorder(argv[1], "synthetic", "name: synthetic\n");
  std::puts("created");
  std::fflush(stdout);
  for (int i = 0; i < frames; ++i) {
    const double time_s = 40.0 * i / std::max(1, frames - 1);
    const std::string failure =
        recorder.write(solid ? record::synthetic_solid_frame(time_s, rings) : record::synthetic_frame(time_s, rings));
    if (!failure.empty()) {
      std::fprintf(stderr, "%s\n", failure.c_str());
      return 1;
    }
    std::printf("%zu frames %ld changes\n", recorder.frames(), changes);
    std::fflush(stdout);
  }
  return 0;
}
