// SPDX-License-Identifier: BSD-3-Clause
// What an edit has changed, how it is taken back, and ids without the gaps that edits leave.
#include "triangulation/triangulation_impl.hpp"

#include <algorithm>
#include <memory>
#include <new>
#include <utility>
#include <vector>

namespace delone {

Changes Triangulation::Impl::changes_since(const internal::EditRecord& before) const {
  Changes made;
  if (engine && !before.has_other_engine) {
    if (before.engine_has_log) engine->changed_cells(made.killed, made.born);
  } else if (engine || before.engine || affine_hull.dimension() != before.affine_hull.dimension() ||
             single_links[0] != before.only_vertex || !before.moved.empty()) {
    made.killed = cells_before(before);
    for (const CellId c : complex().all_cells()) made.born.push_back(c);
  }
  const auto is_gone = [&](Index v) { return row_of_vertex[v] == invalid_index; };
  const auto was_there = [&](Index v) { return v < before.num_row_of_vertex; };
  for (Index v = static_cast<Index>(before.num_row_of_vertex); v < row_of_vertex.size(); ++v)
    if (!is_gone(v)) made.came.push_back(VertexId{v});
  for (const internal::EditRecord::MovedRow& moved : before.rows)
    if (moved.before != invalid_vertex && was_there(index(moved.before)) && is_gone(index(moved.before)))
      made.gone.push_back(moved.before);
  std::vector<std::pair<Index, bool>> seen = before.were_visible;
  std::stable_sort(seen.begin(), seen.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const auto [v, was_visible] = seen[i];
    const bool is_first = i == 0 || seen[i - 1].first != v;
    if (is_first && was_there(v) && !is_gone(v) && was_visible != is_visible(v))
      (was_visible ? made.hid : made.reappeared).push_back(VertexId{v});
  }
  for (const Index v : before.moved)
    if (!is_gone(v)) made.moved.push_back(VertexId{v});
  const auto sort = [](auto& ids) {
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  };
  sort(made.killed);
  sort(made.born);
  sort(made.gone);
  sort(made.moved);
  return made;
}

/// The cells of before, where the engine is another one now.
std::vector<CellId> Triangulation::Impl::cells_before(const internal::EditRecord& before) {
  if (!before.engine)
    return before.affine_hull.dimension() == 0 ? std::vector{CellId{0}, CellId{1}} : std::vector<CellId>{};
  std::vector<CellId> gone, come, cells;
  if (before.engine_has_log) before.engine->changed_cells(gone, come);
  std::sort(come.begin(), come.end());
  for (const CellId c : before.engine->complex(0, {}).all_cells())
    if (!std::binary_search(come.begin(), come.end(), c)) cells.push_back(c);
  cells.insert(cells.end(), gone.begin(), gone.end());
  return cells;
}

void Triangulation::Impl::forget_undo() {
  if (!last_edit) return;
  if (engine) engine->keep_batch();
  last_edit.reset();
}

void Triangulation::Impl::undo() {
  require_idle();
  if (!last_edit) throw Error(Errc::invalid_argument, "there is no edit that can be undone");
  Changes made;
  if (records_changes) {
    made = changes_since(*last_edit);
    std::swap(made.killed, made.born);
    std::swap(made.came, made.gone);
    std::swap(made.hid, made.reappeared);
  }
  const std::unique_ptr<internal::EditRecord> taken = std::move(last_edit);
  roll_back(*taken);
  changes = std::move(made);
}

void Triangulation::Impl::roll_back(internal::EditRecord& before) noexcept {
  record = nullptr;
  for (std::size_t i = before.rows.size(); i-- > 0;) {
    const internal::EditRecord::MovedRow& moved = before.rows[i];
    try {
      if (shared_rows && moved.after != invalid_vertex) detach(moved.row);
      if (shared_rows && moved.before != invalid_vertex) assign(moved.row, index(moved.before));
    } catch (const std::bad_alloc&) {
      shared_rows.reset();
    }
    vertex_of_row[moved.row] = moved.before;
    if (moved.before != invalid_vertex) row_of_vertex[index(moved.before)] = moved.first_of_before;
    if (moved.after != invalid_vertex) row_of_vertex[index(moved.after)] = moved.first_of_after;
  }
  vertex_of_row.resize(before.num_rows);
  row_of_vertex.resize(before.num_row_of_vertex);
  num_rows_inserted = before.num_rows_inserted;
  has_ids_of_threads = before.had_ids_of_threads;
  for (std::size_t i = before.moved.size(); i-- > 0;)
    std::copy_n(before.points.begin() + static_cast<std::ptrdiff_t>(i * row_size()), row_size(),
                points.coordinates.begin() + static_cast<std::ptrdiff_t>(before.moved[i] * row_size()));
  points.coordinates.resize(before.num_coordinates);
  affine_hull = std::move(before.affine_hull);
  only_vertex() = before.only_vertex;
  hidden_points.reset();
  if (before.has_other_engine) {
    engine = std::move(before.engine);
    landmarks.reset();
  }
  // What has come to be visible is not; what was visible and has lost cells gets them back next.
  for (const auto& [v, was_visible] : before.were_visible)
    if (!was_visible && v < cell_of_vertex.size()) cell_of_vertex[v] = invalid_cell;
  if (engine && before.engine_has_log)
    engine->undo_batch(before.moved, [this](Index cell) {
      const Complex now = engine->complex(0, {});
      for (int i = 0; i <= now.affine_dimension(); ++i)
        cell_of_vertex[index(now.vertex(CellId{cell}, i))] = CellId{cell};
    });
  if (before.has_other_engine || !engine) {
    std::fill(cell_of_vertex.begin(), cell_of_vertex.end(), invalid_cell);
    find_cells_of_vertices();
  }
  cell_of_vertex.resize(before.num_cell_of_vertex, invalid_cell);
  num_vertices = before.num_vertices;
}

CompactedIds Triangulation::Impl::compact_ids() {
  require_idle();
  expand();
  CompactedIds ids;
  ids.vertices.assign(row_of_vertex.size(), invalid_vertex);
  ids.rows.assign(vertex_of_row.size(), CompactedIds::no_row);
  std::vector<Index> new_ids(row_of_vertex.size(), invalid_index);
  std::vector<Index> rows_of_vertices;
  std::vector<double> coordinates;
  std::vector<VertexId> vertices_of_rows;
  const std::size_t size = row_size();
  for (Index v = 0; v < new_ids.size(); ++v) {
    if (v > 0 && row_of_vertex[v] == invalid_index) continue;
    new_ids[v] = static_cast<Index>(rows_of_vertices.size());
    ids.vertices[v] = VertexId{new_ids[v]};
    rows_of_vertices.push_back(v > 0 ? invalid_index : 0);
    const auto from = points.coordinates.begin() + static_cast<std::ptrdiff_t>(v * size);
    coordinates.insert(coordinates.end(), from, from + static_cast<std::ptrdiff_t>(size));
  }
  for (std::size_t row = 0; row < vertex_of_row.size(); ++row) {
    if (vertex_of_row[row] == invalid_vertex) continue;
    const Index v = new_ids[index(vertex_of_row[row])];
    ids.rows[row] = vertices_of_rows.size();
    rows_of_vertices[v] = std::min(rows_of_vertices[v], static_cast<Index>(vertices_of_rows.size()));
    vertices_of_rows.push_back(VertexId{v});
  }
  cell_of_vertex.reserve(rows_of_vertices.size());
  points.coordinates.swap(coordinates);
  try {
    if (engine) engine->renumber_vertices(new_ids);
  } catch (...) {
    points.coordinates.swap(coordinates);
    throw;
  }
  row_of_vertex.swap(rows_of_vertices);
  vertex_of_row.swap(vertices_of_rows);
  forget_undo();
  forget_indexes();
  landmarks.reset();
  changes = {};
  if (affine_hull.dimension() == 0) only_vertex() = new_ids[only_vertex()];
  find_cells_of_vertices();
  return ids;
}

}  // namespace delone
