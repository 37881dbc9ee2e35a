// SPDX-License-Identifier: BSD-3-Clause
// All points in the order of a k-d tree, cut into pages of neighboring points. A search reads the boxes of
// pages, which are always there; the points of a page come when a question reaches it.
#pragma once

#include "io/crc32.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace delone::pages {

/// The points of a page.
struct Page {
  /// Axis by axis: coordinate j of point i is number j·stride() + i; then the weights if points have weights.
  /// What is between size() and stride() is finite and means nothing.
  std::vector<double> coordinates;
  std::vector<std::int64_t> rows;  ///< of the input: the first of equal points

  std::size_t size() const { return rows.size(); }
  std::size_t stride() const { return stride_of(size()); }
  static std::size_t stride_of(std::size_t size) { return (size + 7) / 8 * 8; }
  /// One point: its coordinates, and its weight.
  void copy_point(std::size_t i, double* point) const {
    for (std::size_t at = i; at < coordinates.size(); at += stride()) *point++ = coordinates[at];
  }
};

/// A tile: consecutive pages, and the box outside which all other points lie.
struct Tile {
  std::size_t first_page = 0, last_page = 0;  ///< the pages first_page … last_page − 1
  /// d numbers each, infinite where no other tile is beyond: no point of another tile is strictly inside.
  std::vector<double> low, high;
};

/// What is known of all pages, everywhere.
struct PageTable {
  int dimension = 0;                       ///< d
  bool weighted = false;                   ///< rows of points have d + 1 numbers
  std::vector<std::uint64_t> first_point;  ///< of each page in the order, and the number of distinct points
  std::vector<double> boxes;               ///< 2d numbers per page: the least and the largest coordinates
  std::vector<double> weights;             ///< the largest weight of each page, if points have weights
  std::vector<Tile> tiles;
  /// How many duplicates the tiles before each have, and all have.
  std::vector<std::uint64_t> first_duplicate{0};
  /// What make_page_file() has written: the pages, and the duplicates.
  io::FileContent pages_content, duplicates_content;

  std::size_t num_pages() const { return first_point.empty() ? 0 : first_point.size() - 1; }
  /// Distinct ones.
  std::size_t num_points() const { return first_point.empty() ? 0 : first_point.back(); }
  std::size_t row_size() const { return static_cast<std::size_t>(dimension) + (weighted ? 1 : 0); }
  std::size_t page_size(std::size_t p) const { return first_point[p + 1] - first_point[p]; }
  const double* low(std::size_t p) const {
    return boxes.data() + p * 2 * static_cast<std::size_t>(dimension);
  }
  const double* high(std::size_t p) const { return low(p) + dimension; }
};

/// Where the points of pages come from: a file, or other processes.
class PageSource {
 public:
  virtual ~PageSource() = default;
  /// The points of a page; null if they are not here yet, and the page is wanted from now on. May be called
  /// from several threads at once.
  virtual std::shared_ptr<const Page> find(std::size_t page) = 0;
};

}  // namespace delone::pages
