// SPDX-License-Identifier: BSD-3-Clause
// Level 6 of the check of a folder of tiles: every row of the input is in one part, and is a vertex, a
// duplicate of one or hidden; and the canonical hash.
#pragma once

#include "complex/canonical_hash.hpp"
#include "tiles/check/check_part.hpp"
#include "tiles/record_buckets.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace delone::tiles {

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
  void match_bucket(std::size_t bucket, Findings& findings);
  void compare_with_index(Findings& findings) const;

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
  std::int64_t num_vertices_ = 0, num_duplicates_ = 0, num_hidden_ = 0;
  double least_weight_ = 0, largest_weight_ = 0;
};

}  // namespace delone::tiles
