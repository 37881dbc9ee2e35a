// SPDX-License-Identifier: BSD-3-Clause
// Trimmed triangulations: without the slivers that rounding leaves along the border.
#pragma once

#include <delone/data.hpp>
#include <delone/execution.hpp>
#include <delone/export.hpp>
#include <delone/triangulation.hpp>
#include <delone/types.hpp>

#include <cstddef>
#include <vector>

namespace delone {

/// The result of trim().
struct TrimResult {
  /// The remaining cells, in their order, and their neighbors, renumbered: −1 for a removed cell. Points and
  /// vertex_of_point are those of the triangulation.
  ComplexData data;
  std::vector<unsigned char> kept;  ///< of each cell of Triangulation::to_data(): 1 if it remains
  std::size_t num_removed = 0;      ///< the number of removed cells
  /// The rows of vertices without a remaining cell, increasing. Rows merged into them are not listed.
  std::vector<SignedIndex> orphans;
  double depth = 0;  ///< the largest depth of a removed cell, rounded up: every removed point is within it
  double lost_volume = 0;  ///< the k-volume of the removed cells, rounded up
};

/// Removes cells at the border of a triangulation that are so thin that every removed point is within
/// `tolerance`, a distance, of a remaining cell.
///
/// A facet is *exposed* if it is on the hull or the cell across it was removed. The *height* of a cell over
/// its exposed facets is the longest way in one direction from a point of it to a facet that is not exposed,
/// for a direction away from all exposed ones: for one exposed facet the cell's height over it; for several,
/// along the gradient of the sum s of the barycentric coordinates that are 0 on them, the distance 1/|∇s|
/// between the faces s = 0 and s = 1, if that leads away from each; otherwise along the direction in which
/// all these coordinates grow alike. The *depth* of a cell is its height plus the greatest depth of its
/// exposed facets: 0 on the hull, otherwise that of the removed cell across it. The cell of least depth is
/// removed repeatedly while its depth is at most `tolerance`; ties by the coordinates of the vertices. A cell
/// all of whose facets are exposed stays, and so does the last cell.
///
/// The result depends on the set of cells only. Heights are computed in integers and rounded up, sums too, so
/// a cell stays if rounding takes its depth beyond the tolerance. Trimmed cells are Delaunay, but their union
/// is not convex: the data say that they are trimmed, and check() proves them a part. Cost: O(m·k·d²) for m
/// cells, and a solve in integers for each cell at the border that may be thin. Throws Errc::invalid_argument
/// (a tolerance that is negative, not finite, or larger than the longest side of the bounding box of two
/// points or more), out_of_memory, cancelled.
DELONE_EXPORT TrimResult trim(const Triangulation& triangulation, double tolerance,
                              const Execution& how = {});

}  // namespace delone
