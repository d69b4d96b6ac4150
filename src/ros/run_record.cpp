#include "geocontainer_mpm/ros/run_record.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <system_error>
#include <utility>

#include "geocontainer_mpm/error.h"

namespace geocontainer_mpm::ros_bridge {

RunRecord::RunRecord(std::string path, std::string scene_name, std::string scene_text)
    : path_(std::move(path)), scene_name_(std::move(scene_name)), scene_text_(std::move(scene_text))
{
}

std::string RunRecord::path_of(std::uint64_t run) const
{
  if (run == 1)
    return path_;
  const std::filesystem::path path(path_);
  const std::string name = fmt::format("{}_run{}{}", path.stem().string(), run, path.extension().string());
  return (path.parent_path() / name).string();
}

void RunRecord::write(const scene::Frame& frame)
{
  if (path_.empty() || !error_.empty() || frame.time_s == last_time_s_)
    return;
  last_time_s_ = frame.time_s;
  try {
    if (!recorder_)
      recorder_ = std::make_unique<record::Recorder>(path(), scene_name_, scene_text_);
    error_ = recorder_->write(frame);
  } catch (const InputError& error) {
    error_ = error.what();
  }
}

void RunRecord::begin_run(std::uint64_t run)
{
  recorder_.reset();
  error_.clear();
  last_time_s_ = -1.0;
  run_ = run;
}

std::uint64_t RunRecord::free_run() const
{
  const std::filesystem::path path(path_);
  const std::string numbered = path.stem().string() + "_run", extension = path.extension().string();
  std::error_code error;
  std::uint64_t free = !path_.empty() && std::filesystem::exists(path, error) ? 2 : 1;
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    const std::string name = entry.path().stem().string();
    if (path_.empty() || entry.path().extension() != extension || name.compare(0, numbered.size(), numbered) != 0)
      continue;
    const std::string digits = name.substr(numbered.size());
    std::uint64_t run = 0;
    const auto [end, failed] = std::from_chars(digits.data(), digits.data() + digits.size(), run);
    if (failed == std::errc() && end == digits.data() + digits.size())
      free = std::max(free, run + 1);
  }
  return free;
}

std::string scene_text(const std::string& scene_path, const std::vector<std::string>& overrides)
{
  std::ifstream file(scene_path);
  std::ostringstream text;
  text << file.rdbuf();
  for (const std::string& override_text : overrides)
    text << "\n# override: " << override_text;
  return text.str();
}

std::string digest_text(std::uint64_t digest)
{
  return fmt::format("{:016x}", digest);
}

std::string save_state(const scene::Simulation& simulation, const RunRecord& record, const std::string& stem,
                       double wall_time_s, int threads)
{
  try {
    record::Recorder recorder(stem + ".h5", record.scene_name(), record.scene_text());
    if (const std::string error = recorder.write(simulation.frame()); !error.empty())
      return error;
  } catch (const InputError& error) {
    return error.what();
  }
  nlohmann::ordered_json summary =
      nlohmann::ordered_json::parse(scene::summary_json(simulation, wall_time_s, threads), nullptr, false);
  if (summary.is_discarded())
    return "the summary is not valid JSON";
  summary["digest"] = digest_text(simulation.digest());
  std::ofstream file(stem + ".json");
  file << summary.dump(2) << '\n';
  file.close();
  return file ? "" : stem + ".json: cannot be written";
}

}  // namespace geocontainer_mpm::ros_bridge
