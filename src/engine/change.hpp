// SPDX-License-Identifier: BSD-3-Clause
// What an operation on vertices has done to the cells.
#pragma once

#include <delone/types.hpp>

#include <cstdint>
#include <span>

namespace delone::engine {

enum class Outcome : std::uint8_t {
  done,
  duplicate,  ///< not inserted: a vertex is at the point, with the same weight
  hidden,     ///< not inserted: no cell is in conflict with the vertex
  interior,   ///< the same, and a filter has shown that it is on the hyperplane of no cell
  flat,       ///< not removed: all other vertices lie in a hyperplane
  costly,     ///< not removed, or not moved in place: another way costs less
};

/// Nothing has changed unless the outcome is `done`, but where all vertices may have moved: then the cells
/// are to be put back, or given up. The spans hold until the next operation.
struct Change {
  Outcome outcome = Outcome::done;
  Index vertex = invalid_index;  ///< of an insertion: the vertex that is at the point now
  std::span<const Index> removed_cells =
      {};  ///< the cells that gave way, or whose vertex has moved; some twice
  std::span<const Index> created_cells = {};  ///< the new cells, some in the slots of those
  std::span<const Index> swallowed = {};  ///< the vertices that an insertion took all cells from, if tracked

  bool is_done() const { return outcome == Outcome::done; }
  bool is_hidden() const { return outcome == Outcome::hidden || outcome == Outcome::interior; }
};

}  // namespace delone::engine
