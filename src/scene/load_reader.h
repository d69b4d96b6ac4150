#pragma once
/// Reading YAML into the structs of a scene, by the grammar.

#include <yaml-cpp/yaml.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "description_grammar.h"

namespace geocontainer_mpm::scene {

/// Refuses `name` at `path`: what could have been meant, or else what there is.
[[noreturn]] void refuse_unknown(const std::string& path, const std::string& name, const std::string& value,
                                 const std::vector<std::string>& known);

/// The node of a key of a map, undefined when it is absent. (A const Node's operator[] throws on some absences.)
YAML::Node child(const YAML::Node& map, const std::string& key);

template <class T>
void read_section(const YAML::Node& node, const std::string& path, T& out);

/// Visitor that fills one struct from one YAML map whose keys are known to be in the grammar.
class Reader {
public:
  Reader(const YAML::Node& node, std::string path) : node_(node), path_(std::move(path)) {}

  template <class T>
  void value(const grammar::Key& key, T& member, const grammar::Limits& limits = {})
  {
    const std::string path = grammar::joined(path_, key.name);
    const YAML::Node node = child(node_, key.name);
    refuse_idle(key, node, path);
    if (present(node, path) && key.applies)
      grammar::parse(node, path, limits, member);
    else if (key.applies && key.need == grammar::Need::required)
      grammar::refuse(path, "", "missing; must be " + grammar::type_text(member, limits));
  }
  template <class T>
  void section(const grammar::Key& key, T& member)
  {
    const std::string path = grammar::joined(path_, key.name);
    const YAML::Node node = child(node_, key.name);
    refuse_idle(key, node, path);
    if (present(node, path))
      read_section(node, path, member);
    else if (key.need == grammar::Need::required)
      refuse_missing_section<T>(path);
  }
  template <class T>
  void section(const grammar::Key& key, std::optional<T>& member)
  {
    if (child(node_, key.name).IsDefined())
      section(key, member.emplace());
  }
  template <class T>
  void map(const grammar::Key& key, std::map<std::string, T>& member)
  {
    const std::string path = grammar::joined(path_, key.name);
    const YAML::Node node = child(node_, key.name);
    if (!present(node, path)) {
      if (key.need == grammar::Need::required)
        grammar::refuse(path, "", "missing; must be a map of sections by name");
      return;
    }
    if (!node.IsMap())
      grammar::refuse(path, grammar::text_of(node), "must be a map of sections by name");
    for (const auto& entry : node) {
      const std::string& name = entry.first.Scalar();
      read_section(entry.second, grammar::joined(path, name), member[name]);
    }
  }
  template <class T>
  void checked_by_itself(T&)
  {
  }

private:
  static void refuse_idle(const grammar::Key& key, const YAML::Node& node, const std::string& path)
  {
    if (node.IsDefined() && !key.applies)
      grammar::refuse(path, grammar::text_of(node), grammar::does_not_apply(key));
  }
  static bool present(const YAML::Node& node, const std::string& path)
  {
    if (node.IsDefined() && node.IsNull())
      grammar::refuse(path, "", "has no value; give one or leave the key out");
    return node.IsDefined();
  }
  template <class T>
  static void refuse_missing_section(const std::string& path)
  {
    std::string keys;
    for (const std::string& name : grammar::names_of<T>())
      keys += (keys.empty() ? "" : ", ") + name;
    grammar::refuse(path, "", "missing; must be a section with keys of " + keys);
  }

  YAML::Node node_;
  std::string path_;
};

/// A misspelt key is told before the key that is missing because of it.
template <class T>
void read_section(const YAML::Node& node, const std::string& path, T& out)
{
  const std::vector<std::string> known = grammar::names_of<T>();
  if (!node.IsMap())
    grammar::refuse(path, grammar::text_of(node), "must be a section with keys");
  for (const auto& entry : node) {
    const std::string& name = entry.first.Scalar();
    if (std::find(known.begin(), known.end(), name) == known.end())
      refuse_unknown(path, name, grammar::text_of(entry.second), known);
  }
  Reader reader(node, path);
  grammar::describe(reader, out);
}

}  // namespace geocontainer_mpm::scene
