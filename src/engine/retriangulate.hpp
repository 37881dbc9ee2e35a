// SPDX-License-Identifier: BSD-3-Clause
// Replaces a conflict zone by the star of the new vertex (§2.6 of the report): one new cell per horizon facet, linked along the
// ridges of the horizon by hashing; or as in the report, by rotating about them through the dead cells.
#pragma once

#include "engine/conflict_zone.hpp"
#include "engine/ridge_table.hpp"

#include <algorithm>
#include <iterator>

namespace delone::engine {

/// How many cells of a star are created at a time, so that their records, and those of the cells they are made from, stay in
/// the cache through all steps.
constexpr std::size_t star_block = 64;

/// Links the created cells of a star by rotating about each ridge, from the dead cell of the facet through the zone until the
/// horizon (Boissonnat and Teillaud 1993, doi:10.1016/0304-3975(93)90024-N). REQUIRES that no dead cell has been released.
template <int K>
void link_by_rotation(CellStore<K>& cells, std::span<const HorizonFacet> facets) {
  // Within the zone, a dead cell gets the new cell in place of the neighbor across each of its horizon facets.
  for (const HorizonFacet& facet : facets) cells.neighbors(facet.dead)[facet.slot] = facet.created;
  for (const HorizonFacet& facet : facets)
    for (int slot = 0; slot <= cells.dimension(); ++slot) {
      if (slot == facet.slot) continue;
      Index cell = facet.dead;
      int cross = slot;  // the facet to leave `cell` by: it contains the ridge, as does the facet opposite slot `other`
      int other = facet.slot;
      for (;;) {
        const Index next = cells.neighbors(cell)[cross];
        if (cells.mark(next) != Mark::in_conflict) {  // a new cell, made from facet `cross`
          cells.neighbors(facet.created)[slot] = next;
          break;
        }
        const int entry = cells.slot_of_neighbor(next, cell);
        cross = cells.slot_of_vertex(next, cells.vertices(cell)[other]);
        other = entry;
        cell = next;
      }
    }
}

/// Notes for each block of a star before which cell of the zone there is none that a later block is made from. Throws
/// std::bad_alloc.
inline void find_done(ConflictZone& zone) {
  const std::size_t num_blocks = (zone.num_facets + star_block - 1) / star_block;
  if (zone.done.size() < num_blocks) zone.done.resize(2 * num_blocks);
  auto needed = static_cast<Index>(zone.num_cells);
  for (std::size_t b = num_blocks; b-- > 0;) {
    zone.done[b] = needed;
    const std::size_t first = b * star_block;
    const std::size_t last = zone.is_ordered ? first + 1 : std::min(first + star_block, zone.num_facets);
    for (std::size_t f = first; f < last; ++f) needed = std::min(needed, zone.horizon[f].dead);
  }
}

/// The vertices of the zone that are on no horizon facet. Throws std::bad_alloc, and then changes nothing.
template <int K>
void find_swallowed(const CellStore<K>& cells, const ConflictZone& zone, std::vector<Index>& swallowed) {
  std::vector<Index> all, kept;
  for (std::size_t i = 0; i < zone.num_cells; ++i) {
    const Index* vertices = cells.vertices(zone.cells[i]);
    all.insert(all.end(), vertices, vertices + cells.dimension() + 1);
  }
  for (std::size_t f = 0; f < zone.num_facets; ++f) {
    const Index* vertices = cells.vertices(zone.cells[zone.horizon[f].dead]);
    for (int i = 0; i <= cells.dimension(); ++i)
      if (i != zone.horizon[f].slot) kept.push_back(vertices[i]);
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  std::sort(kept.begin(), kept.end());
  swallowed.clear();
  std::set_difference(all.begin(), all.end(), kept.begin(), kept.end(), std::back_inserter(swallowed));
}

/// Kills the zone and creates the star of vertex v at q; takes the marks back. If memory or ids run out it throws before
/// anything has changed, the marks included. `swallowed`, if any, receives the vertices that lose all their cells.
template <int K, Geometry G>
void retriangulate(CellStore<K>& cells, G& geometry, Index v, const typename G::Query& q, ConflictZone& zone,
                   RidgeTable& ridges, std::vector<Index>* swallowed) {
  const int k = cells.dimension();
  if (swallowed != nullptr) find_swallowed(cells, zone, *swallowed);
  ridges.reserve(zone.num_facets, k);
  geometry.reserve_star(v, std::min(zone.num_facets, star_block));
  cells.reserve_vacancies(zone.num_cells);
  cells.reserve(zone.num_facets);
  const std::span<HorizonFacet> facets{zone.horizon.data(), zone.num_facets};
  const bool releases_early = ridges.hashes() && facets.size() > star_block;
  if (releases_early) find_done(zone);
  std::size_t num_released = 0;
  const auto release = [&](std::size_t end) {
    for (; num_released < end; ++num_released) {
      const Index dead = zone.cells[num_released];
      zone.num_infinite += geometry.is_infinite(dead) ? 1 : 0;
      cells.release(dead);
    }
  };

  for (std::size_t first = 0; first < facets.size(); first += star_block) {
    const std::size_t last = std::min(first + star_block, facets.size());
    if constexpr (K == 2) {  // too few facets for vectors of ids
      for (std::size_t f = first; f < last; ++f) {
        if (f + 8 < facets.size()) cells.prefetch(facets[f + 8].survivor);
        HorizonFacet& facet = facets[f];
        const Index dead = zone.cells[facet.dead], survivor = facet.survivor, created = cells.allocate();
        const int slot = facet.slot;
        const Index* dead_vertices = cells.vertices(dead);
        Index* vertices = cells.vertices(created);
        for (int i = 0; i <= k; ++i) vertices[i] = dead_vertices[i];
        vertices[slot] = v;
        ridges.note(static_cast<std::uint32_t>(f), dead_vertices, slot);
        cells.neighbors(created)[slot] = survivor;
        const int mirror = cells.slot_of_neighbor(survivor, dead);
        cells.neighbors(survivor)[mirror] = created;
        facet.dead_value = zone.values[facet.dead];
        facet.dead = dead;
        facet.created = created;
        facet.dead_opposite = dead_vertices[slot];
        facet.survivor_opposite = cells.vertices(survivor)[mirror];
      }
    } else {
      cells.allocate(last - first, [facet = &facets[first]](Index created) mutable { facet++->created = created; });
      create_cells(cells.links(), v, {zone.cells.data(), zone.values.data()}, facets.subspan(first, last - first));
    }
    ridges.hash(cells, facets, first, last);
    for (const std::uint32_t f : geometry.create_star(v, q, facets.subspan(first, last - first))) {
      const Index cell = facets[first + f].created;
      geometry.create(cell, cells.vertices(cell), cells.infinite_slot(cell), facets[first + f].slot);
    }
    // The next block is written where dead cells were that nothing more is made from, while these are in the cache.
    if (releases_early) release(zone.done[first / star_block]);
  }
  if (ridges.hashes()) {
    ridges.link(cells, facets);
  } else {
    link_by_rotation(cells, facets);
  }
  // Slots that are allocated anew have no marks.
  for (std::size_t i = 0; i < zone.num_marked; ++i) cells.marks().set(zone.marked[i], Mark::unseen);
  release(zone.num_cells);
}

}  // namespace delone::engine
