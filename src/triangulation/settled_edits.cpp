// SPDX-License-Identifier: BSD-3-Clause
// The part of an edit that leaves vertices where they are in the cells: they move little.
#include "triangulation/editing.hpp"

#include "base/compiler.hpp"
#include "kernel/stages.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace delone {

/// Whether a vertex may stay where it is in the cells: it has some, and gets a point that neither the
/// dimension nor the frame has to change for, and that no hidden one has, which would keep its id.
bool Triangulation::Impl::Editing::can_settle(const Placement& placement) const {
  if (placement.vertex == invalid_index || !impl_.engine->frame().contains(point(placement))) return false;
  if (impl_.affine_hull.dimension() < impl_.dimension && !impl_.affine_hull.contains(point(placement)))
    return false;
  if (!impl_.hidden_points || impl_.hidden_points->size() == 0) return true;
  const auto is_equal = [&](Index hidden) {
    return kernel::equal_points(impl_.points.point(hidden), point(placement),
                                static_cast<int>(impl_.row_size()));
  };
  for (const CellId cell : impl_.complex().star(VertexId{placement.vertex}))
    if (impl_.hidden_points->any_of(index(cell), is_equal)) return false;
  return true;
}

/// The hidden vertices that neither go nor move.
std::vector<Index> Triangulation::Impl::Editing::staying_hidden() const {
  std::vector<Index> hidden;
  if (!impl_.may_hide()) return hidden;
  std::vector<std::uint8_t> is_placed(record_->num_row_of_vertex, 0);
  for (const Placement& placement : placements_)
    if (placement.vertex != invalid_index) is_placed[placement.vertex] = 1;
  for (Index v = 1; v < record_->num_row_of_vertex; ++v)
    if (is_placed[v] == 0 && !impl_.is_visible(v) && !is_dying(v)) hidden.push_back(v);
  return hidden;
}

/// Whether one that moves gets the point of a hidden one.
bool Triangulation::Impl::Editing::meets_hidden(std::span<const Index> hidden) const {
  if (hidden.empty()) return false;
  const auto less = [size = impl_.row_size()](const double* a, const double* b) {
    return std::lexicographical_compare(a, a + size, b, b + size);
  };
  std::vector<const double*> points;
  for (const Index v : hidden) points.push_back(impl_.points.point(v));
  std::sort(points.begin(), points.end(), less);
  return std::any_of(placements_.begin(), placements_.end(), [&](const Placement& placement) {
    return std::binary_search(points.begin(), points.end(), point(placement), less);
  });
}

/// Whether most of some that move do so by more than a part of the distance to a neighbor: then few cells
/// stay. REQUIRES an engine, and that some move.
bool Triangulation::Impl::Editing::are_steps_long() const {
  constexpr std::size_t most = 256;
  const Complex now = impl_.complex();
  const std::size_t d = impl_.ambient(), stride = leaving_.size() / most + 1;
  std::size_t num_long = 0, num_all = 0;
  for (std::size_t i = 0; i < leaving_.size(); i += stride) {
    if (leaving_[i].placement == none) continue;
    const Index v = leaving_[i].vertex;
    const CellId cell = impl_.cell_of_vertex[v];
    Index other = index(infinite_vertex);
    for (int slot = 0; slot <= now.affine_dimension() && other == index(infinite_vertex); ++slot)
      if (const Index w = index(now.vertex(cell, slot)); w != v) other = w;
    const double *const from = impl_.points.point(v), *const to = point(placements_[leaving_[i].placement]);
    const double* const neighbor = impl_.points.point(other);
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

/// Where many vertices move, all at once. If that fails, the cells of the engine are of no use before they
/// are rolled back.
void Triangulation::Impl::Editing::settle_all() {
  const auto moves = [](const Leaving& leaving) { return leaving.placement != none; };
  const auto num_moving = static_cast<std::size_t>(std::count_if(leaving_.begin(), leaving_.end(), moves));
  if (!impl_.engine || impl_.points.form == kernel::RowForm::furthest_point) return;
  if (num_moving < 64 || num_moving < impl_.num_vertices / 4) return;
  if (are_steps_long()) return;
  const std::vector<Index> hidden = staying_hidden();
  if (4 * hidden.size() > impl_.num_vertices || meets_hidden(hidden)) return;
  std::vector<double> low(impl_.engine->frame().low()), high(impl_.engine->frame().high());
  for (const Leaving& leaving : leaving_) {
    if (!moves(leaving)) continue;
    const double* const x = point(placements_[leaving.placement]);
    if (impl_.affine_hull.dimension() < impl_.dimension && !impl_.affine_hull.contains(x)) return;
    for (std::size_t j = 0; j < low.size(); ++j) {
      low[j] = std::min(low[j], x[j]);
      high[j] = std::max(high[j], x[j]);
    }
  }
  // With a margin, so that steps that follow stay inside.
  std::optional<geometry::Frame> frame;
  if (!impl_.engine->frame().contains(low.data()) || !impl_.engine->frame().contains(high.data()))
    frame = impl_.frame_with(low.data(), high.data(), 0.0625);
  impl_.engine->begin_batch(true);
  record_->engine_has_log = true;
  const std::size_t first = record_->moved.size();
  constexpr std::size_t ahead = 16;
  for (std::size_t i = 0; i < leaving_.size(); ++i) {
    if (i + ahead < leaving_.size()) prefetch(impl_.points.point(leaving_[i + ahead].vertex));
    if (moves(leaving_[i])) set_point(leaving_[i].vertex, point(placements_[leaving_[i].placement]));
  }
  const engine::Change change = impl_.engine->move_all(std::move(frame), impl_.options.threads);
  if (!change.is_done()) {  // so much moves that all will be built anew
    restore_points(first);
    return;
  }
  impl_.update_cells(change.made);
  impl_.landmarks.reset();
  std::vector<std::uint8_t> is_settled(placements_.size(), 0);
  for (const Leaving& leaving : leaving_)
    if (moves(leaving)) is_settled[leaving.placement] = 1;
  if (impl_.may_hide()) impl_.hidden_points = std::make_unique<internal::HiddenPoints>();
  freed_.insert(freed_.end(), hidden.begin(), hidden.end());
  erase_settled(is_settled);
}

/// One by one. Hidden points of the cells that change come again. Those that cannot stay where they are move
/// in another way.
void Triangulation::Impl::Editing::settle_some() {
  if (!impl_.engine || impl_.points.form == kernel::RowForm::furthest_point || is_worth_building_anew())
    return;
  const bool is_single = edits_.move.size() == 1 && leaving_.size() == 1 && placements_.size() == 1;
  if (is_single && impl_.lone_vertex_of(edits_.move[0]) != invalid_index) return;  // move_at_once() has tried
  const auto moves = [](const Leaving& leaving) { return leaving.placement != none; };
  std::vector<std::uint8_t> is_settled(placements_.size(), 0);
  std::size_t failures = 0;
  if (std::any_of(leaving_.begin(), leaving_.end(), moves)) list_hidden_points();
  for (const Leaving& leaving : leaving_) {
    // Where one in two does not stay, trying costs more than it saves.
    if (!moves(leaving) || failures > 16 + done_) continue;
    const Placement& placement = placements_[leaving.placement];
    if (!can_settle(placement)) continue;
    begin_batch();
    note_point(leaving.vertex);
    const engine::Change change =
        impl_.engine->move(leaving.vertex, index(impl_.cell_of_vertex[leaving.vertex]), point(placement));
    if (!change.is_done()) {
      restore_points(record_->moved.size() - 1);
      ++failures;
      continue;
    }
    if (impl_.hidden_points)
      for (const Index changed : change.gone) impl_.hidden_points->take(changed, freed_);
    impl_.update_cells(change.made);
    is_settled[leaving.placement] = 1;
    tick();
  }
  if (done_ != 0) erase_settled(is_settled);
}

/// Placements that are done, and vertices that need not leave.
void Triangulation::Impl::Editing::erase_settled(const std::vector<std::uint8_t>& is_settled) {
  const auto moves = [](const Leaving& leaving) { return leaving.placement != none; };
  std::vector<Index> new_places(placements_.size(), none);
  Index count = 0;
  for (std::size_t i = 0; i < placements_.size(); ++i) {
    if (is_settled[i] != 0) continue;
    new_places[i] = count;
    placements_[count++] = placements_[i];
  }
  placements_.resize(count);
  std::erase_if(leaving_,
                [&](const Leaving& leaving) { return moves(leaving) && is_settled[leaving.placement] != 0; });
  for (Leaving& leaving : leaving_)
    if (moves(leaving)) leaving.placement = new_places[leaving.placement];
}

/// Takes back the points that were set last.
void Triangulation::Impl::Editing::restore_points(std::size_t first) {
  const std::size_t size = impl_.row_size();
  for (std::size_t i = first; i < record_->moved.size(); ++i)
    std::copy_n(record_->points.begin() + static_cast<std::ptrdiff_t>(i * size), size,
                impl_.points.coordinates.begin() + static_cast<std::ptrdiff_t>(record_->moved[i] * size));
  record_->moved.resize(first);
  record_->points.resize(first * size);
}

}  // namespace delone
