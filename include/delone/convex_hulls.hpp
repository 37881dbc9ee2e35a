// SPDX-License-Identifier: BSD-3-Clause
// The convex hulls of many sets of points at once.
#pragma once

#include <delone/execution.hpp>
#include <delone/export.hpp>
#include <delone/options.hpp>
#include <delone/points.hpp>
#include <delone/types.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace delone {

/// The hulls of h sets of points of R^d, one after the other. Rows are numbered over all points, cells over
/// all hulls, both from 0.
///
/// A set of affine dimension k = d has cells, the simplices of the boundary, with d vertices each; all of
/// them are extreme. A flat set, k < d, has extreme points, and no cells.
struct ConvexHulls {
  int dimension = 0;                        ///< d
  std::vector<int> affine_dimensions;       ///< h: k ≤ d; −1 for a set without points
  std::vector<std::size_t> vertex_offsets;  ///< h+1: the first vertex of each hull
  std::vector<SignedIndex> vertices;        ///< the extreme rows, increasing; of equal rows the first
  std::vector<std::size_t> cell_offsets;    ///< h+1: the first cell of each hull
  std::vector<SignedIndex> cells;           ///< m×d rows
  std::vector<SignedIndex> neighbors;       ///< m×d cells: neighbor i is opposite vertex i
  std::vector<double> equations;            ///< m×(d+1): as in HullData, equal for all cells of a facet
  std::vector<double> volumes;              ///< h: d-dimensional; 0 for flat sets
  /// h: the (d−1)-dimensional volume of the boundary; for flat sets its limit: twice the volume within the
  /// flat if k = d−1, else 0.
  std::vector<double> areas;

  std::size_t size() const { return affine_dimensions.size(); }
};

/// The hulls of sets of points. Set i consists of the rows offsets[i] … offsets[i+1]−1. As exact as
/// ConvexHull; a loop over small sets takes several times as long. Several threads share the sets. Throws
/// Errc::invalid_argument unless the offsets never decrease and run from 0 to the number of points, otherwise
/// as ConvexHull; rows in errors are numbered over all points.
DELONE_EXPORT ConvexHulls convex_hulls(const AnyPoints<>& points, int dimension,
                                       std::span<const std::size_t> offsets, const Options& options = {});

/// The volumes of the intersections of two hulls each: of hulls pairs[0] and pairs[1], pairs[2] and pairs[3],
/// and so on. `points` are those that the hulls were made of. A hull is here the intersection of the
/// halfspaces of its equations, which are rounded; of these the combinatorics of an intersection are exact,
/// and the volume is summed up over its faces. So a volume is off by some roundings of the sizes of the
/// hulls. 0 with a flat hull.
///
/// Cost of a pair: one insertion for each facet of both, of the one without those that do not cut the other.
/// Throws Errc::invalid_argument (a number of a hull that there is not, a half of a pair), bad_dimension,
/// too_many, out_of_memory, cancelled.
DELONE_EXPORT std::vector<double> intersection_volumes(const AnyPoints<>& points, const ConvexHulls& hulls,
                                                       std::span<const std::size_t> pairs,
                                                       const Execution& how = {});

}  // namespace delone
