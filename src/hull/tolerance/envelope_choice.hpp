// SPDX-License-Identifier: BSD-3-Clause
// Which vertices of an exact lower hull one with a tolerance keeps: so few that no point is more than the
// tolerance below it, along the last axis.
//
// Enough to look at vertices: over a cell of the exact lower hull that one is affine, and the lower hull of
// what is kept is convex, so the difference is greatest at a vertex of the cell.
#pragma once

#include <delone/types.hpp>

#include <functional>
#include <span>
#include <vector>

namespace delone::hull {

struct EnvelopeChoice {
  std::vector<SignedIndex> rows;  ///< in lexicographic order of their points
  double max_distance = 0;        ///< no point is farther below; at most the tolerance
};

/// `points`: rows of `width` numbers, the last one is the height; compositions span width − 1 dimensions.
/// `vertices`: the rows of the exact lower hull's vertices. Vertices whose compositions are extreme are kept:
/// the domain stays as it is. Then, while a vertex is more than the tolerance below the lower hull of those
/// kept, the farthest one below each of its cells is kept, too. In the end vertices are dropped again, last
/// ones first, whenever none is then farther below than the tolerance. All this is decided exactly, but for
/// which of several is farthest (in binary64; the lexicographically least of equal ones). A function of the
/// set of points. `alive` is called once in a while, and may throw.
///
/// A vertex can be dropped if that is so for the lower hull of its neighbors, the vertices that share a facet
/// with it, at the vertex itself and at all above which its facets are: what is visible from it of the hull
/// without it has neighbors only (vertex_choice.hpp). So vertices that are no neighbors can be dropped
/// together.
EnvelopeChoice choose_envelope(std::span<const double> points, int width,
                               std::span<const SignedIndex> vertices, double tolerance,
                               const std::function<void()>& alive);

}  // namespace delone::hull
