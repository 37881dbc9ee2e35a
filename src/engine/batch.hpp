// SPDX-License-Identifier: BSD-3-Clause
// What the loop of build.hpp is given where the dimension is not known to the compiler: two virtual calls per
// insertion.
#pragma once

#include <delone/types.hpp>

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

}  // namespace delone::engine
