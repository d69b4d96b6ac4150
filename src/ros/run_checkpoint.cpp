#include "geocontainer_mpm/ros/run_checkpoint.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

#include "geocontainer_mpm/error.h"
#include "geocontainer_mpm/forecast/run_ahead.h"
#include "geocontainer_mpm/record/checkpoint.h"
#include "geocontainer_mpm/record/whole_file.h"
#include "geocontainer_mpm/ros/opening_input.h"

namespace geocontainer_mpm::ros_bridge {
namespace {

namespace fs = std::filesystem;

constexpr double least_work_per_save = 20.0;  ///< a run is held up for a twentieth of the time at most

double seconds(std::int64_t ns)
{
  return static_cast<double>(ns) / 1e9;
}

std::string unused(const std::string& path)
{
  return path + ".unused";
}

void set_file_aside(const std::string& path)
{
  std::error_code ignored;
  fs::rename(path, unused(path), ignored);
}

}  // namespace

Beginning begin_or_resume(const scene::SceneDescription& scene, int threads, const std::string& path)
{
  std::error_code ignored;
  if (path.empty() || !fs::exists(path, ignored))
    return { scene::Simulation(scene, threads), false, false, {} };
  std::string why;
  try {
    scene::Simulation simulation = record::load_checkpoint(path, scene, std::nullopt, threads);
    if (simulation.time_s() < scene.time.end_s) {
      std::string what = fmt::format("goes on at {:.3f} s from {}", simulation.time_s(), path);
      return { std::move(simulation), true, true, std::move(what) };
    }
    why = fmt::format("the run in {} had come to its end", path);
  } catch (const InputError& error) {
    why = error.what();
  }
  set_file_aside(path);
  return { scene::Simulation(scene, threads), true, false,
           fmt::format("a new run begins: {} (kept as {})", why, unused(path)) };
}

RunCheckpoint::RunCheckpoint(std::string path, double period_s)
    : path_(std::move(path)), period_ns_(static_cast<std::int64_t>(period_s * 1e9))
{
}

void RunCheckpoint::save(const scene::Simulation& simulation)
{
  if (path_.empty())
    return;
  if (writer_.valid() && writer_.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
    return;
  look_at_writer();
  // Processor time: a machine that is busy with other things must not make checkpoints rare.
  const double begin_s = forecast::thread_cpu_time_s();
  try {
    std::string bytes = record::checkpoint_bytes(simulation, record::opening_hash({}));
    if (!bytes.empty()) {
      time_s_ = simulation.time_s();
      writer_ = std::async(std::launch::async,
                           [path = path_, whole = std::move(bytes)] { return record::replace_file(path, whole); });
    }
  } catch (const std::exception& error) {
    error_ = error.what();
  }
  const double cost_s = forecast::thread_cpu_time_s() - begin_s;
  cost_s_ = std::max(cost_s_, cost_s);
  due_ns_ = steady_now_ns() + std::max(period_ns_, static_cast<std::int64_t>(least_work_per_save * cost_s * 1e9));
}

void RunCheckpoint::look_at_writer()
{
  if (writer_.valid())
    error_ = writer_.get();
}

void RunCheckpoint::wait()
{
  look_at_writer();
}

void RunCheckpoint::discard()
{
  wait();
  time_s_ = -1.0;
  if (path_.empty())
    return;
  std::error_code error;
  fs::remove(path_, error);
  if (error)
    error_ = fmt::format("of a run that was given up, cannot be removed: {}", error.message());
}

void RunCheckpoint::set_aside()
{
  wait();
  time_s_ = -1.0;
  if (!path_.empty())
    set_file_aside(path_);
}

const std::string& RunCheckpoint::error()
{
  if (writer_.valid() && writer_.wait_for(std::chrono::seconds(0)) == std::future_status::ready)
    look_at_writer();
  return error_;
}

ResumedLog::ResumedLog(const barge::OpeningSignal& saved, const barge::OpeningSignalParameters& believable,
                       double longest_break_s)
    : open_(true)
    , first_ns_(saved.origin_ns())
    , last_ns_(saved.last_accepted().stamp_ns)
    , latest_ns_(last_ns_ + static_cast<std::int64_t>(longest_break_s * 1e9))
    , lowest_rad_(believable.min_angle_rad)
    , highest_rad_(believable.max_angle_rad)
{
}

ResumedLog::Verdict ResumedLog::judge(const barge::OpeningSample& sample) const
{
  const std::int64_t stamp_ns = sample.stamp_ns;
  if (stamp_ns >= first_ns_ && stamp_ns <= last_ns_)
    return Verdict::known;
  // The same log may have begun with samples that nobody could believe: those are no evidence.
  const auto believable = [this](double angle) { return angle >= lowest_rad_ && angle <= highest_rad_; };
  const bool evidence = believable(sample.angles.port_rad) && believable(sample.angles.starboard_rad);
  const bool outside = stamp_ns < first_ns_ || stamp_ns > latest_ns_;
  return open_ && evidence && outside ? Verdict::another : Verdict::goes_on;
}

bool ResumedLog::too_late(std::int64_t now_ns) const
{
  return open_ && now_ns > latest_ns_;
}

std::string ResumedLog::contradiction() const
{
  return fmt::format(
      "a new run begins: the checkpoint's log is of {:.3f} to {:.3f} s and was to go on by {:.3f} s, but "
      "another one is heard",
      seconds(first_ns_), seconds(last_ns_), seconds(latest_ns_));
}

}  // namespace geocontainer_mpm::ros_bridge
