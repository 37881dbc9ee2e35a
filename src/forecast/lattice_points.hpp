// SPDX-License-Identifier: BSD-3-Clause
// Whether points are those of a lattice, as pixels and voxels are. A random subset of them does not tell what
// the whole is like: neighbors matter, so patches do.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace delone::cost_model {

struct LatticePoints {
  bool found = false;
  bool has_ties = false;   ///< exactly a lattice, not rounded: its cells have the volume of a simplex of it
  double hull_volume = 0;  ///< in boxes
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
