// SPDX-License-Identifier: BSD-3-Clause
// What all kinds of triangulations share: points to vertices, affine dimensions, duplicates, hidden points,
// rows; the engine does the rest.
//
// Every row that is there has a vertex id, its own or that of an equal row. Points with weights, and those
// for which vertices are furthest, may be hidden, at once or by later insertions and edits: their ids keep
// their points and have no cell. Insertions leave hidden points hidden, as more points only lower the lifted
// surface; edits may bring them back. Ids of vertices without rows are not used again.
#pragma once

#include "compiled/compact_triangulation.hpp"
#include "compiled/dispatch.hpp"
#include "kernel/predicates.hpp"
#include "triangulation/edit_record.hpp"
#include "triangulation/hidden_points.hpp"
#include "triangulation/landmarks.hpp"
#include "triangulation/shared_rows.hpp"

#include <delone/triangulation.hpp>

#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace delone {

struct Triangulation::Impl {
  Impl(int d, kernel::RowForm form, const Options& given);
  ~Impl();
  /// A deep copy.
  std::unique_ptr<Impl> clone() const;

  int dimension;
  Options options;
  VertexPoints points;
  kernel::AffineHull affine_hull;
  std::unique_ptr<TriangulationEngine>
      engine;  // none while the affine dimension is below 1, and after compact()
  std::unique_ptr<CompactTriangulation> compacted;  // after compact(), until the next insertion
  std::vector<CellId> cell_of_vertex;               // by vertex id; invalid_cell for hidden points
  std::vector<Index> row_of_vertex{0};              // the first row at each vertex; invalid_index without any
  std::vector<VertexId> vertex_of_row;              // invalid_vertex for a row that was removed
  std::size_t num_rows_inserted = 0;
  Index num_vertices = 0;           // those that have cells
  bool has_ids_of_threads = false;  // a batch was large enough for several threads: ids of cells may tell
  Statistics statistics;
  std::unique_ptr<internal::Landmarks>
      landmarks;  // from an insertion without hint on, until the frame changes

  // For edits. The indexes are made by the first edit that needs them.
  std::unique_ptr<internal::SharedRows> shared_rows;
  std::unique_ptr<internal::HiddenPoints> hidden_points;
  bool records_changes = false, records_undo = false;
  Changes changes;
  std::unique_ptr<internal::EditRecord> last_edit;  // if it can be undone
  internal::EditRecord* record = nullptr;           // of the edit that is going on

  /// The links of the complex of one point, a finite and an infinite cell of one vertex each.
  Index single_links[4] = {0, 1, 0, 0};
  Index& only_vertex() { return single_links[0]; }

  std::size_t ambient() const { return static_cast<std::size_t>(dimension); }
  /// A row of the input as the engine reads it: the coordinates, and the weight if points have one.
  std::size_t row_size() const { return points.row_size(); }
  bool weighted() const { return points.weighted(); }
  bool may_hide() const { return points.form != kernel::RowForm::point; }
  bool is_visible(Index v) const { return v < cell_of_vertex.size() && cell_of_vertex[v] != invalid_cell; }

  /// `weights`: one per point, or none: all are 0. `release`, if there is one, is called when the coordinates
  /// are not needed any more, before most cells are created.
  void insert_range(std::span<const double> coordinates, std::span<const double> weights,
                    const std::function<void()>& release = {});
  InsertResult insert(std::span<const double> point, double weight, std::optional<CellId> hint);
  /// `start`: a cell near the first point that is inserted, if nothing else is edited.
  void edit(const RowEdits& edits, Index start = invalid_index);
  void undo();
  void forget_undo();
  CompactedIds compact_ids();
  void compact();
  void sort_cells();
  /// The triangulation, if the affine dimension is at least 1.
  const TriangulationQueries* queries() const {
    return engine ? static_cast<const TriangulationQueries*>(engine.get()) : compacted.get();
  }
  Complex complex() const;
  /// Where to start a walk to a point without a hint: a cell, or invalid_index for where the last insertion
  /// was.
  Index start_near(const double* point) const;
  /// Throws unless a row is one, there or removed.
  void require_row(std::size_t row) const;
  bool is_hidden(std::size_t row) const;  // throws as require_row()
  std::size_t num_hidden() const;
  std::vector<std::size_t> hidden_rows() const;

  /// A query of d coordinates and its weight, checked, as a row. REQUIRES that `row` outlives the use.
  const double* checked_query(std::span<const double> query, double weight, std::vector<double>& row) const;
  Index checked_hint(std::optional<CellId> hint) const;
  Index checked_vertex(VertexId v) const;

  std::vector<CellId> conflict_zone(std::span<const double> query, double weight,
                                    std::optional<CellId> hint) const;
  Sign in_sphere(CellId cell, std::span<const double> query, double weight) const;

 private:
  void check_finite(std::span<const double> coordinates, std::span<const double> weights) const;
  std::size_t add_rows(std::size_t rows);
  Index append(const double* point);
  void drop_last_vertex();
  void assign(std::size_t row, Index v);
  void detach(std::size_t row);
  internal::SharedRows& known_shared_rows();
  Index insert_row(std::size_t row, const double* point, Index start);
  Index place(Index v, Index start);
  Index place_at_only_vertex(Index v);
  void raise(Index v, kernel::AffineHull grown);
  void expand();
  void add_landmarks(Index first, Index last);
  InsertResult insert_on_record(std::span<const double> point, double weight, Index start);
  void update_cells(std::span<const Index> made);
  Index lone_vertex_of(std::size_t row);
  engine::Outcome remove_at_once(std::size_t row);
  bool move_at_once(std::size_t row, std::span<const double> to);
  void forget_indexes();
  void note_visibility(Index v);
  void require_idle() const;
  void replace_engine(std::unique_ptr<TriangulationEngine> next);
  void hide(Index v, Index start);
  void rehome_hidden_points(const engine::Change& change);
  void roll_back(internal::EditRecord& before) noexcept;
  Changes changes_since(const internal::EditRecord& before) const;
  static std::vector<CellId> cells_before(const internal::EditRecord& before);
  void find_cells_of_vertices();
  geometry::Frame frame_with(const double* low, const double* high, double margin) const;
  std::unique_ptr<TriangulationEngine> new_engine(const double* low, const double* high,
                                                  const engine::Effort& effort);
  int compare_with_only_vertex(const double* point) const;

  class BatchInsertion;
  class Editing;
};

}  // namespace delone
