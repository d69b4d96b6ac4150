#pragma once
/// Draws of an ensemble's inputs.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "geocontainer_mpm/ensemble/distribution.h"

namespace geocontainer_mpm::ensemble {

/// Probabilities in (0, 1), one row a member and one column a key: a Latin hypercube (McKay, Beckman and Conover 1979,
/// Technometrics 21:239). Every column has exactly one value in each of the `members` equal parts of (0, 1), at a
/// random place in it, and the parts come in random order.
///
/// The same on every machine: std::mt19937_64, whose output the standard fixes, is used through own transforms, since
/// the standard does not fix those of <random>. A column depends on its key, the seed and the number of members alone,
/// so that another input more leaves the draws of the others as they are.
std::vector<std::vector<double>> latin_hypercube(std::size_t members, const std::vector<std::string>& keys,
                                                 std::uint64_t seed);

/// Values for `--set`, one row a member and one column an input, as text of nine significant digits: what the last bits
/// of a machine's exp and log differ by does not reach them.
std::vector<std::vector<std::string>> draw(const std::vector<Input>& inputs, std::size_t members, std::uint64_t seed);

/// Members as assignments for a scene, `key=value`: `overrides`, then what is drawn; a row a member. Throws InputError
/// from `source` and `key` for an override of what is drawn by `distributions`.
std::vector<std::vector<std::string>> assignments(const std::vector<Input>& inputs,
                                                  const std::vector<std::vector<std::string>>& values,
                                                  const std::vector<std::string>& overrides, const std::string& source,
                                                  const std::string& key, const std::string& distributions);

}  // namespace geocontainer_mpm::ensemble
