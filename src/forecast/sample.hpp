// SPDX-License-Identifier: BSD-3-Clause
// Random subsets of points that do not depend on the order of rows: those whose hashes are smallest.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace delone::cost_model {

struct Sample {
  std::vector<std::size_t> rows;  ///< of distinct points, in the order of their hashes
  double num_distinct = 0;        ///< of all points; exact if all are in the sample
  bool is_all = false;
};

/// About `most` distinct points, or all if there are no more. Of equal ones the first row counts. O(n·d).
Sample sample_of(std::span<const double> coordinates, int dimension, std::size_t most);

}  // namespace delone::cost_model
