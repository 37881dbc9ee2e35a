// SPDX-License-Identifier: BSD-3-Clause
// A hull with a tolerance without the exact hull of all points: where the necessary points cover the others,
// they are the choice of vertex_choice.hpp, however they are found.
#pragma once

#include "base/axis_scale.hpp"
#include "hull/hull_state.hpp"

#include <delone/options.hpp>
#include <delone/types.hpp>

#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace delone::hull {

struct NecessaryHull {
  std::unique_ptr<HullState> state;  ///< the exact hull of the necessary points; the other rows are covered
  std::vector<Index> rows;           ///< for each row of the state, the row of the input
};

/// `scale`: with the tolerance; all distances are those where axes are scaled.
///
/// The hull of those points whose distance from the hull of the others exceeds the tolerance, if it is proved
/// that all other points are within the tolerance of it, and that the points are near no flat of fewer
/// dimensions. Then choose_in_flat() finds nothing, and choose_vertices() keeps the necessary sites and no
/// others: the result is that of TolerantHull. Rows are the vertices and all points that are not certainly in
/// the interior, so all extreme points are among them; of equal rows the first. None if binary64 proves less,
/// or if there are so many points that the exact hull is found faster.
///
/// Necessary: n·(v − w) > ε·|n| for all other points w, for one direction n. The candidates come from a hull
/// that grows by the farthest points beyond its facets, as in Quickhull (Barber, Dobkin, Huhdanpaa 1996,
/// doi:10.1145/235815.235821). Covered: a point of the hull of the vertices, given by weights, is within the
/// tolerance. Cost: O(h·n·d) for h vertices, and a walk over cells for each point.
std::optional<NecessaryHull> find_necessary_hull(std::span<const double> coordinates, int dimension,
                                                 const internal::AxisScale& scale, const Options& options);

}  // namespace delone::hull
