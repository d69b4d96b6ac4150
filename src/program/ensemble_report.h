#pragma once
/// What an ensemble leaves for its user. The same text whoever ran the members: no times, no machine.

#include <cstdint>
#include <string>
#include <vector>

#include "geocontainer_mpm/ensemble/members.h"

namespace geocontainer_mpm::program {

struct EnsembleView {
  const std::string& scene;
  std::uint64_t seed;
  const std::vector<ensemble::Input>& inputs;
  const std::vector<std::vector<std::string>>& values;  ///< drawn, a row a member
  const std::vector<ensemble::Member>& members;
  ensemble::Summary summary;
};

/// One row a member, the members counted from 1.
std::string ensemble_csv(const EnsembleView& view);
/// Statistics, for programs.
std::string ensemble_json(const EnsembleView& view);
/// The same for people.
std::string ensemble_table(const EnsembleView& view);

}  // namespace geocontainer_mpm::program
