// SPDX-License-Identifier: BSD-3-Clause
// The hull of the extreme points of a set, without the others. Where many points lie in common hyperplanes,
// it has far fewer cells than the hull of all of them, whose cells have points of the boundary as vertices,
// too.
#pragma once

#include "hull/hull_analysis.hpp"
#include "hull/hull_state.hpp"

#include <delone/options.hpp>
#include <delone/types.hpp>

#include <memory>
#include <span>
#include <vector>

namespace delone::hull {

struct ExtremeHull {
  std::unique_ptr<HullState> state;
  std::vector<Index> rows;  ///< for each row of the state, the row of the input
  /// Of the state, which must not change as long as this is there; nothing if there is a tolerance.
  std::unique_ptr<HullAnalysis> analysis;
};

/// The hull of a subset of the rows that contains all extreme points; only these are vertices of cells,
/// unless there is a tolerance. Of equal rows it has the first. REQUIRES finite coordinates, and room for as
/// many ids.
///
/// Points strictly inside a growing shell are dropped, as are those that are in it, exactly; the farthest of
/// the others extend it (point_sieve.hpp). If few points are left undecided by floating point, all of them
/// are inserted instead. Vertices of cells that turn out not to be extreme cost another hull without them.
ExtremeHull find_extreme_hull(std::span<const double> coordinates, int dimension, const Options& options);

}  // namespace delone::hull
