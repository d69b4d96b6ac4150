/// Quantiles against closed forms, and what is refused.

#include "geocontainer_mpm/ensemble/distribution.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "geocontainer_mpm/error.h"

namespace geocontainer_mpm::ensemble {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

double normal_share_below(double x)
{
  return 0.5 * std::erfc(-x * std::sqrt(0.5));
}

Distribution uniform(double low, double high)
{
  return { Shape::uniform, low, high, 0.0, 0.0 };
}
Distribution triangular(double low, double mode, double high)
{
  return { Shape::triangular, low, high, mode, 0.0 };
}
Distribution normal(double mean, double deviation, double low = -infinity, double high = infinity)
{
  return { Shape::normal, low, high, mean, deviation };
}
Distribution lognormal(double median, double factor, double low = -infinity, double high = infinity)
{
  return { Shape::lognormal, low, high, median, factor };
}

/// Mean and variance by the midpoint rule over the quantile function, which is what draws converge to.
struct Moments {
  double mean = 0.0, variance = 0.0;
};
Moments moments(const Distribution& distribution)
{
  constexpr int parts = 200000;
  Moments result;
  double square = 0.0;
  for (int i = 0; i < parts; ++i) {
    const double value = distribution.quantile((i + 0.5) / parts);
    result.mean += value / parts;
    square += value * value / parts;
  }
  result.variance = square - result.mean * result.mean;
  return result;
}

/// The rule leaves out what the tails beyond the first and last part hold: relative errors of about 1e-4.
constexpr double rule = 3e-4;

void expect_moments(const Distribution& distribution, double mean, double variance)
{
  const Moments is = moments(distribution);
  EXPECT_NEAR(is.mean, mean, rule * std::sqrt(variance) + rule * std::abs(mean));
  EXPECT_NEAR(is.variance, variance, 3.0 * rule * variance);
}

RC_GTEST_PROP(NormalQuantile, IsTheInverseOfTheNormalLaw, ())
{
  const double x = *rc::gen::inRange(-7000, 4001) * 1e-3;  // above 4 the share's own rounding counts
  RC_ASSERT(std::abs(normal_quantile(normal_share_below(x)) - x) < 1e-11);
}

TEST(NormalQuantile, KnowsTheTables)
{
  EXPECT_EQ(normal_quantile(0.5), 0.0);
  EXPECT_NEAR(normal_quantile(0.975), 1.959963984540054, 1e-14);
  EXPECT_NEAR(normal_quantile(0.001), -3.090232306167813, 1e-14);
  EXPECT_NEAR(normal_quantile(1e-20), -9.262340089798408, 1e-13);
}

TEST(Distribution, HasTheMomentsOfItsLaw)
{
  expect_moments(uniform(2.0, 5.0), 3.5, 9.0 / 12.0);
  const double a = 1.0, c = 2.0, b = 5.0;
  expect_moments(triangular(a, c, b), (a + b + c) / 3.0, (a * a + b * b + c * c - a * b - a * c - b * c) / 18.0);
  expect_moments(normal(33.0, 2.0), 33.0, 4.0);
  const double sigma = std::log(1.6), grown = std::exp(sigma * sigma);
  expect_moments(lognormal(3e6, 1.6), 3e6 * std::sqrt(grown), 9e12 * grown * (grown - 1.0));
}

TEST(Distribution, CutNormalHasTheMomentsOfTheCutLaw)
{
  // Johnson, Kotz and Balakrishnan 1994, Continuous Univariate Distributions 1, section 13.10.1.
  const double mean = 33.0, deviation = 2.0, alpha = -1.5, beta = 0.5;
  const auto density = [](double x) { return std::exp(-0.5 * x * x) / std::sqrt(2.0 * std::acos(-1.0)); };
  const double left = normal_share_below(beta) - normal_share_below(alpha);
  const double shift = (density(alpha) - density(beta)) / left;
  expect_moments(
      normal(mean, deviation, mean + alpha * deviation, mean + beta * deviation), mean + deviation * shift,
      deviation * deviation * (1.0 + (alpha * density(alpha) - beta * density(beta)) / left - shift * shift));
}

TEST(Distribution, TriangularGoesThroughItsMode)
{
  const Distribution d = triangular(0.15, 0.25, 0.45);
  EXPECT_NEAR(d.quantile(1.0 / 3.0), 0.25, 1e-15);  // (mode - low) / (high - low) lies below the mode
  EXPECT_NEAR(triangular(1.0, 1.0, 3.0).quantile(0.75), 2.0, 1e-15);
  EXPECT_NEAR(triangular(1.0, 3.0, 3.0).quantile(0.25), 2.0, 1e-15);
}

RC_GTEST_PROP(Distribution, QuantilesAscendAndStayWithin, ())
{
  const double p = *rc::gen::inRange(1, 1000) * 1e-3, q = *rc::gen::inRange(1, 1000) * 1e-3;
  for (const Distribution& d : { uniform(-1.0, 2.0), triangular(-1.0, 0.5, 2.0), normal(0.0, 3.0, -1.0, 2.0),
                                 lognormal(1.0, 2.0, 0.5, 2.0), lognormal(1.0, 2.0, -1.0, 2.0) }) {
    RC_ASSERT(d.quantile(p) >= d.low && d.quantile(p) <= d.high);
    RC_ASSERT((p < q) == (d.quantile(p) < d.quantile(q)));
  }
}

TEST(LoadInputs, ReadsEveryDistribution)
{
  const std::vector<Input> inputs = parse_inputs(R"(
title: all of them
draw:
  a.b: { uniform: { low: 1, high: 2 } }
  c: { triangular: { low: 1, mode: 1.5, high: 2 } }
  d: { normal: { mean: 33, deviation: 2, low: 28 } }
  e: { lognormal: { median: 3.0e6, factor: 1.5, high: 1.0e7 } }
)",
                                                 "test");
  ASSERT_EQ(inputs.size(), 4u);
  EXPECT_EQ(inputs[0].key, "a.b");
  EXPECT_EQ(inputs[0].distribution.quantile(0.5), 1.5);
  EXPECT_EQ(inputs[1].distribution.middle, 1.5);
  EXPECT_EQ(inputs[2].distribution.low, 28.0);
  EXPECT_EQ(inputs[2].distribution.high, infinity);
  EXPECT_NEAR(inputs[3].distribution.quantile(0.45), 2.85e6, 0.05e6);  // a little below the median
}

/// What is wrong, and the key and the words of the message.
struct Bad {
  const char* draw;
  const char* key;
  const char* words;
};

TEST(LoadInputs, NamesWhatIsWrong)
{
  for (const Bad& bad :
       { Bad{ "{}", "draw", "must be a map of distributions" },
         Bad{ "{ k: 3 }", "draw.k", "must be one distribution; allowed: uniform, triangular, normal, lognormal" },
         Bad{ "{ k: { gauss: { mean: 1 } } }", "draw.k.gauss", "unknown distribution" },
         Bad{ "{ k: { uniform: { low: 1 } } }", "draw.k.uniform.high", "missing" },
         Bad{ "{ k: { uniform: { low: 1, high: 2, mode: 1 } } }", "draw.k.uniform.mode", "allowed: low, high" },
         Bad{ "{ k: { uniform: { low: 2, high: 1 } } }", "draw.k.uniform.high", "must be more than low" },
         Bad{ "{ k: { uniform: { low: x, high: 1 } } }", "draw.k.uniform.low", "must be a number" },
         Bad{ "{ k: { uniform: { low: 0, high: .inf } } }", "draw.k.uniform.high", "finite" },
         Bad{ "{ k: { triangular: { low: 0, mode: 3, high: 2 } } }", "draw.k.triangular.mode", "must be in [0, 2]" },
         Bad{ "{ k: { normal: { mean: 0, deviation: 0 } } }", "draw.k.normal.deviation", "must be > 0" },
         Bad{ "{ k: { normal: { mean: 0, deviation: 1, low: 5, high: 6 } } }", "draw.k.normal.high", "leave" },
         Bad{ "{ k: { lognormal: { median: -1, factor: 2 } } }", "draw.k.lognormal.median", "must be > 0" },
         Bad{ "{ k: { lognormal: { median: 1, factor: 0.5 } } }", "draw.k.lognormal.factor", "must be > 1" },
         Bad{ "{ k: { uniform: { low: 0, high: 1 } }, k: { uniform: { low: 0, high: 1 } } }", "draw.k", "twice" } }) {
    try {
      parse_inputs(std::string("draw: ") + bad.draw, "test");
      ADD_FAILURE() << bad.draw << " was accepted";
    } catch (const InputError& error) {
      EXPECT_EQ(error.key(), bad.key) << error.what();
      EXPECT_NE(error.allowed().find(bad.words), std::string::npos) << error.what();
      EXPECT_EQ(error.source(), "test");
    }
  }
  EXPECT_THROW(parse_inputs("draw: { k: [", "test"), InputError);
  EXPECT_THROW(parse_inputs("draws: {}", "test"), InputError);
  EXPECT_THROW(load_inputs("/nowhere.yaml"), InputError);
}

}  // namespace
}  // namespace geocontainer_mpm::ensemble
