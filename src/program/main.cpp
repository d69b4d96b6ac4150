/// `simulate`: one scene, offline, from the command line to a record and a summary.

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <string>

#include "ensemble_run.h"
#include "exit_status.h"
#include "geocontainer_mpm/error.h"
#include "options.h"
#include "run.h"

int main(int argc, char** argv)
{
  using namespace geocontainer_mpm;
  try {
    const program::CommandLine line = program::parse_command_line(argc, argv);
    if (line.exit_status)
      return *line.exit_status;
    if (!line.options.show.empty())
      return program::show(line.options.show);
    return line.options.ensemble > 0 ? program::run_ensemble(line.options) : program::run(line.options);
  } catch (const InputError& error) {
    std::string text = error.what();
    std::replace(text.begin(), text.end(), '\n', ' ');
    fmt::print(stderr, "simulate: {}\n", text);
    return program::exit_bad_input;
  } catch (const std::exception& error) {  // out of memory, a defect of ours: nothing the user wrote
    fmt::print(stderr, "simulate: internal error: {}\n", error.what());
    return program::exit_solver_stopped;
  }
}
