#include "load_override.h"

#include <fmt/format.h>

#include "geocontainer_mpm/error.h"
#include "load_reader.h"

namespace geocontainer_mpm::scene {

namespace {

using grammar::joined;
using grammar::Key;
using grammar::Limits;

/// What is being looked for: the names of a dotted key, and how many of them are found.
struct Route {
  std::vector<std::string> names;
  std::string value;

  bool ends_at(std::size_t depth) const { return depth + 1 == names.size(); }
  std::string path(std::size_t count) const
  {
    std::string text;
    for (std::size_t i = 0; i < count; ++i)
      text = joined(text, names[i]);
    return text;
  }
  [[noreturn]] void refuse(const std::string& allowed) const { grammar::refuse(path(names.size()), value, allowed); }
};

template <class T>
void follow(const Route& route, std::size_t depth, const YAML::Node& node);

/// Visitor that goes down the grammar along a route, and along the scene where names are the scene's own.
class Follower {
public:
  Follower(const Route& route, std::size_t depth, const YAML::Node& node) : route_(route), depth_(depth), node_(node) {}

  template <class T>
  void value(const Key& key, T&, const Limits& = {})
  {
    if (wanted(key) && !route_.ends_at(depth_))
      route_.refuse(fmt::format("{} is a single value, it has no keys", route_.path(depth_ + 1)));
  }
  template <class T>
  void section(const Key& key, T&)
  {
    if (wanted(key) && !route_.ends_at(depth_))
      follow<T>(route_, depth_ + 1, child(node_, key.name));
  }
  template <class T>
  void section(const Key& key, std::optional<T>&)
  {
    if (!wanted(key) || route_.ends_at(depth_))
      return;
    const YAML::Node node = child(node_, key.name);
    if (!node.IsDefined())
      route_.refuse(fmt::format("the scene has no {}; give the whole section", route_.path(depth_ + 1)));
    follow<T>(route_, depth_ + 1, node);
  }
  template <class T>
  void map(const Key& key, std::map<std::string, T>&)
  {
    if (!wanted(key) || route_.ends_at(depth_) || route_.ends_at(depth_ + 1))
      return;
    const YAML::Node entries = child(node_, key.name);
    const YAML::Node entry = child(entries, route_.names[depth_ + 1]);
    if (!entry.IsDefined())
      route_.refuse(fmt::format("the scene has no {}; {} holds: {}", route_.path(depth_ + 2), route_.path(depth_ + 1),
                                names(entries)));
    follow<T>(route_, depth_ + 2, entry);
  }
  template <class T>
  void checked_by_itself(T&)
  {
  }

  bool found() const { return found_; }

private:
  bool wanted(const Key& key)
  {
    const bool match = route_.names[depth_] == key.name;
    found_ = found_ || match;
    return match;
  }
  static std::string names(const YAML::Node& entries)
  {
    std::string text;
    if (entries.IsDefined() && entries.IsMap())
      for (const auto& entry : entries)
        text += (text.empty() ? "" : ", ") + entry.first.Scalar();
    return text.empty() ? "nothing" : text;
  }

  const Route& route_;
  std::size_t depth_;
  YAML::Node node_;
  bool found_ = false;
};

template <class T>
void follow(const Route& route, std::size_t depth, const YAML::Node& node)
{
  if (node.IsDefined() && !node.IsMap())
    grammar::refuse(route.path(depth), grammar::text_of(node), "must be a section with keys");
  T fresh{};
  Follower follower(route, depth, node);
  grammar::describe(follower, fresh);
  if (!follower.found())
    refuse_unknown(route.path(depth), route.names[depth], route.value, grammar::names_of<T>());
}

Route parse_route(const std::string& assignment)
{
  const std::size_t equals = assignment.find('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == assignment.size())
    grammar::refuse("'" + assignment + "'", "", "must be dotted.key=value, such as hull.friction=0.3");
  Route route{ {}, assignment.substr(equals + 1) };
  std::string name;
  for (const char c : assignment.substr(0, equals) + ".") {
    if (c != '.') {
      name += c;
      continue;
    }
    if (name.empty())
      grammar::refuse("'" + assignment + "'", "", "must be dotted.key=value with a name on each side of a dot");
    route.names.push_back(name);
    name.clear();
  }
  return route;
}

YAML::Node parse_value(const Route& route)
{
  try {
    return YAML::Load(route.value);
  } catch (const YAML::Exception& error) {
    route.refuse("the value is not YAML: " + error.msg);
  }
}

void put(YAML::Node node, const Route& route, std::size_t depth, const YAML::Node& value)
{
  if (route.ends_at(depth))
    node[route.names[depth]] = value;
  else
    put(node[route.names[depth]], route, depth + 1, value);
}

}  // namespace

std::string apply_override(const YAML::Node& root, const std::string& assignment)
{
  try {
    const Route route = parse_route(assignment);
    follow<SceneDescription>(route, 0, root);
    put(root, route, 0, parse_value(route));
    return route.path(route.names.size());
  } catch (const InputError& error) {
    throw InputError(override_source, error.key(), error.value(), error.allowed());
  }
}

}  // namespace geocontainer_mpm::scene
