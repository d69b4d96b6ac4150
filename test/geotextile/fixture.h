#pragma once
// What the tests of sheets share: points and vectors from random_cloud.h, and pi.

#include "../mpm/random_cloud.h"

namespace geocontainer_mpm::geotextile::testing {

using mpm::testing::apart;
using mpm::testing::Chance;
using mpm::testing::holds;
using mpm::testing::set_vector;
using mpm::testing::vector_at;

inline constexpr double pi = 3.14159265358979323846;

}  // namespace geocontainer_mpm::geotextile::testing
