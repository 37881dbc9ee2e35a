// SPDX-License-Identifier: BSD-3-Clause
// The steps of an edit that takes vertices out and places others, one by one.
#include "base/progress_meter.hpp"
#include "order/insertion_order.hpp"
#include "triangulation/editing.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace delone {
namespace {

/// Exchanges the first two vertices of a cell, and its neighbors: the cell is oriented the other way then.
void exchange_first_two(Index* links, std::size_t corners) {
  std::swap(links[0], links[1]);
  std::swap(links[corners], links[corners + 1]);
}

}  // namespace

/// Returns false as soon as building anew costs less than what is left to do.
bool Triangulation::Impl::Editing::take_all_out() {
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
void Triangulation::Impl::Editing::list_hidden_points() {
  if (impl_.engine && impl_.may_hide() && !impl_.hidden_points && !leaving_.empty()) find_hidden_points();
  if (!impl_.hidden_points) return;
  const auto take_from_list = [&](Index v) {
    if (impl_.hidden_points->contains(v)) impl_.hidden_points->remove(v);
  };
  for (const Index v : dead_) take_from_list(v);
  for (const Placement& placement : placements_)
    if (placement.vertex != invalid_index) take_from_list(placement.vertex);
}

/// Every hidden point gets its place in a list.
void Triangulation::Impl::Editing::find_hidden_points() {
  const std::size_t d = impl_.ambient();
  std::vector<Index> hidden;
  std::vector<double> coordinates;
  for (Index v = 1; v < impl_.row_of_vertex.size(); ++v) {
    if (impl_.is_visible(v) || is_dying(v)) continue;
    hidden.push_back(v);
    coordinates.insert(coordinates.end(), impl_.points.point(v), impl_.points.point(v) + d);
  }
  auto lists = std::make_unique<internal::HiddenPoints>();
  lists->reserve(std::size_t{impl_.points.last_vertex()} + 1, impl_.complex().num_cell_slots());
  Index start = invalid_index;
  for (const Index i : order::insertion_order({coordinates, impl_.dimension}, impl_.options)) {
    internal::cancellation_point();
    start = impl_.engine->locate(impl_.points.point(hidden[i]), start).cell;
    lists->add(hidden[i], start);
  }
  impl_.hidden_points = std::move(lists);
}

/// Returns a vertex that was its neighbor, or invalid_index; or nothing, and has done nothing, where building
/// anew costs less.
std::optional<Index> Triangulation::Impl::Editing::take_out(Index v) {
  impl_.note_visibility(v);
  if (!impl_.engine) {
    take_out_only_vertex();
    return invalid_index;
  }
  const engine::Change change = impl_.engine->remove(v, index(impl_.cell_of_vertex[v]));
  if (change.outcome == engine::Outcome::costly) return std::nullopt;
  if (change.outcome == engine::Outcome::flat) {
    lower(v);
    return invalid_index;
  }
  if (impl_.hidden_points)
    for (const Index cell : change.gone) impl_.hidden_points->take(cell, freed_);
  impl_.update_cells(change.made);
  const Complex now = impl_.complex();
  const CellId any{change.made.front()};
  const VertexId first = now.vertex(any, 0);
  const Index near = index(first != infinite_vertex ? first : now.vertex(any, 1));
  impl_.cell_of_vertex[v] = invalid_cell;
  --impl_.num_vertices;
  return near;
}

/// All points that are left are in its place. They come again like hidden points.
void Triangulation::Impl::Editing::take_out_only_vertex() {
  std::vector<Index> known(freed_);
  known.push_back(impl_.only_vertex());
  for (const Placement& placement : placements_)
    if (placement.vertex != invalid_index) known.push_back(placement.vertex);
  std::sort(known.begin(), known.end());
  for (Index v = 1; v < record_->num_row_of_vertex; ++v)
    if (!is_dying(v) && !std::binary_search(known.begin(), known.end(), v)) freed_.push_back(v);
  impl_.affine_hull = kernel::AffineHull(impl_.dimension);
  impl_.cell_of_vertex.assign(impl_.cell_of_vertex.size(), invalid_cell);
  impl_.num_vertices = 0;
}

/// Takes out a vertex without which all others span a flat of one dimension less: each cell of it is a cell
/// of that flat joined to it (engine/dimension_jump.hpp).
void Triangulation::Impl::Editing::lower(Index v) {
  const Complex now = impl_.complex();
  const int k = now.affine_dimension();
  const auto corners = static_cast<std::size_t>(k);
  std::vector<Index> number(now.num_cell_slots(), invalid_index), links;
  kernel::AffineHull flat(impl_.dimension);
  Index num_cells = 0, num_infinite = 0, any = invalid_index;
  const auto slot_of_v = [&](CellId c) {
    for (int i = 0; i <= k; ++i)
      if (index(now.vertex(c, i)) == v) return i;
    return -1;
  };
  for (const CellId c : now.all_cells()) {
    if (impl_.hidden_points) impl_.hidden_points->take(index(c), freed_);
    const int slot = slot_of_v(c);
    if (slot < 0) continue;
    number[index(c)] = num_cells++;
    num_infinite += now.is_infinite(c) ? 1 : 0;
    for (int i = 0; i <= k && flat.dimension() < k - 1; ++i)
      if (i != slot && now.vertex(c, i) != infinite_vertex)
        flat.add(impl_.points.point(index(now.vertex(c, i))));
    for (int i = 0; i <= k; ++i)
      if (i != slot && now.vertex(c, i) != infinite_vertex) any = index(now.vertex(c, i));
  }
  if (k == 1) {
    impl_.replace_engine(nullptr);
    impl_.only_vertex() = any;
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
      simplex.push_back(impl_.points.point(links[2 * corners * finite + i]));
    if (kernel::orientation(flat.flat(), simplex) == Sign::negative)
      for (std::size_t cell = 0; cell < num_cells; ++cell)
        exchange_first_two(links.data() + 2 * corners * cell, corners);
    auto lowered = make_triangulation_engine(flat.axes(), impl_.points, impl_.engine->frame(),
                                             impl_.engine->effort(), impl_.options.force_runtime_dimension);
    lowered->restore({{links.data(), 2 * corners, false},
                      k - 1,
                      num_cells,
                      num_cells - num_infinite,
                      num_infinite,
                      impl_.num_vertices - 1,
                      nullptr,
                      impl_.points.last_vertex() + 1});
    impl_.replace_engine(std::move(lowered));
  }
  impl_.affine_hull = std::move(flat);
  impl_.find_cells_of_vertices();
  // All hidden points have been set free.
  if (impl_.may_hide()) impl_.hidden_points = std::make_unique<internal::HiddenPoints>();
}

void Triangulation::Impl::Editing::place_all() {
  const std::size_t num_new = edits_.insert.size() / impl_.ambient();
  constexpr std::size_t worth_ordering = 32;
  if (num_new >= worth_ordering) {
    const auto first = placements_.end() - static_cast<std::ptrdiff_t>(num_new);
    const std::vector<Placement> given(first, placements_.end());
    const std::vector<Index> order = order::insertion_order({edits_.insert, impl_.dimension}, impl_.options);
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
Index Triangulation::Impl::Editing::start_near(const double* point, Index near, const double* before) {
  if (near != invalid_index && impl_.is_visible(near)) {
    // A step that is not much longer than the edges there is a short walk.
    const auto distance = [&](const double* a, const double* b) {
      double sum = 0;
      for (std::size_t j = 0; j < impl_.ambient(); ++j) sum += std::fabs(a[j] - b[j]);
      return sum;
    };
    const double* const there = impl_.points.point(near);
    if (before == nullptr || !(distance(point, there) > 4 * distance(before, there)))
      return index(impl_.cell_of_vertex[near]);
  }
  if (!impl_.engine || impl_.points.form == kernel::RowForm::furthest_point) return invalid_index;
  if (!impl_.landmarks) impl_.add_landmarks(1, impl_.points.last_vertex());
  return impl_.start_near(point);
}

void Triangulation::Impl::Editing::place(const Placement& placement) {
  if (placement.vertex != invalid_index) {
    const Index v = placement.vertex;
    set_point(v, point(placement));
    const double* const before = record_->points.data() + record_->points.size() - impl_.row_size();
    const Index at = impl_.place(v, start_near(point(placement), placement.near, before));
    if (at != v && at != invalid_index) merge(v, at);
    if (at == v && impl_.landmarks) impl_.add_landmarks(v, v);
    return;
  }
  const bool is_at_start = start_ != invalid_index && leaving_.empty();
  const Index start = is_at_start ? start_ : start_near(point(placement), placement.near, nullptr);
  const Index v = impl_.append(point(placement));
  const Index at = impl_.place(v, start);
  const bool is_duplicate = at != v && at != invalid_index;
  if (is_duplicate) impl_.drop_last_vertex();
  impl_.assign(placement.row, is_duplicate ? at : v);
  if (at == v && impl_.landmarks) impl_.add_landmarks(v, v);
}

/// A vertex that was hidden.
void Triangulation::Impl::Editing::place_again(Index v) {
  const Index start = impl_.landmarks ? impl_.start_near(impl_.points.point(v)) : invalid_index;
  const Index at = impl_.place(v, start);
  if (at != v && at != invalid_index) merge(v, at);
}

/// Notes the point of a vertex that gets another one.
void Triangulation::Impl::Editing::note_point(Index v) {
  const double* const there = impl_.points.point(v);
  record_->points.insert(record_->points.end(), there, there + impl_.row_size());
  record_->moved.push_back(v);
}
void Triangulation::Impl::Editing::set_point(Index v, const double* point) {
  note_point(v);
  impl_.points.set_point(v, point);
}

/// The rows of a vertex become those of another at the same point.
void Triangulation::Impl::Editing::merge(Index v, Index into) {
  while (!is_dying(v)) {
    const std::size_t row = impl_.row_of_vertex[v];
    impl_.detach(row);
    impl_.assign(row, into);
  }
}

}  // namespace delone
