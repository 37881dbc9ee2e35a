// SPDX-License-Identifier: BSD-3-Clause
// The tie-break of points on a small grid for many cells at once, one per SIMD lane. Compiled for several
// instruction sets; the best one of the machine is chosen at run time.
#pragma once

#include "base/compiled_dimension.hpp"

#include <delone/types.hpp>

#include <cstddef>
#include <span>

namespace delone::kernel {

/// A query that is exactly on the spheres of several cells.
struct TieTask {
  int k;                                ///< the dimension: can_break_together(k)
  std::span<const Index* const> cells;  ///< the k + 1 vertices of each
  const double* coordinates;  ///< of all points, by vertex id, in full dimension and on a small grid
  std::size_t row_size;       ///< from a point to the next
  const double* query;
  const double* key_weights;  ///< Grid::key_weight() of the k axes; in binary32 Grid::tiny_key_weight()
  const double* per_unit;     ///< in binary32 Grid::per_unit() of the k axes; else null
  Sign* sides;                ///< receives perturbed_in_sphere() for each cell
};

/// The dimensions in which tables of minors are small, as far as code is compiled for them. In fewer than 3,
/// one cell at a time is as fast.
constexpr bool can_break_together(int k) { return k >= 3 && k <= internal::largest_compiled_dimension; }

/// The dimensions in which binary32, on a tiny grid, is faster: tables are so large and cells so many that
/// twice as many lanes pay.
constexpr bool can_break_in_binary32(int k) { return k >= 6 && can_break_together(k); }

/// Breaks the ties as perturbed_in_sphere() does one at a time: after Devillers and Teillaud (2011,
/// doi:10.1016/j.comgeo.2010.09.010), exactly (docs/predicates.md, "Small lattices"). Cost: k·2^k per cell
/// and determinant, of which there is one for every larger point, from the largest on, up to the first that
/// is not zero. REQUIRES that the query is no vertex of the cells, and can_break_in_binary32(k) and
/// Grid::is_tiny() if units are given.
void break_ties(const TieTask& task);

}  // namespace delone::kernel
