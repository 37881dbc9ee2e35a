// SPDX-License-Identifier: BSD-3-Clause
// What it takes to make an edit undone: as it proceeds, everything that it changes is noted as it was. The
// cells are the business of the engine (engine/undo_log.hpp).
#pragma once

#include "compiled/triangulation_engine.hpp"
#include "kernel/predicates.hpp"

#include <delone/types.hpp>

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace delone::internal {

struct EditRecord {
  /// A row that went from one vertex to another, either of them perhaps invalid_vertex; and their first rows.
  struct MovedRow {
    std::size_t row;
    VertexId before, after;
    Index first_of_before, first_of_after;
  };

  kernel::AffineHull affine_hull{1};
  std::size_t num_coordinates = 0, num_rows = 0, num_row_of_vertex = 0, num_rows_inserted = 0;
  std::size_t num_cell_of_vertex = 0;
  Index num_vertices = 0, only_vertex = 0;
  std::vector<MovedRow> rows;                        // in the order of time
  std::vector<std::pair<Index, bool>> were_visible;  // vertices that have come to have cells or lost them
  std::vector<Index> moved;                          // vertices with other points …
  std::vector<double> points;                        // … theirs before
  bool had_ids_of_threads = false;
  bool engine_has_log = false;
  bool has_other_engine = false;                // the engine is not the one of the beginning
  std::unique_ptr<TriangulationEngine> engine;  // that one, if there was one
};

}  // namespace delone::internal
