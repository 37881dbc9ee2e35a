// SPDX-License-Identifier: BSD-3-Clause
// The rows of vertices where all are kept in memory: by the geometry of one thread, and read by those of
// others.
#pragma once

#include "base/growable_array.hpp"

#include <delone/types.hpp>

#include <algorithm>
#include <cstddef>

namespace delone::geometry {

class KeptRows {
 public:
  explicit KeptRows(std::size_t width) : width_(width) {}
  /// Those of another object, for another thread: all vertices must have theirs, and they must stay where
  /// they are while this object is in use.
  struct ForThread {};
  KeptRows(const KeptRows& shared, ForThread) : width_(shared.width_), shared_(shared.data()) {}

  const double* data() const { return shared_ != nullptr ? shared_ : rows_.data(); }
  /// Makes room for the rows of vertices up to `last`. Throws std::bad_alloc, and then changes nothing.
  void reserve(Index last) {
    const std::size_t size = (static_cast<std::size_t>(last) + 1) * width_;
    if (shared_ == nullptr && size > rows_.capacity()) rows_.reserve(size + size / 2);
  }
  /// The row of a vertex, to be written. REQUIRES that it is not shared.
  double* row(Index v) { return rows_.data() + v * width_; }
  /// Sets the row of a vertex, unless it is shared: then it is known.
  void set(Index v, const double* row) {
    if (shared_ == nullptr) std::copy_n(row, width_, rows_.data() + v * width_);
  }

 private:
  std::size_t width_;
  internal::GrowableArray<double> rows_;
  const double* shared_ = nullptr;
};

}  // namespace delone::geometry
