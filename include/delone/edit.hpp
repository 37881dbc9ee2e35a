// SPDX-License-Identifier: BSD-3-Clause
// Editing a triangulation: what to insert, remove, move and weigh anew, and what has changed by it.
#pragma once

#include <delone/points.hpp>
#include <delone/types.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace delone {

/// What becomes of rows, for the members edit() of the triangulations. A row may be in several lists, but in
/// none twice, and one that is removed in no other. Lists that are not named are empty; those that are come
/// in the order of declaration, as C++ demands it of designated initializers.
///
///   t.edit({.remove = gone, .move = rows, .to = points});
///
/// Without any row or point, an edit does nothing, and leaves changes() and what undo() takes back as they
/// are. One that leaves everything as it was, such as a move to where a row is, counts like others: its
/// changes() are empty, and undo() takes back that edit.
template <int D = dynamic>
struct Edit {
  std::span<const std::size_t> remove = {};     ///< rows that go
  std::span<const std::size_t> move = {};       ///< rows that get other coordinates …
  AnyPoints<D> to = PointsView();               ///< … these, as many
  std::span<const std::size_t> weigh = {};      ///< rows that get other weights …
  std::span<const double> weights = {};         ///< … these, as many; of regular triangulations alone
  AnyPoints<D> insert = PointsView();           ///< the next rows
  std::span<const double> insert_weights = {};  ///< of these, as many; of regular triangulations alone
};

/// What the last insertion, edit or undo of a triangulation did to it. Every list is in ascending order.
struct Changes {
  /// Cells that are no more, and new ones. The id of a cell that is no more may be that of a new one, and is
  /// then in both lists. A cell in neither list has the same id and vertices; but these may have moved, and
  /// cells next to it may be new.
  std::vector<CellId> killed, born;
  std::vector<VertexId> came;        ///< vertices with new ids, visible or hidden
  std::vector<VertexId> gone;        ///< vertices that have no row any more: their ids are not used again
  std::vector<VertexId> hid;         ///< vertices that had cells and have none, but still have rows
  std::vector<VertexId> reappeared;  ///< vertices that had rows but no cells, and have cells now
  std::vector<VertexId> moved;       ///< vertices with other coordinates or another weight
};

/// What ids have become, see compact_ids().
struct CompactedIds {
  std::vector<VertexId> vertices;  ///< by old id: the new one, or invalid_vertex; the infinite vertex stays 0
  std::vector<std::size_t> rows;   ///< by old number: the new one, or no_row
  static constexpr std::size_t no_row = static_cast<std::size_t>(-1);
};

}  // namespace delone
