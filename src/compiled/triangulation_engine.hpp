// SPDX-License-Identifier: BSD-3-Clause
// The engine with its geometry behind one virtual interface: the dimension of the flat is fixed in an
// implementation, which is compiled for 1 … 8 and once for a dimension chosen at run time. Calls are as
// coarse as an insertion.
#pragma once

#include "engine/batch.hpp"
#include "engine/hole/removal.hpp"
#include "engine/workspace.hpp"
#include "geometry/frame.hpp"
#include "kernel/flat.hpp"
#include "kernel/grid.hpp"

#include <delone/complex.hpp>
#include <delone/types.hpp>

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace delone {

/// The points of the vertices, which the engine reads: d coordinates each, and then the weight if points have
/// one, by vertex id; vertex 0 is a dummy.
struct VertexPoints {
  VertexPoints(int dimension, kernel::RowForm given)
      : ambient(dimension), form(given), coordinates(row_size(), 0.0), grid(dimension, weighted()) {}
  int ambient;
  kernel::RowForm form;
  std::vector<double> coordinates;
  std::size_t num_waiting = 0;  ///< how many of the points, at the end, are no vertices yet
  kernel::Grid grid;

  bool weighted() const { return form == kernel::RowForm::weighted_point; }
  std::size_t row_size() const { return static_cast<std::size_t>(ambient) + (weighted() ? 1 : 0); }
  /// The largest vertex id; where points may be hidden some vertices have no cell.
  Index last_vertex() const { return static_cast<Index>(coordinates.size() / row_size() - num_waiting) - 1; }
  /// What that may become without more memory.
  Index last_expected() const { return static_cast<Index>(coordinates.capacity() / row_size()) - 1; }
  const double* point(Index v) const { return coordinates.data() + static_cast<std::size_t>(v) * row_size(); }
  /// A grid for the points and a query.
  kernel::Grid grid_with(const double* query) const {
    kernel::Grid larger = grid;
    larger.include(query);
    return larger;
  }
};

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

/// The same, while points are inserted, removed and moved.
class TriangulationEngine : public TriangulationQueries {
 public:
  /// Starts from k+1 affinely independent vertices.
  virtual void seed(std::span<const Index> vertices) = 0;
  /// Whether wrapping so many points costs less than inserting them. Only points of full dimension, neither
  /// weighted nor sought for what is furthest, can be wrapped.
  virtual bool is_worth_wrapping(std::size_t num_points) const = 0;
  /// Starts from all vertices, if they can be wrapped: returns false, and has no cells, where rounded numbers
  /// do not say how, and if there are ties. What only queries and insertions need is computed by the first of
  /// them, O(k³) per cell. The cells and their ids are the same for every number of threads. `tick` is called
  /// often by this thread, with the fraction done; what it throws is passed on.
  virtual bool wrap(unsigned threads, const std::function<void(double)>& tick) = 0;
  /// Starts from a triangulation of dimension k−1 and a vertex outside its flat.
  virtual void jump(const Complex& old, Index q) = 0;
  /// Starts from a triangulation of the same points. Its cells keep their ids if it has no vacant slots.
  virtual void restore(const Complex& old) = 0;

  /// A copy that reads the points, which are the same, from another place.
  virtual std::unique_ptr<TriangulationEngine> copy(const VertexPoints& points) const = 0;

  /// Changing the frame recomputes all cached functionals.
  virtual void set_frame(geometry::Frame frame) = 0;

  /// Inserts vertex v, starting at cell `start` or, if that is invalid, where the last insertion ended.
  /// Returns v, or the vertex that is at the same point with the same weight, or invalid_index if v is
  /// hidden.
  virtual Index insert(Index v, Index start) = 0;
  /// Inserts all vertices of a batch, each as insert() does.
  virtual void insert_all(engine::Batch& batch) = 0;
  /// Removes vertex v, one of whose cells is `cell`.
  virtual engine::Removal remove(Index v, Index cell) = 0;
  /// Whether several threads can insert a batch of so many vertices.
  virtual bool shares_batches_of(std::size_t num_vertices) const = 0;
  /// The same in several threads. REQUIRES that they can.
  virtual void insert_all(const engine::ParallelBatch& batch) = 0;
  /// Gives vertices other ids: vertex v becomes new_ids[v], which may be invalid_index for those that have no
  /// cell. The points of the vertices have been moved by then. Throws std::bad_alloc, and then changes
  /// nothing.
  virtual void renumber_vertices(std::span<const Index> new_ids) = 0;
  /// Gives cells ids that depend on the ids of their vertices alone, without gaps, where several threads may
  /// have inserted a batch. Throws std::bad_alloc, and then changes nothing.
  virtual void sort_cells(unsigned threads) = 0;
  /// After vertex v, one of whose cells is `cell`, has got another point in the frame: makes the cells those
  /// of the new point, if they change little. Returns false if they do not; then no cell has changed, and
  /// renew() has to be called as soon as the point is the old one.
  virtual bool settle(Index v, Index cell) = 0;
  /// The same after any vertices have moved, in another frame if there is one, in up to `threads` threads
  /// (Options::threads). If it returns false, renew_all() has to be called.
  virtual bool settle_all(std::optional<geometry::Frame> frame, unsigned threads) = 0;
  /// The cells that settling has made; some of them may have gone again.
  virtual std::span<const Index> made_by_settling() const = 0;
  /// After settle(): the cells that the vertex had, and those that have gone.
  virtual std::span<const Index> changed_by_settling() const = 0;
  /// Says that a vertex that is in no cell, or whose cells will be renewed, has got another point.
  virtual void rewrite_row(Index v) noexcept = 0;
  /// Computes anew what is cached for the cells of vertex v, unless settle() was never called; or for all
  /// cells.
  virtual void renew(Index v, Index cell) noexcept = 0;
  virtual void renew_all() noexcept = 0;

  /// What follows can be undone, until it is, or kept. `is_small`: it changes few of the cells, and does not
  /// use several threads. Throws, and then changes nothing.
  virtual void begin_batch(bool is_small = false) = 0;
  virtual void keep_batch() noexcept = 0;
  /// Cells are what they were, in their slots. A frame or box that has become larger stays so. `put_back` is
  /// called with each cell that had gone, and must not throw.
  virtual void undo_batch(const std::function<void(Index)>& put_back = [](Index) {}) noexcept = 0;
  /// The cells that have gone and come since the beginning of the batch. A cell that has come may have the id
  /// of one that has gone.
  virtual void changed_cells(std::vector<CellId>& gone, std::vector<CellId>& come) const = 0;

  /// The facets that the cells of the last insertion were made from.
  virtual std::span<const HorizonFacet> star() const = 0;
  /// The cells that gave way at the last insertion or removal, and those that the last removal has made.
  virtual std::span<const Index> replaced() const = 0;
  virtual std::span<const Index> made_by_removal() const = 0;
  /// Whether insertions find out which vertices lose all their cells. At first they do not: it costs.
  virtual void track_swallowed(bool wanted) = 0;
  /// The vertices that the last insertion took all cells from, if that was tracked.
  virtual std::span<const Index> swallowed() const = 0;
};

/// An engine for the flat that projects one-to-one on `axes`. K = axes.size(), or 0 for any number of axes.
template <int K>
std::unique_ptr<TriangulationEngine> make_triangulation_engine(const std::vector<int>& axes,
                                                               const VertexPoints& points,
                                                               const geometry::Frame& frame,
                                                               const engine::Effort& effort);

}  // namespace delone
