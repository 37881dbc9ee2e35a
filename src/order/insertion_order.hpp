// SPDX-License-Identifier: BSD-3-Clause
// Points → the order in which to insert them: rounds, each sorted along a Hilbert curve. Knows coordinates
// only.
#pragma once

#include <delone/options.hpp>
#include <delone/types.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace delone::order {

/// The rows 0…n−1 in the order that the options name. `rounds`, if there are any, receives where rounds end
/// that cover the whole set, ascending: within one of them, stretches far from each other have points far
/// from each other. Up to Options::threads threads share the work; the order does not depend on them.
std::vector<Index> insertion_order(PointsView points, const Options& options,
                                   std::vector<std::size_t>* rounds = nullptr);

/// BRIO (Amenta, Choi, Rote 2003, doi:10.1145/777792.777824): the rows 0…n−1 in random rounds of growing
/// size, each round sorted along a d-dimensional Hilbert curve by coordinate comparisons only (RR-6743,
/// appendix A). Deterministic in (points, seed); `threads` of this and of the next two: as of hilbert_sort().
std::vector<Index> brio_order(PointsView points, std::uint64_t seed,
                              std::vector<std::size_t>* rounds = nullptr, unsigned threads = 1);

/// The rows 0…n−1 in rounds, each of which doubles the number of points. A round takes points that are far
/// from those before it: within a block of the Hilbert curve, each is the farthest from those chosen before
/// it. Within a round points are sorted along the curve, and the last rounds of each stretch of the curve
/// come together. Deterministic in (points, seed). Cost O(n log n), and O(d) times the size of a block per
/// point for the distances; memory O(n·d).
std::vector<Index> spread_order(PointsView points, std::uint64_t seed,
                                std::vector<std::size_t>* rounds = nullptr, unsigned threads = 1);

/// brio_order() in the plane, where choosing far points costs more than the cells it saves, and else
/// spread_order().
inline std::vector<Index> automatic_order(PointsView points, std::uint64_t seed,
                                          std::vector<std::size_t>* rounds = nullptr, unsigned threads = 1) {
  return points.dimension() <= 2 ? brio_order(points, seed, rounds, threads)
                                 : spread_order(points, seed, rounds, threads);
}

/// A uniformly random permutation of 0…n−1. Deterministic in (n, seed).
std::vector<Index> shuffled_order(std::size_t n, std::uint64_t seed);

/// Sorts rows along a d-dimensional Hilbert curve by recursive median splits. It only compares coordinates of
/// one axis with each other: no scale, unit or offset of an axis matters. Equal coordinates are ordered by
/// row. A thousand rows and more in 2 to 4 dimensions are first distributed to equal cubes along the curve,
/// which is several times faster; cubes with many rows are split at medians. The axes are split in the order
/// first_axis, first_axis − 1, … (mod d). m rows are halved ⌈log2 m⌉ times, so with m ≤ 2^(d−1) some axes are
/// never used. As different axes may have different units, no axis is preferred; the rounds of brio_order()
/// start with different axes instead. REQUIRES 0 ≤ first_axis < d. O(m log m) expected; memory O(m·d) for d ≤
/// 4, O(m) beyond. Up to `threads` threads distribute rows to cubes; the result does not depend on them.
void hilbert_sort(PointsView points, std::span<Index> rows, int first_axis = 0, unsigned threads = 1);

}  // namespace delone::order
