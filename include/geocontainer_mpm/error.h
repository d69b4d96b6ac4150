#pragma once
/// The one exception of the core: bad input, found while a case is described, loaded or built.

#include <stdexcept>
#include <string>
#include <utility>

namespace geocontainer_mpm {

/// Names where the input came from, which key (dotted), what it said and what is allowed. `what()` is one line.
/// Thrown at construction and configuration only, never while stepping.
class InputError : public std::runtime_error {
public:
  InputError(std::string source, std::string key, std::string value, std::string allowed)
      : std::runtime_error(compose(source, key, value, allowed))
      , source_(std::move(source))
      , key_(std::move(key))
      , value_(std::move(value))
      , allowed_(std::move(allowed))
  {
  }

  const std::string& source() const { return source_; }    ///< file, topic or command line; empty when not known yet
  const std::string& key() const { return key_; }          ///< dotted key, e.g. `materials.sand.poisson_ratio`
  const std::string& value() const { return value_; }      ///< the offending value as text
  const std::string& allowed() const { return allowed_; }  ///< what would have been accepted

private:
  static std::string compose(const std::string& source, const std::string& key, const std::string& value,
                             const std::string& allowed)
  {
    std::string line;
    if (!source.empty())
      line += source + ": ";
    line += key;
    if (!value.empty())
      line += " = " + value;
    return line + ": " + allowed;
  }

  std::string source_, key_, value_, allowed_;
};

}  // namespace geocontainer_mpm
