// SPDX-License-Identifier: BSD-3-Clause
// What the loops of build.hpp and parallel_insertion.hpp are given where the dimension is not known to the
// compiler.
#pragma once

#include "base/parallel.hpp"

#include <delone/types.hpp>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <span>

namespace delone::engine {

/// Vertices to be inserted.
class Batch {
 public:
  /// The next vertex, in the order of insertion, or invalid_index after the last.
  virtual Index next() = 0;
  /// What has become of vertex v: `at` is v, the vertex that was at its point already, or invalid_index if v
  /// is hidden; `strictly`: for certain not on the hyperplane of any cell. May throw to end the loop.
  virtual void placed(Index v, Index at, bool strictly) = 0;

 protected:
  ~Batch() = default;
};

/// Vertices to be inserted by several threads at once.
struct ParallelBatch {
  unsigned threads;
  Index first;          ///< vertices first, first + 1, …, in the order of insertion; but see `steps`
  std::span<Index> at;  ///< receives, for each, what Batch::placed() is told
  std::span<const std::size_t>
      rounds;  ///< where stretches of the order end that cover the whole set, ascending
  /// Called often in the calling thread, and in no other, with the number of vertices inserted. May throw to
  /// end the batch.
  std::function<void(std::size_t done)> tick = {};

  /// If not empty, the vertices are first + steps[0], first + steps[1], …
  std::span<const Index> steps = {};
  std::size_t num_before = 0;     ///< with steps: about how many vertices there are
  std::span<char> strictly = {};  ///< if not empty, receives 1 where placed() is told so, else 0

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
