// SPDX-License-Identifier: BSD-3-Clause
// An edit, whole or not at all: rows that are removed, moved, weighed anew and inserted.
//
// Rows become vertices first. A vertex that is left without rows goes; a row that is alone at its vertex
// takes it along to its new point; a row that is not alone leaves its vertex behind, and is inserted as a new
// one. Vertices that move little stay where they are in the cells (engine/hole/relocation.hpp). Then either
// all others that go or move are taken out, one by one, and those that come or move are inserted, or
// everything is built anew (rebuilding.cpp), whichever costs less. Hidden points that may come back are
// inserted before those. How many they are shows while vertices are taken out, so that building anew may
// begin then, too.
#pragma once

#include "base/progress_meter.hpp"
#include "triangulation/triangulation_impl.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace delone {

class Triangulation::Impl::Editing {
 public:
  /// Throws for rows that are not there or are given twice, and for numbers that are not finite.
  /// `start`: a cell to walk from to the first point that is inserted, if nothing is taken out; or
  /// invalid_index. `anew`: everything is built anew, as that is known to cost less.
  Editing(Impl& impl, const RowEdits& edits, Index start, bool anew);
  /// Unless the edit has been completed, everything is as it was.
  ~Editing();
  Editing(const Editing&) = delete;
  Editing& operator=(const Editing&) = delete;

  void run();

 private:
  /// A vertex that is to be placed at a point: with a new id and row, or with the id that it has.
  struct Placement {
    Index vertex;  ///< invalid_index for one that gets its id when its turn comes
    Index row;     ///< if it does
    Index point;   ///< number in points_
    Index near;    ///< a vertex that was a neighbor, or invalid_index
  };

  /// A vertex that was visible and goes or moves.
  struct Leaving {
    Index vertex;
    Index placement;  ///< where it goes, or none
  };
  static constexpr Index none = invalid_index;

  void require_rows(const char* list, std::span<const std::size_t> rows) const;
  void require_disjoint(const char* list, std::span<const std::size_t> rows) const;
  void tick();
  void tick_batch(std::size_t placed, std::size_t of);
  void plan();
  void plan_moves();
  void add_point(std::span<const double> coordinates, double weight);
  /// The number of the point that is added next.
  Index next_point() const { return static_cast<Index>(points_.size() / impl_.row_size()); }
  const double* point(const Placement& placement) const {
    return points_.data() + placement.point * impl_.row_size();
  }
  bool is_worth_building_anew() const;
  bool has_freed_many(std::size_t num_taken_out) const;
  void begin_batch();
  void begin();
  bool are_steps_long() const;
  void settle_all();
  void settle_some();
  bool can_settle(const Placement& placement) const;
  std::vector<Index> staying_hidden() const;
  bool meets_hidden(std::span<const Index> hidden) const;
  void restore_points(std::size_t first);
  void erase_settled(const std::vector<std::uint8_t>& is_settled);
  bool take_all_out();
  std::optional<Index> take_out(Index v);
  void take_out_only_vertex();
  void lower(Index v);
  void list_hidden_points();
  void find_hidden_points();
  void place_all();
  Index start_near(const double* point, Index near, const double* before);
  void place(const Placement& placement);
  void place_again(Index v);
  void note_point(Index v);
  void set_point(Index v, const double* point);
  void merge(Index v, Index into);
  void build_anew();
  void merge_equal(std::vector<std::pair<Index, Index>>& equal);
  void insert_others(std::span<const Index> others, std::span<const std::size_t> rounds_of_all,
                     const std::function<void(Index v, Index at)>& on_placed);
  void finish();

  bool is_dying(Index v) const { return impl_.row_of_vertex[v] == invalid_index; }

  Impl& impl_;
  const RowEdits& edits_;
  const Index start_;
  const bool anew_;
  std::unique_ptr<internal::EditRecord> record_;
  std::vector<double> points_;  // new ones, with weights where points have weights
  std::vector<Leaving> leaving_;
  std::vector<Placement> placements_;  // of those that come or move
  std::vector<Index> freed_;           // hidden vertices that may come back
  std::vector<Index> dead_;            // vertices without rows
  const std::size_t total_;
  internal::ProgressMeter progress_;
  std::size_t done_ = 0;
  bool is_done_ = false;
};

}  // namespace delone
