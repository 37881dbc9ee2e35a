// SPDX-License-Identifier: BSD-3-Clause
// The maximal minors of d rows of d+1 entries: the ray on which d independent functions are zero.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace delone::polyhedra {

/// The largest d.
inline constexpr std::size_t most_rows_of_minors = 6;

/// out[c] = (−1)^c · the minor without column c, so that row · out is a determinant, and 0 for each of the d
/// rows: row_at(i)[c] for i < d and c ≤ d. Every product of entries is added once, so with signs of all terms
/// positive (`is_magnitude`, and rows of magnitudes) these are the sums of the magnitudes of the products.
///
/// Laplace expansion by rows, one minor of the first rows for each set of columns: d·2^d products.
template <bool is_magnitude = false, class T, class RowAt>
void find_minors(std::size_t d, const RowAt& row_at, T* out) {
  std::array<T, std::size_t{1} << (most_rows_of_minors + 1)> minors;
  const std::size_t columns = d + 1, all = (std::size_t{1} << columns) - 1;
  for (std::size_t set = 1; set < all; ++set) {
    const auto row = static_cast<std::size_t>(std::popcount(set)) - 1;
    T sum{};
    bool is_negative = false;  // the sign of the last column is positive
    for (std::size_t c = columns; c-- > 0;) {
      if ((set >> c & 1) == 0) continue;
      const T entry = row_at(row, c);
      const T term = row == 0 ? entry : entry * minors[set & ~(std::size_t{1} << c)];
      if (!is_magnitude && is_negative)
        sum = sum - term;
      else
        sum = sum + term;
      is_negative = !is_negative;
    }
    minors[set] = sum;
  }
  for (std::size_t c = 0; c < columns; ++c) {
    out[c] = minors[all & ~(std::size_t{1} << c)];
    if (!is_magnitude && c % 2 == 1) out[c] = -out[c];
  }
}

}  // namespace delone::polyhedra
