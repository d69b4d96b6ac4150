#include "options.h"

#include <fmt/format.h>
#include <sched.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "exit_status.h"

namespace geocontainer_mpm::program {
namespace {

constexpr int max_threads = 256;
constexpr std::size_t max_members = 1000000;

}  // namespace

int cores()
{
  cpu_set_t set;
  CPU_ZERO(&set);
  return sched_getaffinity(0, sizeof set, &set) == 0 ? std::clamp(CPU_COUNT(&set), 1, max_threads) : 1;
}

namespace {

/// Cores this process may use, at most 4: a slice in plane strain has no work for more. The result of a run does not
/// depend on it.
int default_threads()
{
  return std::min(cores(), 4);
}

constexpr const char* footer = R"(Without --bag and --angles the hull follows the opening_table of the scene.

Examples:
  simulate release.yaml --angles log.csv --record out.h5 --summary out.json
  simulate release.yaml --set hull.friction=0.5 --set geotextiles.container.stiffness_n_per_m=5e5
  simulate release.yaml --bag release.bag --until 20 --threads 2
  simulate release.yaml --checkpoint state.h5 --record out.h5      # killed; then
  simulate release.yaml --resume state.h5 --checkpoint state.h5 --record out_2.h5
  simulate release.yaml --ensemble 64 --distributions unsure.yaml --members out.csv --summary out.json

Angles as CSV: the first line is `time_s,port_rad,starboard_rad`, every other line one sample: time of measurement in s
(any epoch), rotation of each hull half from closed, rad, opening positive.

Exit status: 0 the run was completed; 2 bad input (one line says which); 3 the solver had to stop (one line says why,
where and when; the record ends with the last good frame); 130 or 143 stopped by SIGINT or SIGTERM, record and summary
closed properly. Of an ensemble 3: a member failed; the results name it.)";

void define_checkpoints(CLI::App& app, Options& options)
{
  auto* checkpoint = app.add_option("--checkpoint", options.checkpoint,
                                    "Keep the state of the run in this HDF5 file, renewed on a period and at the end")
                         ->option_text("FILE.h5");
  app.add_option("--checkpoint-period", options.checkpoint_period_s, "Wall-clock time between two of them")
      ->needs(checkpoint)
      ->check(CLI::Range(0.0, 1e9))
      ->option_text(fmt::format("SECONDS [{:.0f}]", options.checkpoint_period_s));
  app.add_option("--resume", options.resume,
                 "Go on from a checkpoint of the same scene and log; --record then takes the frames from there on")
      ->option_text("FILE.h5");
}

void define_ensemble(CLI::App& app, Options& options)
{
#ifdef GEOCONTAINER_MPM_WITH_MPI
  const std::string ranks = "; under mpirun its ranks share them";
#else
  const std::string ranks;
#endif
  auto* ensemble =
      app.add_option("--ensemble", options.ensemble, "Run so many members with values drawn at random" + ranks)
          ->check(CLI::Range(std::size_t{ 2 }, max_members))
          ->option_text("N");
  auto* distributions =
      app.add_option("--distributions", options.distributions, "YAML file that says what is drawn, and how")
          ->needs(ensemble)
          ->option_text("FILE.yaml");
  ensemble->needs(distributions);
  app.add_option("--seed", options.seed, "Of the draws")
      ->needs(ensemble)
      ->option_text(fmt::format("N [{}]", options.seed));
  app.add_option("--members", options.members,
                 "Write one row a member to this CSV file: what was drawn, what came of it")
      ->needs(ensemble)
      ->option_text("FILE.csv");
  for (const char* single : { "--record", "--checkpoint", "--resume" })
    ensemble->excludes(app.get_option(single));
}

void define(CLI::App& app, Options& options)
{
  app.footer(footer);
#ifdef GEOCONTAINER_MPM_WITH_ROS
  const std::string bag_support = "reads bags";
#else
  const std::string bag_support = "built without ROS, no --bag";
#endif
  app.set_version_flag("--version", fmt::format("simulate {} ({})", GEOCONTAINER_MPM_VERSION, bag_support));
  app.add_option("SCENE.yaml", options.scene, "The case to run")->option_text(" ");
  auto* bag = app.add_option("--bag", options.bag, "Hull opening from a recorded ROS 1 bag")->option_text("LOG.bag");
  auto* angles = app.add_option("--angles", options.angles, "Hull opening from a CSV file")->option_text("LOG.csv");
  bag->excludes(angles);
  app.add_option("--opening-topic", options.opening_topic,
                 "Topic of the bag: HullOpening or JointState (else hull_opening or, without it, joint_states)")
      ->needs(bag)
      ->option_text("TOPIC");
  app.add_option("--port-joint", options.port_joint, "Joint of the port half in a JointState")
      ->needs(bag)
      ->option_text(fmt::format("NAME [{}]", options.port_joint));
  app.add_option("--starboard-joint", options.starboard_joint, "Joint of the starboard half in a JointState")
      ->needs(bag)
      ->option_text(fmt::format("NAME [{}]", options.starboard_joint));
  app.add_option("--record", options.record, "Write frames to this HDF5 file, with an XDMF file beside it for ParaView")
      ->option_text("OUT.h5");
  app.add_option("--set", options.overrides, "Replace a value of the scene; may be given several times")
      ->allow_extra_args(false)
      ->option_text("dotted.key=value ...");
  app.add_option("--threads", options.threads,
                 "Threads of the solver, or members at a time; the result does not depend on them")
      ->check(CLI::Range(1, max_threads))
      ->option_text(fmt::format("N [{}]", options.threads));
  define_checkpoints(app, options);
  define_ensemble(app, options);
  app.add_option("--until", options.until_s, "End at this simulated time, where the scene would end later")
      ->check(CLI::Validator(
          [](const std::string& text) {
            double value = 0.0;
            const bool good = CLI::detail::lexical_cast(text, value) && std::isfinite(value) && value > 0.0;
            return good ? std::string() : text + " is not a time in seconds > 0";
          },
          ""))
      ->option_text("SECONDS");
  app.add_option("--summary", options.summary, "Write the results to this JSON file")->option_text("FILE.json");
  app.add_option("--show", options.show, "Print the table of an earlier summary, this program's or the node's, and end")
      ->option_text("FILE.json");
}

}  // namespace

CommandLine parse_command_line(int argc, const char* const* argv)
{
  CommandLine line;
  line.options.threads = default_threads();
  CLI::App app("Predicts the release of a geocontainer from a split-hull barge: runs a scene to its end.", "simulate");
  try {
    define(app, line.options);
    app.parse(argc, argv);
    if (line.options.scene.empty() && line.options.show.empty())
      throw CLI::RequiredError("SCENE.yaml");
    if (line.options.ensemble > 0 && app.count("--threads") == 0)
      line.options.threads = 0;
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) {
      line.exit_status = app.exit(error);
      return line;
    }
    std::string message = error.what();
    std::replace(message.begin(), message.end(), '\n', ' ');
    fmt::print(stderr, "simulate: command line: {} (--help tells more)\n", message);
    line.exit_status = exit_bad_input;
  }
  return line;
}

}  // namespace geocontainer_mpm::program
