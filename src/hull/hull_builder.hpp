// SPDX-License-Identifier: BSD-3-Clause
// The boundary of a convex hull, site by site: a range of numbers in one dimension, a boundary of the
// engine's from two on.
#pragma once

#include "compiled/hull_engine.hpp"
#include "compiled/simplicial_hull.hpp"
#include "hull/insertion_places.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

namespace delone::internal {

class ConvexHullBuilder {
 public:
  /// The boundary of the simplex of k+1 affinely independent sites, k ≥ 1. `sites` must outlive this object
  /// and may grow.
  ConvexHullBuilder(const HullSites& sites, const std::vector<Index>& simplex);
  /// A copy that reads the sites from another place.
  ConvexHullBuilder(const HullSites& sites, const ConvexHullBuilder& other);

  /// Takes note of sites that have been added, from `first` on, before they are inserted.
  void include_sites(Index first);
  /// Inserts a site, distinct from all earlier ones. If it throws, the boundary is as it was.
  Insertion insert(Index site);
  /// The same for many sites in turn; `placed` is told what became of each, and may throw to stop.
  void insert_all(std::span<const Index> sites, const std::function<void(Index, Insertion)>& placed);
  /// Whether several threads may insert so many sites.
  bool shares_batches_of(std::size_t num_sites) const {
    return boundary_ && boundary_->shares_batches_of(num_sites);
  }
  /// Several threads may insert sites before the next call of hull(), which numbers cells in an order that
  /// does not depend on timing. `order`: of these sites, among others perhaps, and no function of what was
  /// inserted by several threads before. Until hull() is called, a batch that has begun can be undone.
  void prepare_for_threads(std::span<const Index> order);
  /// The same as above by several threads. `rounds`: as for engine::ParallelBatch. `tick` is called often, in
  /// the calling thread alone, with the number of sites inserted, and may throw to stop. REQUIRES
  /// shares_batches_of() and prepare_for_threads(). Without begin_batch() the boundary is of no use after an
  /// exception.
  void insert_all(std::span<const Index> sites, std::span<const std::size_t> rounds, unsigned threads,
                  const std::function<void(std::size_t)>& tick,
                  const std::function<void(Index, Insertion)>& placed);
  /// What follows can be undone, until it is, or kept. Throws std::bad_alloc, and then changes nothing.
  void begin_batch();
  void keep_batch() noexcept;
  /// The boundary is what it was; the box and the grid may stay larger.
  void undo_batch() noexcept;
  /// Whether a site is in the interior for certain; false says nothing. Fast if the previous site was
  /// near.
  bool is_surely_interior(Index site) { return boundary_ && boundary_->is_surely_interior(site); }
  /// The same for many sites, by several threads (Options::threads): is_interior[i] becomes 1 or 0. A
  /// cancellation point.
  void find_surely_interior(std::span<const Index> sites, std::span<char> is_interior,
                            unsigned threads) const;

  /// Made on the first call after an insertion; `const` calls may come from several threads.
  const SimplicialHull& hull() const;
  /// None for k = 1.
  const HullEngine* boundary() const { return boundary_.get(); }
  /// A point strictly inside, on the axes, if `has_center()`.
  const std::vector<double>& center() const { return view_.center; }
  bool has_center() const { return view_.is_inside; }
  const engine::Effort& effort() const { return boundary_ ? boundary_->effort() : now_.effort_of_ends; }
  std::uint64_t insertions() const { return now_.insertions; }
  std::size_t bytes() const;

 private:
  struct SiteBatch;
  /// What of all this a batch changes.
  struct Progress {
    Index ends[2] = {};  ///< the lower and the upper end, for k = 1
    engine::Effort effort_of_ends;
    std::uint64_t insertions = 0;
    bool hull_is_current = false;
  };

  Insertion insert_end(Index site);
  void sort_cells() const;
  void count(Insertion outcome);
  void choose_center(const std::vector<Index>& simplex);
  void grow_box(const double* point, double margin);

  const HullSites& sites_;
  HullView view_;
  std::unique_ptr<HullEngine> boundary_;  // none for k = 1
  mutable Progress now_;
  Progress before_;
  unsigned threads_ = 1;  // of the last batch of several
  mutable std::mutex mutex_;
  mutable InsertionPlaces places_;
  /// Whether several threads may have inserted anything: then what is cached of cells tells of timing for
  /// ever, and so may the ids of all that are made later.
  bool was_shared_ = false;
  bool is_in_batch_ = false;                 // that may be undone: cells stay in their slots
  mutable bool ids_tell_of_timing_ = false;  // of cells: they have to be sorted before they are shown
  mutable SimplicialHull hull_;              // if now_.hull_is_current
};

}  // namespace delone::internal
