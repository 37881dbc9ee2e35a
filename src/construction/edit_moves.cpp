// SPDX-License-Identifier: BSD-3-Clause
// The part of an edit that leaves vertices where they are in the cells: they move little.
#include "construction/editing.hpp"

#include "base/compiler.hpp"
#include "kernel/stages.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace delone::construction {

/// Whether a vertex may stay where it is in the cells: it has some, and gets a point that neither the
/// dimension nor the frame has to change for, and that no hidden one has, which would keep its id.
bool Editing::can_stay(const Placement& placement) const {
  if (placement.vertex == invalid_index || !frame_of(*state_.engine).contains(point(placement))) return false;
  if (state_.affine_hull.dimension() < state_.dimension() && !state_.affine_hull.contains(point(placement)))
    return false;
  if (!state_.hidden_points || state_.hidden_points->size() == 0) return true;
  const auto is_equal = [&](Index hidden) {
    return kernel::equal_points(state_.sites.point(hidden), point(placement),
                                static_cast<int>(state_.row_size()));
  };
  for (const CellId cell : state_.complex().star(VertexId{placement.vertex}))
    if (state_.hidden_points->any_of(index(cell), is_equal)) return false;
  return true;
}

/// The hidden vertices that are neither removed nor move.
std::vector<Index> Editing::staying_hidden() const {
  std::vector<Index> hidden;
  if (!state_.may_hide()) return hidden;
  std::vector<std::uint8_t> is_placed(record().sites.num_ids, 0);
  for (const Placement& placement : placements_)
    if (placement.vertex != invalid_index) is_placed[placement.vertex] = 1;
  for (Index v = 1; v < record().sites.num_ids; ++v)
    if (is_placed[v] == 0 && !state_.is_visible(v) && state_.sites.has_rows(v)) hidden.push_back(v);
  return hidden;
}

/// Whether one that moves gets the point of a hidden one.
bool Editing::meets_hidden(std::span<const Index> hidden) const {
  if (hidden.empty()) return false;
  const auto less = [size = state_.row_size()](const double* a, const double* b) {
    return std::lexicographical_compare(a, a + size, b, b + size);
  };
  std::vector<const double*> points;
  for (const Index v : hidden) points.push_back(state_.sites.point(v));
  std::sort(points.begin(), points.end(), less);
  return std::any_of(placements_.begin(), placements_.end(), [&](const Placement& placement) {
    return std::binary_search(points.begin(), points.end(), point(placement), less);
  });
}

/// Whether most of some that move do so by more than a part of the distance to a neighbor: then few cells
/// stay. REQUIRES an engine, and that some move.
bool Editing::are_steps_long() const {
  constexpr std::size_t most = 256;
  const Complex now = state_.complex();
  const std::size_t d = state_.ambient(), stride = leaving_.size() / most + 1;
  std::size_t num_long = 0, num_all = 0;
  for (std::size_t i = 0; i < leaving_.size(); i += stride) {
    if (leaving_[i].placement == none) continue;
    const Index v = leaving_[i].vertex;
    const CellId cell = state_.cell_of_vertex[v];
    Index other = index(infinite_vertex);
    for (int slot = 0; slot <= now.affine_dimension() && other == index(infinite_vertex); ++slot)
      if (const Index w = index(now.vertex(cell, slot)); w != v) other = w;
    const double *const from = state_.sites.point(v), *const to = point(placements_[leaving_[i].placement]);
    const double* const neighbor = state_.sites.point(other);
    double step = 0, edge = 0;
    for (std::size_t j = 0; j < d; ++j) {
      step += std::fabs(to[j] - from[j]);
      edge += std::fabs(neighbor[j] - from[j]);
    }
    constexpr double part = 1.0 / 16;
    num_long += step > part * edge ? 1 : 0;
    ++num_all;
  }
  return 2 * num_long > num_all;
}

/// If many vertices move, all at once. Returns false if everything has to be rebuilt.
bool Editing::move_all_in_place() {
  const auto num_moving =
      static_cast<std::size_t>(std::count_if(leaving_.begin(), leaving_.end(), std::mem_fn(&Leaving::moves)));
  if (!state_.engine || state_.is_furthest()) return true;
  if (num_moving < 64 || num_moving < state_.num_vertices / 4) return true;
  if (are_steps_long()) return true;
  const std::vector<Index> hidden = staying_hidden();
  if (4 * hidden.size() > state_.num_vertices || meets_hidden(hidden)) return true;
  std::vector<double> low(frame_of(*state_.engine).low()), high(frame_of(*state_.engine).high());
  for (const Leaving& leaving : leaving_) {
    if (!leaving.moves()) continue;
    const double* const x = point(placements_[leaving.placement]);
    if (state_.affine_hull.dimension() < state_.dimension() && !state_.affine_hull.contains(x)) return true;
    for (std::size_t j = 0; j < low.size(); ++j) {
      low[j] = std::min(low[j], x[j]);
      high[j] = std::max(high[j], x[j]);
    }
  }
  // With a margin, so that steps that follow stay inside.
  std::optional<geometry::Frame> frame;
  if (!frame_of(*state_.engine).contains(low.data()) || !frame_of(*state_.engine).contains(high.data()))
    frame = state_.frame_with(low.data(), high.data(), 0.0625);
  state_.engine->begin_batch(true);
  record().engine_has_log = true;
  const std::size_t first = record().sites.moved.size();
  constexpr std::size_t ahead = 16;
  for (std::size_t i = 0; i < leaving_.size(); ++i) {
    if (i + ahead < leaving_.size()) internal::prefetch(state_.sites.point(leaving_[i + ahead].vertex));
    if (leaving_[i].moves()) state_.sites.move(leaving_[i].vertex, point(placements_[leaving_[i].placement]));
  }
  std::vector<std::uint8_t> is_put_back(record().sites.num_ids, 0);
  const engine::Change change =
      state_.engine->move_all(std::move(frame), state_.options.threads, [&](std::span<const Index> vertices) {
        for (const Index v : vertices) is_put_back[v] = 1;
        put_points_back(is_put_back, first);
      });
  if (!change.is_done()) {  // so much moves that all will be rebuilt
    restore_points(first);
    return false;
  }
  state_.update_cells(change.created_cells);
  state_.landmarks.reset();
  std::vector<std::uint8_t> is_placed_now(placements_.size(), 0);
  for (const Leaving& leaving : leaving_)
    if (leaving.moves() && is_put_back[leaving.vertex] == 0) is_placed_now[leaving.placement] = 1;
  if (state_.may_hide()) state_.hidden_points = std::make_unique<HiddenPoints>();
  freed_.insert(freed_.end(), hidden.begin(), hidden.end());
  erase_placed(is_placed_now);
  return true;
}

/// One by one. Hidden points of the cells that change are inserted again. Vertices that cannot stay where
/// they are move in another way.
void Editing::move_some_in_place() {
  if (!state_.engine || state_.is_furthest() || !hints_.moves_in_place || is_worth_rebuilding()) return;
  std::vector<std::uint8_t> is_placed_now(placements_.size(), 0);
  std::size_t failures = 0;
  if (std::any_of(leaving_.begin(), leaving_.end(), std::mem_fn(&Leaving::moves))) list_hidden_points();
  for (const Leaving& leaving : leaving_) {
    // Where one in two does not stay, trying costs more than it saves.
    if (!leaving.moves() || failures > 16 + done_) continue;
    const Placement& placement = placements_[leaving.placement];
    if (!can_stay(placement)) continue;
    begin_batch();
    state_.sites.note_point(leaving.vertex);
    const engine::Change change =
        state_.engine->move(leaving.vertex, index(state_.cell_of_vertex[leaving.vertex]), point(placement));
    if (!change.is_done()) {
      restore_points(record().sites.moved.size() - 1);  // which the engine has done: there is nothing to note
      ++failures;
      continue;
    }
    if (state_.hidden_points)
      for (const Index changed : change.removed_cells) state_.hidden_points->take(changed, freed_);
    state_.update_cells(change.created_cells);
    is_placed_now[leaving.placement] = 1;
    tick();
  }
  if (done_ != 0) erase_placed(is_placed_now);
}

/// Placements that are done, and vertices that need not leave.
void Editing::erase_placed(const std::vector<std::uint8_t>& is_placed_now) {
  std::vector<Index> new_places(placements_.size(), none);
  Index count = 0;
  for (std::size_t i = 0; i < placements_.size(); ++i) {
    if (is_placed_now[i] != 0) continue;
    new_places[i] = count;
    placements_[count++] = placements_[i];
  }
  placements_.resize(count);
  std::erase_if(leaving_, [&](const Leaving& leaving) {
    return leaving.moves() && is_placed_now[leaving.placement] != 0;
  });
  for (Leaving& leaving : leaving_)
    if (leaving.moves()) leaving.placement = new_places[leaving.placement];
}

/// Gives their old points to some of the vertices that were moved since the journal had `first` entries.
void Editing::put_points_back(const std::vector<std::uint8_t>& is_put_back, std::size_t first) {
  const sites::Journal& journal = record().sites;
  const std::size_t size = state_.row_size(), last = journal.moved.size();
  std::vector<double> before(size);
  for (std::size_t i = first; i < last; ++i) {
    if (is_put_back[journal.moved[i]] == 0) continue;
    std::copy_n(journal.points.data() + i * size, size, before.data());
    state_.sites.move(journal.moved[i], before.data());
  }
}

/// Takes back the points that were set last.
void Editing::restore_points(std::size_t first) {
  sites::Journal& journal = record().sites;
  state_.sites.restore_points(journal, first);
  journal.moved.resize(first);
  journal.points.resize(first * state_.row_size());
}

}  // namespace delone::construction
