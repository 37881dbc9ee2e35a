// SPDX-License-Identifier: BSD-3-Clause
// The boundary of a convex hull, site by site: a range of numbers in one dimension, a boundary of the
// engine's from two on.
#pragma once

#include "compiled/hull_engine.hpp"
#include "compiled/simplicial_hull.hpp"

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
  /// What follows can be undone, until it is, or kept. Throws std::bad_alloc, and then changes nothing.
  void begin_batch();
  void keep_batch() noexcept;
  /// The boundary is what it was; the box and the grid may stay larger.
  void undo_batch() noexcept;
  /// Whether a site is in the interior for certain; false says nothing. Fast if the previous site was
  /// near.
  bool is_surely_interior(Index site) { return boundary_ && boundary_->is_surely_interior(site); }

  /// Made on the first call after an insertion; `const` calls may come from several threads.
  const SimplicialHull& hull() const;
  /// None for k = 1.
  const HullEngine* boundary() const { return boundary_.get(); }
  /// A point strictly inside, on the axes, if `has_center()`.
  const std::vector<double>& center() const { return view_.center; }
  bool has_center() const { return view_.is_inside; }
  const engine::Effort& effort() const { return boundary_ ? boundary_->effort() : now_.effort_of_ends; }
  std::uint64_t insertions() const { return now_.insertions; }
  std::size_t bytes() const { return boundary_ ? boundary_->bytes() : sizeof(now_.ends); }

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
  void count(Insertion outcome);
  void choose_center(const std::vector<Index>& simplex);
  void grow_box(const double* point, double margin);

  const HullSites& sites_;
  HullView view_;
  std::unique_ptr<HullEngine> boundary_;  // none for k = 1
  mutable Progress now_;
  Progress before_;
  mutable std::mutex mutex_;
  mutable SimplicialHull hull_;  // if now_.hull_is_current
};

}  // namespace delone::internal
