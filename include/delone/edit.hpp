// SPDX-License-Identifier: BSD-3-Clause
// Edits of a triangulation: rows to insert, remove, move and reweight, and what an edit has changed.
#pragma once

#include <delone/points.hpp>
#include <delone/types.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace delone {

/// What edit() of a triangulation does to its rows. A row may appear at most once per list; a removed row
/// must not appear in any other list. Lists that are not named are empty. C++ requires designated
/// initializers in the order of declaration.
///
///   t.edit({.remove = old_rows, .move = rows, .to = points});
///
/// An edit without any row or point does nothing: changes() and what undo() takes back stay as they are. An
/// edit without effect, such as a move of a row to where it is, counts: its changes() are empty, and undo()
/// takes it back.
template <int D = dynamic>
struct Edit {
  std::span<const std::size_t> remove = {};     ///< rows to remove
  std::span<const std::size_t> move = {};       ///< rows to move …
  AnyPoints<D> to = PointsView();               ///< … to these points, one per row
  std::span<const std::size_t> reweight = {};   ///< rows to reweight …
  std::span<const double> weights = {};         ///< … with these, one per row; regular triangulations only
  AnyPoints<D> insert = PointsView();           ///< points to insert as the next rows
  std::span<const double> insert_weights = {};  ///< one per inserted point; regular triangulations only
};

/// What the last insertion, edit or undo of a triangulation did to it. Every list is in ascending order.
struct Changes {
  /// A created cell may have the id of a removed one, which is then in both lists. A cell in neither list has
  /// the same id and vertices as before; its vertices may have moved, and its neighbors may be new.
  std::vector<CellId> removed_cells, created_cells;
  std::vector<VertexId> added_vertices;       ///< visible or hidden
  std::vector<VertexId> removed_vertices;     ///< no row is left; their ids are not reused
  std::vector<VertexId> hidden_vertices;      ///< were visible: they have rows, but no cells any more
  std::vector<VertexId> reappeared_vertices;  ///< were hidden, and have cells now
  std::vector<VertexId> moved_vertices;       ///< have other coordinates or another weight
};

/// The new ids and row numbers after compact_ids().
struct CompactedIds {
  std::vector<VertexId> vertices;  ///< by old id: the new one, or invalid_vertex; the infinite vertex stays 0
  std::vector<std::size_t> rows;   ///< by old number: the new one, or no_row
  static constexpr std::size_t no_row = static_cast<std::size_t>(-1);
};

}  // namespace delone
