// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace delone::engine {

/// Whether wrapping n points that span k dimensions costs less than inserting them.
constexpr bool is_worth_wrapping(int k, std::size_t n) {
  return (k == 7 && 200 <= n && n <= 4000) || (k == 8 && 100 <= n && n <= 4000);
}

}  // namespace delone::engine
