// SPDX-License-Identifier: BSD-3-Clause
// Which cells of a triangulation are thick: have a least height greater than a tolerance.
#pragma once

#include "kernel/nearest_in_hull.hpp"

#include <delone/complex.hpp>

#include <atomic>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace delone::queries {

/// The sign of (least height − τ) of a simplex of m ≥ 2 affinely independent points of R^dimension, exactly.
/// The height of a vertex is its distance from the affine hull of the others. τ ≥ 0, finite.
Sign compare_least_height(std::span<const double* const> points, int dimension, double tolerance);

/// The kinds of cells, for one tolerance; each is decided when it is first needed. May be used from several
/// threads at once.
class ThickCells {
 public:
  ThickCells(std::size_t num_slots, double tolerance);

  double tolerance() const { return tolerance_; }
  /// Whether the least height of a finite cell with these points exceeds the tolerance; that of a cell of
  /// dimension 0 does. `work` keeps memory from call to call.
  bool is_thick(CellId cell, std::span<const double* const> points, int dimension,
                kernel::NearestInHull& work) const;
  /// All thick cells, if keep_list() has got them, else null.
  const std::vector<CellId>* list() const { return list_.load(std::memory_order_acquire); }
  /// Keeps the list of all thick cells that find() returns. One thread finds them; calls of others that come
  /// meanwhile do nothing. If find() throws, the next call tries again.
  template <class Find>
  void keep_list(Find find) const {
    if (is_listing_.exchange(true)) return;
    try {
      cells_ = find();
    } catch (...) {
      is_listing_ = false;
      throw;
    }
    list_.store(&cells_, std::memory_order_release);
  }

  /// Whether the cell is known to be thick.
  bool is_known_thick(CellId cell) const {
    return kinds_[index(cell)].load(std::memory_order_relaxed) == Kind::thick;
  }

 private:
  enum class Kind : unsigned char { unknown, thin, thick };

  double tolerance_;
  std::unique_ptr<std::atomic<Kind>[]> kinds_;
  mutable std::vector<CellId> cells_;
  mutable std::atomic<const std::vector<CellId>*> list_ = nullptr;
  mutable std::atomic<bool> is_listing_ = false;
};

}  // namespace delone::queries
