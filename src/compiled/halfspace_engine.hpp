// SPDX-License-Identifier: BSD-3-Clause
// The engine with the geometry of halfspaces behind one virtual interface: the boundary of the cone of
// homogeneous rows. The dimension is fixed in an implementation, which is compiled as for convex hulls.
#pragma once

#include "compiled/simplicial_hull.hpp"
#include "engine/batch.hpp"
#include "engine/workspace.hpp"
#include "geometry/halfspace_geometry.hpp"

#include <delone/types.hpp>

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace delone::internal {

using geometry::DualSites;
using geometry::DualView;

/// The boundary of the cone of rows that span k+1 dimensions, k ≥ 2. Its cells have k vertices.
class HalfspaceEngine {
 public:
  virtual ~HalfspaceEngine() = default;

  /// Inserts a site, whose ray is that of no other. False if it is in conflict with no cell. Strong
  /// guarantee.
  virtual bool insert(Index site) = 0;
  /// Inserts all vertices of a batch, each as insert() does.
  virtual void insert_all(engine::Batch& batch) = 0;
  /// Whether several threads may insert a batch of so many vertices.
  virtual bool shares_batches_of(std::size_t num_vertices) const = 0;
  /// The same by several threads. REQUIRES shares_batches_of(). After an exception cells are of no use unless
  /// the batch is undone.
  virtual void insert_all(const engine::ParallelBatch& batch) = 0;
  /// Gives cells ids that depend on their vertices alone, and on the places where these come in a certain
  /// order (engine/sort_cells.hpp): by vertex, from 0 on. Where batches are never shared, does nothing.
  virtual void sort_cells(std::span<const Index> places, unsigned threads) = 0;
  /// What follows can be undone, until it is, or kept. Throws, and then changes nothing.
  virtual void begin_batch() = 0;
  virtual void keep_batch() noexcept = 0;
  /// Cells are what they were, in their slots. A frame or box that has become larger stays so.
  virtual void undo_batch() noexcept = 0;
  /// Takes over the view's box, which has changed. Throws std::bad_alloc, and then changes nothing.
  virtual void update_box() = 0;
  /// A copy that reads sites and view from other places.
  virtual std::unique_ptr<HalfspaceEngine> copy(const DualSites& sites, const DualView& view) const = 0;

  virtual SimplicialHull to_simplicial_hull() const = 0;
  /// The pairs of neighboring cells that lie in one hyperplane.
  virtual std::vector<std::pair<Index, Index>> coplanar_neighbors(const SimplicialHull& hull) const = 0;
  /// The exact side of the cell in a slot that a site is on: + inside, 0 on its hyperplane.
  virtual Sign side(Index slot, Index site) const = 0;
  /// For a site that is in no cell: the slot of a cell on whose hyperplane it is exactly, or nullopt if it is
  /// strictly inside.
  virtual std::optional<Index> cell_through(Index site) const = 0;

  virtual const engine::Effort& effort() const = 0;
  virtual std::size_t bytes() const = 0;
};

/// The boundary of the cone of k+1 independent rows. K is k − 1, the dimension of the cells, or 0 for any.
template <int K>
std::unique_ptr<HalfspaceEngine> make_halfspace_engine(const DualSites& sites, const DualView& view,
                                                       std::vector<Index> simplex);

}  // namespace delone::internal
