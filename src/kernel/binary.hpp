// SPDX-License-Identifier: BSD-3-Clause
// Finite doubles as integers times powers of two, for the exact stages.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace delone::kernel {

/// A finite double as mantissa·2^exponent, |mantissa| < 2^53.
struct Binary {
  std::int64_t mantissa;
  int exponent;
};
inline Binary decompose(double x) {
  const auto bits = std::bit_cast<std::uint64_t>(x);
  const auto fraction = static_cast<std::int64_t>(bits & ((std::uint64_t{1} << 52) - 1));
  const int biased = static_cast<int>(bits >> 52 & 0x7ff);
  const std::int64_t magnitude = biased == 0 ? fraction : fraction | std::int64_t{1} << 52;
  return {std::signbit(x) ? -magnitude : magnitude, std::max(biased, 1) - 1075};
}

}  // namespace delone::kernel
