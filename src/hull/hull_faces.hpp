// SPDX-License-Identifier: BSD-3-Clause
// From the simplicial cells of a boundary to the faces of the polytope. Neighboring cells in one hyperplane
// merge into facets; extreme points, ridges and all other faces are intersections of facets, as sets of
// sites. A facet of one cell is that simplex, and all its vertices are extreme. Only facets of several cells
// cost anything.
#pragma once

#include "compiled/simplicial_hull.hpp"

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace delone::hull {

using compiled::SimplicialHull;

/// A sequence of lists, stored back to back.
struct Lists {
  std::vector<std::size_t> offsets{0};
  std::vector<Index> items;
  std::size_t size() const { return offsets.size() - 1; }
  std::span<const Index> operator[](std::size_t i) const {
    return {items.data() + offsets[i], offsets[i + 1] - offsets[i]};
  }
  void add(std::span<const Index> list) {
    items.insert(items.end(), list.begin(), list.end());
    offsets.push_back(items.size());
  }
};

/// For each of the items 0 … num_items − 1, the numbers of the lists that have it, increasing.
Lists lists_with_each(const Lists& lists, std::size_t num_items);

struct PolytopeFaces {
  std::vector<Index> facet_of_cell;
  Lists cells_of_facet;          ///< increasing
  std::vector<char> is_extreme;  ///< by site
  /// The cell whose plane is that of each facet, if facets are labels that a tolerance has made; else empty.
  std::vector<Index> seeds;

  std::size_t num_facets() const { return cells_of_facet.size(); }
};

/// `coplanar`: all pairs of neighboring cells in one hyperplane.
///
/// Why sets suffice. Seen from inside, the boundary is a fan, and the perturbation moves sites only along the
/// rays of that fan. So a site that is a vertex of any cell is a vertex of a cell in each facet that contains
/// the site. The facets that contain a site intersect in the smallest face that contains it, and the site is
/// extreme iff that face contains no other vertex of a cell. O(m·k) for m cells, plus the total size of the
/// vertex lists of merged facets, up to a logarithm.
PolytopeFaces find_faces(const SimplicialHull& hull, std::size_t num_sites,
                         std::span<const std::pair<Index, Index>> coplanar);

/// Sets cells_of_facet from facet_of_cell.
void list_cells_of_facets(PolytopeFaces& faces, std::size_t num_facets);

/// The extreme sites of each facet, in increasing order.
Lists find_facet_sites(const SimplicialHull& hull, const PolytopeFaces& faces);

/// Where two facets meet. Facets that a tolerance has made may do so in several places; all of them are one
/// ridge, whose sites are those that both facets have.
struct PolytopeRidges {
  std::vector<Index> facets;  ///< two per ridge, increasing; ridges are in the order of these pairs
  Lists sites;                ///< extreme ones, increasing
};
PolytopeRidges find_ridges(const SimplicialHull& hull, const PolytopeFaces& faces, const Lists& facet_sites);
/// The facets of the ridges alone.
std::vector<Index> neighboring_facets(const SimplicialHull& hull, const PolytopeFaces& faces);
std::size_t count_ridges(const SimplicialHull& hull, const PolytopeFaces& faces);

/// The number of faces of each dimension 0 … k−1, given the vertices of each facet. The facets of a face are
/// its maximal proper intersections with facets of the polytope.
std::vector<std::size_t> count_faces(const Lists& facets, int dimension);

/// The vertices common to all given facets, in increasing order.
std::vector<Index> common_vertices(const Lists& facets, std::span<const Index> which);

}  // namespace delone::hull
