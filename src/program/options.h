#pragma once
/// Command line of `simulate`.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace geocontainer_mpm::program {

struct Options {
  std::string scene;          ///< YAML file
  std::string bag;            ///< recorded bag with the opening; empty: none
  std::string angles;         ///< CSV with the opening; empty: none
  std::string opening_topic;  ///< topic of the bag to use; empty: see bag_log.h
  std::string port_joint = "hull_port_joint";
  std::string starboard_joint = "hull_starboard_joint";
  std::string record;                  ///< HDF5 record to write; empty: none
  std::string summary;                 ///< JSON summary to write; empty: none
  std::string show;                    ///< JSON summary to print, and nothing else; empty: none
  std::vector<std::string> overrides;  ///< `dotted.key=value`
  std::optional<double> until_s;       ///< cap of the scene's time.end_s, s
  int threads = 1;         ///< of the solver, or members at a time; 0: of an ensemble, as many as there are cores
  std::string checkpoint;  ///< file to write the state to, again and again; empty: none
  double checkpoint_period_s = 60.0;  ///< of wall-clock time, s
  std::string resume;                 ///< checkpoint to go on from; empty: from the start
  std::size_t ensemble = 0;           ///< number of members; 0: a single run
  std::string distributions;          ///< YAML file with what is drawn
  std::uint64_t seed = 1;
  std::string members;  ///< CSV file to write, one row a member; empty: none
};

/// What the command line asks for: a run, or (with `exit_status` set) nothing more, its answer having been printed.
struct CommandLine {
  Options options;
  std::optional<int> exit_status;
};

/// That this process may use.
int cores();

/// Prints help, version, or one line on stderr about what is wrong.
CommandLine parse_command_line(int argc, const char* const* argv);

}  // namespace geocontainer_mpm::program
