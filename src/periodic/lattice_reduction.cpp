// SPDX-License-Identifier: BSD-3-Clause
#include "periodic/lattice_reduction.hpp"

#include "base/progress_meter.hpp"
#include "kernel/grid.hpp"

#include <algorithm>
#include <limits>

namespace delone::periodic {

namespace {

using kernel::Integer;

/// The integer nearest to a/b, b > 0; of two the larger one.
Integer nearest_quotient(const Integer& a, const Integer& b) {
  const Integer doubled = 2 * a + b, divisor = 2 * b;
  Integer quotient = doubled / divisor;
  if (quotient * divisor > doubled) quotient -= 1;
  return quotient;
}

class Reducer {
 public:
  Reducer(std::vector<Integer>& rows, std::size_t rank)
      : rows_(rows), rank_(rank), width_(rows.size() / rank), sums_(rank * rank) {
    for (std::size_t i = 0; i < rank; ++i) sums_[i * rank + i] = 1;
  }

  std::vector<Integer> reduce() {
    do {
      internal::cancellation_point();
    } while (shorten_by_pairs() || shorten_by_sums());
    return std::move(sums_);
  }

 private:
  Integer dot(std::size_t a, std::size_t b) const {
    Integer sum = 0;
    for (std::size_t j = 0; j < width_; ++j) sum += rows_[a * width_ + j] * rows_[b * width_ + j];
    return sum;
  }
  /// Adds `factor` times row b to row a.
  void add(std::size_t a, const Integer& factor, std::size_t b) {
    for (std::size_t j = 0; j < width_; ++j) rows_[a * width_ + j] += factor * rows_[b * width_ + j];
    for (std::size_t j = 0; j < rank_; ++j) sums_[a * rank_ + j] += factor * sums_[b * rank_ + j];
  }

  bool shorten_by_pairs() {
    bool any = false;
    for (std::size_t a = 0; a < rank_; ++a)
      for (std::size_t b = 0; b < rank_; ++b) {
        if (a == b) continue;
        const Integer before = dot(a, a), factor = -nearest_quotient(dot(a, b), dot(b, b));
        if (factor == 0) continue;
        add(a, factor, b);
        if (dot(a, a) < before)
          any = true;
        else
          add(a, -factor, b);
      }
    return any;
  }

  /// Three dimensions at least: one vector plus or minus two others. That is all there is to reduce in three
  /// dimensions (Nguyen and Stehlé 2009, doi:10.1145/1597036.1597050).
  bool shorten_by_sums() {
    for (std::size_t a = 0; a < rank_; ++a)
      for (std::size_t b = 0; b < rank_; ++b)
        for (std::size_t c = b + 1; c < rank_; ++c) {
          if (a == b || a == c) continue;
          const Integer before = dot(a, a);
          for (const int of_b : {-1, 1})
            for (const int of_c : {-1, 1}) {
              add(a, of_b, b);
              add(a, of_c, c);
              if (dot(a, a) < before) return true;
              add(a, -of_b, b);
              add(a, -of_c, c);
            }
        }
    return false;
  }

  std::vector<Integer>& rows_;
  const std::size_t rank_, width_;
  std::vector<Integer> sums_;
};

}  // namespace

IntegerRows integers_of(std::span<const double> numbers) {
  IntegerRows rows;
  rows.grid = std::numeric_limits<int>::max();
  for (const double x : numbers) rows.grid = std::min(rows.grid, kernel::trailing_exponent(x));
  if (rows.grid == std::numeric_limits<int>::max()) rows.grid = 0;
  for (const double x : numbers) rows.entries.push_back(kernel::scaled_integer(x, rows.grid));
  return rows;
}

std::vector<Integer> gram_matrix(std::span<const Integer> rows, std::size_t rank) {
  std::vector<Integer> products;
  if (rank == 0) return products;
  const std::size_t width = rows.size() / rank;
  for (std::size_t a = 0; a < rank; ++a)
    for (std::size_t b = 0; b < rank; ++b) {
      Integer sum = 0;
      for (std::size_t j = 0; j < width; ++j) sum += rows[a * width + j] * rows[b * width + j];
      products.push_back(std::move(sum));
    }
  return products;
}

std::vector<Integer> reduce_lattice(std::vector<Integer>& rows, std::size_t rank) {
  if (rank == 0) return {};
  return Reducer(rows, rank).reduce();
}

}  // namespace delone::periodic
