// SPDX-License-Identifier: BSD-3-Clause
// Replaces a conflict zone by the star of the new vertex (§2.6 of the report): one new cell per horizon facet, glued along the
// ridges of the horizon by rotating about them through the dead cells (Boissonnat and Teillaud 1993,
// doi:10.1016/0304-3975(93)90024-N).
#pragma once

#include "engine/conflict_zone.hpp"

namespace delone::engine {

/// Links facet `slot` of new cell N, made from facet `base` of dead cell A: rotates about the ridge opposite slots `base` and
/// `slot` of A, from A through the zone until the horizon, and links the new cell found there. A dead cell has the new cell
/// in place of the neighbor across each of its horizon facets.
template <int K>
void glue(CellStore<K>& cells, Index new_cell, Index dead, int base, int slot) {
  Index cell = dead;
  int cross = slot;  // the facet to leave `cell` by: it contains the ridge, as does the facet opposite slot `other`
  int other = base;
  for (;;) {
    const Index next = cells.neighbors(cell)[cross];
    if (cells.mark(next) != Mark::in_conflict) {  // a new cell, made from facet `cross`: the ridge is opposite slot `other`
      cells.neighbors(new_cell)[slot] = next;
      cells.neighbors(next)[other] = new_cell;
      return;
    }
    const int entry = cells.slot_of_neighbor(next, cell);
    cross = cells.slot_of_vertex(next, cells.vertices(cell)[other]);
    other = entry;
    cell = next;
  }
}

/// Kills the zone and creates the star of vertex v at q, whose cells `created` receives; takes the marks back. If memory or ids
/// run out it throws before anything has changed, the marks included.
template <int K, Geometry G>
void retriangulate(CellStore<K>& cells, G& geometry, Index v, const typename G::Query& q, const ConflictZone& zone,
                   std::vector<Index>& created) {
  const int k = cells.dimension();
  created.resize(zone.num_facets);
  cells.reserve_vacancies(zone.num_cells);
  geometry.reserve_cells(cells.reserve(zone.num_facets));

  for (std::size_t f = 0; f < zone.num_facets; ++f) {
    const HorizonFacet& facet = zone.horizon[f];
    const Index cell = cells.allocate();
    created[f] = cell;
    const Index survivor = cells.neighbors(facet.cell)[facet.slot];
    const Index* dead_vertices = cells.vertices(facet.cell);
    Index* vertices = cells.vertices(cell);
    Index* neighbors = cells.neighbors(cell);
    int infinite_slot = -1;
    for (int i = 0; i <= k; ++i) {
      vertices[i] = i == facet.slot ? v : dead_vertices[i];
      neighbors[i] = invalid_index;
      if (vertices[i] == index(infinite_vertex)) infinite_slot = i;
    }
    neighbors[facet.slot] = survivor;
    const int mirror = cells.slot_of_neighbor(survivor, facet.cell);
    cells.neighbors(survivor)[mirror] = cell;
    cells.neighbors(facet.cell)[facet.slot] = cell;
    geometry.create_across(cell, vertices, infinite_slot, facet.slot, q, {facet.cell, facet.value, dead_vertices[facet.slot]},
                           {survivor, facet.survivor_value, cells.vertices(survivor)[mirror]});
  }
  for (std::size_t f = 0; f < zone.num_facets; ++f) {
    const HorizonFacet& facet = zone.horizon[f];
    for (int slot = 0; slot <= k; ++slot)
      if (cells.neighbors(created[f])[slot] == invalid_index) glue(cells, created[f], facet.cell, facet.slot, slot);
  }
  unmark(cells, zone);
  for (std::size_t i = 0; i < zone.num_cells; ++i) cells.release(zone.cells[i]);
}

}  // namespace delone::engine
