#include "geocontainer_mpm/vessel/nmea_angles.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <optional>

namespace geocontainer_mpm::vessel {
namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double largest_angle_deg = 360.0;
/// So that every sentence of this file fits 82 characters, whatever its figures: -360.0000 and seven times -9999.99.
constexpr std::size_t longest_angle = 9;
constexpr std::size_t longest_figure = 8;

std::optional<double> number(std::string_view text)
{
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed);
  return error == std::errc() && end == text.data() + text.size() && std::isfinite(value) ? std::optional(value)
                                                                                          : std::nullopt;
}

/// Empty for what is not finite or longer than any such figure of a barge.
std::string field(double value, int decimals, std::size_t longest = longest_figure)
{
  if (!(std::abs(value) < 1e9))
    return "";
  std::string text = fmt::format("{:.{}f}", value, decimals);
  return text.size() <= longest ? text : "";
}

std::vector<std::string> quadruple(double angle_rad, const std::string& name)
{
  return { "A", field(angle_rad * 180.0 / pi, 4, longest_angle), "D", name };
}

char state_letter(const ReleaseFigures& figures)
{
  if (figures.stopped)
    return 'S';
  switch (figures.state) {
    case ReleaseState::waiting:
      return 'W';
    case ReleaseState::releasing:
      return 'R';
    case ReleaseState::released:
      return 'O';
    case ReleaseState::hung_up:
      return 'H';
    case ReleaseState::none:
      break;
  }
  return 'N';
}

}  // namespace

std::vector<HullAngle> read_hull_angles(const Sentence& sentence, const NmeaNames& names, NmeaCounts& counts)
{
  std::vector<HullAngle> angles;
  if (sentence.start != '$' || sentence.formatter != "XDR" || sentence.talker == "P")
    return angles;
  if (sentence.fields.empty() || sentence.fields.size() % 4 != 0) {
    counts.add(NmeaFault::bad_field);
    return angles;
  }
  for (std::size_t i = 0; i < sentence.fields.size(); i += 4) {
    const std::string_view name = sentence.fields[i + 3];
    const bool ours = name == names.port || name == names.starboard;
    if (!ours || sentence.fields[i] != "A" || sentence.fields[i + 2] != "D")
      continue;
    const auto degrees = number(sentence.fields[i + 1]);
    if (sentence.fields[i + 1].empty())
      counts.add(NmeaFault::empty_field);
    else if (!degrees)
      counts.add(NmeaFault::bad_field);
    else if (std::abs(*degrees) > largest_angle_deg)
      counts.add(NmeaFault::out_of_range);
    else {
      ++counts.angles;
      angles.push_back({ name == names.port ? HullHalf::port : HullHalf::starboard, *degrees * pi / 180.0 });
    }
  }
  return angles;
}

std::vector<std::string> write_hull_angles(double port_rad, double starboard_rad, const NmeaNames& names)
{
  const std::string address = names.talker + "XDR";
  std::vector<std::string> port = quadruple(port_rad, names.port);
  const std::vector<std::string> starboard = quadruple(starboard_rad, names.starboard);
  std::vector<std::string> both = port;
  both.insert(both.end(), starboard.begin(), starboard.end());
  if (const auto one = write_sentence(address, both))
    return { *one };
  std::vector<std::string> sentences;
  for (const auto& fields : { port, starboard })
    if (const auto sentence = write_sentence(address, fields))
      sentences.push_back(*sentence);
  return sentences;
}

std::string write_release(const ReleaseFigures& figures)
{
  const std::string release_time = figures.release_time_s >= 0.0 ? field(figures.release_time_s, 2) : "";
  const auto sentence = write_sentence(
      "PGCM", { "1", std::string(1, state_letter(figures)), field(100.0 * figures.peak_utilisation, 1),
                field(figures.peak_tension_n_per_m, 0), field(figures.current_tension_n_per_m, 0),
                field(figures.centroid_m[2], 2), field(figures.width_m, 2), release_time, field(figures.lag_s, 2) });
  return sentence.value_or("");
}

}  // namespace geocontainer_mpm::vessel
