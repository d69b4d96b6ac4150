#include "ensemble_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "case.h"
#include "ensemble_report.h"
#include "exit_status.h"
#include "geocontainer_mpm/ensemble/members.h"
#include "geocontainer_mpm/ensemble/sampling.h"
#include "geocontainer_mpm/error.h"
#include "progress_bar.h"
#include "ranks.h"
#include "report.h"
#include "stop_request.h"

namespace geocontainer_mpm::program {
namespace {

using ensemble::Member;

/// All that every rank knows before members run.
struct Plan {
  std::vector<ensemble::Input> inputs;
  std::vector<std::vector<std::string>> values;  ///< a row a member
  std::vector<scene::SceneDescription> scenes;   ///< a member each
  std::vector<barge::OpeningSample> samples;
};

void check_outputs(const Options& options)
{
  if (!options.members.empty())
    check_output("--members", options.members);
  if (!options.summary.empty())
    check_output("--summary", options.summary);
  if (!options.members.empty() && options.members == options.summary)
    throw InputError("command line", "--summary", options.summary, "must be another file than --members");
}

/// Every member's scene is read and checked before the first one runs.
Plan make_plan(const Options& options)
{
  Plan plan;
  plan.inputs = ensemble::load_inputs(options.distributions);
  plan.values = ensemble::draw(plan.inputs, options.ensemble, options.seed);
  const auto members = ensemble::assignments(plan.inputs, plan.values, options.overrides, "command line", "--set",
                                             options.distributions);
  plan.samples = read_log(options);
  for (const std::vector<std::string>& member : members)
    plan.scenes.push_back(load_case(options, member));
  return plan;
}

/// Members rank, rank + size, ...: whichever rank runs one, it is the same.
std::vector<Member> run_share(const Options& options, const Plan& plan, const Ranks& ranks, const StopRequest& stop)
{
  const auto size = static_cast<std::size_t>(ranks.size()), rank = static_cast<std::size_t>(ranks.rank());
  const std::size_t count = (plan.scenes.size() + size - 1 - rank) / size;
  const int threads = options.threads > 0 ? options.threads : ranks.size() > 1 ? 1 : cores();
  std::optional<ProgressBar> bar;
  if (ranks.first())
    bar.emplace(static_cast<double>(plan.scenes.size()));
  std::size_t done = 0;
  return ensemble::run_members(
      count, threads,
      [&](std::size_t i) {
        return ensemble::run_member(
            plan.scenes[rank + i * size],
            [&](scene::Simulation& simulation) { open_hull(options, plan.samples, simulation); },
            [&] { return stop.signal() != 0; });
      },
      [&] {
        if (bar)
          bar->show_members(std::min(++done * size, plan.scenes.size()));
      });
}

/// In the members' own order.
std::vector<Member> joined(const std::vector<std::string>& of_ranks, std::size_t count)
{
  std::vector<Member> members(count);
  for (std::size_t r = 0; r < of_ranks.size(); ++r) {
    std::vector<Member> share = ensemble::from_text(of_ranks[r]);
    for (std::size_t i = 0; i < share.size(); ++i)
      members[r + i * of_ranks.size()] = std::move(share[i]);
  }
  return members;
}

int report(const Options& options, const Plan& plan, const std::vector<Member>& members, const StopRequest& stop)
{
  const EnsembleView view{
    plan.scenes.front().name, options.seed, plan.inputs, plan.values, members, ensemble::summarise(members, plan.values)
  };
  fmt::print("{}", ensemble_table(view));
  if (!options.members.empty())
    write_file("--members", options.members, ensemble_csv(view));
  if (!options.summary.empty())
    write_file("--summary", options.summary, ensemble_json(view));
  if (stop.signal() != 0)
    return exit_signal_base + stop.signal();
  return view.summary.completed == members.size() ? exit_completed : exit_solver_stopped;
}

}  // namespace

int run_ensemble(const Options& options)
{
  const Ranks ranks;
  const StopRequest stop;
  std::optional<Plan> plan;
  std::optional<InputError> bad;
  try {
    if (ranks.first())
      check_outputs(options);
    plan = make_plan(options);
  } catch (const InputError& error) {
    bad = error;
  }
  if (!ranks.all(!bad)) {
    if (bad && ranks.first())
      throw *bad;
    return exit_bad_input;
  }
  const std::vector<std::string> shares = ranks.gather(ensemble::to_text(run_share(options, *plan, ranks, stop)));
  return ranks.first() ? report(options, *plan, joined(shares, plan->scenes.size()), stop) : exit_completed;
}

}  // namespace geocontainer_mpm::program
