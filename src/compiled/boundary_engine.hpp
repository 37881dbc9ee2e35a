// SPDX-License-Identifier: BSD-3-Clause
// The engine of boundaries behind one virtual interface: of the convex hull of points, and of the cone of
// homogeneous rows of halfspaces. The dimension is fixed in an implementation, which is compiled for 2 … 8
// and once for a dimension chosen at run time. What is only asked of cells are functions beside it.
#pragma once

#include "compiled/simplicial_hull.hpp"
#include "engine/batch.hpp"
#include "engine/workspace.hpp"
#include "geometry/central_view.hpp"

#include <delone/types.hpp>

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace delone::compiled {

using geometry::CentralView;

/// What has become of a new site: a vertex of the boundary; none, as it is in conflict with no cell; none,
/// and in the interior.
enum class Insertion { vertex, hidden, interior };

/// The boundary of sites that span k dimensions, k ≥ 2: points a k-flat, homogeneous rows a cone of dimension
/// k + 1. Its cells have k vertices; site i is vertex i + 1.
class BoundaryEngine {
 public:
  virtual ~BoundaryEngine() = default;
  int dimension() const { return dimension_; }  ///< k

  /// Inserts a site, which is none of the others. Strong guarantee.
  virtual Insertion insert(Index site) = 0;
  /// Inserts all vertices of a batch, each as insert() does. After an exception in several threads cells are
  /// of no use unless the batch is undone.
  virtual void insert_all(const engine::Batch& batch) = 0;
  /// Whether several threads may insert a batch of so many vertices.
  virtual bool shares_batches_of(std::size_t num_vertices) const = 0;
  /// Gives cells ids that depend on their vertices alone, and on the places where these come in a certain
  /// order (engine/sort_cells.hpp): by vertex, from 0 on. Where batches are never shared, does nothing.
  virtual void sort_cells(std::span<const Index> places, unsigned threads) = 0;
  /// What follows can be undone, until it is, or kept. Throws, and then changes nothing.
  virtual void begin_batch() = 0;
  virtual void keep_batch() noexcept = 0;
  /// Cells are what they were, in their slots. A box that has become larger stays so.
  virtual void undo_batch() noexcept = 0;
  /// Whether a site is in the interior for certain; false says nothing. Walks from where the last insertion
  /// or question ended.
  virtual bool is_surely_interior(Index site) = 0;
  /// Takes over the view's box, which has changed. Throws std::bad_alloc, and then changes nothing.
  virtual void update_box() = 0;
  /// A copy that reads sites and view from other places.
  virtual std::unique_ptr<BoundaryEngine> copy(const BoundarySites& sites, const CentralView& view) const = 0;

 protected:
  explicit BoundaryEngine(int dimension) : dimension_(dimension) {}

 private:
  int dimension_;
};

/// The boundary of the simplex of k+1 independent sites.
std::unique_ptr<BoundaryEngine> make_boundary_engine(const BoundarySites& sites, const CentralView& view,
                                                     const std::vector<Index>& simplex);

SimplicialHull simplicial_hull_of(const BoundaryEngine& boundary);
const engine::Effort& effort_of(const BoundaryEngine& boundary);
std::size_t bytes_of(const BoundaryEngine& boundary);
/// The pairs of neighboring cells that lie in one hyperplane, exactly. `hull`: that of the boundary.
std::vector<std::pair<Index, Index>> coplanar_neighbors(const BoundaryEngine& boundary,
                                                        const SimplicialHull& hull);
/// Whether sites are in the interior for certain, by several threads (Options::threads): sets is_interior[i]
/// to 1 or 0. A cancellation point.
void find_surely_interior(const BoundaryEngine& boundary, std::span<const Index> sites,
                          std::span<char> is_interior, unsigned threads);

// Of the cell in a slot, and of sites:

/// The exact side of the cell that a site is on: + inside, 0 on its hyperplane.
Sign side_of_slot(const BoundaryEngine& boundary, Index slot, Index site);
/// For a site that is in no cell: the slot of a cell on whose hyperplane it is exactly, or nullopt if it is
/// strictly inside.
std::optional<Index> slot_through(const BoundaryEngine& boundary, Index site);

// Of points of the flat, and of sites that are points:

/// The side of the hyperplane of the cell in a slot that a point is on, by the filter: + inside, − beyond,
/// zero if uncertain.
Sign certain_side(const BoundaryEngine& boundary, Index slot, const double* q);
/// A cell's hyperplane as the engine holds it: n·(x − o) is 1 on it, about, and less inside, with the centre
/// o. Writes n, one number per axis of the flat; returns how far the product is off for points of the box,
/// about: infinity or NaN if nothing is known.
double hyperplane(const BoundaryEngine& boundary, Index slot, double* normal);
/// A cell near the ray from the centre to a point, and what is certain: − the point is beyond its hyperplane,
/// + it is in the interior of the hull. Starts from the best of some cells. O(k) per cell that is passed.
std::pair<Index, Sign> descend(const BoundaryEngine& boundary, const double* q,
                               const std::vector<Index>& starts);

}  // namespace delone::compiled
