// SPDX-License-Identifier: BSD-3-Clause
// Smallest orthospheres of simplices with up to 6 vertices: SIMD with one simplex per lane, for the best
// instruction set of the processor.
#pragma once

#include <cstddef>
#include <cstdint>

namespace delone::internal {

/// The number of simplices per call.
inline constexpr std::size_t orthosphere_block = 32;

/// The largest number of edges from the first vertex, and the largest dimension of the space.
inline constexpr std::size_t most_orthosphere_edges = 5, most_orthosphere_dimension = 8;

/// What is found of each simplex of a block. Only that of which the mark is 1 is certain.
struct OrthosphereBlock {
  alignas(64) double square[orthosphere_block];  ///< rounded up
  alignas(64) double square_is_certain[orthosphere_block];
  alignas(64) std::uint64_t beyond[orthosphere_block];
  alignas(64) double beyond_is_certain[orthosphere_block];
  /// The squared radius is between these.
  alignas(64) double least[orthosphere_block], most[orthosphere_block];
  alignas(64) double range_is_certain[orthosphere_block];
};

/// The certified stage of Orthospheres for orthosphere_block simplices with n+1 vertices in
/// R^d, 1 ≤ n ≤ most_orthosphere_edges, n ≤ d ≤ most_orthosphere_dimension. `vertices`: coordinate j of
/// vertex i of all simplices starts at (i·(d+1) + j)·orthosphere_block, its weight at j = d if `weighted`.
/// All must be finite. Finds the range and `beyond`, and `square` if it is wanted.
void find_orthospheres_in_lanes(std::size_t n, std::size_t d, bool weighted, bool want_square,
                                const double* vertices, OrthosphereBlock& found);

}  // namespace delone::internal
