#include "geocontainer_mpm/ensemble/distribution.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "geocontainer_mpm/error.h"

namespace geocontainer_mpm::ensemble {
namespace {

/// Of a cut distribution at least this much is left: less is no longer the one that is named.
constexpr double least_left = 0.01;

using Coefficients = std::array<double, 8>;  // ascending

double polynomial(const Coefficients& c, double x)
{
  double value = c[7];
  for (std::size_t k = 7; k-- > 0;)
    value = value * x + c[k];
  return value;
}

double normal_share_below(double x)
{
  return 0.5 * std::erfc(-x * std::sqrt(0.5));
}

/// Of a cut normal distribution, its ends in standard deviations from the mean.
double cut_normal_quantile(double p, double low, double high)
{
  const double from = normal_share_below(low), to = normal_share_below(high);
  const double value = normal_quantile(from + p * (to - from));
  return std::min(std::max(value, low), high);
}

double triangular_quantile(double p, double low, double mode, double high)
{
  const double width = high - low, rise = mode - low, fall = high - mode;
  return p * width < rise ? low + std::sqrt(p * width * rise) : high - std::sqrt((1.0 - p) * width * fall);
}

[[noreturn]] void refuse(const std::string& key, double value, const std::string& allowed)
{
  throw InputError("", key, fmt::format("{}", value), allowed);
}

}  // namespace

const char* to_string(Shape shape)
{
  switch (shape) {
    case Shape::uniform:
      return "uniform";
    case Shape::triangular:
      return "triangular";
    case Shape::normal:
      return "normal";
    case Shape::lognormal:
      break;
  }
  return "lognormal";
}

double normal_quantile(double p)
{
  constexpr Coefficients a{ 3.3871328727963666080e0,  1.3314166789178437745e+2, 1.9715909503065514427e+3,
                            1.3731693765509461125e+4, 4.5921953931549871457e+4, 6.7265770927008700853e+4,
                            3.3430575583588128105e+4, 2.5090809287301226727e+3 };
  constexpr Coefficients b{ 1.0,
                            4.2313330701600911252e+1,
                            6.8718700749205790830e+2,
                            5.3941960214247511077e+3,
                            2.1213794301586595867e+4,
                            3.9307895800092710610e+4,
                            2.8729085735721942674e+4,
                            5.2264952788528545610e+3 };
  constexpr Coefficients c{ 1.42343711074968357734e0,  4.63033784615654529590e0, 5.76949722146069140550e0,
                            3.64784832476320460504e0,  1.27045825245236838258e0, 2.41780725177450611770e-1,
                            2.27238449892691845833e-2, 7.74545014278341407640e-4 };
  constexpr Coefficients d{ 1.0,
                            2.05319162663775882187e0,
                            1.67638483018380384940e0,
                            6.89767334985100004550e-1,
                            1.48103976427480074590e-1,
                            1.51986665636164571966e-2,
                            5.47593808499534494600e-4,
                            1.05075007164441684324e-9 };
  constexpr Coefficients e{ 6.65790464350110377720e0,  5.46378491116411436990e0,  1.78482653991729133580e0,
                            2.96560571828504891230e-1, 2.65321895265761230930e-2, 1.24266094738807843860e-3,
                            2.71155556874348757815e-5, 2.01033439929228813265e-7 };
  constexpr Coefficients f{ 1.0,
                            5.99832206555887937690e-1,
                            1.36929880922735805310e-1,
                            1.48753612908506148525e-2,
                            7.86869131145613259100e-4,
                            1.84631831751005468180e-5,
                            1.42151175831644588870e-7,
                            2.04426310338993978564e-15 };
  const double q = p - 0.5;
  if (std::abs(q) <= 0.425) {
    const double r = 0.180625 - q * q;
    return q * polynomial(a, r) / polynomial(b, r);
  }
  const double r = std::sqrt(-std::log(q < 0.0 ? p : 1.0 - p));
  const double size =
      r <= 5.0 ? polynomial(c, r - 1.6) / polynomial(d, r - 1.6) : polynomial(e, r - 5.0) / polynomial(f, r - 5.0);
  return q < 0.0 ? -size : size;
}

double Distribution::quantile(double p) const
{
  switch (shape) {
    case Shape::uniform:
      return low + p * (high - low);
    case Shape::triangular:
      return triangular_quantile(p, low, middle, high);
    case Shape::normal:
      return middle + spread * cut_normal_quantile(p, (low - middle) / spread, (high - middle) / spread);
    case Shape::lognormal:
      break;
  }
  const double deviation = std::log(spread);
  const auto standard = [&](double x) { return std::log(x / middle) / deviation; };
  return middle * std::exp(deviation * cut_normal_quantile(p, low > 0.0 ? standard(low) : -HUGE_VAL, standard(high)));
}

void Distribution::validate(const std::string& key) const
{
  const bool may_be_open = shape == Shape::normal || shape == Shape::lognormal;
  if (std::isnan(low) || (!may_be_open && std::isinf(low)))
    refuse(key + ".low", low, "must be a finite number");
  if (std::isnan(high) || (!may_be_open && std::isinf(high)))
    refuse(key + ".high", high, "must be a finite number");
  if (!(low < high))
    refuse(key + ".high", high, fmt::format("must be more than low, {}", low));
  if (shape == Shape::triangular && !(low <= middle && middle <= high))
    refuse(key + ".mode", middle, fmt::format("must be in [{}, {}]", low, high));
  if (shape == Shape::normal && !std::isfinite(middle))
    refuse(key + ".mean", middle, "must be a finite number");
  if (shape == Shape::normal && !(spread > 0.0 && std::isfinite(spread)))
    refuse(key + ".deviation", spread, "must be > 0");
  if (shape == Shape::lognormal && !(middle > 0.0 && std::isfinite(middle)))
    refuse(key + ".median", middle, "must be > 0");
  if (shape == Shape::lognormal && !(spread > 1.0 && std::isfinite(spread)))
    refuse(key + ".factor", spread, "must be > 1");
  if (shape == Shape::lognormal && high <= 0.0)
    refuse(key + ".high", high, "must be > 0");
  if (!may_be_open)
    return;
  const auto standard = [this](double x) {
    if (shape == Shape::normal)
      return (x - middle) / spread;
    return x > 0.0 ? std::log(x / middle) / std::log(spread) : -HUGE_VAL;
  };
  const double left = normal_share_below(standard(high)) - normal_share_below(standard(low));
  if (left < least_left)
    refuse(key + ".high", high,
           fmt::format("low and high leave {:.2g} of the distribution, must leave {}", left, least_left));
}

}  // namespace geocontainer_mpm::ensemble
