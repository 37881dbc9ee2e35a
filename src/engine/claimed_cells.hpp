// SPDX-License-Identifier: BSD-3-Clause
// Cells as a worker sees them among others: each is claimed before it is read (claims.hpp). Walks and
// searches are the same as in a single thread.
#pragma once

#include "engine/cell_store.hpp"
#include "engine/claims.hpp"

#include <delone/types.hpp>

#include <cstddef>

namespace delone::engine {

/// Only of cells that are held may anything be asked.
template <int K>
class ClaimedCells {
 public:
  ClaimedCells(const CellStore<K>& cells, Claims& claims) : cells_(cells), claims_(claims) {}

  int dimension() const { return cells_.dimension(); }
  Index vertex(Index cell, int i) const { return cells_.vertex(cell, i); }
  cells::CellVertices<K> vertices(Index cell) const { return cells_.vertices(cell); }
  const Index* vertices(Index cell, Index* room) const { return cells_.vertices(cell, room); }
  int infinite_slot(Index cell) const { return cells_.infinite_slot(cell); }

  /// The neighbors of a cell, which is owned then, and all of which are held. Throws Clash if that cannot be.
  const Index* neighbors(Index cell) const {
    claims_.own(cell);
    const Index* const across = cells_.neighbors(cell);
    Claims::Claiming claiming = begin_claims(static_cast<std::size_t>(dimension()) + 1);
    for (int i = 0; i <= dimension(); ++i) claiming.add(across[i]);
    end_claims(claiming);
    return across;
  }
  /// The same without claiming them: nothing of them may be read until they are claimed.
  const Index* unclaimed_neighbors(Index cell) const { return cells_.neighbors(cell); }
  void own(const Index* cells, std::size_t count, bool is_fenced) const {
    claims_.own(cells, count, is_fenced);
  }
  Claims::Claiming begin_claims(std::size_t most) const { return claims_.begin(most); }
  bool end_claims(const Claims::Claiming& claiming) const { return claims_.end(claiming); }

  [[gnu::always_inline]] void prefetch(Index cell) const {
    cells_.prefetch(cell);
    claims_.prefetch(cell);
  }
  [[gnu::always_inline]] void prefetch_neighbors(Index cell) const {
    const Index* const across = cells_.neighbors(cell);
    for (int i = 0; i <= dimension(); ++i) prefetch(across[i]);
  }
  /// Not that cell itself: it is not known before the infinite one is owned.
  [[gnu::always_inline]] void prefetch_across_hull(Index) const {}

 private:
  const CellStore<K>& cells_;
  Claims& claims_;
};

}  // namespace delone::engine
