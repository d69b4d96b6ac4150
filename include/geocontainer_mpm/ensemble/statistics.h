#pragma once
/// What samples say. A value may be infinite: a release that has not happened is later than any other.

#include <cstddef>
#include <optional>
#include <vector>

namespace geocontainer_mpm::ensemble {

/// Value below which the next draw lies with probability `p`: the mean of a sample's place is rank / (n + 1) (Weibull;
/// definition 6 of Hyndman and Fan 1996, The American Statistician 50:361), so that the band from P10 to P90 of few
/// samples holds 80 % of what is drawn like them, where the customary definition 7 of 16 samples holds 71 %. Linear
/// between neighbours, the first or last sample beyond them; infinite where a neighbour is that it leans on. Not of an
/// empty sample.
double quantile(std::vector<double> samples, double p);

/// Places in ascending order from 1; equal values share the mean of their places.
std::vector<double> ranks(const std::vector<double>& samples);

/// Spearman's rank correlation of two samples of equal size: the correlation of their ranks, in [-1, 1]. None where
/// one of them has a single value only.
std::optional<double> rank_correlation(const std::vector<double>& x, const std::vector<double>& y);

/// What chance alone exceeds in one of twenty samples of this size, of a rank correlation: 1.96 / sqrt(n - 1), the
/// large sample's normal law (Kendall 1948); at most 1.
double chance_correlation(std::size_t samples);

/// A probability from counts.
struct Share {
  double value = 0.0;
  double low = 0.0, high = 0.0;  ///< between which the true one lies with 95 %
};
/// Of `count` among `samples` > 0; the interval is Wilson's (1927, J. Am. Stat. Assoc. 22:209), which holds near 0
/// and 1.
Share share(std::size_t count, std::size_t samples);

}  // namespace geocontainer_mpm::ensemble
