#pragma once
/// One key of the scene grammar, without its value.

#include <string>

namespace geocontainer_mpm::scene::grammar {

enum class Need { required, optional };

struct Key {
  const char* name;
  Need need;
  const char* unit;       ///< empty for a key without dimension
  const char* text;       ///< meaning, for the reference page
  bool applies = true;    ///< false: means nothing with what was said before it, so it must not be given
  const char* when = "";  ///< in words: when it applies
};

inline std::string joined(const std::string& path, const std::string& name)
{
  return path.empty() ? name : path + "." + name;
}

inline std::string does_not_apply(const Key& key)
{
  return std::string("must not be given: it applies only to ") + key.when;
}

inline constexpr Need required = Need::required;
inline constexpr Need optional = Need::optional;

}  // namespace geocontainer_mpm::scene::grammar
