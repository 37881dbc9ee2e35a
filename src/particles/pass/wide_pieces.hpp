// SPDX-License-Identifier: BSD-3-Clause
// The pieces of single cells where binary64 lanes do not do: in any dimension, in pairs of doubles, in
// integers.
#pragma once

#include "particles/pass/pieces_kernel.hpp"

#include <cstddef>
#include <cstdint>
#include <span>

namespace delone::particles {

/// The neighbors of a site, without error: each is at high + low from it, and w_0 − w is weight_high +
/// weight_low, two numbers of any size in any order for find_pieces_exactly(), otherwise a pair of doubles.
/// Without weights both of these are empty.
struct ExactNeighbors {
  std::size_t k, d;
  std::span<const double> high, low;  ///< d per neighbor
  std::span<const double> weight_high, weight_low;
  int exponent = 0;  ///< what find_pieces_exactly() finds is in the unit 2^exponent
};

/// Of the cell with these k neighbors, the piece_size(k, d) numbers. `records` as for find_pieces_in_lanes().
void find_pieces(std::size_t k, std::size_t d, const double* records, const std::uint32_t* corners,
                 double* pieces);
/// The same in pairs of doubles.
void find_pieces_in_pairs(const ExactNeighbors& neighbors, const std::uint32_t* corners, double* pieces);
/// The same in integers: each number of a piece has a relative error of a few roundings. REQUIRES affinely
/// independent points.
void find_pieces_exactly(const ExactNeighbors& neighbors, const std::uint32_t* corners, double* pieces);

}  // namespace delone::particles
