// SPDX-License-Identifier: BSD-3-Clause
// Facets of a hull with a tolerance: labels of its cells.
#pragma once

#include "compiled/simplicial_hull.hpp"
#include "hull/hull_faces.hpp"

namespace delone::hull {

/// Joins cells into facets. The largest cell that has no facet yet begins one, as its *seed*; the facet grows
/// across ridges to cells that have none, while all their vertices are within the tolerance of the plane of
/// the seed, exactly. (Of cells with the same (k−1)-volume, computed in binary64, that with the
/// lexicographically least vertices is first.) So all vertices of a facet are within the tolerance of its
/// seed's plane, and the facets are a function of the set of cells. All sites of cells are extreme. Facets
/// are numbered in the order of their first cells. Cost: one normal per cell, a test per ridge, and more
/// where cells are joined.
PolytopeFaces label_facets(const sites::BoundarySites& sites, const SimplicialHull& hull, double tolerance);

}  // namespace delone::hull
