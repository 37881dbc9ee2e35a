// SPDX-License-Identifier: BSD-3-Clause
// The engine of triangulations, behind a virtual interface: of points that span a k-flat, 1 ≤ k ≤ d. It is
// compiled for k = 1 … 8, and once for any k.
#pragma once

#include "compiled/engine.hpp"
#include "engine/workspace.hpp"
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

/// A Delaunay, regular or furthest-site triangulation. Vertices are ids of points.
class TriangulationEngine : public Engine {
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

  /// Removes vertex v, one of whose cells is `cell`: done, flat or costly. Strong guarantee.
  virtual engine::Change remove(Index v, Index cell) = 0;
  /// Moves vertex v, one of whose cells is `cell`, to a point in the frame, where it stays among its cells:
  /// done, or costly if it cannot stay or many cells would change. Writes the point. Strong guarantee.
  virtual engine::Change move(Index v, Index cell, const double* to) = 0;
  /// The same after any vertices have got other points, in another frame if there is one, in up to `threads`
  /// threads (Options::threads). Where the hull changes too much, it calls `put_back` with vertices, which
  /// must all have their old points again when the call returns. If it is costly, or throws, the batch has to
  /// be undone before anything else is done. REQUIRES begin_batch() and no change since.
  virtual engine::Change move_all(std::optional<geometry::Frame> frame, unsigned threads,
                                  const std::function<void(std::span<const Index>)>& put_back) = 0;
  /// Takes note, before undo_batch(), that these vertices have their old points again.
  virtual void move_back(std::span<const Index> vertices) noexcept = 0;
  /// Gives vertices other ids: vertex v becomes new_ids[v], which may be invalid_index for those that have no
  /// cell. The points of the vertices have been moved by then. Throws std::bad_alloc, and then changes
  /// nothing.
  virtual void renumber_vertices(std::span<const Index> new_ids) = 0;

 protected:
  using Engine::Engine;
};

/// An engine without cells for the flat that projects one-to-one on `axes`. Its implementation is compiled
/// for axes.size() dimensions. If there is none, or if `force_runtime_dimension`, it takes any number of
/// axes.
std::unique_ptr<TriangulationEngine> make_triangulation_engine(const std::vector<int>& axes,
                                                               VertexPoints& points,
                                                               const geometry::Frame& frame,
                                                               const engine::Effort& effort,
                                                               bool force_runtime_dimension);

/// Where a query lies: the cell the walk ended in, and for a finite one the slots of the smallest face that
/// contains it.
struct QueryLocation {
  Index cell = invalid_index;
  bool outside = false;
  std::vector<VertexId> face;
};

// What may be asked of a CompactTriangulation as well (compact_triangulation.hpp):

/// The box that insertions must stay in to profit from the filter.
const geometry::Frame& frame_of(const TriangulationEngine& engine);
const engine::Effort& effort_of(const TriangulationEngine& engine);
std::size_t bytes_of(const TriangulationEngine& engine);
Complex complex_of(const TriangulationEngine& engine, Index num_vertices,
                   std::span<const CellId> cell_of_vertex);
/// A query has a weight where points have one; where it lies depends on its coordinates only. A walk that is
/// not given a cell to start from starts where the last insertion ended.
QueryLocation locate(const TriangulationEngine& engine, const double* query, Index start);
std::vector<CellId> conflict_zone(const TriangulationEngine& engine, const double* query, Index start);
/// Negative if the query is in conflict with a finite cell, ties not perturbed.
Sign unperturbed_side(const TriangulationEngine& engine, Index cell, const double* query);

// Of an engine alone:

/// The cells that are gone since the beginning of the batch, and those that are new, some perhaps in the
/// slots of the former.
void find_changed_cells(const TriangulationEngine& engine, std::vector<CellId>& gone,
                        std::vector<CellId>& made);
/// Those of the cells that are gone that were infinite, in no order.
void find_removed_infinite_cells(const TriangulationEngine& engine, std::vector<CellId>& gone);
/// Whether several threads can insert a batch of so many vertices.
bool shares_batches_of(const TriangulationEngine& engine, std::size_t num_vertices);
/// Whether wrapping so many points costs less than inserting them.
bool is_worth_wrapping(const TriangulationEngine& engine, std::size_t num_points);

}  // namespace delone::compiled
