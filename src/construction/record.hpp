// SPDX-License-Identifier: BSD-3-Clause
// What it takes to take back a transaction: as it proceeds, everything that it changes is noted as it was.
// The cells are the business of the engine (engine/undo_log.hpp), rows and points that of the sites.
#pragma once

#include "compiled/triangulation_engine.hpp"
#include "kernel/predicates.hpp"
#include "sites/site_set.hpp"

#include <delone/types.hpp>

#include <cstddef>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace delone::construction {

/// Cells, and those of them that are infinite, in no order.
struct CellLists {
  std::vector<CellId> all, infinite;
};

struct Record {
  sites::Journal sites;
  kernel::AffineHull affine_hull{1};
  std::size_t num_cell_of_vertex = 0;
  Index num_vertices = 0, only_vertex = 0;
  bool ids_told_of_timing = false;
  std::vector<std::pair<Index, bool>> were_visible;  ///< vertices that got their first cells or lost all
  bool engine_has_log = false;                       ///< the engine of the beginning has a log of its cells
  bool has_other_engine = false;                     ///< the engine is not the one of the beginning
  std::unique_ptr<compiled::TriangulationEngine> engine;  ///< that one, if there was one
  /// Its cells instead of it, if only the changes are wanted.
  std::optional<CellLists> cells_before;
};

}  // namespace delone::construction
