// SPDX-License-Identifier: BSD-3-Clause
// Rows of the input and the vertices at their points. Equal rows share a vertex.
//
// A row keeps its number and a vertex its id as long as they are there; neither is given again. Vertices may
// lose all their rows: then they have an id and a point, and nothing else.
#pragma once

#include "kernel/flat.hpp"
#include "sites/shared_rows.hpp"
#include "sites/vertex_points.hpp"

#include <delone/edit.hpp>
#include <delone/types.hpp>

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace delone::sites {

/// What a set of sites was, as far as it has changed since.
struct Journal {
  /// A row that went from one vertex to another (invalid_vertex: none), and the first rows that both had
  /// before.
  struct MovedRow {
    std::size_t row;
    VertexId before, after;
    Index first_of_before, first_of_after;
  };

  std::size_t num_coordinates = 0, num_rows = 0, num_present_rows = 0;
  Index num_ids = 0;
  std::vector<MovedRow> rows;  ///< of those that were there, in the order of time
  std::vector<Index> moved;    ///< vertices with other points …
  std::vector<double> points;  ///< … theirs before
};

class SiteSet {
 public:
  SiteSet(int dimension, kernel::RowForm form) : points_(dimension, form) {}

  VertexPoints& points() { return points_; }
  const VertexPoints& points() const { return points_; }
  const double* point(Index v) const { return points_.point(v); }

  /// One more than the number of the last row, and how many rows are at a vertex.
  std::size_t num_rows() const { return vertex_of_row_.size(); }
  std::size_t num_present_rows() const { return num_present_rows_; }
  /// One more than the largest id that a vertex with rows has or had.
  Index num_ids() const { return static_cast<Index>(row_of_vertex_.size()); }
  /// invalid_vertex for a row that was removed, or is not placed yet.
  VertexId vertex_of(std::size_t row) const { return vertex_of_row_[row]; }
  const std::vector<VertexId>& vertices_of_rows() const { return vertex_of_row_; }
  /// The first row at a vertex; invalid_index if it has none.
  Index row_of(Index v) const { return row_of_vertex_[v]; }
  bool has_rows(Index v) const { return row_of_vertex_[v] != invalid_index; }

  /// Makes room for so many more rows with vertices of their own. Throws std::bad_alloc.
  void reserve(std::size_t more);
  void reserve_one_more();
  /// The next rows, at no vertex yet. Throws Errc::too_many if there are not enough ids. Strong guarantee.
  std::size_t add_rows(std::size_t count);
  /// Takes back the last rows, which are at no vertex.
  void drop_rows(std::size_t num_left) { vertex_of_row_.resize(num_left); }
  /// Puts a row at a vertex. Strong guarantee; throws nothing if there is room, the row is not noted, and
  /// nobody has asked whether vertices have several rows.
  void assign(std::size_t row, Index v);
  /// Puts the rows in `rows`, which have no vertices yet, at vertices `first`, first + 1, …, which have no
  /// rows, in up to `threads` threads. Forgets which vertices have several.
  void assign_in_order(std::span<const Index> rows, std::size_t first_row, Index first, unsigned threads);
  /// Takes a row from its vertex.
  void detach(std::size_t row);
  /// Moves the rows of a vertex to another one.
  void merge(Index v, Index into);

  /// Whether several rows are at a vertex. The first call looks at all rows.
  bool has_several(Index v) { return shared_rows().has_several(v); }
  void forget_shared_rows() { shared_rows_.reset(); }

  /// Gives rows and vertices numbers without gaps, in their present order; `ids` receives what they become.
  /// renumber(new_ids) is called after points have moved to their new ids. If it throws, all is put back.
  template <class Renumber>
  void compact(CompactedIds& ids, Renumber&& renumber);
  void shrink_to_fit();

  /// From here on changes are noted in a journal, until end().
  void begin(Journal& journal);
  void end() { journal_ = nullptr; }
  /// Gives a vertex another point.
  void move(Index v, const double* point) {
    note_point(v);
    points_.set_point(v, point);
  }
  /// Notes the point of a vertex that gets another one. REQUIRES a journal.
  void note_point(Index v);
  /// Takes back all points that were noted from number `first` of the journal on.
  void restore_points(Journal& journal, std::size_t first) noexcept;
  /// Makes all what it was at the beginning of a journal.
  void roll_back(Journal& journal) noexcept;

 private:
  SharedRows& shared_rows() {
    if (!shared_rows_) shared_rows_.emplace(vertex_of_row_, row_of_vertex_);
    return *shared_rows_;
  }
  bool is_noted(std::size_t row) const { return journal_ != nullptr && row < journal_->num_rows; }

  VertexPoints points_;
  std::vector<Index> row_of_vertex_{0};  // vertex 0 is a dummy
  std::vector<VertexId> vertex_of_row_;
  std::size_t num_present_rows_ = 0;
  std::optional<SharedRows> shared_rows_;  // built on first use; a bulk assignment drops it
  Journal* journal_ = nullptr;
};

template <class Renumber>
void SiteSet::compact(CompactedIds& ids, Renumber&& renumber) {
  ids.vertices.assign(num_ids(), invalid_vertex);
  ids.rows.assign(num_rows(), CompactedIds::no_row);
  std::vector<Index> new_ids(num_ids(), invalid_index), rows_of_vertices;
  std::vector<double> coordinates;
  std::vector<VertexId> vertices_of_rows;
  const std::size_t size = points_.row_size();
  for (Index v = 0; v < new_ids.size(); ++v) {
    if (v > 0 && !has_rows(v)) continue;
    new_ids[v] = static_cast<Index>(rows_of_vertices.size());
    ids.vertices[v] = VertexId{new_ids[v]};
    rows_of_vertices.push_back(v > 0 ? invalid_index : 0);
    coordinates.insert(coordinates.end(), point(v), point(v) + size);
  }
  for (std::size_t row = 0; row < num_rows(); ++row) {
    if (vertex_of(row) == invalid_vertex) continue;
    const Index v = new_ids[index(vertex_of(row))];
    ids.rows[row] = vertices_of_rows.size();
    rows_of_vertices[v] = std::min(rows_of_vertices[v], static_cast<Index>(vertices_of_rows.size()));
    vertices_of_rows.push_back(VertexId{v});
  }
  points_.coordinates.swap(coordinates);
  try {
    renumber(std::span<const Index>(new_ids));
  } catch (...) {
    points_.coordinates.swap(coordinates);
    throw;
  }
  row_of_vertex_.swap(rows_of_vertices);
  vertex_of_row_.swap(vertices_of_rows);
  forget_shared_rows();
}

}  // namespace delone::sites
