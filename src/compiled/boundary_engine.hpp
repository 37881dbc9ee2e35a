// SPDX-License-Identifier: BSD-3-Clause
// The engine of boundaries, behind a virtual interface: of the convex hull of points, and of the cone of
// homogeneous rows of halfspaces. It is compiled for cells of 1 … 7 dimensions, and once for any number.
#pragma once

#include "compiled/engine.hpp"
#include "compiled/simplicial_hull.hpp"
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

/// The boundary of sites that span k dimensions, k ≥ 2: points a k-flat, homogeneous rows a cone of dimension
/// k + 1. Its cells have k vertices; site i is vertex i + 1.
class BoundaryEngine : public Engine {
 public:
  /// Takes over the view's box, which has changed. Throws std::bad_alloc, and then changes nothing.
  virtual void update_box() = 0;
  /// Makes the cells those of a hull of the same sites. `planes`: for each the slot of a present cell in the
  /// same hyperplane, whose functional it takes over. Throws std::bad_alloc, and then changes nothing.
  /// REQUIRES that no batch has begun.
  virtual void replace_cells(const SimplicialHull& hull, std::span<const Index> planes) = 0;
  /// A copy that reads sites and view from other places.
  virtual std::unique_ptr<BoundaryEngine> copy(const BoundarySites& sites, const CentralView& view) const = 0;

 protected:
  using Engine::Engine;
};

/// The boundary of the simplex of k+1 independent sites.
std::unique_ptr<BoundaryEngine> make_boundary_engine(const BoundarySites& sites, const CentralView& view,
                                                     const std::vector<Index>& simplex);

SimplicialHull simplicial_hull_of(const BoundaryEngine& boundary);
const engine::Effort& effort_of(const BoundaryEngine& boundary);
std::size_t bytes_of(const BoundaryEngine& boundary);
/// Whether several threads may insert a batch of so many vertices.
bool shares_batches_of(const BoundaryEngine& boundary, std::size_t num_vertices);
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
