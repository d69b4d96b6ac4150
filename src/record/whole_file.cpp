#include "geocontainer_mpm/record/whole_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

namespace geocontainer_mpm::record {
namespace {

namespace fs = std::filesystem;

/// Returns errno, 0 for success.
int write_all(int file, const std::string& bytes)
{
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t count = ::write(file, bytes.data() + done, bytes.size() - done);
    if (count < 0 && errno != EINTR)
      return errno;
    done += count > 0 ? static_cast<std::size_t>(count) : 0;
  }
  return 0;
}

}  // namespace

std::string replace_file(const std::string& path, const std::string& bytes)
{
  std::error_code ignored;
  const bool replace = !fs::exists(path, ignored) || fs::is_regular_file(path, ignored);
  const fs::path target = replace ? fs::weakly_canonical(path, ignored) : fs::path(path);
  const std::string written = replace ? fmt::format("{}.{}.part", target.string(), ::getpid()) : target.string();
  const int file = ::open(written.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | (replace ? O_TRUNC : 0), 0666);
  if (file < 0)
    return std::strerror(errno);
  int error = write_all(file, bytes);
  if (error == 0 && replace && ::fsync(file) != 0)
    error = errno;
  if (::close(file) != 0 && error == 0)
    error = errno;
  if (error == 0 && replace && std::rename(written.c_str(), target.c_str()) != 0)
    error = errno;
  if (error != 0 && replace)
    ::unlink(written.c_str());
  return error == 0 ? "" : std::strerror(error);
}

}  // namespace geocontainer_mpm::record
