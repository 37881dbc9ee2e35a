// SPDX-License-Identifier: BSD-3-Clause
#include "construction/editing.hpp"

#include "base/compiler.hpp"

#include <algorithm>
#include <utility>

namespace delone::construction {
Editing::Editing(Construction& construction, const RowEdits& edits, const EditHints& hints)
    : construction_(construction),
      state_(construction.state_),
      edits_(edits),
      hints_(hints),
      total_(edits.remove.size() + 2 * (edits.move.size() + edits.reweight.size()) +
             edits.insert.size() / state_.ambient()),
      progress_(state_.options.progress, total_) {}

/// One more step; a move is two, and may be none.
void Editing::tick() { progress_(std::min(++done_, total_)); }

/// A rebuild has placed `placed` of `of` vertices: that share of what was left when it began is done.
void Editing::tick_batch(std::size_t placed, std::size_t of) {
  const std::size_t begun = std::min(done_, total_);
  progress_(begun + (total_ - begun) * placed / of);
}

bool Editing::run() {
  plan();
  if (!move_all_in_place()) return rebuild_if_allowed();
  move_some_in_place();
  if (is_worth_rebuilding() || !take_all_out()) return rebuild_if_allowed();
  place_all();
  return true;
}

bool Editing::rebuild_if_allowed() {
  if (hints_.may_rebuild) rebuild();
  return hints_.may_rebuild;
}

/// What becomes of vertices.
void Editing::plan() {
  for (const std::size_t row : edits_.remove) {
    const Index v = index(state_.sites.vertex_of(row));
    state_.sites.detach(row);
    if (!state_.sites.has_rows(v)) dead_.push_back(v);
  }
  for (const Index v : dead_)
    if (state_.is_visible(v)) leaving_.push_back({v, none});
  const std::size_t d = state_.ambient(), num_inserted = edits_.insert.size() / d;
  const std::size_t num_placed = edits_.move.size() + edits_.reweight.size() + num_inserted;
  placements_.reserve(num_placed);
  points_.reserve(num_placed * state_.row_size());
  leaving_.reserve(leaving_.size() + edits_.move.size() + edits_.reweight.size());
  record().sites.moved.reserve(edits_.move.size() + edits_.reweight.size());
  record().sites.points.reserve((edits_.move.size() + edits_.reweight.size()) * state_.row_size());
  plan_moves();
  const std::size_t first_row = state_.sites.add_rows(num_inserted);
  for (std::size_t i = 0; i < num_inserted; ++i) {
    const auto row = static_cast<Index>(first_row + i);
    placements_.push_back({invalid_index, row, next_point(), invalid_index});
    add_point(edits_.insert.subspan(i * d, d), state_.weighted() ? edits_.insert_weights[i] : 0);
  }
}

/// Rows that get another point, another weight, or both.
void Editing::plan_moves() {
  const std::size_t d = state_.ambient();
  std::vector<std::pair<std::size_t, std::size_t>> weighed;  // rows, and their numbers in the list
  for (std::size_t i = 0; i < edits_.reweight.size(); ++i) weighed.emplace_back(edits_.reweight[i], i);
  std::sort(weighed.begin(), weighed.end());
  const auto find = [&](std::size_t row) {
    const auto found = std::lower_bound(weighed.begin(), weighed.end(), std::pair(row, std::size_t{0}));
    return found != weighed.end() && found->first == row ? found : weighed.end();
  };
  const auto move_row = [&](std::size_t row, std::span<const double> to, double weight) {
    const Index v = index(state_.sites.vertex_of(row));
    const double* const before = state_.sites.point(v);
    if (std::equal(to.begin(), to.end(), before) && (!state_.weighted() || weight == before[d])) return;
    const Index number = next_point();
    add_point(to, weight);
    if (state_.sites.has_several(v)) {
      state_.sites.detach(row);
      placements_.push_back({invalid_index, static_cast<Index>(row), number, v});
      return;
    }
    if (state_.is_visible(v)) leaving_.push_back({v, static_cast<Index>(placements_.size())});
    placements_.push_back({v, static_cast<Index>(row), number, invalid_index});
  };
  constexpr std::size_t ahead = 16;
  for (std::size_t i = 0; i < edits_.move.size(); ++i) {
    if (i + ahead < edits_.move.size()) {
      const Index soon = index(state_.sites.vertex_of(edits_.move[i + ahead]));
      internal::prefetch(state_.sites.point(soon));
      internal::prefetch(state_.cell_of_vertex.data() + soon);
    }
    const std::size_t row = edits_.move[i];
    double weight = state_.weighted() ? state_.sites.point(index(state_.sites.vertex_of(row)))[d] : 0;
    if (const auto found = find(row); found != weighed.end()) {
      weight = edits_.weights[found->second];
      weighed.erase(found);
    }
    move_row(row, edits_.to.subspan(i * d, d), weight);
  }
  for (const auto& [row, i] : weighed) {
    const double* const before = state_.sites.point(index(state_.sites.vertex_of(row)));
    const std::vector<double> there(before, before + d);
    move_row(row, there, edits_.weights[i]);
  }
}

void Editing::add_point(std::span<const double> coordinates, double weight) {
  points_.insert(points_.end(), coordinates.begin(), coordinates.end());
  if (state_.weighted()) points_.push_back(weight);
}

/// A vertex that leaves costs about as much as two insertions, and insertions one by one more than twice as
/// much as those of a rebuild.
bool Editing::is_worth_rebuilding() const {
  const std::size_t left = state_.num_vertices - leaving_.size() + placements_.size();
  constexpr std::size_t fewest = 16;
  if (hints_.rebuilds) return true;
  return leaving_.size() + placements_.size() >= fewest &&
         2 * leaving_.size() + placements_.size() > left / 2;
}

/// The same after some vertices have been taken out. A rebuild inserts those that stay hidden, too.
bool Editing::has_freed_many(std::size_t num_taken_out) const {
  constexpr std::size_t fewest = 64;
  if (freed_.size() < fewest) return false;
  const std::size_t left_to_go = leaving_.size() - num_taken_out;
  const std::size_t num_hidden = state_.hidden_points ? state_.hidden_points->size() : 0;
  const std::size_t in_all =
      state_.num_vertices - left_to_go + num_hidden + freed_.size() + placements_.size();
  return 2 * left_to_go + freed_.size() + placements_.size() > in_all / 2;
}

void Editing::begin_batch() {
  if (!state_.engine || record().engine_has_log) return;
  const std::size_t changes = leaving_.size() + placements_.size();
  state_.engine->begin_batch(changes < state_.num_vertices / 64 + 16);
  record().engine_has_log = true;
}

}  // namespace delone::construction
