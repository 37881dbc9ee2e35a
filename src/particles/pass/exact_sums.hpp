// SPDX-License-Identifier: BSD-3-Clause
// Sums of doubles that do not depend on the order of the terms, to the last bit (Demmel and Nguyen 2013,
// doi:10.1109/ARITH.2013.9).
//
// Let N = 2^L be more than the number of terms, and |x| ≤ 2^e. With A = 1.5·2^(e+L), the sum x + A is in
// [2^(e+L), 2^(e+L+1)], where doubles are multiples of a quantum q = 2^(e+L−52). So (x + A) − A is the
// nearest multiple of q. Its difference from x is at most q/2 and exact. Sums of such multiples are exact,
// as they are at most N·2^e = 2^52·q. The rest is split in the same way, with e + L − 52 in place
// of e. After two levels a term has lost at most 2^(e+2L−105).
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

namespace delone::particles {

class TermSplitter {
 public:
  /// Of `count` terms that are at most `largest` in magnitude. Beyond the range of this method, 2^±900, terms
  /// are not split.
  TermSplitter(double largest, std::size_t count)
      : log_count_(std::bit_width(count)), levels_(count <= 4096 ? 2 : 4) {
    set_constant(largest);
  }
  /// Returns the first part of x, and subtracts it from x.
  double take(double& x) const {
    const double part = (x + constant_) - constant_;
    x -= part;
    return part;
  }
  double constant() const { return constant_; }
  /// Goes on to what is left of the terms. Returns false if nothing that counts is left.
  bool next() {
    if (--levels_ == 0 || constant_ == 0) return false;
    set_constant(constant_ * (0x1p-53 / 1.5));
    return true;
  }

 private:
  void set_constant(double largest) {
    constant_ = 0;
    if (!(largest >= 0x1p-900 && largest < 0x1p900)) return;
    const int exponent = static_cast<int>(std::bit_cast<std::uint64_t>(largest) >> 52) + 1 + log_count_;
    constant_ = 1.5 * std::bit_cast<double>(static_cast<std::uint64_t>(exponent) << 52);
  }

  int log_count_, levels_;
  double constant_ = 0;
};

inline double largest_magnitude(std::span<const double> terms) {
  double largest = 0;
  for (const double x : terms) largest = std::max(largest, std::abs(x));
  return largest;
}

/// The sum, the same for any order of the terms: what is left of them after all levels is dropped. Terms are
/// split in place.
inline double exact_sum(std::span<double> terms) {
  double sum = 0;
  TermSplitter splitter(largest_magnitude(terms), terms.size());
  do {
    double part = 0;
    for (double& x : terms) part += splitter.take(x);
    sum += part;
  } while (splitter.next());
  return sum;
}

}  // namespace delone::particles
