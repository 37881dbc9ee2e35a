// SPDX-License-Identifier: BSD-3-Clause
// The only place where a dimension known at run time picks a compiled one.
#pragma once

#include "compiled/triangulation_engine.hpp"

namespace delone {

inline constexpr int largest_compiled_dimension = DELONE_LARGEST_COMPILED_DIMENSION;

/// Calls make(std::integral_constant<int, K>) with K = dimension where the engine is compiled for that, else with K = 0.
template <int K = 1, class Make>
auto with_compiled_dimension(std::size_t dimension, Make&& make) {
  if constexpr (K > largest_compiled_dimension) {
    return make(std::integral_constant<int, 0>{});
  } else {
    if (dimension == K) return make(std::integral_constant<int, K>{});
    return with_compiled_dimension<K + 1>(dimension, make);
  }
}

/// The hull compiled for axes.size() dimensions, or the one for run-time dimensions beyond 8 and when asked for.
std::unique_ptr<Hull> make_hull(const std::vector<int>& axes, const VertexPoints& points, const geometry::Frame& frame,
                                const engine::Effort& effort, bool force_runtime_dimension);

}  // namespace delone
