// SPDX-License-Identifier: BSD-3-Clause
// The steps of an edit that takes vertices out and places others, one by one.
#include "base/progress_meter.hpp"
#include "construction/editing.hpp"
#include "order/insertion_order.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace delone::construction {
namespace {

/// Exchanges the first two vertices of a cell, and its neighbors: the cell is oriented the other way then.
void exchange_first_two(Index* links, std::size_t corners) {
  std::swap(links[0], links[1]);
  std::swap(links[corners], links[corners + 1]);
}

}  // namespace

/// Returns false as soon as a rebuild costs less than what is left to do.
bool Editing::take_all_out() {
  begin_batch();
  list_hidden_points();
  for (std::size_t i = 0; i < leaving_.size(); ++i) {
    const Leaving& leaving = leaving_[i];
    tick();
    const std::optional<Index> near = take_out(leaving.vertex);
    if (!near || has_freed_many(i + 1)) return false;
    if (leaving.placement != none) placements_[leaving.placement].near = *near;
  }
  return true;
}

/// Where vertices leave, each hidden point that stays is in a list.
void Editing::list_hidden_points() {
  if (state_.engine && state_.may_hide() && !state_.hidden_points && !leaving_.empty()) find_hidden_points();
  if (!state_.hidden_points) return;
  const auto take_from_list = [&](Index v) {
    if (state_.hidden_points->contains(v)) state_.hidden_points->remove(v);
  };
  for (const Index v : dead_) take_from_list(v);
  for (const Placement& placement : placements_)
    if (placement.vertex != invalid_index) take_from_list(placement.vertex);
}

/// Every hidden point gets its place in a list.
void Editing::find_hidden_points() {
  const std::size_t d = state_.ambient();
  std::vector<Index> hidden;
  std::vector<double> coordinates;
  for (Index v = 1; v < state_.sites.num_ids(); ++v) {
    if (state_.is_visible(v) || !state_.sites.has_rows(v)) continue;
    hidden.push_back(v);
    coordinates.insert(coordinates.end(), state_.sites.point(v), state_.sites.point(v) + d);
  }
  auto lists = std::make_unique<HiddenPoints>();
  lists->reserve(std::size_t{state_.sites.points().last_vertex()} + 1, state_.complex().num_cell_slots());
  Index start = invalid_index;
  for (const Index i : order::insertion_order({coordinates, state_.dimension()}, state_.options)) {
    internal::cancellation_point();
    start = locate(*state_.engine, state_.sites.point(hidden[i]), start).cell;
    lists->add(hidden[i], start);
  }
  state_.hidden_points = std::move(lists);
}

/// Returns a vertex that was its neighbor, or invalid_index; or nothing, and has done nothing, if a rebuild
/// costs less.
std::optional<Index> Editing::take_out(Index v) {
  state_.note_visibility(v);
  if (!state_.engine) {
    take_out_only_vertex();
    return invalid_index;
  }
  const engine::Change change = state_.engine->remove(v, index(state_.cell_of_vertex[v]));
  if (change.outcome == engine::Outcome::costly) return std::nullopt;
  if (change.outcome == engine::Outcome::flat) {
    lower(v);
    return invalid_index;
  }
  if (state_.hidden_points)
    for (const Index cell : change.removed_cells) state_.hidden_points->take(cell, freed_);
  state_.update_cells(change.created_cells);
  const Complex now = state_.complex();
  const CellId any{change.created_cells.front()};
  const VertexId first = now.vertex(any, 0);
  const Index near = index(first != infinite_vertex ? first : now.vertex(any, 1));
  state_.cell_of_vertex[v] = invalid_cell;
  --state_.num_vertices;
  return near;
}

/// All points that are left are in its place. They are inserted again like hidden points.
void Editing::take_out_only_vertex() {
  std::vector<Index> known(freed_);
  known.push_back(state_.only_vertex());
  for (const Placement& placement : placements_)
    if (placement.vertex != invalid_index) known.push_back(placement.vertex);
  std::sort(known.begin(), known.end());
  for (Index v = 1; v < record().sites.num_ids; ++v)
    if (state_.sites.has_rows(v) && !std::binary_search(known.begin(), known.end(), v)) freed_.push_back(v);
  state_.affine_hull = kernel::AffineHull(state_.dimension());
  state_.cell_of_vertex.assign(state_.cell_of_vertex.size(), invalid_cell);
  state_.num_vertices = 0;
}

/// Takes out a vertex without which all others span a flat of one dimension less: each cell of it is a cell
/// of that flat joined to it (engine/dimension_jump.hpp).
void Editing::lower(Index v) {
  const Complex now = state_.complex();
  const int k = now.affine_dimension();
  const auto corners = static_cast<std::size_t>(k);
  std::vector<Index> number(now.num_cell_slots(), invalid_index), links;
  kernel::AffineHull flat(state_.dimension());
  Index num_cells = 0, num_infinite = 0, any = invalid_index;
  const auto slot_of_v = [&](CellId c) {
    for (int i = 0; i <= k; ++i)
      if (index(now.vertex(c, i)) == v) return i;
    return -1;
  };
  for (const CellId c : now.all_cells()) {
    if (state_.hidden_points) state_.hidden_points->take(index(c), freed_);
    const int slot = slot_of_v(c);
    if (slot < 0) continue;
    number[index(c)] = num_cells++;
    num_infinite += now.is_infinite(c) ? 1 : 0;
    for (int i = 0; i <= k && flat.dimension() < k - 1; ++i)
      if (i != slot && now.vertex(c, i) != infinite_vertex)
        flat.add(state_.sites.point(index(now.vertex(c, i))));
    for (int i = 0; i <= k; ++i)
      if (i != slot && now.vertex(c, i) != infinite_vertex) any = index(now.vertex(c, i));
  }
  if (k == 1) {
    state_.replace_engine(nullptr);
    state_.only_vertex() = any;
  } else {
    // The cells of v are coherently oriented as seen from v, up to exchanges that bring v to the first slot.
    links.reserve(2 * corners * num_cells);
    for (const CellId c : now.all_cells()) {
      if (number[index(c)] == invalid_index) continue;
      const int slot = slot_of_v(c);
      const std::size_t first = links.size();
      for (int i = 0; i <= k; ++i)
        if (i != slot) links.push_back(index(now.vertex(c, i)));
      for (int i = 0; i <= k; ++i)
        if (i != slot) links.push_back(number[index(now.neighbor(c, i))]);
      if (slot % 2 == 1) exchange_first_two(links.data() + first, corners);
    }
    const auto is_finite = [&](std::size_t cell) {
      const Index* const vertices = links.data() + 2 * corners * cell;
      return std::find(vertices, vertices + corners, index(infinite_vertex)) == vertices + corners;
    };
    std::size_t finite = 0;
    while (!is_finite(finite)) ++finite;
    std::vector<const double*> simplex;
    for (std::size_t i = 0; i < corners; ++i)
      simplex.push_back(state_.sites.point(links[2 * corners * finite + i]));
    if (kernel::orientation(flat.flat(), simplex) == Sign::negative)
      for (std::size_t cell = 0; cell < num_cells; ++cell)
        exchange_first_two(links.data() + 2 * corners * cell, corners);
    auto lowered = state_.new_engine(flat, frame_of(*state_.engine));
    lowered->restore({{links.data(), 2 * corners, false},
                      k - 1,
                      num_cells,
                      num_cells - num_infinite,
                      num_infinite,
                      state_.num_vertices - 1,
                      nullptr,
                      state_.sites.points().last_vertex() + 1});
    state_.replace_engine(std::move(lowered));
  }
  state_.affine_hull = std::move(flat);
  state_.find_cells_of_vertices();
  // All hidden points have been set free.
  if (state_.may_hide()) state_.hidden_points = std::make_unique<HiddenPoints>();
}

void Editing::place_all() {
  const std::size_t num_new = edits_.insert.size() / state_.ambient();
  constexpr std::size_t worth_ordering = 32;
  if (num_new >= worth_ordering) {
    const auto first = placements_.end() - static_cast<std::ptrdiff_t>(num_new);
    const std::vector<Placement> given(first, placements_.end());
    const std::vector<Index> order =
        order::insertion_order({edits_.insert, state_.dimension()}, state_.options);
    std::transform(order.begin(), order.end(), first, [&](Index i) { return given[i]; });
  }
  // In the order of their ids, and before others: of equal points, the oldest keeps its id.
  std::sort(freed_.begin(), freed_.end());
  for (const Index v : freed_) {
    internal::cancellation_point();
    place_again(v);
  }
  for (const Placement& placement : placements_) {
    tick();
    place(placement);
  }
}

/// Where a walk to a point starts; `near` is a vertex close to the place that it comes from, or
/// invalid_index.
Index Editing::start_near(const double* point, Index near, const double* before) {
  if (near != invalid_index && state_.is_visible(near)) {
    // A step that is not much longer than the edges there is a short walk.
    const auto distance = [&](const double* a, const double* b) {
      double sum = 0;
      for (std::size_t j = 0; j < state_.ambient(); ++j) sum += std::fabs(a[j] - b[j]);
      return sum;
    };
    const double* const there = state_.sites.point(near);
    if (before == nullptr || !(distance(point, there) > 4 * distance(before, there)))
      return index(state_.cell_of_vertex[near]);
  }
  if (!state_.engine || state_.is_furthest()) return invalid_index;
  if (!state_.landmarks) state_.add_landmarks(1, state_.sites.points().last_vertex());
  return state_.start_near(point);
}

void Editing::place(const Placement& placement) {
  if (placement.vertex != invalid_index) {
    const Index v = placement.vertex;
    state_.sites.move(v, point(placement));
    const double* const before =
        record().sites.points.data() + record().sites.points.size() - state_.row_size();
    const Index at = state_.place(v, start_near(point(placement), placement.near, before));
    if (at != v && at != invalid_index) state_.sites.merge(v, at);
    if (at == v && state_.landmarks) state_.add_landmarks(v, v);
    return;
  }
  const bool is_at_start = hints_.start != invalid_index && leaving_.empty();
  const Index start = is_at_start ? hints_.start : start_near(point(placement), placement.near, nullptr);
  const Index v = state_.sites.points().append(point(placement));
  const Index at = state_.place(v, start);
  const bool is_duplicate = at != v && at != invalid_index;
  if (is_duplicate) state_.sites.points().drop_last();
  state_.sites.assign(placement.row, is_duplicate ? at : v);
  if (at == v && state_.landmarks) state_.add_landmarks(v, v);
}

/// A vertex that was hidden.
void Editing::place_again(Index v) {
  const Index start = state_.landmarks ? state_.start_near(state_.sites.point(v)) : invalid_index;
  const Index at = state_.place(v, start);
  if (at != v && at != invalid_index) state_.sites.merge(v, at);
}

}  // namespace delone::construction
