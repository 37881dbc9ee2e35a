// SPDX-License-Identifier: BSD-3-Clause
// The one place where a dimension known at run time selects compiled code.
#pragma once

#include <cstddef>
#include <type_traits>
#include <utility>

namespace delone::internal {

/// The largest dimension that code is compiled for.
inline constexpr int largest_compiled_dimension = DELONE_LARGEST_COMPILED_DIMENSION;

/// Calls make(std::integral_constant<int, K>), with K = dimension if First ≤ dimension ≤ Last and else with K
/// = 0, and returns what it returns.
template <int First = 1, int Last = largest_compiled_dimension, class Make>
decltype(auto) with_compiled_dimension(std::size_t dimension, Make&& make) {
  if constexpr (First > Last) {
    return std::forward<Make>(make)(std::integral_constant<int, 0>{});
  } else {
    if (dimension == First) return std::forward<Make>(make)(std::integral_constant<int, First>{});
    return with_compiled_dimension<First + 1, Last>(dimension, std::forward<Make>(make));
  }
}

}  // namespace delone::internal
