// SPDX-License-Identifier: BSD-3-Clause
// In which order sites came into a boundary, as far as that does not depend on timing. Where several threads
// may have inserted them, the ids of cells tell who was first, until cells are sorted by these places.
#pragma once

#include <delone/types.hpp>

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace delone::hull {

/// Vertices of the engine are sites + 1.
class InsertionPlaces {
 public:
  /// Sites come next, in this order; all are before `end`. Throws std::bad_alloc, and then changes nothing.
  void add(std::span<const Index> sites, std::size_t end) {
    if (places_.size() <= end) places_.resize(std::max(end + 1, places_.size() + places_.size() / 2), 0);
    for (const Index site : sites) places_[site + 1] = ++last_;
  }
  /// By vertex.
  std::span<const Index> of_vertices() const { return places_; }

 private:
  std::vector<Index> places_;
  Index last_ = 0;
};

}  // namespace delone::hull
