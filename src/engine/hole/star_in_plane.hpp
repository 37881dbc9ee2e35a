// SPDX-License-Identifier: BSD-3-Clause
// The cells around a vertex of the plane, in their order around it.
#pragma once

#include "engine/cell_store.hpp"

#include <delone/types.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace delone::engine {

/// Memory is kept from star to star.
class StarInPlane {
 public:
  /// A cell, the vertex that its edge begins with, seen counterclockwise, and the cell beyond that edge, in
  /// whose slot `mirror` this one is. The edge ends where that of the next sector begins.
  struct Sector {
    Index cell, vertex, survivor;
    int mirror;
  };

  /// The star of vertex v, one of whose cells is `cell`. Returns false as soon as a cell is infinite; then
  /// sectors are missing. Throws std::bad_alloc.
  template <class G>
  bool find(const CellStore<2>& cells, const G& geometry, Index v, Index cell) {
    sectors_.clear();
    clockwise_.clear();
    // Returns the slot of v, or −1 if the vertex of the sector is infinite.
    const auto add = [&](Index next, std::vector<Sector>& sectors) {
      cells.prefetch_neighbors(next);
      const int slot = cells.slot_of_vertex(next, v);
      const Index vertex = cells.vertex(next, after(slot));
      geometry.prefetch_row(vertex);
      sectors.push_back({next, vertex, cells.neighbors(next)[slot], 0});
      return vertex == index(infinite_vertex) ? -1 : slot;
    };
    int slot = add(cell, sectors_);
    if (slot < 0) return false;
    // To both sides in turn, as each step waits for memory. The neighbor opposite the vertex where the edge
    // of a cell begins is the next one counterclockwise.
    Index ahead = cells.neighbors(cell)[after(slot)], behind = cells.neighbors(cell)[after(after(slot))];
    while (ahead != behind) {
      if ((slot = add(ahead, sectors_)) < 0) return false;
      ahead = cells.neighbors(ahead)[after(slot)];
      if (ahead == behind) break;
      if ((slot = add(behind, clockwise_)) < 0) return false;
      behind = cells.neighbors(behind)[after(after(slot))];
    }
    if (add(ahead, sectors_) < 0) return false;
    sectors_.insert(sectors_.end(), clockwise_.rbegin(), clockwise_.rend());
    for (Sector& sector : sectors_) sector.mirror = cells.slot_of_neighbor(sector.survivor, sector.cell);
    return true;
  }
  std::span<const Sector> sectors() const { return sectors_; }
  std::size_t size() const { return sectors_.size(); }

 private:
  static int after(int slot) { return slot == 2 ? 0 : slot + 1; }
  std::vector<Sector> sectors_, clockwise_;
};

}  // namespace delone::engine
