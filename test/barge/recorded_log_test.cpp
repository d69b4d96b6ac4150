// The committed log: what was planted in it is found, what was not is not, and the profile comes out.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>

#include "geocontainer_mpm/barge/opening_signal.h"

namespace geocontainer_mpm::barge {
namespace {

std::vector<OpeningSample> read_log()
{
  std::ifstream file(std::string(GEOCONTAINER_MPM_SOURCE_DIR) + "/config/logs/release.csv");
  std::string line;
  EXPECT_TRUE(std::getline(file, line));
  EXPECT_EQ(line, "time_s,port_rad,starboard_rad");
  std::vector<OpeningSample> samples;
  while (std::getline(file, line)) {
    double time_s = 0.0;
    OpeningSample sample;
    EXPECT_EQ(std::sscanf(line.c_str(), "%lf,%lf,%lf", &time_s, &sample.angles.port_rad, &sample.angles.starboard_rad),
              3)
        << line;
    sample.stamp_ns = std::llround(time_s * 1e9);
    samples.push_back(sample);
  }
  return samples;
}

// The generator's profile: closed 5 s, then 25 s with ramps of 5 s to 0.365 rad.
double true_port_rad(double time_s)
{
  const auto ramped = [](double t) {
    const double s = std::clamp(t / 5.0, 0.0, 1.0);
    return 5.0 * (s * s * s - 0.5 * s * s * s * s) + std::max(t - 5.0, 0.0);
  };
  return 0.365 / 20.0 * (ramped(time_s - 5.0) - ramped(time_s - 25.0));
}

class RecordedLog : public testing::Test {
protected:
  void SetUp() override
  {
    for (const OpeningSample& sample : read_log())
      signal_.add(sample);
    signal_.finish();
  }
  OpeningSignal signal_{ OpeningSignalParameters{} };
};

TEST_F(RecordedLog, RejectsExactlyWhatWasPlanted)
{
  EXPECT_EQ(signal_.count(SampleVerdict::accepted), 1180U);
  EXPECT_EQ(signal_.count(SampleVerdict::duplicate), 1U);
  EXPECT_EQ(signal_.count(SampleVerdict::too_fast), 1U);
  EXPECT_EQ(signal_.rejected(), 2U);
  ASSERT_EQ(signal_.gaps().size(), 1U);
  EXPECT_NEAR(signal_.gaps()[0].from_s, 15.0, 0.06);
  EXPECT_NEAR(signal_.gaps()[0].to_s, 16.0, 0.06);
}

TEST_F(RecordedLog, IsExactlyStillBeforeAndAfterTheOpening)
{
  EXPECT_EQ(signal_.angles(0.0).port_rad, 0.0);
  EXPECT_EQ(signal_.angles(0.0).starboard_rad, 0.0);
  EXPECT_GT(signal_.next_motion_s(0.0), 5.0);
  EXPECT_EQ(signal_.next_motion_s(33.0), INFINITY);
}

TEST_F(RecordedLog, FollowsTheTrueProfile)
{
  double largest_error = 0.0;
  double largest_rate = 0.0;
  for (double t = 0.0; t < 60.0; t += 0.01) {
    if (t > 14.4 && t < 17.2)  // the dropout and its catch-up
      continue;
    largest_error = std::max(largest_error, std::abs(signal_.angles(t).port_rad - true_port_rad(t)));
    largest_rate = std::max(largest_rate, std::abs(signal_.rates(t).port_rad));
    EXPECT_GE(signal_.rates(t).port_rad, 0.0) << t;  // opens only: noise does not turn it back
  }
  EXPECT_LT(largest_error, 0.004);
  EXPECT_LT(largest_rate, 1.3 * 0.365 / 20.0);
}

TEST_F(RecordedLog, PortLeadsByAThirdOfADegreeAtMost)
{
  double lead = 0.0;
  for (double t = 17.5; t < 25.0; t += 0.01)
    lead = std::max(lead, signal_.angles(t).port_rad - signal_.angles(t).starboard_rad);
  EXPECT_GT(lead, 0.2 * M_PI / 180.0);
  EXPECT_LT(lead, 0.4 * M_PI / 180.0);
}

}  // namespace
}  // namespace geocontainer_mpm::barge
