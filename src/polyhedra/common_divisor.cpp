// SPDX-License-Identifier: BSD-3-Clause
#include "polyhedra/common_divisor.hpp"

#include <bit>
#include <cstdint>
#include <numeric>
#include <utility>

namespace delone::polyhedra {
namespace {

namespace mp = boost::multiprecision;

/// What many steps of Euclid's algorithm do to a > b, as far as their leading 62 bits u and v tell: a and b
/// become x·a + y·b and z·a + w·b.
struct EuclidSteps {
  std::int64_t x = 1, y = 0, z = 0, w = 1;

  /// Lehmer's method (Knuth, The Art of Computer Programming, vol. 2, 1997, algorithm 4.5.2L): the quotients
  /// for the least and the largest numbers that begin with these bits must agree.
  EuclidSteps(std::int64_t u, std::int64_t v) {
    while (v + z != 0 && v + w != 0) {
      const std::int64_t quotient = (u + x) / (v + z);
      if (quotient != (u + y) / (v + w)) return;
      x = std::exchange(z, x - quotient * z);
      y = std::exchange(w, y - quotient * w);
      u = std::exchange(v, u - quotient * v);
    }
  }
};

}  // namespace

#if DELONE_HAS_INT128
Int128 common_divisor(Int128 x, Int128 y) {
  using Word = internal::BuiltInUInt128;
  auto a = static_cast<Word>(x), b = static_cast<Word>(y);
  const auto zeros = [](Word z) {
    const auto low = static_cast<std::uint64_t>(z);
    return low != 0 ? std::countr_zero(low) : 64 + std::countr_zero(static_cast<std::uint64_t>(z >> 64));
  };
  if (a == 0 || b == 0) return static_cast<Int128>(a | b);
  const int shift = zeros(a | b);
  a >>= zeros(a);
  for (;;) {  // a is odd
    b >>= zeros(b);
    if ((a | b) >> 64 == 0) {
      const std::uint64_t rest = std::gcd(static_cast<std::uint64_t>(a), static_cast<std::uint64_t>(b));
      return static_cast<Int128>(static_cast<Word>(rest) << shift);
    }
    if (a > b) std::swap(a, b);
    b -= a;
    if (b == 0) return static_cast<Int128>(a << shift);
  }
}
#else
Int128 common_divisor(Int128 a, Int128 b) { return mp::gcd(a, b); }
#endif

Integer common_divisor(Integer a, Integer b) {
  if (a < 0) a = -a;
  if (b < 0) b = -b;
  for (;;) {
    if (a < b) a.swap(b);
    if (b == 0) return a;
    const unsigned top = mp::msb(a);
    if (top < 126) return Integer(common_divisor(static_cast<Int128>(a), static_cast<Int128>(b)));
    constexpr unsigned leading = 62;
    const unsigned shift = top + 1 - leading;
    const EuclidSteps steps(static_cast<std::int64_t>(Integer(a >> shift)),
                            static_cast<std::int64_t>(Integer(b >> shift)));
    if (steps.y == 0) {
      a %= b;
      continue;
    }
    const Integer next = a * steps.x + b * steps.y;
    b = a * steps.z + b * steps.w;
    a = next;
  }
}

}  // namespace delone::polyhedra
