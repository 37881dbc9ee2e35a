// SPDX-License-Identifier: BSD-3-Clause
// The cells of a triangulation with ghosts as translates of the cells of a periodic triangulation, one of
// each class: the one whose lexicographically smallest vertex is a point of the set in the box. A translation
// keeps the order of points, so there is exactly one. Cells with a vertex in the box are cells of the whole
// set; others may be none.
//
// Numbers of classes and the order of vertices in each are those of the public arrays: functions of the rows,
// the given points and the lattice, and not of how the triangulation came about. Classes are in the order of
// their smallest vertices along a curve through the box, and those of one row in the order of their vertices.
// Vertices are in the order of their rows, and images of one row in that of their offsets from the smallest
// vertex; the last two are exchanged where the orientation wants it so.
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
  /// Where vertex i of a class is among those of its cell in the triangulation.
  int slot(std::size_t number, std::size_t i) const { return slots_[number * corners_ + i]; }
  VertexId vertex(SignedIndex number, std::size_t i) const {
    return complex_.vertex(cell(number), slot(static_cast<std::size_t>(number), i));
  }
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
  VertexId own_vertex(VertexId v) const { return ghosts_.vertex_of_row(ghosts_.image_of(v).row); }

 private:
  void order_rows(const PeriodicSet& set);
  void sort_by_row();
  void sort_within_rows(const PeriodicSet& set);

  const GhostTriangulation& ghosts_;
  const Complex complex_;
  CanonicalCells canonical_;
  const std::size_t r_, corners_;
  std::vector<std::uint32_t> row_at_, place_of_row_;  // along the curve
  std::vector<std::size_t> first_at_;                 // by place, the first number of a class with this row
  std::vector<std::uint8_t> slots_;
};

}  // namespace delone::periodic
