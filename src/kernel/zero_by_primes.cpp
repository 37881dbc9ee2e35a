// SPDX-License-Identifier: BSD-3-Clause
// Residues are multiplied as in Montgomery 1985, doi:10.1090/S0025-5718-1985-0777282-X: a·b becomes a·b/2^64
// modulo p. Such a factor common to all products of a step, and to all entries in the beginning, does not
// change whether a determinant is zero, so nothing is ever converted back. Elimination multiplies rows by
// pivots, and needs no inverse.
#include "kernel/zero_by_primes.hpp"

#include "base/progress_meter.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace delone::kernel {
namespace {

using internal::TwoWords;

/// The largest primes below 2^62 are 2^62 less these.
constexpr std::array<std::uint16_t, 64> gaps{
    57,   87,   117,  143,  153,  167,  171,  195,  203,  273,  287,  317,  443,  483,  495,  575,
    581,  603,  633,  663,  765,  773,  777,  791,  813,  831,  923,  981,  993,  1001, 1007, 1017,
    1197, 1241, 1293, 1353, 1433, 1515, 1553, 1575, 1581, 1595, 1617, 1673, 1697, 1701, 1703, 1823,
    1881, 1911, 1923, 2043, 2073, 2103, 2141, 2187, 2217, 2247, 2285, 2351, 2367, 2375, 2397, 2421};
/// A bound of the binary logarithm of each from below.
constexpr double bits_of_prime = 61.99;

class Residues {
 public:
  explicit Residues(std::uint64_t prime) : prime_(prime) {
    // Newton: each round doubles the number of right bits, of which p itself has three.
    std::uint64_t inverse = prime;
    for (int round = 0; round < 5; ++round) inverse *= 2 - prime * inverse;
    negative_inverse_ = 0 - inverse;
  }

  std::uint64_t product(std::uint64_t a, std::uint64_t b) const {
    return reduce(internal::multiply_add(a, b, 0));
  }
  std::uint64_t difference(std::uint64_t a, std::uint64_t b) const { return a >= b ? a - b : a + prime_ - b; }
  /// Of x/2^64. REQUIRES |x| < 2^126.
  std::uint64_t residue(const Int128& x) const {
    const std::uint64_t size = reduce(magnitude(x));
    return x < 0 ? difference(0, size) : size;
  }

 private:
  /// x/2^64 modulo p: x plus a multiple of p below 2^64·p that makes the low word 0. REQUIRES x < 2^126, so
  /// that the result is below 3p before it is reduced.
  std::uint64_t reduce(TwoWords x) const {
    std::uint64_t result = internal::multiply_add(x.low * negative_inverse_, prime_, x.low).high + x.high;
    while (result >= prime_) result -= prime_;
    return result;
  }

  std::uint64_t prime_, negative_inverse_;
};

bool is_zero_modulo(std::uint64_t prime, const std::vector<Int128>& entries, std::size_t n,
                    std::vector<std::uint64_t>& a) {
  const Residues residues(prime);
  a.resize(n * n);
  for (std::size_t i = 0; i < n * n; ++i) a[i] = residues.residue(entries[i]);
  for (std::size_t s = 0; s < n; ++s) {
    std::size_t pivot = s;
    while (pivot < n && a[pivot * n + s] == 0) ++pivot;
    if (pivot == n) return true;
    for (std::size_t c = s; pivot != s && c < n; ++c) std::swap(a[pivot * n + c], a[s * n + c]);
    const std::uint64_t diagonal = a[s * n + s];
    for (std::size_t r = s + 1; r < n; ++r) {
      const std::uint64_t factor = a[r * n + s];
      if (factor == 0) continue;
      for (std::size_t c = s + 1; c < n; ++c)
        a[r * n + c] = residues.difference(residues.product(a[r * n + c], diagonal),
                                           residues.product(factor, a[s * n + c]));
    }
  }
  return false;
}

}  // namespace

bool is_zero_by_primes(const std::vector<Int128>& entries, int n, double bits) {
  std::vector<std::uint64_t> scratch;
  double proved = 0;
  for (const std::uint16_t gap : gaps) {
    internal::cancellation_point();
    if (!is_zero_modulo((std::uint64_t{1} << 62) - gap, entries, static_cast<std::size_t>(n), scratch))
      return false;
    proved += bits_of_prime;
    if (proved >= bits) return true;
  }
  return false;
}

}  // namespace delone::kernel
