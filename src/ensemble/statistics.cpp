#include "geocontainer_mpm/ensemble/statistics.h"

#include <algorithm>
#include <cmath>

namespace geocontainer_mpm::ensemble {
namespace {

constexpr double two_sided_95 = 1.959963984540054;  ///< of a standard normal distribution 5 % lie further out

}  // namespace

double quantile(std::vector<double> samples, double p)
{
  std::sort(samples.begin(), samples.end());
  const auto count = static_cast<double>(samples.size());
  const double place = std::clamp(p * (count + 1.0) - 1.0, 0.0, count - 1.0);
  const auto below = static_cast<std::size_t>(place);
  const double part = place - static_cast<double>(below);
  if (part == 0.0)
    return samples[below];
  const double from = samples[below], to = samples[below + 1];
  return std::isinf(to) ? to : from + part * (to - from);
}

std::vector<double> ranks(const std::vector<double>& samples)
{
  std::vector<std::size_t> order(samples.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    order[i] = i;
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return samples[a] < samples[b]; });
  std::vector<double> result(samples.size());
  for (std::size_t i = 0; i < order.size();) {
    std::size_t end = i + 1;
    while (end < order.size() && samples[order[end]] == samples[order[i]])
      ++end;
    for (std::size_t k = i; k < end; ++k)
      result[order[k]] = 0.5 * static_cast<double>(i + 1 + end);
    i = end;
  }
  return result;
}

std::optional<double> rank_correlation(const std::vector<double>& x, const std::vector<double>& y)
{
  const std::vector<double> a = ranks(x), b = ranks(y);
  const double mean = 0.5 * static_cast<double>(x.size() + 1);
  double both = 0.0, of_a = 0.0, of_b = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    both += (a[i] - mean) * (b[i] - mean);
    of_a += (a[i] - mean) * (a[i] - mean);
    of_b += (b[i] - mean) * (b[i] - mean);
  }
  if (of_a == 0.0 || of_b == 0.0)
    return std::nullopt;
  return both / std::sqrt(of_a * of_b);
}

double chance_correlation(std::size_t samples)
{
  return samples < 2 ? 1.0 : std::min(1.0, two_sided_95 / std::sqrt(static_cast<double>(samples - 1)));
}

Share share(std::size_t count, std::size_t samples)
{
  const double n = static_cast<double>(samples), p = static_cast<double>(count) / n;
  const double z2 = two_sided_95 * two_sided_95;
  const double middle = (p + z2 / (2.0 * n)) / (1.0 + z2 / n);
  const double half = two_sided_95 / (1.0 + z2 / n) * std::sqrt(p * (1.0 - p) / n + z2 / (4.0 * n * n));
  return { p, std::max(0.0, middle - half), std::min(1.0, middle + half) };
}

}  // namespace geocontainer_mpm::ensemble
