// SPDX-License-Identifier: BSD-3-Clause
// Homogeneous rows as rays: two rows are the same ray if one is a positive multiple of the other. Exact, no
// division.
#pragma once

#include <compare>

namespace delone::kernel {

/// A total order on rays of `size` entries that are finite and not all zero; equal exactly for the same ray.
/// By the last entry that is not zero: rays whose last entry has a lower index come first, among those of one
/// index the negative ones; the others are compared lexicographically after division by its magnitude. So
/// rows (x, 1) are in lexicographic order of x.
std::strong_ordering compare_rays(const double* a, const double* b, int size);

}  // namespace delone::kernel
