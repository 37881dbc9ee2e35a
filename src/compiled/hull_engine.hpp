// SPDX-License-Identifier: BSD-3-Clause
// The engine with the geometry of hulls behind one virtual interface: the dimension is fixed in an
// implementation, which is compiled for flats of 2 … 8 dimensions and once for a dimension chosen at run
// time.
#pragma once

#include "compiled/simplicial_hull.hpp"
#include "engine/batch.hpp"
#include "engine/workspace.hpp"

#include <delone/types.hpp>

#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace delone::internal {

/// What a boundary is seen from. It outlives boundaries, and its grid includes all sites.
struct HullView {
  std::vector<double> center;  ///< a point of R^d
  bool is_inside = false;      ///< whether the centre is strictly inside the simplex the boundary began with
  kernel::Grid grid;           ///< one for the sites and the centre
  std::vector<double> low, high;  ///< a box for all sites
};

/// What has become of a new site: a vertex of the boundary; none, as it is in conflict with no cell; none,
/// and in the interior.
enum class Insertion { vertex, hidden, interior };

/// The boundary of the hull of sites that span a k-flat, k ≥ 2. Its cells have k vertices; site i is vertex i
/// + 1.
class HullEngine {
 public:
  virtual ~HullEngine() = default;

  /// Inserts a site. Strong guarantee.
  virtual Insertion insert(Index site) = 0;
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
  /// Whether a site is in the interior for certain; false says nothing. Walks from where the last insertion
  /// or question ended.
  virtual bool is_surely_interior(Index site) = 0;
  /// The same for many sites, by several threads (Options::threads): sets is_interior[i] to 1 or 0. A
  /// cancellation point.
  virtual void find_surely_interior(std::span<const Index> sites, std::span<char> is_interior,
                                    unsigned threads) const = 0;
  /// Takes over the view's box, which has changed. Throws std::bad_alloc, and then changes nothing.
  virtual void update_box() = 0;
  /// A copy that reads sites and view from other places.
  virtual std::unique_ptr<HullEngine> copy(const HullSites& sites, const HullView& view) const = 0;

  virtual SimplicialHull to_simplicial_hull() const = 0;
  /// The pairs of neighboring cells that lie in one hyperplane, exactly. `hull`: what to_simplicial_hull()
  /// gave.
  virtual std::vector<std::pair<Index, Index>> coplanar_neighbors(const SimplicialHull& hull) const = 0;

  /// The side of a cell's hyperplane that a point of the flat is on, by the filter: + inside, − beyond, zero
  /// if uncertain.
  virtual Sign certain_side(Index slot, const double* q) const = 0;
  /// A cell's hyperplane as the engine holds it: n·(x − o) is 1 on it, about, and less inside, with the
  /// centre o. Writes n, one number per axis of the flat; returns how far the product is off for points of
  /// the box, about: infinity or NaN if nothing is known.
  virtual double hyperplane(Index slot, double* normal) const = 0;
  /// A cell near the ray from the centre to a point of the flat, and what is certain: − the point is beyond
  /// its hyperplane, + it is in the interior of the hull. Starts from the best of some cells. O(k) per cell
  /// that is passed.
  virtual std::pair<Index, Sign> descend(const double* q, const std::vector<Index>& starts) const = 0;

  virtual const engine::Effort& effort() const = 0;
  virtual std::size_t bytes() const = 0;
};

/// The boundary of a simplex of k+1 sites. K is k − 1, the dimension of the cells, or 0 for any.
template <int K>
std::unique_ptr<HullEngine> make_hull_engine(const HullSites& sites, const HullView& view,
                                             std::vector<Index> simplex);

}  // namespace delone::internal
