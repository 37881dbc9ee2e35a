// SPDX-License-Identifier: BSD-3-Clause
// Which vertices of an exact hull a hull with a tolerance keeps: so few that the others are within the
// tolerance of the hull of those.
//
// Enough to look at vertices. The distance from a convex set is a convex function, so over the exact hull it
// is greatest at an extreme point: if these are within the tolerance, all points are.
#pragma once

#include "compiled/simplicial_hull.hpp"
#include "hull/hull_faces.hpp"

#include <delone/types.hpp>

#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace delone::hull {

using sites::BoundarySites;

/// The extreme sites of a hull in lexicographic order of their points, and which of them share a facet of it.
/// A site is named by its place in this order.
class ExtremeSites {
 public:
  /// `facet_sites`: the extreme sites of each facet.
  ExtremeSites(const BoundarySites& sites, const Lists& facet_sites);

  std::size_t size() const { return sites_.size(); }
  Index site(std::size_t place) const { return sites_[place]; }
  const std::vector<Index>& sites() const { return sites_; }
  /// Adds those that share a facet with one, and are not marked, to a list, and marks them.
  void add_neighbors(std::size_t place, std::vector<char>& marks, std::vector<Index>& list) const;

 private:
  std::vector<Index> sites_;
  Lists facets_, facets_of_;  // by facet, places; by place, facets
};

struct VertexChoice {
  std::vector<Index> sites;  ///< that are kept, in lexicographic order of their points
  double max_distance = 0;   ///< of a point from the hull of those is at most this, and this ≤ tolerance
};

/// A direction in which a site may be so much farther than its neighbors that this proves it to be necessary;
/// it then needs no search. May be empty, or of no numbers.
using DirectionOf = std::function<std::span<const double>(Index site)>;

/// Chooses from the extreme sites. A site is *necessary* if its distance from the hull of the others exceeds
/// the tolerance. Necessary sites are kept, and if few of a sample are and there are many sites in few
/// dimensions, those of grown_choice.hpp. Then, while a site is more than the tolerance outside of the hull
/// of those kept, the farthest one is kept, too (of several the lexicographically least; distances are
/// compared in binary64). In the end those that are not necessary are dropped again, the last one first,
/// whenever all sites stay within the tolerance. Whether a distance exceeds the tolerance is decided exactly.
/// The result is a function of the set of points. `alive` is called once in a while, and may throw.
///
/// The necessary ones are found from neighbors alone. Let P be the hull, v a vertex, and P′ the hull of the
/// other vertices, with v not in the flat of P′. The point x of P′ nearest to v lies on a facet of P′ that is
/// visible from v, since v − x is a nonnegative combination of the outward normals of the facets at x, one of
/// which has a positive product with v − x. Let u be a vertex of a visible facet of P′. As u is a vertex of
/// P, not all facets of P′ at u are visible. If v is strictly beneath one of them, the segment uv is an edge
/// of P (Grünbaum, Convex Polytopes, theorem 5.2.1); if v lies in the hyperplane of one, that hyperplane
/// supports P and contains both. In either case u and v share a facet of P. So x is in the hull of the
/// neighbors of v, which is part of P′, and is the nearest point of both. If v is not in the flat of P′, P is
/// a pyramid over P′, and all other vertices share a facet with v. (With k = 1 they do not; the ends of a
/// segment count as neighbors.)
///
/// Cost: O(h·d) for h sites if directions, from the neighbors' mean or given, prove them all to be necessary.
/// A site that is not costs a search of the nearest point among neighbors, and, if these do not cover it, a
/// few searches for the farthest kept point in a direction, each O(log h) on data that are not very
/// degenerate, whenever its distance has fallen. After a grown choice most sites are within the tolerance of
/// a cell that is known, and need one search.
VertexChoice choose_vertices(const BoundarySites& sites, const ExtremeSites& extreme, double tolerance,
                             const std::function<void()>& alive, const DirectionOf& direction_of = {});

/// A flat of lower dimension than the points that all of them are near to.
struct NearFlatChoice {
  std::vector<int> axes;  ///< as many as the flat has dimensions: it projects one-to-one on them
  VertexChoice vertices;
};

/// A hull in a flat, if all points are near one. The flat is spanned by the lexicographically least extreme
/// point, the one farthest from it, the one farthest from the line through both, and so on, until the next
/// one's distance is within the tolerance (ends exactly; the farthest is found in binary64, the least of
/// several). Points are then taken for their projections on the axes, of the flat's largest minor by
/// elimination with pivoting; only sites that are extreme there can be vertices, and are chosen as above, by
/// distances in space. If some point is farther than the tolerance from the hull of all these, one more
/// dimension is tried. None if that leads to as many dimensions as the points have, `dimension`.
std::optional<NearFlatChoice> choose_in_flat(const BoundarySites& sites, const ExtremeSites& extreme,
                                             int dimension, double tolerance,
                                             const std::function<void()>& alive);

}  // namespace delone::hull
