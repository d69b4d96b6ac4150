#include "description_grammar.h"
#include "geocontainer_mpm/scene/description.h"

namespace geocontainer_mpm::scene {

namespace {

using grammar::Key;
using grammar::Limits;

/// Writes every key that applies and has a value, a line each, nested by indentation.
class Writer {
public:
  template <class T>
  void value(const Key& key, T& member, const Limits& = {})
  {
    if (key.applies && (key.need == grammar::Need::required || grammar::given(member)))
      line(std::string(key.name) + ": " + grammar::to_text(member));
  }
  template <class T>
  void section(const Key& key, T& member)
  {
    if (key.applies)
      nested(key.name, member);
  }
  template <class T>
  void section(const Key& key, std::optional<T>& member)
  {
    if (member)
      section(key, *member);
  }
  template <class T>
  void map(const Key& key, std::map<std::string, T>& member)
  {
    if (member.empty()) {
      line(std::string(key.name) + ": {}");
      return;
    }
    line(std::string(key.name) + ":");
    indent_ += 2;
    for (auto& [name, entry] : member)
      nested(name, entry);
    indent_ -= 2;
  }
  template <class T>
  void checked_by_itself(T&)
  {
  }

  std::string text;

private:
  template <class T>
  void nested(const std::string& name, T& member)
  {
    line(name + ":");
    indent_ += 2;
    grammar::describe(*this, member);
    indent_ -= 2;
  }
  void line(const std::string& content) { text += std::string(indent_, ' ') + content + "\n"; }

  std::size_t indent_ = 0;
};

}  // namespace

std::string scene_text(const SceneDescription& scene)
{
  SceneDescription copy = scene;  // a description is visited as something that can be written to
  Writer writer;
  grammar::describe(writer, copy);
  return writer.text;
}

}  // namespace geocontainer_mpm::scene
