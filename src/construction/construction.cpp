// SPDX-License-Identifier: BSD-3-Clause
#include "construction/construction.hpp"

#include "base/large_vector.hpp"
#include "base/parallel.hpp"
#include "base/progress_meter.hpp"
#include "base/stopwatch.hpp"
#include "construction/bulk_insertion.hpp"
#include "construction/editing.hpp"
#include "order/insertion_order.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace delone::construction {
namespace {

/// Each point followed by its weight.
std::vector<double> weighted_rows(PointsView points, std::span<const double> weights) {
  std::vector<double> rows;
  rows.reserve(points.size() * (static_cast<std::size_t>(points.dimension()) + 1));
  for (std::size_t i = 0; i < points.size(); ++i) {
    rows.insert(rows.end(), points[i].begin(), points[i].end());
    rows.push_back(weights[i]);
  }
  return rows;
}

/// The cells at the beginning of a record, if the engine is another one now.
CellLists cells_before(const Record& record) {
  if (record.cells_before) return *record.cells_before;
  if (!record.engine)  // finite and infinite, see State::single_links
    return record.affine_hull.dimension() == 0 ? CellLists{{CellId{0}, CellId{1}}, {CellId{1}}} : CellLists{};
  CellLists cells;
  std::vector<CellId> made;
  if (record.engine_has_log) {
    find_changed_cells(*record.engine, cells.all, made);
    find_removed_infinite_cells(*record.engine, cells.infinite);
  }
  std::sort(made.begin(), made.end());
  const Complex now = complex_of(*record.engine, 0, {});
  cells.all.reserve(cells.all.size() + now.num_cell_slots());
  for (const CellId c : now.all_cells()) {
    if (std::binary_search(made.begin(), made.end(), c)) continue;
    cells.all.push_back(c);
    if (now.is_infinite(c)) cells.infinite.push_back(c);
  }
  return cells;
}

}  // namespace

Construction::Construction(State& state, const Recording& recording, internal::BuildLimits& limits)
    : state_(state), recording_(recording), limits_(limits), record_(std::make_unique<Record>()) {
  record_->affine_hull = state.affine_hull;
  record_->num_cell_of_vertex = state.cell_of_vertex.size();
  record_->num_vertices = state.num_vertices;
  record_->only_vertex = state.only_vertex();
  record_->ids_told_of_timing = state.ids_tell_of_timing;
  state.sites.begin(record_->sites);
  state.record = record_.get();
}

Construction::~Construction() {
  if (record_) roll_back(state_, *record_);
}

std::unique_ptr<Record> Construction::commit() {
  if (recording_.changes && !recording_.undo && record_->has_other_engine) {
    record_->cells_before = cells_before(*record_);
    record_->engine.reset();
  }
  state_.record = nullptr;
  state_.sites.end();
  std::unique_ptr<Record> record = std::move(record_);
  if (recording_.is_on()) return record;
  if (record->engine_has_log && !record->has_other_engine) state_.engine->keep_batch();
  return nullptr;
}

void Construction::insert(std::span<const double> coordinates, std::span<const double> weights,
                          const std::function<void()>& release) {
  const PointsView view(coordinates, state_.dimension());
  const bool is_shared = is_shared_on_record(view.size());
  if (is_shared || is_small(view.size())) {
    edit({.insert = coordinates, .insert_weights = weights}, {.rebuilds = is_shared});
    if (release) release();
    return;
  }
  const std::vector<CellId> cells_before =
      recording_.is_on() && state_.may_hide() ? state_.cell_of_vertex : std::vector<CellId>();
  internal::Stopwatch stopwatch;
  std::vector<std::size_t> rounds;
  std::vector<Index> order = order::insertion_order(view, state_.options, &rounds);
  const double order_seconds = stopwatch.restart();
  internal::ProgressMeter progress(state_.options.progress, order.size());
  state_.sites.reserve(view.size());
  const std::size_t first_row = state_.sites.add_rows(view.size());
  BulkInsertion bulk(state_, std::move(order), std::move(rounds), recording_.is_on(), 0.0, limits_,
                     [&](std::size_t done) { progress(done); });
  bulk.take(state_.weighted() ? std::span<const double>(weighted_rows(view, weights)) : coordinates);
  if (release) release();
  bulk.run();
  assign_rows(bulk, first_row);
  sort_cells_on_record();
  state_.hidden_points.reset();
  state_.find_cells_of_vertices();
  note_all_visibility(cells_before);
  if (state_.landmarks) state_.add_landmarks(bulk.first(), state_.sites.points().last_vertex());
  state_.statistics.order_seconds += order_seconds;
  state_.statistics.build_seconds += stopwatch.seconds();
}

/// Whether a batch is so small that it should not cost what looks at all cells, though one by one points take
/// longer.
bool Construction::is_small(std::size_t num_points) const {
  return state_.engine && num_points < state_.num_vertices / 1024;
}

/// Whether a batch on record is for several threads. They cannot insert into cells that must keep their
/// slots, but they can share a rebuild. That pays if the batch has more points than there are.
bool Construction::is_shared_on_record(std::size_t num_points) const {
  return recording_.is_on() && state_.engine && num_points > state_.num_vertices &&
         shares_batches_of(*state_.engine, num_points) &&
         engine::threads_for_batch(state_.options.threads, num_points, state_.dimension()) > 1;
}

/// Gives the rows their vertices. Of equal points, the first in the order is the vertex; the gaps that the
/// others leave in the ids are closed.
void Construction::assign_rows(const BulkInsertion& bulk, std::size_t first_row) {
  const std::span<const Index> order = bulk.order();
  const Index first = bulk.first();
  std::size_t num_duplicates = 0;
  for (std::size_t i = 0; i < order.size(); ++i) num_duplicates += bulk.is_duplicate(i);
  if (num_duplicates == 0) {
    state_.sites.assign_in_order(order, first_row, first, bulk.threads());
  } else {
    sites::VertexPoints& points = state_.sites.points();
    std::vector<Index> new_ids(first + order.size(), invalid_index);
    std::iota(new_ids.begin(), new_ids.begin() + static_cast<std::ptrdiff_t>(first), Index{0});
    Index next = first;
    for (std::size_t i = 0; i < order.size(); ++i) {
      const Index own = first + static_cast<Index>(i);
      Index& id = new_ids[bulk.is_duplicate(i) ? bulk.at()[i] : own];
      if (id == invalid_index) {
        id = next++;
        if (id != own)
          std::copy_n(points.point(own), points.row_size(),
                      points.coordinates.data() + id * points.row_size());
      }
      state_.sites.assign(first_row + order[i], id);
    }
    points.coordinates.resize(next * points.row_size());
    if (state_.engine)
      state_.engine->renumber_vertices(new_ids);
    else
      state_.only_vertex() = new_ids[state_.only_vertex()];
  }
  for (const auto& [row, same] : bulk.duplicates())
    state_.sites.assign(first_row + row, index(state_.sites.vertex_of(first_row + same)));
}

bool Construction::edit(const RowEdits& edits, const EditHints& hints) {
  return Editing(*this, edits, hints).run();
}

/// Cells of a new engine get ids that do not tell of timing, unless the caller sorts them later. After the
/// next transaction has begun, sorting would drop the record.
void Construction::sort_cells_on_record() {
  if (!recording_.is_on() || recording_.sorts_later || !state_.ids_tell_of_timing ||
      !record_->has_other_engine)
    return;
  state_.sort_cells();
  state_.ids_tell_of_timing = false;
}

/// After all vertices may have got or lost cells. `before`: their cells then.
void Construction::note_all_visibility(std::span<const CellId> before) {
  for (Index v = 1; v < before.size(); ++v)
    if ((before[v] != invalid_cell) != state_.is_visible(v))
      record_->were_visible.emplace_back(v, before[v] != invalid_cell);
}

AllChanges Construction::changes_since(const State& state, const Record& record) {
  AllChanges all;
  Changes& made = all.lists;
  if (state.engine && !record.has_other_engine) {
    if (record.engine_has_log) {
      find_changed_cells(*state.engine, made.removed_cells, made.created_cells);
      find_removed_infinite_cells(*state.engine, all.removed_infinite_cells);
    }
  } else if (state.engine || record.engine || record.cells_before ||
             state.affine_hull.dimension() != record.affine_hull.dimension() ||
             state.single_links[0] != record.only_vertex || !record.sites.moved.empty()) {
    CellLists before = cells_before(record);
    made.removed_cells = std::move(before.all);
    all.removed_infinite_cells = std::move(before.infinite);
    for (const CellId c : state.complex().all_cells()) made.created_cells.push_back(c);
  }
  const auto is_gone = [&](Index v) { return !state.sites.has_rows(v); };
  const auto was_there = [&](Index v) { return v < record.sites.num_ids; };
  for (Index v = record.sites.num_ids; v < state.sites.num_ids(); ++v)
    if (!is_gone(v)) made.added_vertices.push_back(VertexId{v});
  for (const sites::Journal::MovedRow& moved : record.sites.rows)
    if (moved.before != invalid_vertex && was_there(index(moved.before)) && is_gone(index(moved.before)))
      made.removed_vertices.push_back(moved.before);
  std::vector<std::pair<Index, bool>> seen = record.were_visible;
  std::stable_sort(seen.begin(), seen.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const auto [v, was_visible] = seen[i];
    const bool is_first = i == 0 || seen[i - 1].first != v;
    if (is_first && was_there(v) && !is_gone(v) && was_visible != state.is_visible(v))
      (was_visible ? made.hidden_vertices : made.reappeared_vertices).push_back(VertexId{v});
  }
  for (const Index v : record.sites.moved)
    if (!is_gone(v)) made.moved_vertices.push_back(VertexId{v});
  const auto sort = [](auto& ids) {
    if (!std::is_sorted(ids.begin(), ids.end())) std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  };
  sort(made.removed_cells);
  sort(made.created_cells);
  sort(all.removed_infinite_cells);
  sort(made.removed_vertices);
  sort(made.moved_vertices);
  return all;
}

void Construction::roll_back(State& state, Record& record) noexcept {
  state.record = nullptr;
  state.sites.roll_back(record.sites);
  state.ids_tell_of_timing = record.ids_told_of_timing;
  state.affine_hull = std::move(record.affine_hull);
  state.only_vertex() = record.only_vertex;
  state.hidden_points.reset();
  if (record.has_other_engine) {
    state.engine = std::move(record.engine);
    state.landmarks.reset();
  }
  // What has come to be visible is not; what was visible and has lost cells gets them back next.
  std::vector<CellId>& cell_of_vertex = state.cell_of_vertex;
  for (const auto& [v, was_visible] : record.were_visible)
    if (!was_visible && v < cell_of_vertex.size()) cell_of_vertex[v] = invalid_cell;
  if (state.engine && record.engine_has_log) {
    state.engine->move_back(record.sites.moved);
    state.engine->undo_batch([&state](Index cell) {
      const Complex now = complex_of(*state.engine, 0, {});
      for (int i = 0; i <= now.affine_dimension(); ++i)
        state.cell_of_vertex[index(now.vertex(CellId{cell}, i))] = CellId{cell};
    });
  }
  if (record.has_other_engine || !state.engine) {
    std::fill(cell_of_vertex.begin(), cell_of_vertex.end(), invalid_cell);
    state.find_cells_of_vertices();
  }
  cell_of_vertex.resize(std::min<std::size_t>(record.num_cell_of_vertex, record.sites.num_ids));
  cell_of_vertex.resize(record.num_cell_of_vertex, invalid_cell);
  internal::shrink_large(cell_of_vertex);
  state.num_vertices = record.num_vertices;
}

}  // namespace delone::construction
