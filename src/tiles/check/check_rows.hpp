// SPDX-License-Identifier: BSD-3-Clause
// Level 6 of the check of a folder of tiles: every row of the input is in one part, and is a vertex, a
// duplicate of one or hidden; and the canonical hash.
#pragma once

#include "complex/canonical_hash.hpp"
#include "tiles/check/check_part.hpp"
#include "tiles/record_buckets.hpp"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace delone::tiles {

/// Throws a Violation unless index.json says the same. `what`: as in "there are 3 vertices".
void compare_with_index(const char* what, std::int64_t found, std::int64_t expected);
void compare_with_index(const CanonicalHash& found, const TilesIndex& index);

/// Numbers of rows.
struct RoleCounts {
  std::int64_t vertices = 0, duplicates = 0, hidden = 0;

  /// A row that is at a vertex; −1: hidden.
  void add(std::int64_t row, std::int64_t vertex) {
    (vertex < 0 ? hidden : vertex == row ? vertices : duplicates) += 1;
  }
  /// Throws a Violation.
  void compare_with_index(const TilesIndex& index) const;
};

/// What parts say of the rows first … last − 1. Each is in one part: as a vertex of cells, merged into an
/// earlier row that is one, or hidden. All throw a Violation that names the row.
class RowRoles {
 public:
  RowRoles(std::int64_t first, std::int64_t last);

  /// A part has the row, and says at which vertex it is.
  void add(std::int64_t row, std::int64_t vertex, std::size_t part);
  /// The vertex that the row is at, or −1. `has_cell`: whether it is a vertex of a cell.
  std::int64_t vertex_of(std::int64_t row, bool has_cell) const;
  /// REQUIRES that the vertex is one of these rows, whichever the row is.
  void require_earlier_vertex(std::int64_t row, std::int64_t vertex) const;

 private:
  std::size_t at(std::int64_t row) const { return static_cast<std::size_t>(row - first_); }

  std::int64_t first_;
  std::vector<std::int64_t> vertices_;
  std::vector<std::size_t> parts_;
};

class RowChecker {
 public:
  /// `words`: about how many numbers of rows and coordinates will come. `input`: all points, each with its
  /// weight if points have one, to be compared with; or null.
  RowChecker(const TilesIndex& index, const std::string& scratch, std::uint64_t words, std::uint64_t memory,
             const double* input);

  void add(const CheckedPart& part, Findings& findings);
  void match(Findings& findings);

 private:
  std::size_t bucket_of(std::int64_t row) const { return static_cast<std::size_t>(row / rows_per_bucket_); }
  void match_bucket(std::size_t bucket);
  void compare_with_index() const;

  const double* input_of(std::int64_t row) const {
    return input_ + static_cast<std::size_t>(row) * row_size_;
  }

  const TilesIndex& index_;
  const double* input_;
  std::size_t row_size_;
  std::int64_t rows_per_bucket_;
  RecordBuckets owned_;   ///< row, part, vertex of the row
  RecordBuckets seen_;    ///< row, part, coordinates and weight: the vertices of cells
  RecordBuckets merged_;  ///< vertex, the row that was merged into it
  complex::HashAccumulator hash_, weighted_hash_;
  RoleCounts counts_;
  double least_weight_ = std::numeric_limits<double>::infinity(), largest_weight_ = -least_weight_;
};

}  // namespace delone::tiles
