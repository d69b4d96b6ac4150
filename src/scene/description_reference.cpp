#include <fmt/format.h>

#include <cctype>
#include <functional>

#include "description_grammar.h"
#include "geocontainer_mpm/scene/description.h"

namespace geocontainer_mpm::scene {

namespace {

using grammar::joined;
using grammar::Key;
using grammar::Limits;
using grammar::Need;

constexpr const char* introduction =
    R"(<!-- Written from the scene grammar by test_scene_description_reference; that test says how to renew it. -->
# Scene reference

A scene is one YAML file: what there is, how it behaves, how long to run. `simulate SCENE.yaml` runs it; `--set
dotted.key=value` changes one key for one run, for instance `--set hull.friction=0.4` or `--set
bodies.sand.shape.hopper_fill.area_m2=9.5`. A value may be any YAML, so that `--set 'bodies.sand.shape={disc: {center_m:
[0, 0], radius_m: 1}}'` replaces a whole section.

A table over time is a list of rows, each a time and its values: `[[0, 0], [2, 1], [5, 1]]`. Times ascend. Between rows
values are linear, before the first and after the last they stay.

Lengths are metres, angles of the hull radians, angles of soils and boxes degrees, all SI. Points are `[y, z]` in the
frame of the barge: hinge axis midships, y to port, z up. Tension in a sheet is force per width. A name in angle
brackets is yours to choose: a letter, then letters, digits and `_`.

A key that is unknown, given twice, missing, of another type, not finite or out of range ends the program with one line
that names file, key, value and what is allowed. Keys marked *required* have no default.

)";

std::string escaped(std::string text)
{
  for (std::size_t i = text.find('|'); i != std::string::npos; i = text.find('|', i + 2))
    text.insert(i, "\\");
  return text;
}

/// One table for each struct, those of its sections after it.
class Documenter {
public:
  explicit Documenter(std::string path) : path_(std::move(path)) {}

  template <class T>
  void value(const Key& key, T& member, const Limits& limits = {})
  {
    const std::string fallback = grammar::given(member) ? "`" + grammar::to_text(member) + "`" : "absent";
    row(key, grammar::type_text(member, limits), key.need == Need::required ? "*required*" : fallback);
  }
  template <class T>
  void section(const Key& key, T&)
  {
    row(key, "section", key.need == Need::required ? "*required*" : "all defaults");
    later<T>(joined(path_, key.name), key);
  }
  template <class T>
  void section(const Key& key, std::optional<T>&)
  {
    row(key, "section", "absent");
    later<T>(joined(path_, key.name), key);
  }
  template <class T>
  void map(const Key& key, std::map<std::string, T>&)
  {
    row(key, "sections by name", key.need == Need::required ? "*required*" : "none");
    later<T>(joined(path_, key.name) + ".<name>", key);
  }
  template <class T>
  void checked_by_itself(T&)
  {
  }

  template <class T>
  std::string page()
  {
    T fresh{};
    grammar::describe(*this, fresh);
    std::string text = "| key | unit | allowed | default | meaning |\n|---|---|---|---|---|\n" + rows_ + "\n";
    for (const auto& section : sections_)
      text += section();
    return text;
  }

private:
  void row(const Key& key, const std::string& type, const std::string& fallback)
  {
    std::string meaning = key.text;
    if (*key.when)
      meaning += fmt::format("; only with {}", key.when);
    rows_ += fmt::format("| `{}` | {} | {} | {} | {} |\n", key.name, key.unit, escaped(type), escaped(fallback),
                         escaped(meaning));
  }
  template <class T>
  void later(const std::string& path, const Key& key)
  {
    std::string sentence = key.text;
    sentence.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(sentence.front())));
    const std::string heading = fmt::format("## `{}`\n\n{}.\n\n", path, sentence);
    sections_.push_back([path, heading] { return heading + Documenter(path).page<T>(); });
  }

  std::string path_;
  std::string rows_;
  std::vector<std::function<std::string()>> sections_;
};

}  // namespace

std::string scene_reference()
{
  return introduction + Documenter("").page<SceneDescription>();
}

}  // namespace geocontainer_mpm::scene
