/// Distributions from YAML.

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "geocontainer_mpm/ensemble/distribution.h"
#include "geocontainer_mpm/error.h"

namespace geocontainer_mpm::ensemble {
namespace {

/// A parameter's name in the file.
struct Parameter {
  const char* name;
  double Distribution::*value;
  bool required;
};
struct Form {
  Shape shape;
  std::vector<Parameter> parameters;
};

const std::vector<Form>& forms()
{
  using D = Distribution;
  static const std::vector<Form> all = {
    { Shape::uniform, { { "low", &D::low, true }, { "high", &D::high, true } } },
    { Shape::triangular, { { "low", &D::low, true }, { "mode", &D::middle, true }, { "high", &D::high, true } } },
    { Shape::normal,
      { { "mean", &D::middle, true },
        { "deviation", &D::spread, true },
        { "low", &D::low, false },
        { "high", &D::high, false } } },
    { Shape::lognormal,
      { { "median", &D::middle, true },
        { "factor", &D::spread, true },
        { "low", &D::low, false },
        { "high", &D::high, false } } }
  };
  return all;
}

template <class Items>
std::string listed(const Items& items)
{
  std::string text;
  for (const auto& item : items)
    if constexpr (std::is_same_v<std::decay_t<decltype(item)>, Form>)
      text += (text.empty() ? "" : ", ") + std::string(to_string(item.shape));
    else
      text += (text.empty() ? "" : ", ") + std::string(item.name);
  return text;
}

std::string text_of(const YAML::Node& node)
{
  return YAML::Dump(node);
}

double number(const YAML::Node& node, const std::string& key)
{
  try {
    return node.as<double>();
  } catch (const YAML::Exception&) {
    throw InputError("", key, text_of(node), "must be a number");
  }
}

void read_parameters(const YAML::Node& node, const std::string& key, const Form& form, Distribution& distribution)
{
  if (!node.IsMap())
    throw InputError("", key, text_of(node), "must be a map with " + listed(form.parameters));
  for (const auto& entry : node) {
    const std::string& name = entry.first.Scalar();
    const std::string full = fmt::format("{}.{}", key, name);
    const Parameter* parameter = nullptr;
    for (const Parameter& known : form.parameters)
      if (name == known.name)
        parameter = &known;
    if (!parameter)
      throw InputError("", full, text_of(entry.second), "unknown key; allowed: " + listed(form.parameters));
    distribution.*parameter->value = number(entry.second, full);
  }
  for (const Parameter& parameter : form.parameters)
    if (parameter.required && !node[parameter.name])
      throw InputError("", key + "." + parameter.name, "", "missing; must be a number");
}

Distribution read_distribution(const YAML::Node& node, const std::string& key)
{
  if (!node.IsMap() || node.size() != 1)
    throw InputError("", key, text_of(node), "must be one distribution; allowed: " + listed(forms()));
  const std::string& name = node.begin()->first.Scalar();
  for (const Form& form : forms()) {
    if (name != to_string(form.shape))
      continue;
    Distribution distribution;
    distribution.shape = form.shape;
    const std::string full = fmt::format("{}.{}", key, name);
    read_parameters(node.begin()->second, full, form, distribution);
    distribution.validate(full);
    return distribution;
  }
  throw InputError("", key + "." + name, "", "unknown distribution; allowed: " + listed(forms()));
}

std::vector<Input> read_inputs(const YAML::Node& root)
{
  if (!root.IsMap())
    throw InputError("", "YAML", text_of(root), "must be a map with the key draw");
  for (const auto& entry : root)
    if (const std::string& name = entry.first.Scalar(); name != "title" && name != "draw")
      throw InputError("", name, text_of(entry.second), "unknown key; allowed: title, draw");
  const YAML::Node draw = root["draw"];
  if (!draw || !draw.IsMap() || draw.size() == 0)
    throw InputError("", "draw", draw ? text_of(draw) : "", "must be a map of distributions by scene key");
  std::vector<Input> inputs;
  for (const auto& entry : draw) {
    const std::string& key = entry.first.Scalar();
    for (const Input& before : inputs)
      if (before.key == key)
        throw InputError("", "draw." + key, "", "given twice; keep one");
    inputs.push_back({ key, read_distribution(entry.second, "draw." + key) });
  }
  return inputs;
}

}  // namespace

std::vector<Input> parse_inputs(const std::string& yaml, const std::string& source)
{
  try {
    return read_inputs(YAML::Load(yaml));
  } catch (const InputError& error) {
    throw InputError(source, error.key(), error.value(), error.allowed());
  } catch (const YAML::Exception& error) {
    throw InputError(fmt::format("{}:{}:{}", source, error.mark.line + 1, error.mark.column + 1), "YAML", "",
                     "cannot be parsed: " + error.msg);
  }
}

std::vector<Input> load_inputs(const std::string& path)
{
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    throw InputError(path, "distributions", "", "cannot be read: is a directory");
  errno = 0;
  std::ifstream file(path);
  if (!file)
    throw InputError(path, "distributions", "", std::string("cannot be read: ") + std::strerror(errno));
  std::ostringstream text;
  text << file.rdbuf();
  return parse_inputs(text.str(), path);
}

}  // namespace geocontainer_mpm::ensemble
