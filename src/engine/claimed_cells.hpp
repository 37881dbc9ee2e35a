// SPDX-License-Identifier: BSD-3-Clause
// Cells as a worker sees them among others: each is claimed before it is read (claims.hpp). Walks and
// searches are the same as in a single thread.
#pragma once

#include "engine/cell_store.hpp"
#include "engine/claims.hpp"

#include <delone/types.hpp>

#include <cstddef>

namespace delone::engine {

/// Only what is said of cells that are held may be asked.
template <int K>
class ClaimedCells {
 public:
  ClaimedCells(const CellStore<K>& cells, Claims& claims) : cells_(cells), claims_(claims) {}

  int dimension() const { return cells_.dimension(); }
  Index vertex(Index cell, int i) const { return cells_.vertex(cell, i); }
  CellVertices<K> vertices(Index cell) const { return cells_.vertices(cell); }
  const Index* vertices(Index cell, Index* room) const { return cells_.vertices(cell, room); }
  int infinite_slot(Index cell) const { return cells_.infinite_slot(cell); }

  /// The neighbors of a cell, all of which are held then. Throws Clash if they cannot be.
  const Index* neighbors(Index cell) const {
    const Index* const across = cells_.neighbors(cell);
    claim(static_cast<std::size_t>(dimension()) + 1, [across](std::size_t i) { return across[i]; });
    return across;
  }
  /// The same without claiming them: nothing of them may be read.
  const Index* unclaimed_neighbors(Index cell) const { return cells_.neighbors(cell); }
  template <class CellAt>
  void claim(std::size_t count, CellAt&& cell_at) const {
    claims_.claim(count, cell_at);
  }

  [[gnu::always_inline]] void prefetch(Index cell) const { cells_.prefetch(cell); }
  [[gnu::always_inline]] void prefetch_neighbors(Index cell) const { cells_.prefetch_neighbors(cell); }
  [[gnu::always_inline]] void prefetch_across_hull(Index cell) const { cells_.prefetch_across_hull(cell); }

 private:
  const CellStore<K>& cells_;
  Claims& claims_;
};

}  // namespace delone::engine
