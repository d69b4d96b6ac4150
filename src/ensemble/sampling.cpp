#include "geocontainer_mpm/ensemble/sampling.h"

#include <fmt/format.h>

#include <random>
#include <utility>

#include "geocontainer_mpm/error.h"

namespace geocontainer_mpm::ensemble {
namespace {

/// FNV-1a: tells the keys' generators apart.
std::uint64_t hash_of(const std::string& text)
{
  std::uint64_t hash = 14695981039346656037ULL;
  for (const char letter : text)
    hash = (hash ^ static_cast<unsigned char>(letter)) * 1099511628211ULL;
  return hash;
}

/// In (0, 1): the middles of 2^32 equal parts, so that a whole number may be added without rounding it up to the next.
double uniform(std::mt19937_64& generator)
{
  return (static_cast<double>(generator() >> 32) + 0.5) * 0x1p-32;
}

/// One of 0 ... count - 1, all alike: draws that would favour some are thrown away.
std::uint64_t below(std::uint64_t count, std::mt19937_64& generator)
{
  const std::uint64_t usable = UINT64_MAX - UINT64_MAX % count;
  std::uint64_t drawn = generator();
  while (drawn >= usable)
    drawn = generator();
  return drawn % count;
}

}  // namespace

std::vector<std::vector<double>> latin_hypercube(std::size_t members, const std::vector<std::string>& keys,
                                                 std::uint64_t seed)
{
  std::vector<std::vector<double>> rows(members, std::vector<double>(keys.size()));
  std::vector<std::size_t> part(members);
  for (std::size_t column = 0; column < keys.size(); ++column) {
    std::mt19937_64 generator(seed ^ hash_of(keys[column]));
    for (std::size_t i = 0; i < members; ++i)
      part[i] = i;
    for (std::size_t i = members; i > 1; --i)  // Fisher and Yates
      std::swap(part[i - 1], part[below(i, generator)]);
    for (std::size_t i = 0; i < members; ++i)
      rows[i][column] = (static_cast<double>(part[i]) + uniform(generator)) / static_cast<double>(members);
  }
  return rows;
}

std::vector<std::vector<std::string>> draw(const std::vector<Input>& inputs, std::size_t members, std::uint64_t seed)
{
  std::vector<std::string> keys;
  keys.reserve(inputs.size());
  for (const Input& input : inputs)
    keys.push_back(input.key);
  std::vector<std::vector<std::string>> values;
  for (const std::vector<double>& row : latin_hypercube(members, keys, seed)) {
    values.emplace_back();
    for (std::size_t i = 0; i < inputs.size(); ++i)
      values.back().push_back(fmt::format("{:.9g}", inputs[i].distribution.quantile(row[i])));
  }
  return values;
}

std::vector<std::vector<std::string>> assignments(const std::vector<Input>& inputs,
                                                  const std::vector<std::vector<std::string>>& values,
                                                  const std::vector<std::string>& overrides, const std::string& source,
                                                  const std::string& key, const std::string& distributions)
{
  for (const std::string& assignment : overrides)
    for (const Input& input : inputs)
      if (assignment.compare(0, input.key.size() + 1, input.key + "=") == 0)
        throw InputError(source, key, assignment, "is drawn by " + distributions);
  std::vector<std::vector<std::string>> members;
  members.reserve(values.size());
  for (const std::vector<std::string>& row : values) {
    members.push_back(overrides);
    for (std::size_t i = 0; i < row.size(); ++i)
      members.back().push_back(inputs[i].key + "=" + row[i]);
  }
  return members;
}

}  // namespace geocontainer_mpm::ensemble
