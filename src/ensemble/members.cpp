#include "geocontainer_mpm/ensemble/members.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <mutex>
#include <nlohmann/json.hpp>
#include <thread>

namespace geocontainer_mpm::ensemble {
namespace {

using Json = nlohmann::json;
using scene::Advance;
using scene::Outcome;

enum : std::size_t { peak_tension, peak_utilisation, release_time, residual_tension, width, height };

std::vector<std::optional<double>> figures_of(const scene::StatusFrame& status)
{
  std::vector<std::optional<double>> values(figures().size());
  values[peak_tension] = status.peak_tension_n_per_m;
  values[peak_utilisation] = std::max(status.peak_utilisation_sheet, status.peak_utilisation_seam);
  if (status.release_time_s >= 0.0)
    values[release_time] = status.release_time_s;
  values[residual_tension] = status.current_tension_n_per_m;
  values[width] = status.width_m;
  values[height] = status.height_m;
  return values;
}

void advance_to_end(scene::Simulation& simulation, const std::function<bool(const scene::Simulation&)>& done,
                    const std::function<bool()>& stop, Member& member)
{
  while (!stop()) {
    switch (simulation.advance()) {
      case Advance::stepped:
        continue;
      case Advance::frame_due:
        if (!done(simulation))
          continue;
        [[fallthrough]];
      case Advance::finished:
        member.ending = Ending::completed;
        return;
      case Advance::waiting:
      case Advance::stopped: {
        const scene::Failure& failure = simulation.failure();
        member.ending = Ending::failed;
        member.why = fmt::format("the solver stopped at {:.4f} s: {}", failure.time_s, failure.reason);
        return;
      }
    }
  }
}

/// What was not within the run is later than anything.
double value_of(const Member& member, std::size_t figure)
{
  return member.figures[figure].value_or(std::numeric_limits<double>::infinity());
}

FigureSummary summarise_figure(const std::vector<const Member*>& members, std::size_t figure,
                               const std::vector<std::vector<double>>& inputs, double chance)
{
  std::vector<double> samples;
  samples.reserve(members.size());
  for (const Member* member : members)
    samples.push_back(value_of(*member, figure));
  FigureSummary summary{ quantile(samples, 0.1), quantile(samples, 0.5), quantile(samples, 0.9), {}, std::nullopt };
  double largest = chance;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    summary.rank_correlation.push_back(rank_correlation(inputs[i], samples));
    const double size = std::abs(summary.rank_correlation.back().value_or(0.0));
    if (size > largest) {
      largest = size;
      summary.most_important = i;
    }
  }
  return summary;
}

}  // namespace

const char* to_string(Ending ending)
{
  switch (ending) {
    case Ending::completed:
      return "completed";
    case Ending::failed:
      return "failed";
    case Ending::interrupted:
      break;
  }
  return "interrupted";
}

const std::vector<Figure>& figures()
{
  static const std::vector<Figure> all = { { "peak_tension_n_per_m", "N/m" }, { "peak_utilisation", "1" },
                                           { "release_time_s", "s" },         { "residual_tension_n_per_m", "N/m" },
                                           { "container_width_m", "m" },      { "container_height_m", "m" } };
  return all;
}

std::size_t peak_tension_figure()
{
  return peak_tension;
}

std::size_t peak_utilisation_figure()
{
  return peak_utilisation;
}

std::size_t width_figure()
{
  return width;
}

std::size_t release_time_figure()
{
  return release_time;
}

Member advance_member(scene::Simulation& simulation, const std::function<bool(const scene::Simulation&)>& done,
                      const std::function<bool()>& stop)
{
  Member member;
  advance_to_end(simulation, done, stop, member);
  const scene::StatusFrame status = simulation.status();
  member.outcome = status.outcome;
  member.figures = figures_of(status);
  member.ruptures = status.ruptures;
  member.digest = simulation.digest();
  return member;
}

Member failed_member(const std::string& why)
{
  Member member;
  member.figures.resize(figures().size());
  member.ending = Ending::failed;
  member.why = why;
  return member;
}

Member run_member(const scene::SceneDescription& scene, const std::function<void(scene::Simulation&)>& open,
                  const std::function<bool()>& stop)
{
  if (stop()) {
    Member member;
    member.figures.resize(figures().size());
    return member;
  }
  try {
    scene::Simulation simulation(scene, 1);
    open(simulation);
    return advance_member(
        simulation, [](const scene::Simulation&) { return false; }, stop);
  } catch (const std::exception& error) {  // a scene that cannot be built, or no memory
    return failed_member(error.what());
  }
}

std::vector<Member> run_members(std::size_t count, int threads, const std::function<Member(std::size_t)>& run,
                                const std::function<void()>& done)
{
  std::vector<Member> members(count);
  std::atomic<std::size_t> next{ 0 };
  std::mutex one_at_a_time;
  const auto work = [&] {
    for (std::size_t i = next++; i < count; i = next++) {
      members[i] = run(i);
      const std::lock_guard<std::mutex> lock(one_at_a_time);
      done();
    }
  };
  std::vector<std::thread> team;
  for (int t = 1; t < threads && static_cast<std::size_t>(t) < count; ++t)
    team.emplace_back(work);
  work();
  for (std::thread& thread : team)
    thread.join();
  return members;
}

Summary summarise(const std::vector<Member>& members, const std::vector<std::vector<std::string>>& values)
{
  Summary summary;
  summary.members = members.size();
  std::vector<const Member*> completed;
  std::vector<std::vector<double>> inputs(values.empty() ? 0 : values.front().size());
  std::size_t ruptured = 0, overloaded = 0;
  for (std::size_t m = 0; m < members.size(); ++m) {
    if (members[m].ending != Ending::completed)
      continue;
    completed.push_back(&members[m]);
    for (std::size_t i = 0; i < inputs.size(); ++i)
      inputs[i].push_back(std::strtod(values[m][i].c_str(), nullptr));
    ++summary.outcomes[members[m].outcome];
    ruptured += members[m].ruptures > 0 ? 1 : 0;
    overloaded += members[m].figures[peak_utilisation].value_or(0.0) > 1.0 ? 1 : 0;
  }
  summary.completed = completed.size();
  summary.chance = chance_correlation(completed.size());
  if (completed.empty())
    return summary;
  const auto of_all = [&](std::size_t count) { return share(count, completed.size()); };
  const auto hung_up = summary.outcomes.find(Outcome::hung_up);
  summary.hung_up = of_all(hung_up == summary.outcomes.end() ? 0 : hung_up->second);
  summary.ruptured = of_all(ruptured);
  summary.overloaded = of_all(overloaded);
  for (std::size_t f = 0; f < figures().size(); ++f)
    summary.figures.push_back(summarise_figure(completed, f, inputs, summary.chance));
  return summary;
}

std::string to_text(const std::vector<Member>& members)
{
  Json all = Json::array();
  for (const Member& member : members) {
    Json values = Json::array();
    for (const std::optional<double>& value : member.figures)
      values.push_back(value ? Json(*value) : Json());
    all.push_back({ { "ending", member.ending },
                    { "why", member.why },
                    { "outcome", member.outcome },
                    { "figures", values },
                    { "ruptures", member.ruptures },
                    { "digest", member.digest } });
  }
  return all.dump(-1, ' ', true, Json::error_handler_t::replace);
}

std::vector<Member> from_text(const std::string& text)
{
  std::vector<Member> members;
  for (const Json& one : Json::parse(text)) {
    Member member;
    member.ending = one.at("ending").get<Ending>();
    member.why = one.at("why").get<std::string>();
    member.outcome = one.at("outcome").get<Outcome>();
    for (const Json& value : one.at("figures"))
      member.figures.push_back(value.is_null() ? std::nullopt : std::optional<double>(value.get<double>()));
    member.ruptures = one.at("ruptures").get<std::size_t>();
    member.digest = one.at("digest").get<std::uint64_t>();
    members.push_back(std::move(member));
  }
  return members;
}

}  // namespace geocontainer_mpm::ensemble
