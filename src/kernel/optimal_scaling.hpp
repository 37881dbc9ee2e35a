// SPDX-License-Identifier: BSD-3-Clause
// Powers of two by which the rows and columns of a matrix are divided, so that all entries are at most 1 and
// those of the largest term of the determinant are near 1: the duals of an optimal assignment (Olschowka and
// Neumaier 1996, doi:10.1016/0024-3795(94)00084-2).
#pragma once

#include <cstdint>
#include <span>

namespace delone::kernel {

/// The exponent of an entry that is 0.
inline constexpr std::int64_t exponent_of_zero = -1'000'000;
/// The largest matrix that is scaled.
inline constexpr int most_scaled_columns = 12;

/// `exponents`: n·n numbers, row by row, in −10⁵ … 10⁵ or exponent_of_zero. Finds integers with exponents[i,
/// j] ≤ row[i] + column[j] everywhere, and equality at the entries of one permutation. Returns false if every
/// term of the determinant has a zero. REQUIRES 1 ≤ n ≤ most_scaled_columns. Cost O(n³).
bool scale_optimally(std::span<const std::int64_t> exponents, int n, std::int64_t* row, std::int64_t* column);

}  // namespace delone::kernel
