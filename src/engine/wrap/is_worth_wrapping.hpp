// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace delone::engine {

/// Engines of fewer dimensions do not wrap: they never need to. For tests, which are quicker there, they do.
inline constexpr int least_wrapped_dimension = DELONE_LEAST_WRAPPED_DIMENSION;
constexpr bool can_wrap(int k) { return k >= least_wrapped_dimension; }

/// Whether wrapping n points that span k dimensions costs less than inserting them.
constexpr bool is_worth_wrapping(int k, std::size_t n) {
  return (k == 7 && 200 <= n && n <= 4000) || (k == 8 && 100 <= n && n <= 4000);
}

}  // namespace delone::engine
