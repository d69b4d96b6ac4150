#pragma once
/// Random numbers that are the same on every machine and standard library: SplitMix64 (Steele, Lea and Flood 2014) and
/// plain arithmetic on it.

#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <vector>

namespace geocontainer_mpm::stability {

class Chance {
public:
  explicit Chance(std::uint64_t seed) : state_(seed) {}

  std::uint64_t bits()
  {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  /// Uniform in [low, high).
  double between(double low, double high) { return low + (high - low) * 0x1p-53 * static_cast<double>(bits() >> 11); }
  /// Uniform in the logarithm.
  double over_decades(double low, double high) { return low * std::pow(high / low, between(0.0, 1.0)); }
  int whole(int low, int high) { return low + static_cast<int>(between(0.0, 1.0) * (high - low + 1)); }
  bool one_in(double n) { return between(0.0, n) < 1.0; }
  template <class T>
  T any_of(std::initializer_list<T> choices)
  {
    return *(choices.begin() + whole(0, static_cast<int>(choices.size()) - 1));
  }

private:
  std::uint64_t state_;
};

}  // namespace geocontainer_mpm::stability
