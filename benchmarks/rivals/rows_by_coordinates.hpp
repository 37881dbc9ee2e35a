// SPDX-License-Identifier: BSD-3-Clause
// Finds the input row of a peer's vertex by its coordinates, so that the timed triangulations hold nothing
// but points and may permute them. Duplicates stand for their first row.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <stdexcept>
#include <vector>

namespace rival {

class RowsByCoordinates {
 public:
  RowsByCoordinates(std::vector<double> coordinates, int dimension)
      : coordinates_(std::move(coordinates)),
        dimension_(static_cast<std::size_t>(dimension)),
        rows_(coordinates_.size() / dimension_) {
    std::iota(rows_.begin(), rows_.end(), std::size_t{0});
    std::stable_sort(rows_.begin(), rows_.end(),
                     [&](std::size_t a, std::size_t b) { return less(point(a), point(b)); });
  }

  std::int64_t operator()(std::span<const double> point_of_vertex) const {
    const auto found =
        std::lower_bound(rows_.begin(), rows_.end(), point_of_vertex,
                         [&](std::size_t row, std::span<const double> p) { return less(point(row), p); });
    if (found == rows_.end() || less(point_of_vertex, point(*found)))
      throw std::logic_error("a vertex that is no input point");
    return static_cast<std::int64_t>(*found);
  }

 private:
  std::span<const double> point(std::size_t row) const {
    return {&coordinates_[row * dimension_], dimension_};
  }
  static bool less(std::span<const double> a, std::span<const double> b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
  }

  std::vector<double> coordinates_;
  std::size_t dimension_;
  std::vector<std::size_t> rows_;
};

}  // namespace rival
