#pragma once
/// Runs the real `simulate`, in a folder of its own that disappears afterwards.

#include <filesystem>
#include <string>
#include <vector>

namespace geocontainer_mpm::test {

struct Result {
  int status = -1;  ///< exit status; 1000 plus the signal for a process that a signal ended
  std::string out, err;
};

/// A started `simulate`; killed, if it still runs, when this goes.
class SimulateProcess {
public:
  /// Output goes to files in `folder`.
  SimulateProcess(const std::filesystem::path& folder, const std::vector<std::string>& arguments);
  ~SimulateProcess();
  SimulateProcess(const SimulateProcess&) = delete;
  SimulateProcess& operator=(const SimulateProcess&) = delete;

  void send(int signal) const;
  Result wait();

private:
  std::filesystem::path folder_;
  int process_ = -1;
};

class TemporaryFolder {
public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::string file(const std::string& name) const { return (path_ / name).string(); }
  std::string write(const std::string& name, const std::string& text) const;

private:
  std::filesystem::path path_;
};

Result simulate(const TemporaryFolder& folder, const std::vector<std::string>& arguments);

std::string read_text(const std::filesystem::path& path);

/// A scene that comes with the package.
std::string scene_file(const std::string& name);

/// Times of the frames in a record, in order; fails the test where the record cannot be opened.
std::vector<double> frame_times(const std::string& record);

}  // namespace geocontainer_mpm::test
