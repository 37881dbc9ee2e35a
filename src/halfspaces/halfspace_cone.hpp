// SPDX-License-Identifier: BSD-3-Clause
// The cone of the rows of an intersection of halfspaces, row by row: its boundary by the engine, or two rays
// for k = 1.
//
// Site 0 is the row at infinity (0, …, 0, −1), dual to the origin: cells on whose hyperplane it lies are
// directions to infinity.
#pragma once

#include "compiled/halfspace_engine.hpp"
#include "halfspaces/halfspace_dual.hpp"
#include "hull/insertion_places.hpp"

#include <delone/options.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace delone::internal {

class HalfspaceCone {
 public:
  /// The cone of the simplex of k+1 sites that are independent. `sites` holds all rows of the first batch,
  /// outlives this object and may grow.
  HalfspaceCone(const DualSites& sites, std::vector<Index> simplex, const InteriorPoint& p);
  /// A copy that reads the sites from another place.
  HalfspaceCone(const DualSites& sites, const HalfspaceCone& other);

  /// Inserts sites, whose rays are those of no others, in turn or by several threads. `rounds`: as for
  /// engine::ParallelBatch. progress() is told often how many are inserted, and may throw to stop. Returns
  /// the number of threads. After an exception the cone is of no use, unless the batch is undone.
  unsigned insert_all(std::span<const Index> sites, std::span<const std::size_t> rounds,
                      const Options& options, const std::function<void(std::size_t)>& progress);
  /// Says of a site of the first batch that it is strictly inside, and need not be inserted. For k ≥ 2.
  void leave_out(Index site);
  /// What follows can be undone, until it is, or kept. Throws std::bad_alloc, and then changes nothing.
  void begin_batch();
  void keep_batch() noexcept;
  /// The cone is what it was; its box may stay larger.
  void undo_batch() noexcept;

  /// The boundary. Inside of a cell is where the determinant of its rows and of the queried row is
  /// positive; for k = 1 cell 0 is so, cell 1 the other way round. Cells have an order that does not depend
  /// on timing; until then they may.
  SimplicialHull hull() const;
  std::vector<std::pair<Index, Index>> coplanar_neighbors(const SimplicialHull& hull) const;
  /// The exact side of cell c of hull() that a site is on: + inside, 0 on its hyperplane.
  Sign side(const SimplicialHull& hull, std::size_t c, Index site) const;
  /// For a site in no cell: a cell of hull() on whose hyperplane it is exactly, or nullopt if it is strictly
  /// inside.
  std::optional<Index> cell_through(const SimplicialHull& hull, Index site) const;

  engine::Effort effort() const { return boundary_ ? boundary_->effort() : engine::Effort{}; }
  std::uint64_t insertions() const { return now_.insertions; }
  std::size_t bytes() const;

 private:
  void choose_center(const std::vector<Index>& simplex, const InteriorPoint& p);
  bool grow_box(Index site);
  void include(std::span<const Index> sites);
  void insert_end(Index site);
  unsigned prepare_for_threads(std::span<const Index> sites, const Options& options);
  void insert_in_threads(std::span<const Index> sites, std::span<const std::size_t> rounds, unsigned threads,
                         const std::function<void(std::size_t)>& progress);
  void sort_cells() const;

  struct SiteBatch;
  /// What of all this a batch changes.
  struct Progress {
    Index ends[2] = {};  ///< for k = 1: all rays are on the positive side of the first, seen from it
    std::uint64_t insertions = 0;
  };

  const DualSites& sites_;
  DualView view_;
  std::unique_ptr<HalfspaceEngine> boundary_;  // none for k = 1
  Progress now_, before_;
  std::vector<char> is_surely_inside_;  // by site: whether it is known to be strictly inside
  unsigned threads_ = 1;                // of the last batch of several
  mutable std::mutex mutex_;
  mutable InsertionPlaces places_;
  /// Whether several threads may have inserted anything: then what is cached of cells tells of timing for
  /// ever, and so may the ids of all that are made later.
  bool was_shared_ = false;
  mutable bool ids_tell_of_timing_ = false;  // of cells: they have to be sorted before they are shown
};

}  // namespace delone::internal
