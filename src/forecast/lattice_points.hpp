// SPDX-License-Identifier: BSD-3-Clause
// Whether points are those of a lattice, as pixels and voxels are. A random subset of them does not tell what
// the whole is like: neighbors matter, so patches do.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

namespace delone::cost_model {

struct LatticePoints {
  bool found = false;
  std::string_view kind;   ///< of the named point sets, the one that they are most like
  double hull_volume = 0;  ///< in boxes; 0: not known, that of a grid with equal sides
};

/// `rows`: a random subset of the points, which are `num_distinct`. Nearest neighbors of a few are looked for
/// among all, O(n·d).
LatticePoints find_lattice(std::span<const double> coordinates, int dimension,
                           std::span<const std::size_t> rows, double num_distinct);

/// The coordinates of the m points nearest to that of a row, the row itself included, by their distance and,
/// of equal ones, by their rows. O(n·d) with memory for m points.
std::vector<double> patch_around(std::span<const double> coordinates, int dimension, std::size_t row,
                                 std::size_t m);

}  // namespace delone::cost_model
