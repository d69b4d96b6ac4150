/// The search for the fastest rate that will do.

#include "geocontainer_mpm/forecast/advice.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

namespace geocontainer_mpm::forecast {
namespace {

const AdviceSettings settings{ 0.9, 0.004, 0.032, 4, 3 };

struct Search {
  Advice advice;
  std::vector<double> tried;
};

Search search(const std::function<double(double)>& utilisation)
{
  RateSearch search(settings);
  Search result;
  while (const std::optional<double> rate = search.next()) {
    result.tried.push_back(*rate);
    search.add(utilisation(*rate));
  }
  result.advice = search.advice();
  EXPECT_TRUE(result.advice.complete);
  return result;
}

TEST(RateSearch, SaysThatAnyRateWillDoOnlyWhereAllHaveBeenTried)
{
  const Search found = search([](double rate) { return 10.0 * rate; });
  EXPECT_EQ(found.advice.verdict, Verdict::any_rate);
  EXPECT_DOUBLE_EQ(found.advice.rate_rad_per_s, 0.032);
  EXPECT_EQ(found.advice.slowest_rad_per_s, 0.0);
  EXPECT_DOUBLE_EQ(found.advice.utilisation, 0.32);
  EXPECT_EQ(found.tried.size(), 4u);
}

TEST(RateSearch, AllowsWhatHasBeenTriedSoFar)
{
  RateSearch search(settings);
  EXPECT_EQ(search.advice().verdict, Verdict::none);
  search.add(1.0);
  EXPECT_EQ(search.advice().verdict, Verdict::none);  // slower may do
  search.add(0.5);
  EXPECT_EQ(search.advice().verdict, Verdict::rate);
  EXPECT_FALSE(search.advice().complete);
  EXPECT_DOUBLE_EQ(search.advice().rate_rad_per_s, 0.016);
  EXPECT_DOUBLE_EQ(search.advice().slowest_rad_per_s, 0.016);
  search.add(0.4);
  EXPECT_DOUBLE_EQ(search.advice().slowest_rad_per_s, 0.008);
  search.add(0.3);
  EXPECT_EQ(search.advice().slowest_rad_per_s, 0.0);
}

TEST(RateSearch, SaysThatSlowerIsWorseWhereItIs)
{
  const Search found = search([](double rate) { return 0.016 / rate; });
  EXPECT_EQ(found.advice.verdict, Verdict::rate);
  EXPECT_DOUBLE_EQ(found.advice.rate_rad_per_s, 0.032);
  EXPECT_DOUBLE_EQ(found.advice.slowest_rad_per_s, 0.032);
  EXPECT_EQ(found.tried.size(), 4u);  // nothing faster is to be looked for
}

TEST(RateSearch, SaysSoWhereNoneWillDo)
{
  const Search found = search([](double rate) { return 1.0 + rate; });
  EXPECT_EQ(found.advice.verdict, Verdict::no_rate);
  EXPECT_EQ(found.tried.size(), 4u);
  EXPECT_NEAR(found.tried.back(), 0.004, 1e-15);
  EXPECT_NEAR(found.advice.utilisation, 1.004, 1e-12);  // the least
}

TEST(RateSearch, FindsTheFasterPartWhereSlowIsWorseToo)
{
  // A hull that opens slowly holds its container in the slot: only rates about 0.016 rad/s will do.
  const Search found = search([](double rate) { return 0.5 + std::abs(std::log(rate / 0.016)); });
  EXPECT_EQ(found.advice.verdict, Verdict::rate);
  EXPECT_GT(found.advice.rate_rad_per_s, 0.016);
  EXPECT_NEAR(found.advice.slowest_rad_per_s, 0.016, 1e-12);
  EXPECT_LT(found.advice.utilisation, 0.9);
}

RC_GTEST_PROP(RateSearch, OfUtilisationThatGrowsWithTheRateComesWithinOneStepOfTheLimit, ())
{
  const double fastest_good = 0.0041 + 0.0275 * (*rc::gen::inRange(0, 1000) / 1000.0);
  const Search found = search([&](double rate) { return 0.9 * rate / fastest_good; });
  RC_ASSERT(found.advice.verdict == Verdict::rate);
  RC_ASSERT(found.advice.rate_rad_per_s < fastest_good);
  RC_ASSERT(found.advice.slowest_rad_per_s == 0.0);
  // A step of the ladder is a factor 2, halved three times.
  RC_ASSERT(found.advice.rate_rad_per_s * std::pow(2.0, 1.0 / 8.0) * (1.0 + 1e-9) >= fastest_good);
}

}  // namespace
}  // namespace geocontainer_mpm::forecast
