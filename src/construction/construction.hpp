// SPDX-License-Identifier: BSD-3-Clause
// A transaction on sites and cells: rows are inserted in bulk, or edited, whole or not at all.
#pragma once

#include "base/build_limits.hpp"
#include "construction/edit_lists.hpp"
#include "construction/state.hpp"

#include <delone/edit.hpp>

#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace delone::construction {

/// What is wanted of what a transaction notes.
struct Recording {
  bool changes = false, undo = false;
  bool sorts_later = false;  ///< new cells whose ids may tell of timing stay as they are for now
  bool is_on() const { return changes || undo; }
};

/// What is known of an edit beforehand.
struct EditHints {
  Index start = invalid_index;  ///< a cell to walk from to the first new point, if nothing is removed
  bool rebuilds = false;        ///< to rebuild everything costs less
  bool moves_in_place = true;   ///< vertices that move may stay where they are in the cells
  bool may_rebuild = true;      ///< if not, an edit that would rebuild everything is given up instead
};

/// Changes, and a list of theirs that users ask for separately.
struct AllChanges {
  Changes lists;
  std::vector<CellId> removed_infinite_cells;  ///< increasing
};

class Construction {
 public:
  /// From here on everything that changes is noted. `limits` is told while cells are wrapped: what is done
  /// then is not counted in points.
  Construction(State& state, const Recording& recording, internal::BuildLimits& limits);
  /// Unless it was committed, everything is as it was.
  ~Construction();
  Construction(const Construction&) = delete;
  Construction& operator=(const Construction&) = delete;

  /// Inserts rows: d coordinates each, and one of `weights` if points have weights. `release`, if there is
  /// one, is called when the coordinates are not needed any more, before most cells are created.
  void insert(std::span<const double> coordinates, std::span<const double> weights,
              const std::function<void()>& release);
  /// Removes, moves, reweights and inserts rows. Returns false if it was given up (EditHints::may_rebuild):
  /// then the transaction must not be committed. REQUIRES lists that are valid (require_valid()).
  bool edit(const RowEdits& edits, const EditHints& hints);

  /// Keeps what was done. Returns its record, if that is wanted: then nothing else may change before forget()
  /// or, if undoing is wanted, roll_back().
  std::unique_ptr<Record> commit();

  /// What has changed since the beginning of a record.
  static AllChanges changes_since(const State& state, const Record& record);
  static void roll_back(State& state, Record& record) noexcept;
  /// The record of the last committed transaction is not wanted any more: the engine drops its log, the
  /// caller the record.
  static void forget(State& state) {
    if (state.engine) state.engine->keep_batch();
  }

 private:
  friend class Editing;
  bool is_small(std::size_t num_points) const;
  bool is_shared_on_record(std::size_t num_points) const;
  void sort_cells_on_record();
  void note_all_visibility(std::span<const CellId> before);
  void assign_rows(const class BulkInsertion& bulk, std::size_t first_row);

  State& state_;
  const Recording recording_;
  internal::BuildLimits& limits_;
  std::unique_ptr<Record> record_;
};

}  // namespace delone::construction
