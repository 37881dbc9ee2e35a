// SPDX-License-Identifier: BSD-3-Clause
// Signs of determinants of integers. The type holds every minor; for elimination also products of two, less
// another.
#pragma once

#include "base/progress_meter.hpp"

#include <delone/types.hpp>

#include <bit>
#include <cstddef>
#include <utility>
#include <vector>

namespace delone::kernel {

template <class Integer>
Sign sign_of_integer(const Integer& x) {
  return x > 0 ? Sign::positive : x < 0 ? Sign::negative : Sign::zero;
}

/// Laplace expansion over all minors of the first rows: n·2^(n−1) products of a minor and an entry, no
/// division.
template <class Integer>
Sign sign_by_integer_minors(const std::vector<Integer>& a, int n) {
  std::vector<Integer> minors(std::size_t{1} << n, Integer(0));
  minors[0] = 1;
  for (std::size_t subset = 1; subset < minors.size(); ++subset) {
    const int row = std::popcount(subset) - 1;
    Integer sum(0);
    bool negate = (row & 1) != 0;  // the sign of the cofactor of the lowest column of the subset
    for (std::size_t rest = subset; rest != 0; rest &= rest - 1, negate = !negate) {
      const int c = std::countr_zero(rest);
      const Integer& entry = a[static_cast<std::size_t>(row * n + c)];
      const Integer& minor = minors[subset & ~(std::size_t{1} << c)];
      if (entry == 0 || minor == 0) continue;
      if (negate)
        sum -= entry * minor;
      else
        sum += entry * minor;
    }
    minors[subset] = std::move(sum);
  }
  return sign_of_integer(minors.back());
}

/// Fraction-free elimination (Bareiss 1968, doi:10.1090/S0025-5718-1968-0226829-0): every intermediate value
/// is a minor.
template <class Integer>
Sign sign_by_integer_elimination(std::vector<Integer> a, int n) {
  const auto at = [&](int r, int c) -> Integer& { return a[static_cast<std::size_t>(r * n + c)]; };
  Integer previous(1);
  bool negate = false;
  for (int s = 0; s + 1 < n; ++s) {
    int pivot = s;
    while (pivot < n && at(pivot, s) == 0) ++pivot;
    if (pivot == n) return Sign::zero;
    if (pivot != s) {
      for (int c = 0; c < n; ++c) std::swap(at(pivot, c), at(s, c));
      negate = !negate;
    }
    for (int r = s + 1; r < n; ++r) {
      internal::cancellation_point();
      for (int c = s + 1; c < n; ++c) at(r, c) = (at(r, c) * at(s, s) - at(r, s) * at(s, c)) / previous;
    }
    previous = at(s, s);
  }
  const Sign sign = sign_of_integer(at(n - 1, n - 1));
  return negate ? -sign : sign;
}

}  // namespace delone::kernel
