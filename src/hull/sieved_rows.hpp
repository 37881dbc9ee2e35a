// SPDX-License-Identifier: BSD-3-Clause
// The rows of the first batch of a hull, if rows of it are known to be interior and have no site. All that is
// left of these rows are their coordinates. Which of them are equal is found out when somebody asks.
#pragma once

#include <delone/types.hpp>

#include <cstddef>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

namespace delone::hull {

class SievedRows {
 public:
  SievedRows() = default;
  /// `rows`: those without a site, increasing.
  SievedRows(std::span<const double> coordinates, int dimension, std::vector<Index> rows)
      : coordinates_(coordinates.begin(), coordinates.end()), dimension_(dimension), rows_(std::move(rows)) {}
  SievedRows(const SievedRows& other);
  SievedRows& operator=(SievedRows&& other) noexcept;

  bool empty() const { return rows_.empty(); }
  /// Without a site, increasing.
  const std::vector<Index>& rows() const { return rows_; }
  /// Any row of the batch.
  const double* point(std::size_t row) const {
    return coordinates_.data() + row * static_cast<std::size_t>(dimension_);
  }
  /// For each of rows(), the first row that is equal to it. Computed on first use, O(rows); safe to call from
  /// several threads.
  const std::vector<Index>& first_rows() const;
  /// How many of rows() are equal to an earlier one.
  std::size_t num_duplicates() const;

 private:
  std::vector<double> coordinates_;
  int dimension_ = 0;
  std::vector<Index> rows_;
  mutable std::mutex mutex_;
  mutable std::optional<std::vector<Index>> first_rows_;
};

}  // namespace delone::hull
