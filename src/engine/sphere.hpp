// SPDX-License-Identifier: BSD-3-Clause
// What build.hpp works on: the cells of a triangulated sphere with the geometry that decides about them, and
// what it takes to copy them or to recompute their functionals.
#pragma once

#include "cells/cell_memory.hpp"
#include "engine/cell_store.hpp"
#include "engine/create_functionals.hpp"
#include "engine/geometry_concept.hpp"
#include "engine/locate.hpp"
#include "engine/parallel_insertion.hpp"
#include "engine/retriangulate.hpp"
#include "engine/sort_cells.hpp"
#include "engine/undo_log.hpp"
#include "engine/workspace.hpp"

#include <delone/types.hpp>

#include <algorithm>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace delone::engine {

/// K is the dimension of the cells, or 0 when it is chosen at run time.
template <int K, Geometry G>
class Sphere {
 public:
  using Query = typename G::Query;

  /// No cells yet. `of_geometry`: what a geometry is made from, beside the memory of the cells.
  template <class... OfGeometry>
  Sphere(int dimension, cells::VertexIds ids, OfGeometry&&... of_geometry)
      : memory_(dimension, ids),
        cells_(memory_),
        geometry_(memory_, std::forward<OfGeometry>(of_geometry)...) {}
  Sphere(const Sphere&) = delete;
  Sphere& operator=(const Sphere&) = delete;

  const CellStore<K>& cells() const { return cells_; }
  CellStore<K>& cells() { return cells_; }
  const G& geometry() const { return geometry_; }
  G& geometry() { return geometry_; }
  const CellMemory<K>& memory() const { return memory_; }
  const Effort& effort() const { return effort_; }
  Effort& effort() { return effort_; }
  Index num_infinite() const { return num_infinite_; }
  /// A cell near the last insertion, or where the last walk ended.
  Index last_cell() const { return work_.last_cell; }
  std::span<const HorizonFacet> star() const { return work_.star(); }
  UndoLog<K>& log() { return log_; }
  Workspace& workspace() { return work_; }
  const Workspace& workspace() const { return work_; }

  /// Takes over the cells of another sphere of the same vertices. REQUIRES that this one has none, and a
  /// geometry made from the same as that of the other.
  void copy_cells(const Sphere& other) {
    memory_.copy(other.memory_, other.cells_.num_slots());
    cells_.copy_slots(other.cells_);
    num_infinite_ = other.num_infinite_;
    work_.last_cell = other.work_.last_cell;
    effort_ = other.effort_;
  }

  /// What follows can be undone, until it is. `is_small`: it changes few of the cells. Throws std::bad_alloc,
  /// and then changes nothing.
  void begin_batch(bool is_small = false) {
    log_.begin(cells_, is_small);
    before_ = {num_infinite_, work_.last_cell, effort_};
  }
  void keep_batch() noexcept { log_.end(); }
  /// Makes the cells those that they were, in their slots, and gives back most of the memory that others
  /// took. Vertices stay wide. `put_back` is called with each cell that had gone.
  template <class PutBack>
  void undo_batch(PutBack&& put_back) noexcept {
    if (!log_.is_on()) return;
    log_.undo(cells_, geometry_, put_back);
    num_infinite_ = before_.num_infinite;
    work_.clear();
    work_.last_cell = before_.last_cell;
    effort_ = before_.effort;
  }
  void undo_batch() noexcept {
    undo_batch([](Index) {});
  }

  /// Since the beginning of the batch: the cells that are gone, and the new ones, perhaps in their slots.
  void changed_cells(std::vector<CellId>& gone, std::vector<CellId>& come) const {
    log_.list_changes(cells_, gone, come);
  }
  /// Since the beginning of the batch: the infinite cells that are gone.
  void changed_infinite_cells(std::vector<CellId>& gone) const { log_.list_infinite_changes(cells_, gone); }

  /// Vertex v becomes new_ids[v]; of vertices that are in no cell the entry does not matter. Throws
  /// std::bad_alloc, and then changes nothing.
  void renumber_vertices(std::span<const Index> new_ids) {
    Index last = 0;
    for (const Index id : new_ids) last = id == invalid_index ? last : std::max(last, id);
    cells_.admit_vertices(last);
    for (Index cell = 0; cell < cells_.num_slots(); ++cell)
      if (!cells_.is_vacant(cell))
        for (int i = 0; i <= cells_.dimension(); ++i)
          cells_.set_vertex(cell, i, new_ids[cells_.vertex(cell, i)]);
  }

  /// Gives cells ids that depend on their vertices alone (sort_cells.hpp).
  void sort_cells(const VertexOrder& order, unsigned threads) {
    engine::sort_cells(memory_, cells_, order, threads);
    work_.clear();
    work_.last_cell = 0;
  }

  /// Makes room for the functionals of cells of which only the links were written.
  void prepare_functionals() {
    memory_.reserve(cells_.num_slots());
    memory_.prepare(cells_.num_slots());
  }
  /// Recomputes the functionals of all cells.
  void create_functionals() { engine::create_functionals(cells_, geometry_); }

  /// What insertions by several workers change.
  InsertionParts<K, G> insertion_parts() {
    return {memory_, cells_,        geometry_,      log_.is_on() ? &log_ : nullptr,
            effort_, num_infinite_, work_.last_cell};
  }

  /// Walks to q (§2.5 of the report) from cell `start`, or if that is invalid from near the last insertion.
  WalkResult walk_to(const Query& q, Index start) {
    if (start == invalid_index)
      start = work_.star().empty() ? work_.last_cell : start_in_star(geometry_, q, work_.star());
    work_.clear();
    const WalkResult found = locate(cells_, geometry_, q, start, effort_.stages);
    effort_.visited_cells += found.visited;
    work_.last_cell = found.cell;
    work_.is_strictly_hidden = found.strictly;
    return found;
  }
  /// The cells of the zone, which find_zone() writes to the workspace, give way to cells that fill its place:
  /// fill() makes them, and returns them as a Filling, perhaps optional; if there is none, nothing has
  /// changed. Returns whether it was there. Strong guarantee, if both give it.
  template <class FindZone, class Fill>
  bool replace_zone(FindZone&& find_zone, Fill&& fill) {
    try {
      find_zone();
      if (log_.is_on()) log_.note(cells_, {work_.zone.cells.data(), work_.zone.num_cells});
      if (const std::optional<Filling> made = fill()) {
        effort_.created_cells += made->num_cells;
        num_infinite_ += made->num_infinite - static_cast<Index>(work_.zone.num_infinite);
        work_.last_cell = made->cell;
        return true;
      }
    } catch (...) {
      abandon_zone();
      throw;
    }
    abandon_zone();
    return false;
  }

  /// After cells were made otherwise than by an insertion.
  void starts_with(Index num_infinite, Index created) {
    effort_.created_cells += created;
    num_infinite_ = num_infinite;
    work_.clear();
    work_.last_cell = 0;
  }

  /// Whether the rest of a batch, of which some vertices are inserted, is for several threads.
  bool has_work_for_threads(const Batch& batch, std::size_t num_done) const {
    if constexpr (is_shared<K, G>)
      return batch.threads > 1 && geometry_.can_walk() && batch.size() > few_vertices<K> &&
             (num_done >= few_vertices<K> || cells_.num_cells() >= many_cells<K>);
    return false;
  }
  /// Inserts the rest in several threads. After an exception cells are of no use unless the batch is undone.
  void insert_in_threads(const Batch& batch, std::size_t num_done) {
    if constexpr (is_shared<K, G>) {
      work_.clear();
      ParallelInsertion<K, G>(insertion_parts(), batch).insert_from(num_done);
    }
  }

 protected:
  /// After a search or a replacement that has failed: there is no star, and there are no marks.
  void abandon_zone() {
    unmark(cells_.marks(), work_.zone);
    work_.clear();
  }
  Index count_infinite() const {
    Index count = 0;
    for (Index cell = 0; cell < cells_.num_slots(); ++cell)
      count += !cells_.is_vacant(cell) && geometry_.is_infinite(cell) ? 1 : 0;
    return count;
  }

  CellMemory<K> memory_;
  CellStore<K> cells_;
  G geometry_;
  Workspace work_;
  Effort effort_;
  Index num_infinite_ = 0;
  UndoLog<K> log_;

 private:
  struct {
    Index num_infinite, last_cell;
    Effort effort;
  } before_{};  // the batch
};

}  // namespace delone::engine
