#include "run.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>

#include "case.h"
#include "exit_status.h"
#include "geocontainer_mpm/error.h"
#include "geocontainer_mpm/record/checkpoint.h"
#include "geocontainer_mpm/record/recorder.h"
#include "geocontainer_mpm/scene/simulation.h"
#include "progress_bar.h"
#include "report.h"
#include "stop_request.h"

namespace geocontainer_mpm::program {
namespace {

using scene::Advance;
using scene::Simulation;

constexpr int steps_between_looks = 16;  ///< at the stop request and the progress bar: a few hundredths of a second

/// How a run ended.
struct End {
  int exit_status = exit_completed;
  std::string why;  ///< one sentence; empty for a completed run
};

/// The YAML as the run saw it: overrides follow as comments.
std::string scene_text(const Options& options)
{
  std::ostringstream text;
  text << std::ifstream(options.scene).rdbuf();
  for (const std::string& override_text : options.overrides)
    text << "# --set " << override_text << "\n";
  return text.str();
}

void check_outputs(const Options& options)
{
  std::vector<std::pair<const char*, const std::string*>> outputs;
  for (const auto& [option, path] :
       { std::make_pair("--record", &options.record), std::make_pair("--summary", &options.summary),
         std::make_pair("--checkpoint", &options.checkpoint) }) {
    if (path->empty())
      continue;
    check_output(option, *path);
    for (const auto& [other, same] : outputs)
      if (*same == *path)
        throw InputError("command line", option, *path, std::string("must be another file than ") + other);
    outputs.emplace_back(option, path);
  }
  std::error_code ignored;
  if (!options.resume.empty() && !options.record.empty() && std::filesystem::exists(options.record, ignored))
    throw InputError("command line", "--record", options.record,
                     "exists; a run that is resumed records from the checkpoint on, into a new file");
}

/// Keeps frames, each instant once.
class Keeper {
public:
  Keeper(const Options& options, const std::string& scene_name)
  {
    if (!options.record.empty())
      recorder_.emplace(options.record, scene_name, scene_text(options));
  }

  /// Empty, or what went wrong.
  std::string keep(const Simulation& simulation)
  {
    if (!recorder_ || simulation.time_s() == last_s_)
      return {};
    last_s_ = simulation.time_s();
    return recorder_->write(simulation.frame());
  }

private:
  std::optional<record::Recorder> recorder_;
  double last_s_ = -1.0;
};

/// Keeps the state of the run in a file, from the first frame on.
class Saver {
public:
  Saver(const Options& options, std::uint64_t opening)
      : path_(options.checkpoint), period_(options.checkpoint_period_s), opening_(opening)
  {
  }

  /// Where the period is over. Empty, or what went wrong.
  std::string save_if_due(const Simulation& simulation)
  {
    return !path_.empty() && Clock::now() >= due_ ? save(simulation) : std::string();
  }
  std::string save(const Simulation& simulation)
  {
    if (path_.empty())
      return {};
    std::string error = record::save_checkpoint(simulation, opening_, path_);
    due_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(period_);
    return error;
  }

private:
  using Clock = std::chrono::steady_clock;

  const std::string& path_;
  const std::chrono::duration<double> period_;
  const std::uint64_t opening_;
  Clock::time_point due_ = Clock::time_point::min();
};

std::string describe(const Simulation& simulation)
{
  const scene::Failure& failure = simulation.failure();
  return fmt::format("the solver stopped at {:.4f} s at {}: {}", failure.time_s,
                     scene::place(failure.position_m, simulation.status().dimensions), failure.reason);
}

/// From now to the end, whatever kind of end it is. A stopped run keeps no last frame: its state is not to be trusted.
/// Its last checkpoint stays as it is.
End advance_to_end(Simulation& simulation, Keeper& keeper, Saver& saver, const StopRequest& stop)
{
  const auto unwritten = [](const char* what, const std::string& error) {
    return End{ exit_bad_input, fmt::format("the {} cannot be written: {}", what, error) };
  };
  ProgressBar bar(simulation.scene().time.end_s);
  std::string record_error = keeper.keep(simulation);
  while (record_error.empty()) {
    std::string save_error;
    if (stop.signal() != 0) {
      keeper.keep(simulation);
      if (simulation.counters().steps > 0)
        save_error = saver.save(simulation);
      return { exit_signal_base + stop.signal(),
               fmt::format("stopped by signal {} at {:.4f} s{}", stop.signal(), simulation.time_s(),
                           save_error.empty() ? "" : "; the checkpoint cannot be written: " + save_error) };
    }
    switch (simulation.advance(steps_between_looks)) {
      case Advance::stepped:
        break;
      case Advance::frame_due:
        record_error = keeper.keep(simulation);
        save_error = saver.save_if_due(simulation);
        break;
      case Advance::finished:
        record_error = keeper.keep(simulation);
        save_error = saver.save(simulation);
        if (record_error.empty() && save_error.empty())
          return {};
        break;
      case Advance::waiting:  // cannot be: the opening is known to the end
        return { exit_solver_stopped, fmt::format("no opening is known beyond {:.4f} s", simulation.time_s()) };
      case Advance::stopped:
        return { exit_solver_stopped, describe(simulation) };
    }
    if (!save_error.empty())
      return unwritten("checkpoint", save_error);
    bar.show(simulation.time_s());
  }
  return unwritten("record", record_error);
}

nlohmann::ordered_json summarise(const Simulation& simulation, const Options& options, const End& end,
                                 double wall_time_s, double setup_time_s, std::optional<double> resumed_at_s)
{
  auto summary = nlohmann::ordered_json::parse(scene::summary_json(simulation, wall_time_s, options.threads));
  summary["completed"] = end.exit_status == exit_completed;
  summary["why"] = end.why.empty() ? nlohmann::ordered_json() : nlohmann::ordered_json(end.why);
  summary["setup_time_s"] = setup_time_s;
  summary["resumed_at_s"] = resumed_at_s ? nlohmann::ordered_json(*resumed_at_s) : nlohmann::ordered_json();
  return summary;
}

}  // namespace

int run(const Options& options)
{
  using Clock = std::chrono::steady_clock;
  const auto seconds = [](Clock::duration duration) { return std::chrono::duration<double>(duration).count(); };
  const StopRequest stop;

  const scene::SceneDescription scene = load_case(options, options.overrides);
  check_outputs(options);
  const std::vector<barge::OpeningSample> samples = read_log(options);
  const std::uint64_t opening = record::opening_hash(samples);

  const Clock::time_point begin = Clock::now();
  Simulation simulation = options.resume.empty()
                              ? Simulation(scene, options.threads)
                              : record::load_checkpoint(options.resume, scene, opening, options.threads);
  std::optional<double> resumed_at_s;
  if (options.resume.empty())
    open_hull(options, samples, simulation);
  else
    resumed_at_s = simulation.time_s();

  const Clock::time_point start = Clock::now();
  End end;
  {
    Keeper keeper(options, scene.name);
    Saver saver(options, opening);
    end = advance_to_end(simulation, keeper, saver, stop);
  }
  const nlohmann::ordered_json summary =
      summarise(simulation, options, end, seconds(Clock::now() - start), seconds(start - begin), resumed_at_s);
  if (!end.why.empty())
    fmt::print(stderr, "simulate: {}: {}\n", options.scene, end.why);
  fmt::print("{}", table(summary));
  if (!options.summary.empty())
    write_file("--summary", options.summary, summary.dump(2) + "\n");
  return end.exit_status;
}

int show(const std::string& path)
{
  std::ifstream file(path);
  if (!file)
    throw InputError("command line", "--show", path, "cannot be read");
  try {
    fmt::print("{}", table(nlohmann::ordered_json::parse(file)));
  } catch (const std::exception& error) {  // of the stream (a folder) or of the JSON library
    throw InputError("command line", "--show", path, std::string("is no summary of a run: ") + error.what());
  }
  return exit_completed;
}

}  // namespace geocontainer_mpm::program
