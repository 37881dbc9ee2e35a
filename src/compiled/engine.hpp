// SPDX-License-Identifier: BSD-3-Clause
// What every engine does behind its virtual interface, be its cells a triangulation or the boundary of a hull
// or cone. TriangulationEngine and BoundaryEngine add what only one of them can do. A virtual function
// changes cells, or copies them, and is as coarse as an insertion; what is asked of cells are free functions
// beside each interface. The dimension of cells is fixed in an implementation (engine_of.hpp).
#pragma once

#include "engine/batch.hpp"
#include "engine/change.hpp"
#include "engine/vertex_order.hpp"

#include <delone/types.hpp>

#include <cstddef>
#include <functional>
#include <span>

namespace delone::compiled {

class Engine {
 public:
  virtual ~Engine() = default;

  /// The dimension of cells that the implementation is compiled for, or 0 for any.
  int compiled_dimension() const { return compiled_dimension_; }

  /// Inserts vertex v, starting at cell `start` or, if that is invalid, where the last insertion ended.
  /// Strong guarantee.
  virtual engine::Change insert(Index v, Index start) = 0;
  /// Inserts all vertices of a batch, in up to batch.threads threads where they can share cells. Does not
  /// tell which vertices are swallowed. After an exception cells are of no use unless the batch is undone.
  virtual void insert_all(const engine::Batch& batch) = 0;
  /// Gives cells ids that depend on their vertices alone, and on the places where these come in the order,
  /// without gaps; nothing changes where batches are never shared. Throws std::bad_alloc, and then changes
  /// nothing.
  virtual void sort_cells(const engine::VertexOrder& order, unsigned threads) = 0;

  /// What follows can be undone, until it is, or kept. `is_small`: it changes few of the cells, and does not
  /// use several threads. Throws, and then changes nothing.
  virtual void begin_batch(bool is_small = false) = 0;
  virtual void keep_batch() noexcept = 0;
  /// Makes the cells what they were, in their slots. A frame or box that has become larger stays so.
  /// `put_back` is called with each cell that was gone, and must not throw.
  virtual void undo_batch(const std::function<void(Index)>& put_back = [](Index) {}) noexcept = 0;

 protected:
  explicit Engine(int compiled_dimension) : compiled_dimension_(compiled_dimension) {}

 private:
  int compiled_dimension_;
};

}  // namespace delone::compiled
