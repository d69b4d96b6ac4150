/// Statistics of samples whose answers are known.

#include "geocontainer_mpm/ensemble/statistics.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace geocontainer_mpm::ensemble {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(Quantile, IsLinearBetweenSamples)
{
  const std::vector<double> ten = { 7, 1, 5, 3, 9, 2, 4, 10, 8, 6 };
  EXPECT_DOUBLE_EQ(quantile(ten, 0.0), 1.0);
  EXPECT_DOUBLE_EQ(quantile(ten, 0.1), 1.1);  // rank 0.1 (10 + 1)
  EXPECT_DOUBLE_EQ(quantile(ten, 0.5), 5.5);
  EXPECT_DOUBLE_EQ(quantile(ten, 0.9), 9.9);
  EXPECT_DOUBLE_EQ(quantile(ten, 1.0), 10.0);
  EXPECT_DOUBLE_EQ(quantile({ 4.0 }, 0.9), 4.0);
}

/// What a band is for: of a truth that is drawn like the members it holds what it says, however few they are.
TEST(Quantile, BandsHoldTheShareOfNewDrawsThatTheyPromise)
{
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform;
  int inside = 0;
  const int trials = 20000, members = 16;
  for (int i = 0; i < trials; ++i) {
    std::vector<double> samples;
    for (int m = 0; m < members; ++m)
      samples.push_back(uniform(random));
    const double truth = uniform(random);
    inside += truth >= quantile(samples, 0.1) && truth <= quantile(samples, 0.9) ? 1 : 0;
  }
  // Exact for the uniform law. Three standard deviations of so many trials are 0.0085.
  EXPECT_NEAR(static_cast<double>(inside) / trials, 0.8, 0.0085);
}

TEST(Quantile, IsInfiniteWhereASampleIs)
{
  const std::vector<double> five = { 1.0, infinity, 2.0, 3.0, infinity };
  EXPECT_EQ(quantile(five, 0.5), 3.0);
  EXPECT_EQ(quantile(five, 0.6), infinity);
  EXPECT_EQ(quantile(five, 0.9), infinity);
  EXPECT_EQ(quantile({ infinity, infinity }, 0.5), infinity);
}

TEST(Ranks, ShareTies)
{
  EXPECT_EQ(ranks({ 10.0, 30.0, 20.0, 30.0 }), (std::vector<double>{ 1.0, 3.5, 2.0, 3.5 }));
  EXPECT_EQ(ranks({ infinity, 1.0, infinity }), (std::vector<double>{ 2.5, 1.0, 2.5 }));
}

TEST(RankCorrelation, KnowsATextbookSample)
{
  // Without ties rho = 1 - 6 sum d^2 / (n (n^2 - 1)): d^2 sums up to 194 here.
  const std::vector<double> iq = { 106, 100, 86, 101, 99, 103, 97, 113, 112, 110 };
  const std::vector<double> hours = { 7, 27, 2, 50, 28, 29, 20, 12, 6, 17 };
  EXPECT_NEAR(rank_correlation(iq, hours).value(), 1.0 - 6.0 * 194.0 / (10.0 * 99.0), 1e-15);
}

TEST(RankCorrelation, HasNoAnswerForAConstant)
{
  EXPECT_FALSE(rank_correlation({ 1.0, 2.0, 3.0 }, { 5.0, 5.0, 5.0 }).has_value());
  EXPECT_FALSE(rank_correlation({ 1.0 }, { 5.0 }).has_value());
}

RC_GTEST_PROP(RankCorrelation, SeesOrderAlone, (const std::vector<int>& samples))
{
  std::vector<double> x, y;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    x.push_back(static_cast<double>(i));
    y.push_back(samples[i]);
  }
  const auto rho = rank_correlation(x, y);
  if (!rho)
    return;
  RC_ASSERT(*rho >= -1.0 - 1e-12 && *rho <= 1.0 + 1e-12);
  std::vector<double> grown, mirrored;
  for (const double value : y) {
    grown.push_back(std::sinh(value * 1e-9));  // keeps the order
    mirrored.push_back(-value);
  }
  RC_ASSERT(std::abs(*rank_correlation(x, grown) - *rho) < 1e-12);
  RC_ASSERT(std::abs(*rank_correlation(x, mirrored) + *rho) < 1e-12);
  std::sort(y.begin(), y.end());
  if (std::adjacent_find(y.begin(), y.end()) == y.end()) {
    RC_ASSERT(std::abs(*rank_correlation(x, y) - 1.0) < 1e-12);
  }
}

TEST(Share, HasWilsonsInterval)
{
  const Share none = share(0, 16);  // z^2 / (n + z^2)
  EXPECT_EQ(none.value, 0.0);
  EXPECT_NEAR(none.low, 0.0, 1e-15);
  EXPECT_NEAR(none.high, 3.841458820694124 / (16.0 + 3.841458820694124), 1e-14);
  const Share half = share(8, 16);  // 1/2 +- z / 2 / sqrt(n + z^2)
  EXPECT_NEAR(half.high - 0.5, 0.5 * 1.959963984540054 / std::sqrt(16.0 + 3.841458820694124), 1e-14);
  EXPECT_NEAR(half.low + half.high, 1.0, 1e-14);
  EXPECT_EQ(share(16, 16).high, 1.0);
}

TEST(ChanceCorrelation, FallsWithTheRootOfTheSample)
{
  EXPECT_NEAR(chance_correlation(16), 1.959963984540054 / std::sqrt(15.0), 1e-15);
  EXPECT_EQ(chance_correlation(2), 1.0);
}

}  // namespace
}  // namespace geocontainer_mpm::ensemble
