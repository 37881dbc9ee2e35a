// SPDX-License-Identifier: BSD-3-Clause
// The lists of neighbors that parts of the work make, and how they are joined.
#pragma once

#include <delone/site_cells.hpp>
#include <delone/types.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace delone::particles {

struct ListedNeighbor {
  SignedIndex row;        ///< −1 for a wall
  SignedIndex num_edges;  ///< of the face, in three dimensions
  double area, distance;
};

/// The lists of some sites, one after the other.
struct NeighborLists {
  std::vector<Index> rows;             ///< the sites
  std::vector<std::uint32_t> lengths;  ///< by site
  std::vector<ListedNeighbor> neighbors;
  std::vector<std::int32_t> lattice;  ///< `rank` numbers for each neighbor
  // If vertices are wanted.
  std::vector<std::uint32_t> num_vertices;  ///< by site
  std::vector<double> vertices;             ///< d coordinates each
  std::vector<std::uint32_t> face_lengths;  ///< by neighbor
  std::vector<SignedIndex> face_vertices;

  /// The list of the next site follows.
  void begin(std::size_t row, std::size_t length) {
    rows.push_back(static_cast<Index>(row));
    lengths.push_back(static_cast<std::uint32_t>(length));
  }
};

/// Puts the lists of all parts into the order of rows, and empties them. REQUIRES that the arrays by row are
/// made.
void join_lists(std::span<NeighborLists> parts, bool have_edges, bool have_vertices, unsigned threads,
                SiteCells& cells);

}  // namespace delone::particles
