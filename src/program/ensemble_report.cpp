#include "ensemble_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace geocontainer_mpm::program {
namespace {

using Json = nlohmann::ordered_json;
using ensemble::Distribution;
using ensemble::Ending;
using ensemble::Figure;
using ensemble::FigureSummary;
using ensemble::Member;
using ensemble::Share;

/// Infinite is null.
Json number(double value)
{
  return std::isfinite(value) ? Json(value) : Json();
}

Json distribution(const Distribution& d)
{
  Json json{ { "distribution", ensemble::to_string(d.shape) } };
  switch (d.shape) {
    case ensemble::Shape::uniform:
      break;
    case ensemble::Shape::triangular:
      json["mode"] = d.middle;
      break;
    case ensemble::Shape::normal:
      json["mean"] = d.middle;
      json["deviation"] = d.spread;
      break;
    case ensemble::Shape::lognormal:
      json["median"] = d.middle;
      json["factor"] = d.spread;
      break;
  }
  json["low"] = number(d.low);
  json["high"] = number(d.high);
  return json;
}

Json share(const std::optional<Share>& share)
{
  if (!share)
    return {};
  return { { "value", share->value }, { "low_95", share->low }, { "high_95", share->high } };
}

Json figure(const Figure& what, const FigureSummary& summary, const std::vector<ensemble::Input>& inputs)
{
  Json correlations = Json::object();
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const std::optional<double>& rho = summary.rank_correlation[i];
    correlations[inputs[i].key] = rho ? Json(*rho) : Json();
  }
  return { { "unit", what.unit },
           { "p10", number(summary.p10) },
           { "p50", number(summary.p50) },
           { "p90", number(summary.p90) },
           { "rank_correlation", correlations },
           { "most_important_input", summary.most_important ? Json(inputs[*summary.most_important].key) : Json() } };
}

Json unfinished(const EnsembleView& view, Ending ending)
{
  Json list = Json::array();
  for (std::size_t m = 0; m < view.members.size(); ++m)
    if (view.members[m].ending == ending)
      list.push_back({ { "member", m + 1 }, { "why", view.members[m].why } });
  return list;
}

/// For a spreadsheet: in quotes where it has to be.
std::string field(const std::string& text)
{
  if (text.find_first_of(",\"\n") == std::string::npos)
    return text;
  std::string quoted = "\"";
  for (const char letter : text)
    quoted += letter == '"' ? std::string("\"\"") : std::string(1, letter);
  return quoted + "\"";
}

std::string percent(const Share& share)
{
  return fmt::format("{:.0f} % (true value within {:.0f} to {:.0f} %)", 100.0 * share.value, 100.0 * share.low,
                     100.0 * share.high);
}

/// A figure in the unit that people use.
std::string quantity(const Figure& what, double value)
{
  if (!std::isfinite(value))
    return "later";
  const std::string unit = what.unit;
  if (unit == "N/m")
    return fmt::format("{:.1f} kN/m", 1e-3 * value);
  return unit == "1" ? fmt::format("{:.0f} %", 100.0 * value) : fmt::format("{:.2f} {}", value, unit);
}

std::string label(const Figure& what)
{
  std::string name = what.name;
  for (const char* unit : { "_n_per_m", "_s", "_m" })
    if (const std::size_t length = std::string(unit).size();
        name.size() > length && name.compare(name.size() - length, length, unit) == 0) {
      name.resize(name.size() - length);
      break;
    }
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

}  // namespace

std::string ensemble_csv(const EnsembleView& view)
{
  std::string text = "member,ending";
  for (const ensemble::Input& input : view.inputs)
    text += "," + field(input.key);
  text += ",outcome";
  for (const Figure& one : ensemble::figures())
    text += std::string(",") + one.name;
  text += ",ruptures,digest,why\n";
  for (std::size_t m = 0; m < view.members.size(); ++m) {
    const Member& member = view.members[m];
    const bool completed = member.ending == Ending::completed;  // else its figures are of no moment in particular
    text += fmt::format("{},{}", m + 1, ensemble::to_string(member.ending));
    for (const std::string& value : view.values[m])
      text += "," + value;
    text += std::string(",") + (completed ? scene::to_string(member.outcome) : "");
    for (const std::optional<double>& value : member.figures)
      text += completed && value ? fmt::format(",{}", *value) : ",";
    text += completed ? fmt::format(",{},{:016x}", member.ruptures, member.digest) : ",,";
    text += "," + field(member.why) + "\n";
  }
  return text;
}

std::string ensemble_json(const EnsembleView& view)
{
  const ensemble::Summary& s = view.summary;
  Json json{ { "scene", view.scene }, { "seed", view.seed }, { "members", s.members }, { "completed", s.completed } };
  json["failed"] = unfinished(view, Ending::failed);
  json["interrupted"] = unfinished(view, Ending::interrupted).size();
  json["inputs"] = Json::object();
  for (const ensemble::Input& input : view.inputs)
    json["inputs"][input.key] = distribution(input.distribution);
  json["outcomes"] = Json::object();
  for (const auto& [outcome, count] : s.outcomes)
    json["outcomes"][scene::to_string(outcome)] = count;
  json["probability"] = { { "hung_up", share(s.hung_up) },
                          { "ruptured", share(s.ruptured) },
                          { "overloaded", share(s.overloaded) } };
  json["chance_correlation"] = s.chance;
  json["figures"] = Json::object();
  for (std::size_t f = 0; f < s.figures.size(); ++f) {
    const Figure& what = ensemble::figures()[f];
    json["figures"][what.name] = figure(what, s.figures[f], view.inputs);
  }
  return json.dump(2) + "\n";
}

std::string ensemble_table(const EnsembleView& view)
{
  const ensemble::Summary& s = view.summary;
  std::string outcomes;
  for (const auto& [outcome, count] : s.outcomes)
    outcomes += fmt::format("{}{} {}", outcomes.empty() ? "" : ", ", count, scene::to_string(outcome));
  std::string text = fmt::format("{}: {} of {} members completed, seed {}{}{}\n", view.scene, s.completed, s.members,
                                 view.seed, outcomes.empty() ? "" : "; ", outcomes);
  for (std::size_t m = 0; m < view.members.size(); ++m)
    if (view.members[m].ending == Ending::failed)
      text += fmt::format("  member {} failed: {}\n", m + 1, view.members[m].why);
  if (s.completed == 0)
    return text;
  const auto row = [&](const char* name, const std::string& value) {
    text += fmt::format("  {:<29}{}\n", name, value);
  };
  row("hung up", percent(*s.hung_up));
  row("sheet broke", percent(*s.ruptured));
  row("more tension than it bears", percent(*s.overloaded));
  text += fmt::format("  {:<21}{:>13}{:>13}{:>13}   matters most (rank correlation)\n", "", "P10", "P50", "P90");
  for (std::size_t f = 0; f < s.figures.size(); ++f) {
    const Figure& what = ensemble::figures()[f];
    const FigureSummary& one = s.figures[f];
    const std::string important = one.most_important ? fmt::format("{} ({:+.2f})", view.inputs[*one.most_important].key,
                                                                   *one.rank_correlation[*one.most_important])
                                                     : "no input";
    text += fmt::format("  {:<21}{:>13}{:>13}{:>13}   {}\n", label(what), quantity(what, one.p10),
                        quantity(what, one.p50), quantity(what, one.p90), important);
  }
  return text + fmt::format("  Rank correlations below {:.2f} may be chance in so few members.\n", s.chance);
}

}  // namespace geocontainer_mpm::program
