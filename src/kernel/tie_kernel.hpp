// SPDX-License-Identifier: BSD-3-Clause
// The tie-break of points on a small grid for many cells at once, several cells per instruction; compiled for several
// instruction sets, of which the best that the machine has is chosen at run time.
#pragma once

#include <delone/types.hpp>

#include <cstddef>
#include <span>

namespace delone::kernel {

/// A query that is exactly on the spheres of several cells.
struct TieTask {
  int k;                                ///< the dimension: can_break_together(k)
  std::span<const Index* const> cells;  ///< the k+1 vertices of each
  const double* coordinates;            ///< of all points, by vertex id, in full dimension and on a small grid
  std::size_t row_size;                 ///< from a point to the next
  const double* query;
  const double* key_weights;  ///< Grid::key_weight() of the k axes
  Sign* sides;                ///< receives perturbed_in_sphere() for each cell
};

/// The dimensions in which tables of minors are small; in fewer than 3, one at a time is as fast.
constexpr bool can_break_together(int k) { return k >= 3 && k <= 8; }

void break_ties(const TieTask& task);

}  // namespace delone::kernel
