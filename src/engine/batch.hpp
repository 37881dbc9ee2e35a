// SPDX-License-Identifier: BSD-3-Clause
// What the loops of build.hpp and parallel_insertion.hpp are given where the dimension is not known to the
// compiler.
#pragma once

#include <delone/types.hpp>

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
  Index first;          ///< vertices first, first + 1, …, in the order of insertion
  std::span<Index> at;  ///< receives, for each, what Batch::placed() is told
  std::span<const std::size_t>
      rounds;  ///< where stretches of the order end that cover the whole set, ascending
  /// Called often in the calling thread, and in no other, with the number of vertices inserted. May throw to
  /// end the batch.
  std::function<void(std::size_t done)> tick;
};

}  // namespace delone::engine
