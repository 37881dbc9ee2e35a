// SPDX-License-Identifier: BSD-3-Clause
// The spatial sorting of the report, for comparison with the library's own order: points are split at the
// median, recursively, along the axes in which a Hilbert curve splits its cube (its Appendix A, where the
// axes are found by probing the curve; here they follow from the state of the curve, after Hamilton, "Compact
// Hilbert indices", Dalhousie University CS-2006-07 (2006)). Only coordinates are compared, so that the
// points need no scaling.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <random>
#include <span>
#include <vector>

namespace spatial_sort {

/// Sorts rows of points along the curve.
class HilbertSort {
 public:
  HilbertSort(std::span<const double> coordinates, int dimension)
      : coordinates_(coordinates), dimension_(static_cast<unsigned>(dimension)) {}

  void operator()(std::span<std::size_t> rows) const { sort_cube(rows, State{}); }

 private:
  using Mask = std::uint64_t;
  /// How the curve lies in a cube: the corner it enters, and the axis of its first step.
  struct State {
    Mask entry = 0;
    unsigned direction = 0;
  };

  void sort_cube(std::span<std::size_t> rows, State state) const {
    if (rows.size() > 1) split(rows, state, dimension_, 0);
  }

  /// Splits off one bit, the (left−1)-th, of the position of a child cube on the curve; `position` holds the
  /// bits above it.
  void split(std::span<std::size_t> rows, State state, unsigned left, Mask position) const {
    if (rows.size() < 2) return;
    if (left == 0) return sort_cube(rows, child(state, position));
    const unsigned axis = (left - 1 + state.direction + 1) % dimension_;
    // The Gray code of the position has, at this bit, the bit itself xor the one above it.
    const bool descending = ((position & 1U) ^ ((state.entry >> axis) & 1U)) != 0;
    const auto middle = rows.begin() + static_cast<std::ptrdiff_t>(rows.size() / 2);
    std::nth_element(rows.begin(), middle, rows.end(), [&](std::size_t a, std::size_t b) {
      const double x = coordinates_[a * dimension_ + axis], y = coordinates_[b * dimension_ + axis];
      return descending ? y < x : x < y;
    });
    split(rows.first(rows.size() / 2), state, left - 1, position << 1U);
    split(rows.subspan(rows.size() / 2), state, left - 1, position << 1U | 1U);
  }

  Mask rotated(Mask mask, unsigned by) const {
    by %= dimension_;
    const Mask all = (Mask{1} << dimension_) - 1;
    return ((mask << by) | (mask >> (dimension_ - by))) & all;
  }

  State child(State state, Mask position) const {
    const Mask before = position == 0 ? 0 : (position - 1) & ~Mask{1};
    const Mask entry = before ^ (before >> 1U);
    const Mask run = position == 0 ? 0 : position % 2 == 0 ? position - 1 : position;
    const unsigned turn = position == 0 ? 0 : trailing_ones(run);
    return {state.entry ^ rotated(entry, state.direction + 1), (state.direction + turn + 1) % dimension_};
  }

  static unsigned trailing_ones(Mask mask) {
    unsigned count = 0;
    for (; (mask & 1U) != 0; mask >>= 1U) ++count;
    return count;
  }

  std::span<const double> coordinates_;
  unsigned dimension_;
};

/// All rows, along one curve.
inline std::vector<std::size_t> curve(std::span<const double> coordinates, int dimension) {
  std::vector<std::size_t> rows(coordinates.size() / static_cast<std::size_t>(dimension));
  std::iota(rows.begin(), rows.end(), std::size_t{0});
  HilbertSort(coordinates, dimension)(rows);
  return rows;
}

/// Rounds of random rows, each sorted along the curve (Amenta, Choi and Rote, doi:10.1145/777792.777824),
/// with the sizes that the manual of CGAL documents for its function spatial_sort: the share of a round that
/// goes before it is 1/4 in the plane, 1/8 in space and 1/20 beyond, and the first round has at most 16, 64
/// and 500 rows.
inline std::vector<std::size_t> rounds(std::span<const double> coordinates, int dimension,
                                       std::uint64_t seed) {
  std::vector<std::size_t> rows(coordinates.size() / static_cast<std::size_t>(dimension));
  std::iota(rows.begin(), rows.end(), std::size_t{0});
  std::shuffle(rows.begin(), rows.end(), std::mt19937_64(seed));
  const double share = dimension == 2 ? 0.25 : dimension == 3 ? 0.125 : 0.05;
  const std::size_t first_round = dimension == 2 ? 16 : dimension == 3 ? 64 : 500;
  const HilbertSort sort(coordinates, dimension);
  for (std::span<std::size_t> left = rows; !left.empty();) {
    const std::size_t before =
        left.size() < first_round ? 0 : static_cast<std::size_t>(share * static_cast<double>(left.size()));
    sort(left.subspan(before));
    left = left.first(before);
  }
  return rows;
}

/// The points in the order of the rows.
inline std::vector<double> permuted(std::span<const double> coordinates, int dimension,
                                    std::span<const std::size_t> rows) {
  const auto d = static_cast<std::size_t>(dimension);
  std::vector<double> sorted;
  sorted.reserve(coordinates.size());
  for (const std::size_t row : rows)
    sorted.insert(sorted.end(), &coordinates[row * d], &coordinates[row * d] + d);
  return sorted;
}

}  // namespace spatial_sort
