#include <fmt/format.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "geocontainer_mpm/error.h"
#include "load_override.h"
#include "load_reader.h"

namespace geocontainer_mpm::scene {

namespace {

/// The grammar is 7 deep; more is an anchor that holds itself.
constexpr int max_depth = 12;
/// A suggestion may be this share of the word away: `friction_angle` for `friction_angle_deg` is one.
constexpr double suggestion_share = 0.35;

/// Levenshtein distance between two words.
std::size_t distance(const std::string& a, const std::string& b)
{
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j)
    row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({ row[j] + 1, row[j - 1] + 1, replaced });
    }
  }
  return row.back();
}

int line_of(const YAML::Node& node)
{
  return node.Mark().line + 1;
}

/// A copy without anchors and aliases, in which an override changes one place only. Refuses keys given twice, which
/// yaml-cpp would keep silently.
YAML::Node plain_copy(const YAML::Node& node, const std::string& path, const std::string& source, int depth = 0)
{
  if (depth > max_depth)
    throw InputError(source, path, "", fmt::format("nested more than {} deep", max_depth));
  if (node.IsSequence()) {
    YAML::Node copy(YAML::NodeType::Sequence);
    std::size_t index = 0;
    for (const auto& item : node)
      copy.push_back(plain_copy(item, fmt::format("{}[{}]", path, index++), source, depth + 1));
    return copy;
  }
  if (!node.IsMap())
    return YAML::Clone(node);
  YAML::Node copy(YAML::NodeType::Map);
  std::map<std::string, int> lines;
  for (const auto& entry : node) {
    const std::string at = fmt::format("{}:{}", source, line_of(entry.first));
    if (!entry.first.IsScalar())
      throw InputError(at, path, grammar::text_of(entry.first), "a key must be plain text");
    const std::string& name = entry.first.Scalar();
    const std::string key = grammar::joined(path, name);
    const auto [first, is_new] = lines.emplace(name, line_of(entry.first));
    if (!is_new)
      throw InputError(at, key, grammar::text_of(entry.second),
                       fmt::format("given twice, first on line {}; keep one", first->second));
    copy[name] = plain_copy(entry.second, key, source, depth + 1);
  }
  return copy;
}

/// Line of the key, or of the nearest one above it that is in the file; 0 for none.
int locate(YAML::Node node, const std::string& key)
{
  int line = 0;
  std::istringstream names(key.substr(0, key.find('[')));
  std::string name;
  while (std::getline(names, name, '.')) {
    bool found = false;
    if (node.IsMap())
      for (const auto& entry : node)
        if (entry.first.Scalar() == name) {
          line = line_of(entry.first);
          node.reset(entry.second);
          found = true;
          break;
        }
    if (!found)
      return line;
  }
  const std::size_t bracket = key.find('[');
  if (bracket == std::string::npos || !node.IsSequence())
    return line;
  const auto index = static_cast<std::size_t>(std::strtoull(key.c_str() + bracket + 1, nullptr, 10));
  return index < node.size() ? line_of(node[index]) : line;
}

bool is_at_or_below(const std::string& key, const std::string& ancestor)
{
  return key.compare(0, ancestor.size(), ancestor) == 0 &&
         (key.size() == ancestor.size() || key[ancestor.size()] == '.' || key[ancestor.size()] == '[');
}

std::string place(const std::string& source, const YAML::Node& file, const std::vector<std::string>& overridden,
                  const std::string& key)
{
  for (const std::string& changed : overridden)
    if (is_at_or_below(key, changed))
      return source + " " + override_source;
  const int line = locate(file, key);
  const std::string in_file = line > 0 ? fmt::format("{}:{}", source, line) : source;
  // A rule may tie a key of the file to an overridden one.
  return overridden.empty() ? in_file : fmt::format("{} (with {})", in_file, override_source);
}

YAML::Node parse_yaml(const std::string& text, const std::string& source)
{
  std::vector<YAML::Node> documents;
  try {
    documents = YAML::LoadAll(text);
  } catch (const YAML::Exception& error) {
    throw InputError(fmt::format("{}:{}:{}", source, error.mark.line + 1, error.mark.column + 1), "YAML", "",
                     "cannot be parsed: " + error.msg);
  }
  if (documents.size() != 1 || !documents.front().IsMap())
    throw InputError(source, "YAML", documents.empty() ? "nothing" : grammar::text_of(documents.front()),
                     "must be one document with the sections of a scene");
  return documents.front();
}

std::string read_file(const std::string& path)
{
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    throw InputError(path, "scene file", "", "cannot be read: is a directory");
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file)
    throw InputError(path, "scene file", "", std::string("cannot be read: ") + std::strerror(errno));
  std::ostringstream text;
  text << file.rdbuf();
  if (file.bad())
    throw InputError(path, "scene file", "", std::string("cannot be read: ") + std::strerror(errno));
  return text.str();
}

}  // namespace

void refuse_unknown(const std::string& path, const std::string& name, const std::string& value,
                    const std::vector<std::string>& known)
{
  const std::string* best = nullptr;
  std::size_t best_distance = 0;
  std::string all;
  for (const std::string& candidate : known) {
    all += (all.empty() ? "" : ", ") + candidate;
    // Without its unit a key is the commonest slip.
    const bool lacks_unit = candidate.compare(0, name.size() + 1, name + "_") == 0;
    const std::size_t far = lacks_unit ? 1 : distance(name, candidate);
    if (!best || far < best_distance) {
      best = &candidate;
      best_distance = far;
    }
  }
  const bool close = best && static_cast<double>(best_distance) <= suggestion_share * static_cast<double>(best->size());
  grammar::refuse(grammar::joined(path, name), value,
                  "unknown key; " + (close ? "did you mean " + *best + "? " : std::string()) + "allowed: " + all);
}

YAML::Node child(const YAML::Node& map, const std::string& key)
{
  if (map.IsDefined() && map.IsMap())
    for (const auto& entry : map)
      if (entry.first.Scalar() == key)
        return entry.second;
  return YAML::Node(YAML::NodeType::Undefined);
}

SceneDescription parse_scene(const std::string& yaml, const std::string& source,
                             const std::vector<std::string>& overrides)
{
  const YAML::Node file = parse_yaml(yaml, source);
  const YAML::Node root = plain_copy(file, "", source);
  std::vector<std::string> overridden;
  for (const std::string& assignment : overrides) {
    try {
      overridden.push_back(apply_override(root, assignment));
    } catch (const InputError& error) {
      throw InputError(source + " " + error.source(), error.key(), error.value(), error.allowed());
    }
  }
  SceneDescription scene;
  try {
    read_section(root, "", scene);
    scene.validate();
  } catch (const InputError& error) {
    throw InputError(place(source, file, overridden, error.key()), error.key(), error.value(), error.allowed());
  }
  scene.source = source;
  return scene;
}

SceneDescription load_scene(const std::string& path, const std::vector<std::string>& overrides)
{
  return parse_scene(read_file(path), path, overrides);
}

}  // namespace geocontainer_mpm::scene
