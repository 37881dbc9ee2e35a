// SPDX-License-Identifier: BSD-3-Clause
// Proves that determinants of integers are zero.
#pragma once

#include "kernel/int128.hpp"

#include <vector>

namespace delone::kernel {

/// Whether a determinant of n rows is zero modulo so many primes that it must be zero: an integer below
/// 2^bits that is a multiple of all of them is 0, if their product is at least 2^bits. Returns false, too, if
/// the primes do not suffice
/// (`bits` above some 3900). A determinant that is not zero costs one elimination in words, mostly. REQUIRES
/// |entries| < 2^126, |determinant| < 2^bits. O(n³·bits).
bool is_zero_by_primes(const std::vector<Int128>& entries, int n, double bits);

}  // namespace delone::kernel
