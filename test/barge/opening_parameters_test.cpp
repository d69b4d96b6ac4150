// Every parameter of the opening signal names itself when it is wrong.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "geocontainer_mpm/barge/opening_signal.h"
#include "geocontainer_mpm/error.h"

namespace geocontainer_mpm::barge {
namespace {

struct Field {
  const char* name;
  double OpeningSignalParameters::*member;
  std::vector<double> bad;
};

class Parameters : public testing::TestWithParam<Field> {};

TEST_P(Parameters, BadValueIsNamed)
{
  std::vector<double> bad = GetParam().bad;
  bad.insert(bad.end(), { NAN, INFINITY, -INFINITY });
  for (const double value : bad) {
    OpeningSignalParameters parameters;
    ASSERT_NO_THROW(parameters.validate("signal"));
    parameters.*GetParam().member = value;
    try {
      parameters.validate("hull.signal");
      FAIL() << GetParam().name << " = " << value << " passed";
    } catch (const InputError& error) {
      EXPECT_EQ(error.key(), std::string("hull.signal.") + GetParam().name);
      EXPECT_FALSE(error.value().empty());
      EXPECT_NE(error.allowed().find("must be"), std::string::npos);
    }
    EXPECT_THROW(OpeningSignal{ parameters }, InputError);
  }
}

INSTANTIATE_TEST_SUITE_P(
    OpeningSignal, Parameters,
    testing::Values(Field{ "min_angle_rad", &OpeningSignalParameters::min_angle_rad, { 0.1, -2.0 } },
                    Field{ "max_angle_rad", &OpeningSignalParameters::max_angle_rad, { 0.0, 2.0 } },
                    Field{ "max_rate_rad_per_s", &OpeningSignalParameters::max_rate_rad_per_s, { 0.0, -1.0 } },
                    Field{ "noise_rad", &OpeningSignalParameters::noise_rad, { -1e-9 } },
                    Field{ "max_gap_s", &OpeningSignalParameters::max_gap_s, { 0.0, -1.0 } },
                    Field{ "smoothing_time_s", &OpeningSignalParameters::smoothing_time_s, { -0.1, 61.0 } },
                    Field{ "backlash_rad", &OpeningSignalParameters::backlash_rad, { -1e-9, 0.2 } }),
    [](const auto& test_case) { return test_case.param.name; });

}  // namespace
}  // namespace geocontainer_mpm::barge
