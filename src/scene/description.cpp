#include "geocontainer_mpm/scene/description.h"

#include <cctype>

#include "description_grammar.h"
#include "description_rules.h"
#include "geocontainer_mpm/error.h"

namespace geocontainer_mpm::scene {

namespace {

using grammar::joined;
using grammar::Key;
using grammar::Limits;

/// Names become HDF5 groups, marker namespaces and parts of dotted keys.
void check_name(const std::string& name, const std::string& path)
{
  bool good = !name.empty() && std::isalpha(static_cast<unsigned char>(name.front()));
  for (const char c : name)
    good = good && (std::isalnum(static_cast<unsigned char>(c)) || c == '_');
  if (!good)
    grammar::refuse(joined(path, name), "", "a name is a letter, then letters, digits and _");
}

/// Holds each key to its own limits.
class Checker {
public:
  explicit Checker(std::string path) : path_(std::move(path)) {}

  template <class T>
  void value(const Key& key, T& member, const Limits& limits = {})
  {
    if (key.applies)
      grammar::check(member, joined(path_, key.name), limits);
  }
  template <class T>
  void section(const Key& key, T& member)
  {
    Checker checker(joined(path_, key.name));
    grammar::describe(checker, member);
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
    const std::string path = joined(path_, key.name);
    for (auto& [name, entry] : member) {
      check_name(name, path);
      Checker checker(joined(path, name));
      grammar::describe(checker, entry);
    }
  }
  template <class T>
  void checked_by_itself(T& member)
  {
    member.validate(path_);
  }

private:
  std::string path_;
};

}  // namespace

void SceneDescription::validate() const
{
  try {
    SceneDescription copy = *this;  // a description is visited as something that can be written to
    Checker checker("");
    grammar::describe(checker, copy);
    check_rules(*this);
  } catch (const InputError& error) {
    throw InputError(source, error.key(), error.value(), error.allowed());
  }
}

}  // namespace geocontainer_mpm::scene
