// SPDX-License-Identifier: BSD-3-Clause
// The boundary of a convex hull, or of a cone of homogeneous rows, site by site: two ends for k = 1, cells of
// the engine from k = 2 on.
#pragma once

#include "compiled/boundary_engine.hpp"
#include "compiled/simplicial_hull.hpp"
#include "hull/insertion_places.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

namespace delone::hull {

using compiled::SimplicialHull;
using geometry::CentralView;
using sites::BoundarySites;

class Boundary {
 public:
  /// The boundary of the simplex of k+1 independent sites, k ≥ 1. `view`: with a centre, without a box, which
  /// is that of all sites. `sites` must outlive this object and may grow.
  Boundary(const BoundarySites& sites, const std::vector<Index>& simplex, CentralView view);
  /// A copy that reads the sites from another place.
  Boundary(const BoundarySites& sites, const Boundary& other);

  /// Makes the cells those of the hull of more sites, which were not inserted before: `added`, and on its
  /// boundary, or strictly inside. `planes`: for each cell the slot of a present one in the same hyperplane.
  /// If it throws, the boundary is as it was. REQUIRES k ≥ 2, a call of hull() after the last insertion, that
  /// no batch has begun, and cells that depend on those of hull() and on the sites alone.
  void replace_cells(const SimplicialHull& hull, std::span<const Index> planes, std::span<const Index> added,
                     std::span<const char> is_inside);

  /// Makes room for what is noted of n sites.
  void reserve(std::size_t n) { is_surely_interior_.reserve(n); }
  /// Takes note of sites that have been added, from `first` on, before they are inserted.
  void include_sites(Index first);
  /// Inserts a site, distinct from all earlier ones: done, hidden or interior. If it throws, the boundary is
  /// as it was.
  engine::Outcome insert(Index site);
  /// Inserts sites in turn. `tick` is told often how many have been, and may throw to stop: then the boundary
  /// is of no use unless the batch is undone.
  void insert_all(std::span<const Index> sites, const std::function<void(std::size_t)>& tick);
  /// The same by several threads, if there are more than one. Where many sites turn out to be in the
  /// interior, those of the next round are tested first and never claim a cell. `rounds`: as for
  /// engine::Batch. REQUIRES shares_batches_of() and prepare_for_threads() for several.
  void insert_all(std::span<const Index> sites, std::span<const std::size_t> rounds, unsigned threads,
                  const std::function<void(std::size_t)>& tick);
  /// Whether several threads may insert so many sites.
  bool shares_batches_of(std::size_t num_sites) const {
    return engine_ && compiled::shares_batches_of(*engine_, num_sites);
  }
  /// Several threads may insert sites before the next call of hull(), which numbers cells in an order that
  /// does not depend on timing. `order`: of these sites, among others perhaps, and no function of what was
  /// inserted by several threads before. Until hull() is called, a batch that has begun can be undone.
  void prepare_for_threads(std::span<const Index> order);
  /// Whether several threads may have inserted anything.
  bool was_shared() const { return was_shared_; }

  /// What follows can be undone, until it is, or kept. Throws std::bad_alloc, and then changes nothing.
  void begin_batch();
  void keep_batch() noexcept;
  /// The boundary is what it was; the box and the grid may stay larger.
  void undo_batch() noexcept;

  /// Whether a site is known to be strictly inside; others may be, too.
  bool is_surely_interior(Index site) const {
    return site < is_surely_interior_.size() && is_surely_interior_[site] != 0;
  }
  /// Says so of a site that need not be inserted.
  void leave_out(Index site) { is_surely_interior_[site] = 1; }
  /// Looks which of the sites are strictly inside, by several threads (Options::threads). Fast where each is
  /// near the one before. A cancellation point.
  void find_interior(std::span<const Index> sites, unsigned threads);
  /// Takes out the sites that are strictly inside, if a sample says that they are many.
  void drop_interior(std::vector<Index>& sites, unsigned threads);

  /// Inside of a cell is where the determinant of its rows and of another one is positive; for k = 1 cell 0
  /// is the lower of two points, or the row from which the cone is on the positive side. Cells have an order
  /// that does not depend on timing; before, they may. `const` calls may come from several threads.
  SimplicialHull make_hull() const;
  /// The same, made on the first call after an insertion.
  const SimplicialHull& hull() const;
  /// The pairs of neighboring cells of hull() that lie in one hyperplane, exactly.
  std::vector<std::pair<Index, Index>> coplanar_neighbors(const SimplicialHull& hull) const;
  /// The exact side of the end `c` that a site is on: + inside, 0 at the end. REQUIRES k = 1.
  Sign side_of_end(std::size_t c, Index site) const;

  /// None for k = 1.
  const compiled::BoundaryEngine* engine() const { return engine_.get(); }
  /// A point strictly inside, on the axes, if `has_center()`.
  const std::vector<double>& center() const { return view_.center; }
  bool has_center() const { return view_.is_inside; }
  const engine::Effort& effort() const {
    return engine_ ? compiled::effort_of(*engine_) : now_.effort_of_ends;
  }
  std::uint64_t insertions() const { return now_.insertions; }
  std::size_t bytes() const;

 private:
  /// What of all this a batch changes.
  struct Progress {
    Index ends[2] = {};  ///< for k = 1
    engine::Effort effort_of_ends;
    std::uint64_t insertions = 0;
    bool hull_is_current = false;
  };

  bool grow_box(Index first, double margin);
  engine::Outcome insert_end(Index site);
  void insert_part(std::span<const Index> sites, std::span<const std::size_t> rounds, unsigned threads,
                   const std::function<void(std::size_t)>& tick);
  void note(Index site, engine::Outcome outcome);
  bool are_many_interior(std::span<const Index> sites) const;
  void sort_cells() const;
  SimplicialHull hull_of_sorted_cells() const;

  const BoundarySites& sites_;
  CentralView view_;
  std::unique_ptr<compiled::BoundaryEngine> engine_;  // none for k = 1
  std::vector<char> is_surely_interior_;              // by site
  mutable Progress now_;
  Progress before_;
  std::size_t num_sites_before_ = 0;  // the batch
  unsigned threads_ = 1;              // of the last batch of several
  mutable std::mutex mutex_;
  mutable InsertionPlaces places_;
  /// Whether several threads may have inserted anything: then what is cached of cells tells of timing for
  /// ever, and so may the ids of all that are made later.
  bool was_shared_ = false;
  bool is_in_batch_ = false;                 // that may be undone: cells stay in their slots
  mutable bool ids_tell_of_timing_ = false;  // of cells: they have to be sorted before they are shown
  mutable SimplicialHull hull_;              // if now_.hull_is_current
};

}  // namespace delone::hull
