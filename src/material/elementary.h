#pragma once
/// Logarithm and exponential for the loops over particles. The library's do not vectorise, or, where they do, give
/// other bits in a loop's vector part than in its rest, so that the split of a batch would show. These are plain
/// arithmetic, free of branches, exact to a few units in the last place, also where what
/// is wanted is a small difference.

#include <cstdint>
#include <cstring>

namespace geocontainer_mpm::material {

inline std::uint64_t bits_of(double x)
{
  std::uint64_t bits;
  std::memcpy(&bits, &x, sizeof bits);
  return bits;
}
inline double double_of(std::uint64_t bits)
{
  double x;
  std::memcpy(&x, &bits, sizeof x);
  return x;
}

inline constexpr double ln2_high = 0x1.62e42feep-1;  // its last bits are zero: exact times any exponent
inline constexpr double ln2_low = 0x1.a39ef35793c76p-33;

struct Logarithm {
  double value;   ///< ln(1 + d)
  double defect;  ///< d - ln(1 + d), without cancellation
};

/// Of 1 + d > 0. With 1 + d = 2^k (1 + m), 1 + m in [sqrt(1/2), sqrt(2)): ln(1 + m) = 2 atanh z, z = m / (2 + m), and
/// the series of atanh.
inline Logarithm logarithm(double d)
{
  constexpr std::uint64_t one = 0x3ff0000000000000, root_half = 0x3fe6a09e667f3bcd, fraction = 0x000fffffffffffff;
  constexpr double two52 = 0x1p52;
  const std::uint64_t shifted = bits_of(1.0 + d) + (one - root_half);
  const double k = double_of((shifted >> 52U) | 0x4330000000000000) - (two52 + 1023.0);
  const double reduced = double_of((shifted & fraction) + root_half) - 1.0;
  const double m = k == 0.0 ? d : reduced;
  const double z = m / (2.0 + m), s = z * z;
  const double high = 1.0 / 13.0 + s * (1.0 / 15.0 + s * (1.0 / 17.0 + s * (1.0 / 19.0 + s / 21.0)));
  const double tail =
      s * (1.0 / 3.0 + s * (1.0 / 5.0 + s * (1.0 / 7.0 + s * (1.0 / 9.0 + s * (1.0 / 11.0 + s * high)))));
  const double value = k * ln2_high + (k * ln2_low + 2.0 * z * (1.0 + tail));
  // 2 z / (1 - z) = m
  return { value, k == 0.0 ? z * (m - 2.0 * tail) : d - value };
}

/// (1 - exp(-y)) / y for y >= 0, 1 at 0. With y = k ln 2 + r, |r| <= ln(2) / 2: 1 - exp(-y) = 1 - 2^-k + 2^-k (1 -
/// exp(-r)), and the series of 1 - exp(-r).
inline double mean_decay(double y)
{
  constexpr double per_ln2 = 1.4426950408889634, integer_shift = 0x1.8p52;
  const double positive = y > 1e-300 ? y : 1e-300;
  const double bounded = positive < 64.0 ? positive : 64.0;  // exp(-64) is lost beside 1
  const double shifted = bounded * per_ln2 + integer_shift, k = shifted - integer_shift;
  const double r = (bounded - k * ln2_high) - k * ln2_low;
  const double scale = double_of((std::uint64_t{ 1023 } - (bits_of(shifted) - bits_of(integer_shift))) << 52U);
  const double high =
      1.0 / 40320.0 -
      r * (1.0 / 362880.0 -
           r * (1.0 / 3628800.0 -
                r * (1.0 / 39916800.0 - r * (1.0 / 479001600.0 - r * (1.0 / 6227020800.0 - r / 87178291200.0)))));
  const double series =
      1.0 -
      r * (1.0 / 2.0 -
           r * (1.0 / 6.0 - r * (1.0 / 24.0 - r * (1.0 / 120.0 - r * (1.0 / 720.0 - r * (1.0 / 5040.0 - r * high))))));
  return ((1.0 - scale) + scale * (r * series)) / positive;
}

}  // namespace geocontainer_mpm::material
