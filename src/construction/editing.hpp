// SPDX-License-Identifier: BSD-3-Clause
// An edit as part of a transaction: rows are removed, moved, reweighted and inserted.
//
// Rows become vertices first. A vertex that is left without rows is removed; a row that is alone at its
// vertex takes it along to its new point; a row that is not alone leaves its vertex behind, and is inserted
// as a new one. Vertices that move little stay where they are in the cells (edit_moves.cpp). Then either all
// other vertices that are removed or move are taken out one by one, and new ones and those that move are
// inserted (edit_steps.cpp), or everything is rebuilt (rebuild.cpp), whichever costs less. Hidden points that
// may come back are inserted before those. Their number is known only as vertices are taken out, so an edit
// may still turn to a rebuild then.
#pragma once

#include "base/progress_meter.hpp"
#include "construction/construction.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace delone::construction {

class Editing {
 public:
  /// See Construction::edit().
  Editing(Construction& construction, const RowEdits& edits, const EditHints& hints);
  Editing(const Editing&) = delete;
  Editing& operator=(const Editing&) = delete;

  bool run();

 private:
  /// A vertex that is to be placed at a point: with a new id and row, or with the id that it has.
  struct Placement {
    Index vertex;  ///< invalid_index for one that gets its id when its turn comes
    Index row;     ///< if it does
    Index point;   ///< number in points_
    Index near;    ///< a vertex that was a neighbor, or invalid_index
  };

  /// A vertex that was visible and is removed or moves.
  struct Leaving {
    Index vertex;
    Index placement;  ///< where it goes, or none
    bool moves() const { return placement != none; }
  };
  static constexpr Index none = invalid_index;

  void tick();
  void tick_batch(std::size_t placed, std::size_t of);
  void plan();
  void plan_moves();
  void add_point(std::span<const double> coordinates, double weight);
  /// The number of the point that is added next.
  Index next_point() const { return static_cast<Index>(points_.size() / state_.row_size()); }
  const double* point(const Placement& placement) const {
    return points_.data() + placement.point * state_.row_size();
  }
  bool is_worth_rebuilding() const;
  bool has_freed_many(std::size_t num_taken_out) const;
  void begin_batch();
  bool are_steps_long() const;
  bool move_all_in_place();
  void move_some_in_place();
  bool can_stay(const Placement& placement) const;
  std::vector<Index> staying_hidden() const;
  bool meets_hidden(std::span<const Index> hidden) const;
  void put_points_back(const std::vector<std::uint8_t>& is_put_back, std::size_t first);
  void restore_points(std::size_t first);
  void erase_placed(const std::vector<std::uint8_t>& is_placed);
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
  bool rebuild_if_allowed();
  void rebuild();
  struct Live;
  Live live_vertices() const;
  void merge_equal(std::vector<std::pair<Index, Index>>& equal, std::vector<Index>& new_ids);

  Record& record() { return *construction_.record_; }
  const Record& record() const { return *construction_.record_; }

  Construction& construction_;
  State& state_;
  const RowEdits& edits_;
  const EditHints hints_;
  std::vector<double> points_;  // new ones, with weights where points have weights
  std::vector<Leaving> leaving_;
  std::vector<Placement> placements_;  // of new vertices and those that move
  std::vector<Index> freed_;           // hidden vertices that may come back
  std::vector<Index> dead_;            // vertices without rows
  const std::size_t total_;
  internal::ProgressMeter progress_;
  std::size_t done_ = 0;
};

}  // namespace delone::construction
