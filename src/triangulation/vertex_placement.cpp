// SPDX-License-Identifier: BSD-3-Clause
// Vertices and their rows: how a vertex becomes part of the triangulation, and what is kept up to date by it.
#include "base/reserve_one_more.hpp"
#include "triangulation/triangulation_impl.hpp"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

namespace delone {

/// The row is one at vertex v. Throws std::bad_alloc where rows at vertices are known, and then changes
/// nothing.
void Triangulation::Impl::assign(std::size_t row, Index v) {
  const auto r = static_cast<Index>(row);
  if (v >= row_of_vertex.size()) row_of_vertex.resize(std::size_t{v} + 1, invalid_index);
  Index& first = row_of_vertex[v];
  if (record != nullptr) internal::reserve_one_more(record->rows);
  if (shared_rows && first != invalid_index) shared_rows->add(v, std::max(first, r));
  if (record != nullptr) record->rows.push_back({row, invalid_vertex, VertexId{v}, invalid_index, first});
  first = std::min(first, r);
  vertex_of_row[row] = VertexId{v};
  ++num_rows_inserted;
}

/// The row is at no vertex any more.
void Triangulation::Impl::detach(std::size_t row) {
  const VertexId v = vertex_of_row[row];
  Index& first = row_of_vertex[index(v)];
  internal::SharedRows& shared = known_shared_rows();
  if (record != nullptr) record->rows.push_back({row, v, invalid_vertex, first, invalid_index});
  Index next = invalid_index;  // the one to be taken out of the others
  if (first != row)
    next = static_cast<Index>(row);
  else if (shared.has_several(index(v)))
    next = shared.others(index(v)).front();
  if (first == row) first = next;
  if (next != invalid_index) shared.remove(index(v), next);
  vertex_of_row[row] = invalid_vertex;
  --num_rows_inserted;
}

internal::SharedRows& Triangulation::Impl::known_shared_rows() {
  if (!shared_rows) shared_rows = std::make_unique<internal::SharedRows>(vertex_of_row, row_of_vertex);
  return *shared_rows;
}

/// Of rows and hidden points: batches of insertions do not keep them up to date.
void Triangulation::Impl::forget_indexes() {
  shared_rows.reset();
  hidden_points.reset();
}

/// What progress functions call must not change the triangulation while it is edited.
void Triangulation::Impl::require_idle() const {
  if (record != nullptr) throw Error(Errc::invalid_argument, "the triangulation is being edited");
}

/// Before the vertex gets its first cells or loses all.
void Triangulation::Impl::note_visibility(Index v) {
  if (record != nullptr) record->were_visible.emplace_back(v, is_visible(v));
}

void Triangulation::Impl::replace_engine(std::unique_ptr<TriangulationEngine> next) {
  if (record != nullptr && !record->has_other_engine) {
    record->engine = std::move(engine);
    record->has_other_engine = true;
  }
  engine = std::move(next);
  landmarks.reset();
  hidden_points.reset();
}

/// Puts a hidden vertex where it belongs, if that is known of all others; walks from a cell.
void Triangulation::Impl::hide(Index v, Index start) {
  if (!hidden_points) return;
  hidden_points->reserve(std::size_t{points.last_vertex()} + 1, complex().num_cell_slots());
  hidden_points->add(v, engine->locate(points.point(v), start).cell);
}

/// The same for those of the cells that an insertion has replaced, and for the vertices that it has hidden.
void Triangulation::Impl::rehome_hidden_points(const engine::Change& change) {
  if (!hidden_points) return;
  std::vector<Index> homeless(change.swallowed.begin(), change.swallowed.end());
  for (const Index cell : change.gone) hidden_points->take(cell, homeless);
  for (const Index v : homeless) hide(v, change.made.front());
}

/// Makes vertex v, which has a point, part of the triangulation; outside the affine hull it raises the
/// dimension. Keeps cell_of_vertex up to date, which has room for v. Returns the vertex at the point,
/// invalid_index if v is hidden. If it throws, nothing has changed.
Index Triangulation::Impl::place(Index v, Index start) {
  if (affine_hull.dimension() < dimension) {
    kernel::AffineHull grown = affine_hull;
    if (grown.add(points.point(v))) {
      raise(v, std::move(grown));
      return v;
    }
  }
  if (!engine) return place_at_only_vertex(v);
  if (!engine->frame().contains(points.point(v))) {
    engine->set_frame(frame_with(points.point(v), points.point(v), 1.0));
    landmarks.reset();
  }
  const engine::Change change = engine->insert(v, start);
  if (cell_of_vertex.size() <= v) cell_of_vertex.resize(std::size_t{v} + 1, invalid_cell);
  if (change.is_done()) {
    note_visibility(v);
    for (const Index swallowed : change.swallowed) note_visibility(swallowed);
    update_cells(change.made);
    for (const Index swallowed : change.swallowed) cell_of_vertex[swallowed] = invalid_cell;
    num_vertices += 1 - static_cast<Index>(change.swallowed.size());
  }
  try {
    if (change.is_done()) rehome_hidden_points(change);
    if (change.outcome == engine::Outcome::hidden) hide(v, invalid_index);
  } catch (...) {
    hidden_points.reset();
    if (record != nullptr) throw;
  }
  return change.vertex;
}

/// Brings the cells of the vertices of new cells up to date.
void Triangulation::Impl::update_cells(std::span<const Index> made) {
  const Complex now = complex();
  for (const Index cell : made) {
    if (!now.is_cell(CellId{cell})) continue;
    for (int i = 0; i <= now.affine_dimension(); ++i)
      cell_of_vertex[index(now.vertex(CellId{cell}, i))] = CellId{cell};
  }
}

/// All points are in one place: the heaviest is the vertex, equal ones are duplicates, lighter ones hidden.
Index Triangulation::Impl::place_at_only_vertex(Index v) {
  const Index only = only_vertex();
  const int heavier = compare_with_only_vertex(points.point(v));
  if (heavier == 0) return only;
  if (cell_of_vertex.size() <= v) cell_of_vertex.resize(std::size_t{v} + 1, invalid_cell);
  if (heavier < 0) return invalid_index;
  note_visibility(v);
  note_visibility(only);
  cell_of_vertex[v] = std::exchange(cell_of_vertex[only], invalid_cell);
  only_vertex() = v;
  return v;
}

/// + for a heavier point, − for a lighter one.
int Triangulation::Impl::compare_with_only_vertex(const double* point) const {
  if (!weighted()) return 0;
  const double weight = point[ambient()], of_vertex = points.point(single_links[0])[ambient()];
  return weight > of_vertex ? 1 : weight < of_vertex ? -1 : 0;
}

/// Vertex v is outside the affine hull, which has `grown` by it.
void Triangulation::Impl::raise(Index v, kernel::AffineHull grown) {
  cell_of_vertex.reserve(std::size_t{points.last_vertex()} + 1);
  note_visibility(v);
  if (grown.dimension() > 0) {
    const double* const point = points.point(v);
    auto next = make_triangulation_engine(grown.axes(), points, frame_with(point, point, 1.0),
                                          engine ? engine->effort() : engine::Effort{},
                                          options.force_runtime_dimension);
    if (engine)
      next->jump(complex(), v);
    else
      next->seed(std::vector<Index>{only_vertex(), v});
    replace_engine(std::move(next));
  } else {
    only_vertex() = v;
  }
  affine_hull = std::move(grown);
  find_cells_of_vertices();
}

}  // namespace delone
