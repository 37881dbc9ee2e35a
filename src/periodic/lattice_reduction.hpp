// SPDX-License-Identifier: BSD-3-Clause
// Short vectors of a lattice, in integers without error.
#pragma once

#include "kernel/fractions.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace delone::periodic {

/// Rows of integers in units of 2^grid.
struct IntegerRows {
  std::vector<kernel::Integer> entries;
  int grid = 0;
};

/// Doubles as integers on their finest common grid.
IntegerRows integers_of(std::span<const double> numbers);

/// The products of all pairs of `rank` rows, row by row.
std::vector<kernel::Integer> gram_matrix(std::span<const kernel::Integer> rows, std::size_t rank);

/// Makes a basis short: adds multiples of vectors to others as long as one becomes shorter (Lagrange). In up
/// to three dimensions the result has the shortest vectors possible (Minkowski). REQUIRES linearly
/// independent rows. Returns how the new vectors are sums of the given ones: rank×rank, row by row.
std::vector<kernel::Integer> reduce_lattice(std::vector<kernel::Integer>& rows, std::size_t rank);

}  // namespace delone::periodic
