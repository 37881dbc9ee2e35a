// SPDX-License-Identifier: BSD-3-Clause
// The cells of a triangulation with ghosts as translates of the cells of a periodic triangulation, one of
// each class: the one whose lexicographically smallest vertex is a point of the set in the box. A translation
// keeps the order of points, so there is exactly one. Cells with a vertex in the box are cells of the whole
// set; others may be none.
#pragma once

#include "periodic/ghost_triangulation.hpp"

#include <delone/types.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace delone::periodic {

/// The cell of a triangulation with ghosts that stands for each class, by its slot; −1 for others.
struct CanonicalCells {
  std::vector<SignedIndex> number_of_slot;
  std::vector<CellId> cells;
  std::vector<VertexId> smallest;  ///< the vertex of each cell
};
CanonicalCells find_canonical_cells(const GhostTriangulation& ghosts);

/// Multiples of the vectors of the reduced lattice.
using Offset = std::vector<std::int64_t>;

/// A cell that is the translate of a canonical one, or outside.
struct Translate {
  SignedIndex number = -1;
  Offset offset;
};

class CellClasses {
 public:
  /// REQUIRES that both arguments outlive the object.
  CellClasses(const GhostTriangulation& ghosts, const PeriodicSet& set);

  const CanonicalCells& canonical() const { return canonical_; }
  CellId cell(SignedIndex number) const { return canonical_.cells[static_cast<std::size_t>(number)]; }
  /// The row of the smallest vertex.
  std::uint32_t row_of_smallest(std::size_t number) const {
    return ghosts_.image_of(canonical_.smallest[number]).row;
  }
  /// Whether a cell has a vertex in the box; finite or not.
  bool has_own(CellId cell) const;
  /// Of a cell with a vertex in the box.
  Translate find_class(CellId cell) const;
  /// Across the facet opposite vertex i of a finite cell with a vertex in the box.
  Translate find_neighbor(CellId cell, int i) const;
  /// Whether a cell has the vertex v translated by −offset.
  bool has_moved(CellId cell, VertexId v, const Offset& offset) const;
  /// Whether w is that vertex.
  bool is_moved(VertexId w, VertexId v, const Offset& offset) const;
  Offset offset_of(VertexId v) const {
    const auto of_v = ghosts_.offset_of(v);
    return {of_v.begin(), of_v.end()};
  }
  /// The vertex in the box of which v is an image; invalid_vertex if its point is hidden there. Cells with a
  /// vertex in the box have no such vertex.
  VertexId own_vertex(VertexId v) const { return ghosts_.triangulation().vertex_at(ghosts_.image_of(v).row); }

 private:
  const GhostTriangulation& ghosts_;
  const Complex complex_;
  const CanonicalCells canonical_;
  const std::size_t r_, corners_;
  std::vector<std::size_t> first_of_row_, by_row_;  // numbers of cells by the rows of their smallest vertices
};

}  // namespace delone::periodic
