#include "simulate_process.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <hdf5.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <sstream>
#include <stdexcept>

namespace geocontainer_mpm::test {

namespace fs = std::filesystem;

SimulateProcess::SimulateProcess(const fs::path& folder, const std::vector<std::string>& arguments) : folder_(folder)
{
  std::vector<std::string> words = { SIMULATE_PROGRAM };
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words)
    pointers.push_back(word.data());
  pointers.push_back(nullptr);

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  constexpr int flags = O_WRONLY | O_CREAT | O_TRUNC;
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, (folder / "out.txt").c_str(), flags, 0644);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, (folder / "err.txt").c_str(), flags, 0644);
  const int error = posix_spawn(&process_, SIMULATE_PROGRAM, &actions, nullptr, pointers.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0)
    throw std::runtime_error("cannot start " SIMULATE_PROGRAM);
}

SimulateProcess::~SimulateProcess()
{
  if (process_ > 0) {
    send(SIGKILL);
    waitpid(process_, nullptr, 0);
  }
}

void SimulateProcess::send(int signal) const
{
  kill(process_, signal);
}

Result SimulateProcess::wait()
{
  int status = 0;
  waitpid(process_, &status, 0);
  process_ = -1;
  return { WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status), read_text(folder_ / "out.txt"),
           read_text(folder_ / "err.txt") };
}

TemporaryFolder::TemporaryFolder()
{
  std::string name = (fs::temp_directory_path() / "simulate_test_XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr)
    throw std::runtime_error("cannot create a temporary folder");
  path_ = name;
}

TemporaryFolder::~TemporaryFolder()
{
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

std::string TemporaryFolder::write(const std::string& name, const std::string& text) const
{
  std::ofstream(path_ / name, std::ios::binary) << text;
  return file(name);
}

Result simulate(const TemporaryFolder& folder, const std::vector<std::string>& arguments)
{
  return SimulateProcess(folder.path(), arguments).wait();
}

std::string read_text(const fs::path& path)
{
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

std::string scene_file(const std::string& name)
{
  return std::string(GEOCONTAINER_MPM_SOURCE_DIR "/config/scenes/") + name;
}

std::vector<double> frame_times(const std::string& record)
{
  std::vector<double> times;
  const hid_t file = H5Fopen(record.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  if (file < 0) {
    ADD_FAILURE() << record << " cannot be opened";
    return times;
  }
  const hid_t frames = H5Gopen2(file, "frames", H5P_DEFAULT);
  EXPECT_GE(frames, 0) << record << " has no group of frames";
  H5Literate(
      frames, H5_INDEX_NAME, H5_ITER_INC, nullptr,
      [](hid_t group, const char* name, const H5L_info_t*, void* data) -> herr_t {
        const hid_t time = H5Dopen2(group, (std::string(name) + "/time").c_str(), H5P_DEFAULT);
        double value = 0.0;
        const herr_t error = H5Dread(time, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, &value);
        H5Dclose(time);
        static_cast<std::vector<double>*>(data)->push_back(value);
        return error;
      },
      &times);
  H5Gclose(frames);
  H5Fclose(file);
  return times;
}

}  // namespace geocontainer_mpm::test
