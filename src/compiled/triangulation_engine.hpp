// SPDX-License-Identifier: BSD-3-Clause
// The engine with its geometry behind one virtual interface: the dimension of the flat is fixed in an
// implementation, which is compiled for 1 … 8 and once for a dimension chosen at run time. Calls are as
// coarse as an insertion.
#pragma once

#include "engine/batch.hpp"
#include "engine/change.hpp"
#include "engine/workspace.hpp"
#include "engine/wrap/is_worth_wrapping.hpp"
#include "geometry/frame.hpp"
#include "sites/vertex_points.hpp"

#include <delone/complex.hpp>
#include <delone/types.hpp>

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace delone::compiled {

using sites::VertexPoints;

/// Where a query lies: the cell the walk ended in, and for a finite one the slots of the smallest face that
/// contains it.
struct QueryLocation {
  Index cell = invalid_index;
  bool outside = false;
  std::vector<VertexId> face;
};

/// A Delaunay, regular or furthest-site triangulation of points that span a k-flat, 1 ≤ k ≤ d, that does not
/// change.
class TriangulationQueries {
 public:
  virtual ~TriangulationQueries() = default;

  /// The box that insertions must stay in to profit from the filter.
  virtual const geometry::Frame& frame() const = 0;

  /// A query has a weight where points have one; where it lies depends on its coordinates only. A walk that
  /// is not given a cell to start from starts where the last insertion ended.
  virtual QueryLocation locate(const double* query, Index start) const = 0;
  virtual std::vector<CellId> conflict_zone(const double* query, Index start) const = 0;
  /// Negative if the query is in conflict with a finite cell, ties not perturbed.
  virtual Sign unperturbed_side(Index cell, const double* query) const = 0;

  virtual Complex complex(Index num_vertices, std::span<const CellId> cell_of_vertex) const = 0;
  virtual const engine::Effort& effort() const = 0;
  virtual std::size_t bytes() const = 0;
};

/// The same, while points are inserted, removed and moved. Vertices are ids of `points`.
class TriangulationEngine : public TriangulationQueries {
 public:
  /// Starts from k+1 affinely independent vertices.
  virtual void seed(std::span<const Index> vertices) = 0;
  /// Starts from a triangulation of dimension k−1 and a vertex outside its flat.
  virtual void jump(const Complex& old, Index apex) = 0;
  /// Starts from a triangulation of the same points. Its cells keep their ids if it has no vacant slots.
  virtual void restore(const Complex& old) = 0;
  /// Starts from all vertices, if they can be wrapped: returns false, and has no cells, where rounded numbers
  /// do not say how, and if there are ties. What only queries and insertions need is computed by the first of
  /// them, O(k³) per cell. The cells and their ids are the same for every number of threads. `tick` is called
  /// often by this thread, with the fraction done; what it throws is passed on. REQUIRES points of full
  /// dimension, neither weighted nor furthest.
  virtual bool wrap(unsigned threads, const std::function<void(double)>& tick) = 0;
  /// A copy that reads the points, which are the same, from another place.
  virtual std::unique_ptr<TriangulationEngine> copy(VertexPoints& points) const = 0;
  /// Changing the frame recomputes all cached functionals.
  virtual void set_frame(geometry::Frame frame) = 0;

  /// Inserts vertex v, starting at cell `start` or, if that is invalid, where the last insertion ended: done,
  /// duplicate or hidden. Strong guarantee.
  virtual engine::Change insert(Index v, Index start) = 0;
  /// Inserts all vertices of a batch, in up to batch.threads threads where they can share cells. Does not
  /// tell which vertices are swallowed. After an exception cells are of no use unless the batch is undone.
  virtual void insert_all(const engine::Batch& batch) = 0;
  /// Removes vertex v, one of whose cells is `cell`: done, flat or costly. Strong guarantee.
  virtual engine::Change remove(Index v, Index cell) = 0;
  /// Moves vertex v, one of whose cells is `cell`, to a point in the frame, where it stays among its cells:
  /// done, or costly if it cannot stay or many cells would change. Writes the point. Strong guarantee.
  virtual engine::Change move(Index v, Index cell, const double* to) = 0;
  /// The same after any vertices have got other points, in another frame if there is one, in up to `threads`
  /// threads (Options::threads). If it is costly, or throws, the batch has to be undone before anything else
  /// is done. REQUIRES begin_batch() and no change since.
  virtual engine::Change move_all(std::optional<geometry::Frame> frame, unsigned threads) = 0;

  /// Gives vertices other ids: vertex v becomes new_ids[v], which may be invalid_index for those that have no
  /// cell. The points of the vertices have been moved by then. Throws std::bad_alloc, and then changes
  /// nothing.
  virtual void renumber_vertices(std::span<const Index> new_ids) = 0;
  /// Gives cells ids that depend on the ids of their vertices alone, without gaps, if several threads may
  /// have inserted a batch. Throws std::bad_alloc, and then changes nothing.
  virtual void sort_cells(unsigned threads) = 0;

  /// What follows can be undone, until it is, or kept. `is_small`: it changes few of the cells, and does not
  /// use several threads. Throws, and then changes nothing.
  virtual void begin_batch(bool is_small = false) = 0;
  virtual void keep_batch() noexcept = 0;
  /// Makes the cells what they were, in their slots. A frame or box that has become larger stays so. `moved`:
  /// the vertices that have had other points meanwhile, and have their old points again. `put_back` is called
  /// with each cell that was gone, and must not throw.
  virtual void undo_batch(
      std::span<const Index> moved = {},
      const std::function<void(Index)>& put_back = [](Index) {}) noexcept = 0;
  /// The cells that are gone since the beginning of the batch, and those that are new, some perhaps in the
  /// slots of the former.
  virtual void changed_cells(std::vector<CellId>& gone, std::vector<CellId>& made) const = 0;

  /// Whether several threads can insert a batch of so many vertices.
  bool shares_batches_of(std::size_t num_vertices) const { return num_vertices > few_vertices_; }
  /// Whether wrapping so many points costs less than inserting them.
  bool is_worth_wrapping(std::size_t num_points) const {
    return is_wrappable_ && engine::is_worth_wrapping(dimension_, num_points);
  }

 protected:
  /// `is_wrappable`: points have full dimension, and are neither weighted nor furthest. `few_vertices`: so
  /// many are inserted by one thread.
  TriangulationEngine(int dimension, bool is_wrappable, std::size_t few_vertices)
      : dimension_(dimension), is_wrappable_(is_wrappable), few_vertices_(few_vertices) {}

 private:
  int dimension_;
  bool is_wrappable_;
  std::size_t few_vertices_;
};

/// An engine for the flat that projects one-to-one on `axes`. K = axes.size(), or 0 for any number of axes.
template <int K>
std::unique_ptr<TriangulationEngine> make_triangulation_engine(const std::vector<int>& axes,
                                                               VertexPoints& points,
                                                               const geometry::Frame& frame,
                                                               const engine::Effort& effort);

}  // namespace delone::compiled
