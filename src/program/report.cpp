#include "report.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "geocontainer_mpm/error.h"
#include "geocontainer_mpm/record/whole_file.h"

namespace geocontainer_mpm::program {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

[[noreturn]] void refuse(const std::string& option, const std::string& path, const std::string& why)
{
  throw InputError("command line", option, path, "cannot be written: " + why);
}

fs::path folder_of(const fs::path& path)
{
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

/// A value with its unit, or a dash where the summary has none.
/// Of several containers one after the other.
std::string quantity(const Json& value, double scale, int decimals, const char* unit)
{
  if (value.is_array()) {
    std::string text;
    for (const Json& one : value)
      text += (text.empty() ? "" : "; ") + quantity(one, scale, decimals, unit);
    return text;
  }
  if (!value.is_number())
    return "-";
  return fmt::format("{:.{}f} {}", value.get<double>() * scale, decimals, unit);
}

std::string place(const Json& position)
{
  if (!position.is_array())
    return "-";
  if (position.empty() || !position.front().is_number()) {
    std::string text;
    for (const Json& one : position)
      text += (text.empty() ? "" : "; ") + place(one);
    return text;
  }
  const char* axis = position.size() == 3 ? "xyz" : "yz";
  std::string text;
  for (const Json& coordinate : position)
    text += fmt::format("{}{} {:.2f} m", text.empty() ? "" : ", ", *axis++, coordinate.get<double>());
  return text;
}

std::string words(const Json& value)
{
  if (!value.is_array())
    return value.get<std::string>();
  std::string text;
  for (const Json& one : value)
    text += (text.empty() ? "" : ", ") + one.get<std::string>();
  return text;
}

std::string rejected(const Json& counts)
{
  std::string text;
  for (const auto& [verdict, count] : counts.items())
    if (count.get<std::uint64_t>() > 0)
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count.get<std::uint64_t>(), verdict);
  return text.empty() ? "none" : text;
}

std::string line(const std::string& name, const std::string& value)
{
  return fmt::format("  {:<29}{}\n", name, value);
}

std::string in_unit(const Json& value, const std::string& unit)
{
  if (!value.is_number())
    return "none";
  return unit == "N/m" ? quantity(value, 1e-3, 2, "kN/m") : quantity(value, 1.0, 2, unit.c_str());
}

/// What hand rules say for a container, and what each is to be compared with.
std::string hand_rules(const Json& container)
{
  std::string text = line("hand rules for", container.at("container").get<std::string>() + " (sources in the summary)");
  for (const auto& [name, rule] : container.at("rules").items()) {
    const std::string unit = rule.at("unit").get<std::string>();
    std::string value = in_unit(rule.at("value"), unit);
    if (const Json& beside = rule.at("beside"); beside.is_object())
      value += fmt::format(" ({} {})", beside.at("what").get<std::string>(), in_unit(beside.at("value"), unit));
    std::string label = "  " + name;
    std::replace(label.begin(), label.end(), '_', ' ');
    text += line(label, value);
  }
  return text;
}

}  // namespace

void check_output(const std::string& option, const std::string& path)
{
  std::error_code ignored;
  if (fs::is_directory(path, ignored))
    refuse(option, path, "is a directory");
  const fs::path folder = folder_of(path);
  if (!fs::is_directory(folder, ignored))
    refuse(option, path, "there is no directory " + folder.string());
  const bool exists = fs::exists(path, ignored);
  if (::access(exists ? path.c_str() : folder.c_str(), W_OK) != 0)
    refuse(option, path, std::strerror(errno));
}

void write_file(const std::string& option, const std::string& path, const std::string& text)
{
  if (const std::string error = record::replace_file(path, text); !error.empty())
    refuse(option, path, error);
}

std::string table(const Json& s)
{
  std::string text;
  const auto row = [&](const char* name, const std::string& value) { text += line(name, value); };
  text += fmt::format("{}: {}\n", s.at("scene").get<std::string>(), words(s.at("outcome")));
  if (!s.value("completed", true))  // the node's summary is of a moment and does not say
    row("not completed", s.at("why").get<std::string>());
  row("release time", quantity(s.at("release_time_s"), 1.0, 2, "s"));
  if (!s.at("peak_tension_n_per_m").is_null()) {
    row("peak tension", quantity(s.at("peak_tension_n_per_m"), 1e-3, 2, "kN/m"));
    row("  at", quantity(s.at("peak_tension_time_s"), 1.0, 2, "s") + ", " + place(s.at("peak_tension_position_m")));
    row("  of seam strength", quantity(s.at("peak_utilisation_seam"), 100.0, 1, "%"));
    row("  of sheet strength", quantity(s.at("peak_utilisation_sheet"), 100.0, 1, "%"));
    if (s.at("ruptured").is_object())
      row("ruptured", fmt::format("{} pieces, first at ", s.at("ruptured").at("pieces").get<std::size_t>()) +
                          quantity(s.at("ruptured").at("time_s"), 1.0, 2, "s") + ", " +
                          place(s.at("ruptured").at("position_m")));
    row("residual tension", quantity(s.at("residual_tension_n_per_m"), 1e-3, 2, "kN/m"));
    row("largest elongation", quantity(s.at("geotextile_elongation_max"), 100.0, 2, "%"));
  }
  row("centroid", place(s.at("container_centroid_m")));
  const std::string section =
      quantity(s.at("container_width_m"), 1.0, 2, "m") + ", " + quantity(s.at("container_height_m"), 1.0, 2, "m");
  if (s.contains("container_length_m"))
    row("length, width, height", quantity(s.at("container_length_m"), 1.0, 2, "m") + ", " + section);
  else
    row("width, height", section);
  row("soil volume change", quantity(s.at("soil_volume_change"), 100.0, 2, "%"));
  row("energy balance error", quantity(s.at("energy").at("relative_balance_error"), 100.0, 2, "%"));
  for (const Json& flag : s.value("flags", Json::array()))
    row("  doubtful", flag.get<std::string>());
  for (const Json& container : s.value("design_rules", Json::array()))
    text += hand_rules(container);
  row("momentum error", fmt::format("{:.2e}", s.at("momentum_error").get<double>()));
  row("particles, steps", fmt::format("{}, {}; {} retries", s.at("particles").get<std::uint64_t>(),
                                      s.at("steps").get<std::uint64_t>(), s.at("retries").get<std::uint64_t>()));
  row("time step", fmt::format("{:.2e} to {:.2e} s", s.at("min_dt_s").get<double>(), s.at("max_dt_s").get<double>()));
  row("simulated, wall time", quantity(s.at("simulated_time_s"), 1.0, 2, "s, ") +
                                  quantity(s.at("wall_time_s"), 1.0, 2, "s, ") +
                                  quantity(s.at("real_time_factor"), 1.0, 2, "x real time") +
                                  fmt::format(", {} threads", s.at("threads").get<int>()));
  row("not computed", quantity(s.at("skipped").at("resting_time_s"), 1.0, 2, "s at rest, ") +
                          fmt::format("{} contact searches, {} membrane passes",
                                      s.at("skipped").at("contact_searches").get<std::uint64_t>(),
                                      s.at("skipped").at("membrane_passes").get<std::uint64_t>()));
  row("opening samples",
      fmt::format("{} accepted, rejected: {}; {} gaps", s.at("accepted_samples").get<std::uint64_t>(),
                  rejected(s.at("rejected_samples")), s.at("gaps").size()));
  row("digest of the state", s.at("digest").get<std::string>());
  return text;
}

}  // namespace geocontainer_mpm::program
