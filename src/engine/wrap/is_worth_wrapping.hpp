// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace delone::engine {

/// Only engines of 7 and 8 dimensions are ever asked to wrap (below). Developer builds compile wrapping from
/// two dimensions on, where tests are quick.
inline constexpr int least_wrapped_dimension = DELONE_LEAST_WRAPPED_DIMENSION;
constexpr bool can_wrap(int k) { return k >= least_wrapped_dimension; }

/// Whether wrapping n points that span k dimensions costs less than inserting them.
constexpr bool is_worth_wrapping(int k, std::size_t n) {
  return (k == 7 && 200 <= n && n <= 4000) || (k == 8 && 100 <= n && n <= 4000);
}

}  // namespace delone::engine
