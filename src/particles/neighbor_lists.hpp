// SPDX-License-Identifier: BSD-3-Clause
// Lists of neighbors. Where their lengths are known beforehand they are written where they belong; otherwise
// parts of the work make lists of their own, which are joined at the end.
#pragma once

#include <delone/site_cells.hpp>
#include <delone/types.hpp>

#include <algorithm>
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

/// Makes room for lists, in the order of rows. REQUIRES that neighbor_offsets has 0, and the length of each.
void lay_out_lists(bool have_edges, unsigned threads, SiteCells& cells);

/// Writes an entry of a list that has room; `lattice` has `rank` numbers.
inline void put_neighbor(SiteCells& cells, std::size_t at, const ListedNeighbor& neighbor,
                         const std::int32_t* lattice) {
  cells.neighbors[at] = neighbor.row;
  cells.face_areas[at] = neighbor.area;
  cells.distances[at] = neighbor.distance;
  if (!cells.num_edges.empty()) cells.num_edges[at] = neighbor.num_edges;
  const auto rank = static_cast<std::size_t>(cells.rank);
  std::copy_n(lattice, rank, cells.neighbor_lattice.data() + at * rank);
}

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
