#include "geocontainer_mpm/vessel/signalk_delta.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace geocontainer_mpm::vessel {
namespace {

using Json = nlohmann::json;

constexpr const char* own_context = "vessels.self";

Json to_json(const Value& value)
{
  if (const auto* number = std::get_if<double>(&value))
    return *number;
  if (const auto* text = std::get_if<std::string>(&value))
    return *text;
  if (const auto* notice = std::get_if<Notice>(&value)) {
    Json method = Json::array({ "visual" });
    if (notice->sound)
      method.push_back("sound");
    Json json = { { "state", notice->state }, { "method", std::move(method) }, { "message", notice->message } };
    // Not `acknowledgeStatus`: server 2.23 takes that for good, and keeps silent about the next alarm of the path.
    if (notice->acknowledged)
      json["acknowledged"] = true;
    return json;
  }
  if (const auto* columns = std::get_if<Columns>(&value))
    return *columns;
  return nullptr;
}

Json to_json(const Zone& zone)
{
  Json json = { { "state", zone.state }, { "message", zone.message } };
  if (zone.lower)
    json["lower"] = *zone.lower;
  if (zone.upper)
    json["upper"] = *zone.upper;
  return json;
}

/// Text that is no UTF-8 is sent with replacement characters: a sentence is never worth an exception.
std::string dump(const Json& json)
{
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// The parser keeps its own stack, but what it builds is written and destroyed by recursion.
bool deeper_than(std::string_view text, std::size_t limit)
{
  std::size_t depth = 0;
  bool in_text = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char character = text[i];
    if (in_text) {
      if (character == '\\')
        ++i;
      else if (character == '"')
        in_text = false;
    } else if (character == '"') {
      in_text = true;
    } else if (character == '{' || character == '[') {
      if (++depth > limit)
        return true;
    } else if ((character == '}' || character == ']') && depth > 0) {
      --depth;
    }
  }
  return false;
}

std::string text_of(const Json& object, const char* key)
{
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : "";
}

/// Lists of numbers by name; nothing for any other object.
Value to_columns(const Json& object)
{
  Columns columns;
  for (const auto& [name, list] : object.items()) {
    if (!list.is_array() || !std::all_of(list.begin(), list.end(), [](const Json& entry) { return entry.is_number(); }))
      return {};
    columns[name] = list.get<std::vector<double>>();
  }
  return columns;
}

Value to_value(const Json& json)
{
  if (json.is_number())
    return json.get<double>();
  if (json.is_string())
    return json.get<std::string>();
  if (json.is_object() && json.contains("state"))
    return Notice{ text_of(json, "state"), text_of(json, "message"), false, false };
  if (json.is_object() && !json.empty())
    return to_columns(json);
  return {};
}

void read_update(const Json& update, std::size_t most_values, std::vector<IncomingValue>& values)
{
  const auto list = update.find("values");
  if (list == update.end() || !list->is_array())
    return;
  const std::string source = text_of(update, "$source");
  const auto stamp = parse_utc(text_of(update, "timestamp"));
  for (const Json& entry : *list) {
    if (values.size() >= most_values)
      return;
    if (!entry.is_object() || !entry.contains("value"))
      continue;
    std::string path = text_of(entry, "path");
    if (!path.empty())
      values.push_back({ std::move(path), source, stamp, to_value(entry["value"]) });
  }
}

template <typename Source>
void describe(const std::vector<Figure<Source>>& table, const std::string& prefix, double warn, double alarm,
              std::vector<PathMeta>& paths)
{
  for (const Figure<Source>& figure : table) {
    PathMeta meta{ prefix + "." + figure.path, figure.units, figure.description, {} };
    if (figure.limited && warn > 0.0 && alarm > warn)
      meta.zones = { { std::nullopt, warn, "normal", "The geotextile is within its limits" },
                     { warn, alarm, "warn", "The geotextile's tension nears the strength of its seam" },
                     { alarm, std::nullopt, "alarm", "The geotextile's tension is beyond the limit" } };
    paths.push_back(std::move(meta));
  }
}

}  // namespace

std::string write_delta(const std::vector<PathValue>& values, const std::string& source)
{
  Json updates = Json::array();
  // An update has one instant. The values of a frame come in a row.
  for (auto first = values.begin(); first != values.end();) {
    const auto last = std::find_if(first, values.end(), [&](const PathValue& v) { return v.stamp != first->stamp; });
    Json list = Json::array();
    std::for_each(first, last, [&](const PathValue& v) {
      list.push_back({ { "path", v.path }, { "value", to_json(v.value) } });
    });
    updates.push_back(
        { { "$source", source }, { "timestamp", format_utc(first->stamp) }, { "values", std::move(list) } });
    first = last;
  }
  return dump({ { "context", own_context }, { "updates", std::move(updates) } });
}

std::string write_meta(const std::vector<PathMeta>& paths, const std::string& source, Stamp stamp)
{
  Json list = Json::array();
  for (const PathMeta& path : paths) {
    if (path.description.empty())
      continue;
    Json value = { { "description", path.description } };
    if (!path.units.empty())
      value["units"] = path.units;
    if (!path.zones.empty()) {
      value["zones"] = Json::array();
      for (const Zone& zone : path.zones)
        value["zones"].push_back(to_json(zone));
      value["warnMethod"] = Json::array({ "visual" });
      value["alarmMethod"] = Json::array({ "visual", "sound" });
    }
    list.push_back({ { "path", path.path }, { "value", std::move(value) } });
  }
  Json update = { { "$source", source }, { "timestamp", format_utc(stamp) }, { "meta", std::move(list) } };
  return dump({ { "context", own_context }, { "updates", Json::array({ std::move(update) }) } });
}

std::string write_subscription(const std::vector<std::string>& paths)
{
  Json list = Json::array();
  for (const std::string& path : paths)
    list.push_back({ { "path", path }, { "policy", "instant" } });
  return dump({ { "context", own_context }, { "subscribe", std::move(list) } });
}

std::vector<PathMeta> describe_figures(const std::string& prefix, double warn, double alarm)
{
  std::vector<PathMeta> paths;
  describe(release_figures(), prefix, warn, alarm, paths);
  describe(forecast_figures(), prefix, warn, alarm, paths);
  describe(ensemble_figures(), prefix, warn, alarm, paths);
  describe(section_figures(), prefix, warn, alarm, paths);
  return paths;
}

Incoming read_message(std::string_view text, const IncomingLimits& limits)
{
  Incoming message;
  if (text.size() > limits.longest || deeper_than(text, limits.deepest))
    return message;
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object())
    return message;
  const auto updates = json.find("updates");
  if (updates != json.end() && updates->is_array()) {
    message.kind = IncomingKind::delta;
    message.context = text_of(json, "context");
    for (const Json& update : *updates)
      if (update.is_object())
        read_update(update, limits.most_values, message.values);
  } else if (json.contains("version") && json.contains("self")) {
    message.kind = IncomingKind::hello;
    message.self = text_of(json, "self");
  } else {
    message.kind = IncomingKind::other;
  }
  return message;
}

}  // namespace geocontainer_mpm::vessel
