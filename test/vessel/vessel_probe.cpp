/// The room's ends for the Python tests beside it: commands as JSON lines on standard input, answers on standard
/// output.
///   vessel_probe nmea                     bytes in; a line for each hull angle, then the counts
///   vessel_probe write_nmea JSON         the sentences of these figures
///   vessel_probe signalk '{parameters}'   {"send": {path: value}}, {"health": true}
#include <fmt/format.h>

#include <cstdio>
#include <iostream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "geocontainer_mpm/error.h"
#include "geocontainer_mpm/vessel/alarms.h"
#include "geocontainer_mpm/vessel/nmea_angles.h"
#include "geocontainer_mpm/vessel/signalk_client.h"

namespace {

using namespace geocontainer_mpm::vessel;
using Json = nlohmann::json;

constexpr const char* prefix = "cargo.geocontainer";

int nmea()
{
  const std::string bytes{ std::istreambuf_iterator<char>(std::cin), {} };
  SentenceSplitter splitter;
  NmeaCounts counts;
  Sentence sentence;
  splitter.feed(bytes, counts, [&](std::string_view line) {
    if (const auto fault = parse_sentence(line, sentence)) {
      counts.add(*fault);
      return;
    }
    ++counts.sentences;
    for (const HullAngle& angle : read_hull_angles(sentence, {}, counts))
      fmt::print(
          "{}\n",
          Json{ { "half", angle.half == HullHalf::port ? "port" : "starboard" }, { "rad", angle.angle_rad } }.dump());
  });
  Json faults = Json::object();
  for (std::size_t i = 0; i < nmea_fault_count; ++i)
    faults[to_string(static_cast<NmeaFault>(i))] = counts.faults[i];
  fmt::print("{}\n", Json{ { "sentences", counts.sentences }, { "faults", faults } }.dump());
  return 0;
}

int write_nmea(const Json& request)
{
  for (const std::string& text : write_hull_angles(request["port"], request["starboard"], {}))
    fmt::print("{}", text);
  ReleaseFigures release;
  release.state = ReleaseState::releasing;
  release.peak_tension_n_per_m = request["peak_tension"];
  fmt::print("{}", write_release(release));
  return 0;
}

Json to_json(const SignalKHealth& health)
{
  return { { "state", to_string(health.state) },
           { "confirmation", to_string(health.confirmation) },
           { "last_error", health.last_error },
           { "connections", health.connections },
           { "failures", health.failures },
           { "values_sent", health.values_sent },
           { "values_confirmed", health.values_confirmed },
           { "values_replaced", health.values_replaced },
           { "values_received", health.values_received },
           { "bad_messages", health.bad_messages } };
}

SignalKParameters parameters_of(const Json& json)
{
  SignalKParameters parameters;
  parameters.port = json.at("port");
  parameters.host = json.value("host", parameters.host);
  parameters.tls = json.value("tls", false);
  parameters.ca_file = json.value("ca_file", "");
  parameters.token_file = json.value("token_file", "");
  parameters.token_environment = json.value("token_environment", "");
  // A test does not wait as long as a vessel may.
  parameters.connect_timeout_s = 2.0;
  parameters.idle_timeout_s = 2.0;
  parameters.first_retry_s = 0.1;
  parameters.longest_retry_s = 1.0;
  parameters.confirm_within_s = 2.0;
  return parameters;
}

Value to_value(const Json& json)
{
  if (json.is_number())
    return json.get<double>();
  if (json.is_object() && json.contains("state"))
    return Notice{ json["state"], json["message"], true, json.value("acknowledged", false) };
  if (json.is_object())
    return json.get<Columns>();
  return json.is_string() ? Value(json.get<std::string>()) : Value();
}

int signalk(const Json& options)
{
  auto announced = describe_figures(prefix, 0.8, 1.0);
  announced.push_back({ std::string("notifications.") + prefix + ".release", "", "", {} });
  announced.push_back({ std::string(prefix) + ".hull.section", "", "Port half of the hull", {} });
  for (const AlarmKind& kind : alarm_kinds())
    announced.push_back({ std::string("notifications.") + prefix + "." + kind.name, "", "", {} });
  SignalKClient client(
      parameters_of(options), announced, options.value("inputs", std::vector<std::string>{}),
      [](const IncomingValue& value) {
        const auto* number = std::get_if<double>(&value.value);
        fmt::print("{}\n",
                   Json{ { "path", value.path }, { "value", number == nullptr ? Json() : Json(*number) } }.dump());
        std::fflush(stdout);
      });
  for (std::string line; std::getline(std::cin, line);) {
    const Json command = Json::parse(line);
    if (command.contains("send")) {
      std::vector<PathValue> values;
      for (const auto& [path, value] : command["send"].items())
        values.push_back({ path, to_value(value), std::chrono::system_clock::now() });
      client.send(values);
    } else if (command.contains("health")) {
      fmt::print("{}\n", to_json(client.health()).dump());
      std::fflush(stdout);
    }
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv)
{
  const std::string what = argc > 1 ? argv[1] : "";
  try {
    if (what == "nmea")
      return nmea();
    if (what == "write_nmea" && argc > 2)
      return write_nmea(Json::parse(argv[2]));
    if (what == "signalk" && argc > 2)
      return signalk(Json::parse(argv[2]));
  } catch (const geocontainer_mpm::InputError& error) {
    fmt::print(stderr, "{}\n", error.what());
  }
  return 2;
}
