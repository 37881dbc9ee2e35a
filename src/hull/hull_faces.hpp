// SPDX-License-Identifier: BSD-3-Clause
// From the simplices of a boundary to the faces of the polytope: cells in one hyperplane merge into facets,
// from which extreme points, ridges and all other faces follow by intersection of sets. A facet of one cell
// is that simplex, and its vertices are extreme; only facets of several cells take any work.
#pragma once

#include "compiled/simplicial_hull.hpp"

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace delone::internal {

/// Lists of one kind, one after the other.
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

struct PolytopeFaces {
  std::vector<Index> facet_of_cell;
  Lists cells_of_facet;          ///< increasing
  std::vector<char> is_extreme;  ///< by site

  std::size_t num_facets() const { return cells_of_facet.size(); }
};

/// `coplanar`: the pairs of neighboring cells that lie in one hyperplane.
///
/// Why sets suffice. The boundary is a fan seen from inside, and sites move on the rays of that fan only (the
/// perturbation), so a vertex of cells is a vertex of some cell in each facet that contains it. The facets
/// that contain a site meet in the smallest face that contains it; it is extreme iff that face has no other
/// vertex. O(m·k), and the sizes of the lists of facets of several cells.
PolytopeFaces find_faces(const SimplicialHull& hull, std::size_t num_sites,
                         std::span<const std::pair<Index, Index>> coplanar);

/// The extreme sites of each facet, increasing.
Lists find_facet_sites(const SimplicialHull& hull, const PolytopeFaces& faces);

struct PolytopeRidges {
  std::vector<Index> facets;  ///< two per ridge, increasing; ridges are in the order of these pairs
  Lists sites;                ///< extreme ones, increasing
};
PolytopeRidges find_ridges(const SimplicialHull& hull, const PolytopeFaces& faces, const Lists& facet_sites);
std::size_t count_ridges(const SimplicialHull& hull, const PolytopeFaces& faces);

/// The number of faces of each dimension 0 … k−1, from the facets. Faces of dimension j−1 of a face are its
/// largest proper intersections with facets.
std::vector<std::size_t> count_faces(const Lists& facets, int dimension);

/// The vertices common to all given facets, increasing.
std::vector<Index> common_vertices(const Lists& facets, std::span<const Index> which);

}  // namespace delone::internal
