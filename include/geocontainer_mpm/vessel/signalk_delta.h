#pragma once
/// Signal K messages (specification 1.7.0, "Delta format"): written and read as text. What is read may be hostile:
/// size, depth and number of values are bounded, and nothing here throws.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "geocontainer_mpm/vessel/figures.h"

namespace geocontainer_mpm::vessel {

/// A range of values and the state of a value in it: [lower, upper), open ends where absent.
struct Zone {
  std::optional<double> lower, upper;
  std::string state;  ///< as of a notification
  std::string message;
};

/// What is told of a path once for each connection. A path without a description is only watched for its confirmation.
struct PathMeta {
  std::string path;
  std::string units;  ///< SI; empty for text
  std::string description;
  std::vector<Zone> zones;
};

struct PathValue {
  std::string path;
  Value value;
  Stamp stamp;
};

std::string write_delta(const std::vector<PathValue>& values, const std::string& source);
std::string write_meta(const std::vector<PathMeta>& paths, const std::string& source, Stamp stamp);
/// Every change of these paths of this vessel.
std::string write_subscription(const std::vector<std::string>& paths);

/// Prefix and the tables make paths; `warn` and `alarm` are zones of those that are limited, without them where not
/// positive.
std::vector<PathMeta> describe_figures(const std::string& prefix, double warn, double alarm);
/// Every figure of a table, at its source's stamp.
template <typename Source>
std::vector<PathValue> to_values(const std::vector<Figure<Source>>& table, const Source& source,
                                 const std::string& prefix)
{
  std::vector<PathValue> values;
  for (const Figure<Source>& figure : table)
    values.push_back({ prefix + "." + figure.path, figure.value(source), source.stamp });
  return values;
}

struct IncomingValue {
  std::string path;
  std::string source;          ///< `$source`; empty when there is none
  std::optional<Stamp> stamp;  ///< nothing when there is none or it cannot be read
  Value value;                 ///< nothing also for any other object, a list or a truth value
};

enum class IncomingKind { hello, delta, other, faulty };

struct Incoming {
  IncomingKind kind = IncomingKind::faulty;
  std::string self;     ///< hello: the vessel's own context
  std::string context;  ///< delta: empty when it is left out, which means the vessel itself
  std::vector<IncomingValue> values;
};

struct IncomingLimits {
  std::size_t longest = 256 * 1024;  ///< characters
  std::size_t deepest = 32;          ///< objects and lists in each other
  std::size_t most_values = 4096;    ///< of one message; further ones are left out
};

Incoming read_message(std::string_view text, const IncomingLimits& limits = {});

}  // namespace geocontainer_mpm::vessel
