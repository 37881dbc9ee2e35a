// SPDX-License-Identifier: BSD-3-Clause
// Vertices to be inserted, as the loops of build.hpp and parallel_insertion.hpp are given them.
#pragma once

#include "base/parallel.hpp"

#include <delone/types.hpp>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <span>

namespace delone::engine {

/// Vertices to be inserted.
struct Batch {
  unsigned threads;     ///< several are used once there are enough cells for them
  Index first;          ///< vertices first, first + 1, …, in the order of insertion; but see `steps`
  std::span<Index> at;  ///< receives, for each, the vertex at its point, or invalid_index if it is hidden
  /// Where stretches of the order end that cover the whole set, ascending. One thread does not need them.
  std::span<const std::size_t> rounds = {};
  /// Called often in the calling thread, and in no other, with the number of vertices inserted. May throw to
  /// end the batch.
  std::function<void(std::size_t done)> tick = {};

  /// If not empty, the vertices are first + steps[0], first + steps[1], …
  std::span<const Index> steps = {};
  std::size_t num_before = 0;  ///< with steps: about how many vertices there are
  /// If not empty, receives 1 for each vertex that is certainly on the hyperplane of no cell, else 0.
  std::span<char> strictly = {};

  std::size_t size() const { return at.size(); }
  Index vertex(std::size_t i) const { return first + (steps.empty() ? static_cast<Index>(i) : steps[i]); }
  /// The greatest id. REQUIRES a vertex.
  Index last_vertex() const {
    if (steps.empty()) return first + static_cast<Index>(at.size()) - 1;
    return first + *std::max_element(steps.begin(), steps.end());
  }
  std::size_t vertices_before() const { return steps.empty() ? first : num_before; }
  void note_strictly(std::size_t i, bool is_strictly) const {
    if (!strictly.empty()) strictly[i] = is_strictly ? 1 : 0;
  }
};

/// How many threads insert a batch of n vertices into cells of k dimensions. `requested`: as
/// Options::threads; 0 is one thread where the batch takes less than a few milliseconds.
inline unsigned threads_for_batch(unsigned requested, std::size_t n, int k) {
  constexpr std::size_t enough[] = {100000, 100000, 30000, 8000, 2000, 800, 400};
  if (requested == 0 && n < enough[std::clamp(k, 0, 6)]) return 1;
  return internal::threads_to_use(requested);
}

}  // namespace delone::engine
