#include "run.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>

#include "angles_csv.h"
#include "exit_status.h"
#include "geocontainer_mpm/error.h"
#include "geocontainer_mpm/record/recorder.h"
#include "geocontainer_mpm/scene/simulation.h"
#include "progress_bar.h"
#include "report.h"
#include "stop_request.h"
#ifdef GEOCONTAINER_MPM_WITH_ROS
#include "bag_log.h"
#endif

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

scene::SceneDescription load(const Options& options)
{
  scene::SceneDescription scene = scene::load_scene(options.scene, options.overrides);
  if (options.until_s)
    scene.time.end_s = std::min(scene.time.end_s, *options.until_s);
  if (!scene.hull && (!options.bag.empty() || !options.angles.empty()))
    throw InputError(options.scene, "hull", "", "missing, but a log of opening angles needs a hull to open");
  return scene;
}

/// The YAML as the run saw it: overrides follow as comments.
std::string scene_text(const Options& options)
{
  std::ostringstream text;
  text << std::ifstream(options.scene).rdbuf();
  for (const std::string& override_text : options.overrides)
    text << "# --set " << override_text << "\n";
  return text.str();
}

std::vector<barge::OpeningSample> read_log(const Options& options)
{
  if (!options.angles.empty())
    return read_angles_csv(options.angles);
#ifdef GEOCONTAINER_MPM_WITH_ROS
  return read_bag({ options.bag, options.opening_topic, options.port_joint, options.starboard_joint });
#else
  throw InputError("command line", "--bag", options.bag, "this simulate was built without ROS and reads no bags");
#endif
}

void feed(barge::OpeningSignal& opening, const std::vector<barge::OpeningSample>& samples, const std::string& path)
{
  for (const barge::OpeningSample& sample : samples)
    opening.add(sample);
  if (opening.empty())
    throw InputError(path, "opening", "",
                     fmt::format("none of its {} samples is believable (keys under hull.signal)", samples.size()));
  opening.finish();
}

void check_outputs(const Options& options)
{
  if (!options.record.empty())
    check_output("--record", options.record);
  if (!options.summary.empty())
    check_output("--summary", options.summary);
  if (!options.record.empty() && options.record == options.summary)
    throw InputError("command line", "--summary", options.summary, "must be another file than --record");
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

std::string describe(const Simulation& simulation)
{
  const scene::Failure& failure = simulation.failure();
  return fmt::format("the solver stopped at {:.4f} s at {}: {}", failure.time_s,
                     scene::place(failure.position_m, simulation.status().dimensions), failure.reason);
}

/// From now to the end, whatever kind of end it is. A stopped run keeps no last frame: its state is not to be trusted.
End advance_to_end(Simulation& simulation, Keeper& keeper, const StopRequest& stop)
{
  ProgressBar bar(simulation.scene().time.end_s);
  std::string record_error = keeper.keep(simulation);
  while (record_error.empty()) {
    if (stop.signal() != 0) {
      keeper.keep(simulation);
      return { exit_signal_base + stop.signal(),
               fmt::format("stopped by signal {} at {:.4f} s", stop.signal(), simulation.time_s()) };
    }
    switch (simulation.advance(steps_between_looks)) {
      case Advance::stepped:
        break;
      case Advance::frame_due:
        record_error = keeper.keep(simulation);
        break;
      case Advance::finished:
        record_error = keeper.keep(simulation);
        if (record_error.empty())
          return {};
        break;
      case Advance::waiting:  // cannot be: the opening is known to the end
        return { exit_solver_stopped, fmt::format("no opening is known beyond {:.4f} s", simulation.time_s()) };
      case Advance::stopped:
        return { exit_solver_stopped, describe(simulation) };
    }
    bar.show(simulation.time_s());
  }
  return { exit_bad_input, "the record cannot be written: " + record_error };
}

nlohmann::ordered_json summarise(const Simulation& simulation, const Options& options, const End& end,
                                 double wall_time_s, double setup_time_s)
{
  auto summary = nlohmann::ordered_json::parse(scene::summary_json(simulation, wall_time_s, options.threads));
  summary["completed"] = end.exit_status == exit_completed;
  summary["why"] = end.why.empty() ? nlohmann::ordered_json() : nlohmann::ordered_json(end.why);
  summary["setup_time_s"] = setup_time_s;
  return summary;
}

}  // namespace

int run(const Options& options)
{
  using Clock = std::chrono::steady_clock;
  const auto seconds = [](Clock::duration duration) { return std::chrono::duration<double>(duration).count(); };
  const StopRequest stop;

  const scene::SceneDescription scene = load(options);
  check_outputs(options);
  const std::string log = options.angles.empty() ? options.bag : options.angles;
  const std::vector<barge::OpeningSample> samples =
      log.empty() ? std::vector<barge::OpeningSample>() : read_log(options);

  const Clock::time_point begin = Clock::now();
  Simulation simulation(scene, options.threads);
  if (log.empty())
    simulation.use_scene_opening();
  else
    feed(simulation.opening(), samples, log);

  const Clock::time_point start = Clock::now();
  End end;
  {
    Keeper keeper(options, scene.name);
    end = advance_to_end(simulation, keeper, stop);
  }
  const nlohmann::ordered_json summary =
      summarise(simulation, options, end, seconds(Clock::now() - start), seconds(start - begin));
  if (!end.why.empty())
    fmt::print(stderr, "simulate: {}: {}\n", options.scene, end.why);
  fmt::print("{}", table(summary));
  if (!options.summary.empty())
    write_summary(options.summary, summary.dump(2) + "\n");
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
